# Set-up and build, done before make looks at the stages: make remakes an included file first and then
# starts again, so that the programs' own times decide which stages are out of date. (As ordinary
# prerequisites, programs that a build leaves untouched would look older than the build.)
SOURCES := $(shell find libbreast tools cmake pipelines/materials -type f -not -name '.*') \
  CMakeLists.txt CMakePresets.json

# `make -n` and `make -q` only plan: they take the programs as they are, where make would build an included file first.
letters := $(filter-out -%,$(firstword $(MAKEFLAGS)))
planning := $(findstring n,$(letters))$(findstring q,$(letters))
ifneq ($(planning),)
-include $(wildcard build/built-$(PRESET_BUILD).mk)
else ifneq ($(filter-out help setup clean,$(or $(MAKECMDGOALS),$(.DEFAULT_GOAL))),)
include build/built-$(PRESET_BUILD).mk
endif

build/.packages: pipelines/packages.txt pipelines/setup.sh
	@mkdir -p $(@D)
	pipelines/setup.sh
	@touch $@

ifeq ($(planning),)
build/built-$(PRESET_BUILD).mk: build/.packages $(SOURCES)
	cmake --preset $(PRESET_BUILD) > build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
	cmake --build $(BUILD) --target programs -j $$(nproc)
	@echo "# Written when the programs in $(BUILD) were last built." > $@
endif
