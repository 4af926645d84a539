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

# The scan; the tumour and the material set if a rule makes them (those of users are known by content).
MR_FILES := $(MR) $(if $(wildcard $(MR)/.),$(wildcard $(MR)/*))
MADE_TUMOUR := $(filter $(RUNS)/%,$(TUMOUR))
MADE_MATERIALS := $(filter $(RUN)/%,$(MATERIALS))
# What only the run of a tumour has: another mesh may have none.
of_a_tumour := $(addprefix $(RUN)/,curve.vtp curve.tsv curve.json .curve.settings band.vtp band.tsv band-curve.tsv band.json \
  figures/*-matching.png slicer/scene.mrml slicer/column-* slicer/curve-*)
# Contours for checking the labels; a program that replaces segment need not draw them.
contours := $(if $(filter $(BIN)/segment,$(SEGMENT)),--overlay $(RUN)/contours.png)

# What a row of a study may change, each a column of its table (studies.mk).
study_columns := segment fit hexmesh prone mechanics wall cut compress plates slopes materials content
its_segment = $(SEGMENT_OPTIONS)
its_fit = $(FIT_OPTIONS)
its_hexmesh = $(HEXMESH_OPTIONS)
its_prone = $(PRONE)
its_mechanics = $(MECHANICS)
its_wall = $(WALL)
its_cut = $(CUT)
its_compress = $(COMPRESS_OPTIONS)
its_slopes := fat,fibroglandular,skin
its_materials = $(MATERIALS)
its_content = $(content_MATERIALS)

# The options of the stages, and what is remembered of them: program, options, contents of files that users edit.
its_model = $(its_mechanics) $(addprefix --wall ,$(its_wall)) $(addprefix --cut ,$(its_cut))
labels_options = --side $(SIDE) $(addprefix --series ,$(SERIES)) $(addprefix --chest-wall ,$(CHEST_WALL)) $(its_segment)
labels_settings = $(SEGMENT) $(call named,$(MR)) $(labels_options) $(content_CHEST_WALL)
geometry_options = $(its_fit)
geometry_settings = $(FIT_HERMITE) $(geometry_options)
mesh_options = $(its_hexmesh) $(if $(findstring --tumour,$(its_hexmesh)),,--tumour $(TUMOUR))
mesh_settings = $(HEXMESH) $(mesh_options) $(content_TUMOUR)
reference_options = $(its_prone) $(its_model)
reference_settings = $(BACKWARD) $(reference_options) $(its_content)
supine_options = $(its_model)
supine_settings = $(FORWARD) $(supine_options) $(its_content)
# The plates have the distance that the case asks for, or their true positions.
plates_for = $(if $(its_plates),$(call same_plates,$(TRUTH_AT)-fine-$1.json) $(if $(body_slides),$(wordlist 2,3,$(truth_edge_$1))),$(STOPS))
press = --at-least $(AT_LEAST) $(its_compress) $(its_model)
cc_options = $(call plates_for,cc) $(press)
cc_settings = $(COMPRESS) $(if $(its_plates),,$(STOPS)) $(press) $(its_content)
mlo_options = $(call plates_for,mlo) $(press)
mlo_settings = $(cc_settings)
cc-mammogram_options = $(PROJECT_OPTIONS)
cc-mammogram_settings = $(PROJECT) $(PROJECT_OPTIONS)
mlo-mammogram_options = $(PROJECT_OPTIONS)
mlo-mammogram_settings = $(PROJECT) $(PROJECT_OPTIONS)
curve_settings = $(CC2MLO)
slopes_options = $(its_prone) $(its_model) --parameters $(its_slopes)
slopes_settings = $(SENSITIVITY) $(slopes_options)

# Options of every program: its report and its share of the cores. Where all others wait, a stage has all (but not in a cohort).
share = --threads $$($(PIPELINES)/threads.sh)
alone = --threads $$($(PIPELINES)/threads.sh $(if $(filter 0,$(MAKELEVEL)),alone))
common = --report $(basename $@).json $(share)
common_alone = --report $(basename $@).json $(alone)
# The report of a stage whose file has another name.
common_of = --report $(@D)/$1.json $(share)
