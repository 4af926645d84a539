# SPDX-License-Identifier: GPL-3.0-or-later
# Set-up and build, done before make looks at the stages: make remakes an included file first and then
# starts again, so that the programs' own times decide which stages are out of date. (As ordinary
# prerequisites, programs that a build leaves untouched would look older than the build.)
# An installation (pipelines/installed.mk) contains its programs: nothing is set up or built. It cannot make the targets that
# build programs or that read or write the source tree.
source_goals := check fuzz release-check faults full-disk whole-tools clean-root slurm setup build package validation validation-page \
  stability% compare calibrate calibrate-invivo identification budget band-check band-truth matching page-check
ifdef INSTALLED
SOURCES :=
$(call refuse_goals,$(INSTALLED),$(source_goals),needs the source tree of libbreast$(comma) which is not installed)
else
SOURCES := $(shell find $(addprefix $(ROOT),libbreast tools cmake) $(PIPELINES)/materials -type f -not -name '.*') \
  $(ROOT)CMakeLists.txt $(ROOT)CMakePresets.json
endif
$(eval PRESET_BUILD ?= $(default_PRESET_BUILD))

# `make -n` and `make -q` only plan: they use the programs as they are, whereas make would build an included file first.
letters := $(filter-out -%,$(firstword $(MAKEFLAGS)))
planning := $(findstring n,$(letters))$(findstring q,$(letters))
ifdef INSTALLED
else ifneq ($(planning),)
-include $(wildcard $(ROOT)build/built-$(PRESET_BUILD).mk)
else ifneq ($(filter-out help setup clean where settings package,$(goals)),)
include $(ROOT)build/built-$(PRESET_BUILD).mk
endif

$(ROOT)build/.packages: $(PIPELINES)/packages.txt $(PIPELINES)/setup.sh
	@mkdir -p $(@D)
	$(PIPELINES)/setup.sh
	@touch $@

ifeq ($(planning)$(INSTALLED),)
$(ROOT)build/built-$(PRESET_BUILD).mk: $(ROOT)build/.packages $(SOURCES)
	(cd $(or $(ROOT),.) && cmake --preset $(PRESET_BUILD) > build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; })
	cmake --build $(BUILD) --target programs -j $$(nproc)
	@echo "# Written when the programs in $(BUILD) were last built." > $@
endif
