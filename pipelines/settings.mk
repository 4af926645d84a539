# SPDX-License-Identifier: GPL-3.0-or-later
# The settings (settings.tsv). Each can be given on the command line: make -f Makefile.pipeline MATERIALS=wellman
# They are read, checked, completed from the case file and the defaults, and refused in one line by `cases settings`, before make
# or a shell expands them; nothing in them is executed.
comma := ,
define newline


endef
# Data are read by the program `cases`, which make calls with $(call ask,COMMAND). The answer consists of lines of make, separated
# by a byte that $(shell) does not change, or it is an error message.
line_end := $(shell printf '\036')
answer = $(if $(filter 0,$(.SHELLSTATUS)),$(eval $(subst $(line_end),$(newline),$1)),$(error $(filter-out cases:,$1)$(outdated)))
ask = $(call answer,$(shell $1 --quiet 2>&1))
outdated = $(if $(if $(INSTALLED),,$(shell find $(SOURCES) -newer $(BIN)/cases)),; \
  the programs are older than their sources: make -f $(PIPELINE) build)
quoted = '$(subst ','\'',$1)'

# $(shell) would end its command at a line break, before `cases` could refuse it.
$(foreach v,$(given),$(if $(findstring $(newline),$(value $v)),$(error $v: a line break may not stand in it; give a name \
  without it$(comma) or a link that has such a name (ln -s))))
# What is given on the command line is passed on with its values before any expansion.
$(call ask,$(BIN)/cases settings $(PIPELINES) $(BIN) $(if $(INSTALLED),installed,built) $(call quoted,$(goals)) $(if $(planning),0,$$PPID) \
  $(foreach v,$(given),$(call quoted,$v=$(value $v))))

# Every table, verdict and page is made by tabulate, from reports, tables and shapes.
tabulate = $(TABULATE) --quiet --pipelines $(PIPELINES)
# The supports of the breast at its back; if empty, those with which the material set was found, or a held wall and a free cut.
SUPPORT = $(addprefix --wall ,$(WALL)) $(addprefix --cut ,$(CUT))
# As printed in the paper: cuboid, skin as a layer of elements, plain invariants, free cut.
PRINTED_HEXMESH = --template cuboid --elements $(ELEMENTS) --skin-as layer
PRINTED_MECHANICS = --materials $(MATERIALS) --invariants plain --element q1p0
# The plates stop at the first of these limits.
STOPS = --reduction $(REDUCTION) $(addprefix --pressure ,$(PRESSURE))

# Options of every program: its report and its share of the cores. Where all others wait, a stage has all (but not in a cohort).
share = --threads $$($(PIPELINES)/threads.sh)
alone = --threads $$($(PIPELINES)/threads.sh $(if $(filter 0,$(MAKELEVEL)),alone))
common = --report $(basename $@).json $(share)
