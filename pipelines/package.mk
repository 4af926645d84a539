# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian package, build/package/libbreast_VERSION_ARCHITECTURE.deb: programs for every x86-64 processor, built apart from those of
# this machine. clean-root (root, network, debootstrap) installs it in an empty Debian 12 and runs the demonstration there.
.PHONY: clean-root
package: $(ROOT)build/.packages
	cmake --preset package > build/package.log 2>&1 || { cat build/package.log >&2; exit 1; }
	cmake --build build/package -j $$(nproc)
	cd build/package && cpack -G DEB > cpack.log || { cat cpack.log >&2; exit 1; }
	@ls build/package/libbreast_*.deb
clean-root: package
	tests/tools/clean-root.sh build/package/libbreast_*.deb
