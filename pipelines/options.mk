# SPDX-License-Identifier: GPL-3.0-or-later
# What follows from the settings: what this case cannot have is refused, and every stage has its options.

# Empty if there is a tumour to follow.
no_tumour := $(if $(findstring --tumour,$(HEXMESH_OPTIONS)),$(findstring --tumour none,$(HEXMESH_OPTIONS)),$(filter none,$(TUMOUR)))
# `cases check` refuses in one line values that no program would accept, a target that the case cannot have, a folder that belongs to
# another scan, and a case that another make makes with other settings.
settings := $(shell grep -o '^[A-Z0-9_]*' $(PIPELINES)/settings.tsv)
facts := installed=$(if $(INSTALLED),yes) phantom=$(phantom) body_slides=$(body_slides) no_tumour=$(if $(no_tumour),yes)
$(call said,$(shell $(BIN)/cases check $(PIPELINES) $(if $(planning),0,$$PPID) $(call quoted,goals=$(goals)) $(call quoted,given=$(given)) \
  $(facts) $(foreach s,$(settings),$(call quoted,$s=$($s))) --quiet 2>&1))

# Stages know the files that users edit by a digest: with an older date a file may be another one, and a touched one is the same.
content = $(foreach f,$(wildcard $(filter-out $(RUNS)/%,$1)),$(shell [ ! -f $f ] || sha256sum < $f | cut -c 1-12))
content_MATERIALS := $(call content,$(call set_of,$(MATERIALS)))
content_TUMOUR := $(call content,$(TUMOUR))

# With landmarks in a second posture, or a supine scan of the same patient, the set MATERIALS is the prior, and the chain runs with the
# set that `identify` finds.
ifneq ($(LANDMARKS)$(SUPINE),)
prior_set := $(MATERIALS)
override MATERIALS := $(RUN)/identified.tsv
endif
# Parts of the model that the user leaves out; studies/leaveout.tsv measures the effect of each.
whole_set := $(call set_of,$(MATERIALS))
left_out = $(if $(filter $1,$(LEAVE_OUT)),$2,$3)
override HEXMESH_OPTIONS += $(call left_out,no-skin,--skin 0)
override PRONE := $(call left_out,no-backward,--gravity 0$(comma)0$(comma)0,$(PRONE))
override COMPRESS_OPTIONS += $(call left_out,no-gravity-in-compression,--gravity off)
override MATERIALS := $(call left_out,no-gland,$(RUN)/fat-only.tsv,$(MATERIALS))

# Every table, verdict and page is made by tabulate, from reports, tables and shapes.
tabulate = $(BIN)/tabulate --quiet --pipelines $(PIPELINES)
# The supports of the breast at its back; if empty, those with which the material set was found, or a held wall and a free cut.
SUPPORT = $(addprefix --wall ,$(WALL)) $(addprefix --cut ,$(CUT))
# The plates stop at the first of these limits; without any, where those of a screening mammogram do.
STOPS = $(strip $(addprefix --force ,$(FORCE)) $(addprefix --thickness ,$(THICKNESS)) $(addprefix --reduction ,$(REDUCTION)) \
  $(addprefix --pressure ,$(PRESSURE)))

# The scan; the tumour and the material set if a rule makes them (those of users are known by content).
MR_FILES := $(MR) $(if $(wildcard $(MR)/.),$(wildcard $(MR)/*))
MADE_TUMOUR := $(filter $(RUNS)/%,$(TUMOUR))
MADE_MATERIALS := $(filter $(RUN)/%,$(MATERIALS))
MATERIAL_TABLE := $(call set_of,$(MATERIALS))
# Without a tumour, the chain ends with the curves of all CC points and their page instead of one curve.
landmarks := $(if $(no_tumour),,tumour$(comma))nipple
CURVE := $(if $(no_tumour),,$(RUN)/curve.vtp)
# What only the run of a tumour has: another mesh may have none.
of_a_tumour := $(addprefix $(RUN)/,curve.vtp curve.tsv curve.json .curve.settings band.vtp band.tsv band-curve.tsv band.json \
  figures/*-matching.png slicer/scene.mrml slicer/column-* slicer/curve-*)
# $(call of_the_states,NAME): the states on the way to a shape, and their picture.
of_the_states = $(addprefix $(RUN)/,states/$1.vtkhdf states/$1.json states/$1-states figures/$1-states.png)
# $(call of_the_plates,VIEW): what is made of a compressed shape.
of_the_plates = $(addprefix $(RUN)/,$1.vti $1.png $1-sensitivity.vtkhdf $1-sensitivity.tsv lookup.h5 page.html patient.json patient-cc.png patient-mlo.png curves.vtp curves.tsv \
  figures/$1-mammogram.png figures/cc-points.png figures/mlo-curves.png) $(call of_the_states,$1) $(of_a_tumour)
# Contours for checking the labels; a program that replaces segment need not draw them.
contours := $(if $(filter $(BIN)/segment,$(SEGMENT)),--overlay $(RUN)/contours.png)

# What a row of a study may change: each column of its table, and the variable that has other options in the row's folder (studies.mk).
study_columns := segment:SEGMENT_OPTIONS fit:FIT_OPTIONS hexmesh:HEXMESH_OPTIONS prone:PRONE mechanics:MECHANICS wall:WALL cut:CUT \
  compress:COMPRESS_OPTIONS plates:true_plates slopes:slopes_of materials:MATERIALS content:content_MATERIALS
slopes_of := fat,fibroglandular,skin

# The options of the stages, and what is remembered of them: program, options, contents of files that users edit.
model = $(MECHANICS) $(SUPPORT)
labels_options = --side $(SIDE) $(addprefix --series ,$(SERIES)) $(addprefix --fat ,$(FAT)) $(addprefix --also ,$(ALSO)) \
  $(addprefix --chest-wall ,$(CHEST_WALL)) $(SEGMENT_OPTIONS)
labels_settings = $(SEGMENT) $(call named,$(MR)) $(labels_options) $(call content,$(FAT) $(ALSO) $(CHEST_WALL))
geometry_settings = $(FIT_HERMITE) $(FIT_OPTIONS)
mesh_options = $(HEXMESH_OPTIONS) $(if $(findstring --tumour,$(HEXMESH_OPTIONS)),,--tumour $(TUMOUR))
mesh_settings = $(HEXMESH) $(mesh_options) $(content_TUMOUR)
reference_options = $(PRONE) $(model)
reference_settings = $(BACKWARD) $(reference_options) $(content_MATERIALS)
supine_settings = $(FORWARD) $(model) $(content_MATERIALS)
# The plates have the distance that the case asks for, or their true positions.
plates_for = $(if $(true_plates),$(call plates_of_truth,$1),$(STOPS))
press = $(addprefix --at-least ,$(AT_LEAST)) $(COMPRESS_OPTIONS) $(model)
cc_options = $(call plates_for,cc) $(press)
cc_settings = $(COMPRESS) $(if $(true_plates),,$(STOPS)) $(press) $(content_MATERIALS)
mlo_options = $(call plates_for,mlo) $(press)
mlo_settings = $(cc_settings)
cc-mammogram_settings = $(PROJECT) $(PROJECT_OPTIONS)
mlo-mammogram_settings = $(cc-mammogram_settings)
curve_settings = $(CC2MLO)
slopes_options = $(PRONE) $(model) --parameters $(slopes_of)
slopes_settings = $(BIN)/sensitivity $(slopes_options)

# Options of every program: its report and its share of the cores. Where all others wait, a stage has all (but not in a cohort).
jobs = $(or $(patsubst -j%,%,$(filter -j%,$(MAKEFLAGS))),1)
share = --threads $$((threads = $$(nproc) / $(jobs), threads > 0 ? threads : 1))
alone = $(if $(filter 0,$(MAKELEVEL)),--threads $$(nproc),$(share))
common = --report $(basename $@).json $(share)
common_alone = --report $(basename $@).json $(alone)
# The report of a stage whose file has another name.
common_of = --report $(@D)/$1.json $(share)
