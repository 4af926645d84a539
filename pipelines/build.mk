# SPDX-License-Identifier: GPL-3.0-or-later
# Set-up and build, done before make looks at the stages: make remakes an included file first and then
# starts again, so that the programs' own times decide which stages are out of date. (As ordinary
# prerequisites, programs that a build leaves untouched would look older than the build.)
# An installation (pipelines/installed.mk) contains its programs: nothing is set up or built.
BUILD := $(ROOT)build/release
BIN := $(or $(INSTALLED),$(BUILD)/bin)
goals = $(or $(MAKECMDGOALS),$(.DEFAULT_GOAL))
# `make -n` and `make -q` only plan: they use the programs as they are, whereas make would build an included file first.
letters := $(filter-out -%,$(firstword $(MAKEFLAGS)))
planning := $(findstring n,$(letters))$(findstring q,$(letters))
# The settings are checked by the program `cases` before make or a shell expands them and before anything is computed. These
# targets have no settings; for all others `cases` is built first, alone, and then the makefiles are read from the beginning.
without_settings := help $(if $(INSTALLED),,setup build package api)
wanted := $(filter-out $(without_settings),$(goals))
ready := $(and $(wanted),$(wildcard $(BIN)/cases))
# Names given on the command line. Until their values have been checked, no recipe gets them: make would expand them first.
given := $(filter-out -% .% MAKE% GNUMAKEFLAGS,$(foreach v,$(.VARIABLES),$(if $(findstring command,$(origin $v)),$v)))
ifeq ($(ready),)
unexport $(given)
endif

.PHONY: FORCE
FORCE:

ifndef INSTALLED
SOURCES := $(shell find $(addprefix $(ROOT),libbreast tools python cmake) $(PIPELINES)/materials -type f -not -name '.*' -not -name '*.pyc') \
  $(ROOT)CMakeLists.txt $(ROOT)CMakePresets.json
PRESET_BUILD ?= release
# The presets that build in build/release.
$(if $(filter-out release ci,$(value PRESET_BUILD)),$(error PRESET_BUILD: '$(value PRESET_BUILD)' is neither release nor ci))

# The packages for running (.packages), and those that only the tests or the Debian package need besides.
packages := $(addprefix $(ROOT)build/,.packages .packages-check .packages-package)
$(packages): $(PIPELINES)/packages.txt $(PIPELINES)/setup.sh
	@mkdir -p $(@D)
	$(PIPELINES)/setup.sh $(patsubst .packages-%,%,$(@F:.packages=run))
	@touch $@
# $(call build,TARGETS): never two at once in a folder.
define build
(cd $(or $(ROOT),.) && cmake --preset $(PRESET_BUILD) > build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; })
flock $(BUILD) cmake --build $(BUILD) --target $1 -j $$(nproc)
endef
# Programs that the chain does without and that take the compiler long: each is built when a rule first asks for it, and from then on
# with all others.
LATER := calibrate-softness export-deck export-slicer identify
$(LATER:%=$(BIN)/%):
	flock $(BUILD) cmake --build $(BUILD) --target $(@F) -j $$(nproc)
$(ROOT)build/cases.mk: $(ROOT)build/.packages FORCE
	$(call build,cases)
	@echo "# Written when the program that checks the settings was first built." > $@
.PHONY: setup build
setup: $(packages)
build: $(LATER:%=$(BIN)/%)
-include $(wildcard $(ROOT)tests/package.mk)

ifneq ($(planning),)
-include $(wildcard $(ROOT)build/built-$(PRESET_BUILD).mk)
# The plan of a first run ends with `cases`, which is needed to plan the rest.
$(if $(ready),,$(wanted)): $(ROOT)build/cases.mk
else
$(ROOT)build/built-$(PRESET_BUILD).mk: $(ROOT)build/.packages $(SOURCES)
	$(call build,chain_programs $(filter $(LATER),$(notdir $(wildcard $(BIN)/*))))
	@echo "# Written when the programs in $(BUILD) were last built." > $@
ifneq ($(if $(ready),,$(wanted)),)
include $(ROOT)build/cases.mk
else ifneq ($(filter-out help setup clean where package api,$(goals)),)
include $(ROOT)build/built-$(PRESET_BUILD).mk
endif
endif
endif
