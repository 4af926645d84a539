# SPDX-License-Identifier: GPL-3.0-or-later
# What users give, on the command line, in the environment or in a case file, is data. `cases given` refuses in one line a name that is
# no setting, and every value that make or a shell would read as code, before make expands any of them.
comma := ,
define newline


endef
quoted = '$(subst ','\'',$1)'
# $(call said,$(shell COMMAND)): what the program says; make ends with its message if it refuses.
said = $(if $(filter 0,$(.SHELLSTATUS)),$1,$(error $(filter-out cases:,$1)$(outdated)))
outdated = $(if $(if $(INSTALLED),,$(shell find $(SOURCES) -newer $(BIN)/cases)),; \
  the programs are older than their sources: make -f $(PIPELINE) build)

# $(shell) would end its command at a line break, before `cases` could refuse it.
$(foreach v,$(given),$(if $(findstring $(newline),$(value $v)),$(error $v: a line break may not stand in it; give a name \
  without it$(comma) or a link that has such a name (ln -s))))
$(call said,$(shell $(BIN)/cases given $(PIPELINES) $(foreach v,$(given),$(call quoted,$v=$(value $v))) --quiet 2>&1))

# The lines of a case file, KEY = VALUE, as a makefile that overrides the environment and is overridden by the command line.
RUNS ?= runs
CASE_FILE ?=
include $(if $(CASE_FILE),$(call said,$(shell $(BIN)/cases case-file $(PIPELINES) $(CASE_FILE) $(RUNS)/.make --quiet 2>&1)))
