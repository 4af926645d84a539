# Set-up and build. A program is as new as its last link, so a stage runs again only when its own program
# changed.
SOURCES := $(shell find libbreast tools tests cmake pipelines/materials -type f -not -name '.*') \
  CMakeLists.txt CMakePresets.json

build/.packages: pipelines/packages.txt pipelines/setup.sh
	@mkdir -p $(@D)
	pipelines/setup.sh
	@touch $@

build/.built: build/.packages $(SOURCES)
	cmake --preset $(PRESET_BUILD) > build/configure.log || { cat build/configure.log >&2; exit 1; }
	cmake --build $(BUILD) -j $$(nproc)
	@touch $@

$(PROGRAMS): build/.built ;
