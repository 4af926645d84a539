# SPDX-License-Identifier: GPL-3.0-or-later
# build/package/libbreast_VERSION_ARCHITECTURE.deb: programs for every x86-64 processor, built apart from those of this machine.
package: $(ROOT)build/.packages-package
	cmake --preset package > build/package.log 2>&1 || { cat build/package.log >&2; exit 1; }
	cmake --build build/package -j $$(nproc)
	cd build/package && cpack -G DEB > cpack.log || { cat cpack.log >&2; exit 1; }
	@ls build/package/libbreast_*.deb
# build/api/cpp and build/api/python, for which no program is built; `check` makes them too, as a test.
api: | $(ROOT)build/.packages-check
	tests/tools/api.sh $(ROOT)build/api
.PHONY: package api
