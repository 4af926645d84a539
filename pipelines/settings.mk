# SPDX-License-Identifier: GPL-3.0-or-later
# Values of the settings (settings.tsv). Each can be given on the command line: make -f Makefile.pipeline MATERIALS=wellman
# A case file contains one KEY = VALUE per line; the command line overrides it. A case file is data: `cases` checks every key and
# value, and nothing in it is executed.
ifneq ($(CASE_FILE),)
  $(call ask,read $(CASE_FILE) $(case_settings))
  $(foreach v,$(path_settings) $(name_settings),$(call check_setting,$v))
endif
$(foreach v,$(filter-out $(program_settings),$(known_settings)),$(if $(default_$v),$(eval $v ?= $(default_$v))))

# Every table, verdict and page is made by tabulate, from reports, tables and shapes.
tabulate = $(TABULATE) --quiet --pipelines $(PIPELINES)

# ---- the case -----------------------------------------------------------------------------------------
# Breasts of these presets slide on their rib cage; the others are held at the chest wall, as in the paper. The targets that make
# the tables, figures and studies of the paper use the phantom `paper` unless another preset is given.
sliding_presets := average slim broad heavy
paper_goals := $(filter all tables table% fig4 fig5 fig6 fig7 findings verify report validation calibrate truth matching band \
  band-check band-truth budget leaveout wall-sensitivity cost compare stability%,$(MAKECMDGOALS))
PRESET ?= $(if $(PAPER)$(paper_goals),paper,average)
scan_endings := .nii.gz .nii .nrrd .nhdr .mha .mhd .vtkhdf
# The name of a scan without its extension: pat.001.nrrd and pat.002.nrrd differ, and the name of a folder keeps its dots.
without_ending = $(firstword $(foreach e,$(scan_endings),$(patsubst %$e,%,$(filter %$e,$1))) $1)
ifdef MR
  scan_name := $(notdir $(patsubst %/,%,$(MR)))
  CASE ?= $(call without_ending,$(scan_name))-$(SIDE)
else
  CASE ?= $(PRESET)$(if $(filter right,$(SIDE)),-right)
endif
RUN := $(RUNS)/$(CASE)$(if $(PAPER),-as-printed)

# ---- choices ------------------------------------------------------------------------------------------
# A living breast slides on the chest wall and is soft; the breast of the paper is held there and has the materials of Table II.
# (Decided here, because a phantom's MR is set later.)
ifeq ($(origin MATERIALS),undefined)
  MATERIALS := $(if $(PAPER),seed2008,$(if $(MR)$(filter $(sliding_presets),$(PRESET)),invivo,seed2008))
endif
# Material sets for a sliding breast contain the support at its chest wall.
slides := $(if $(PAPER),,$(shell grep -l '^wall' $(or $(wildcard $(MATERIALS)),$(PIPELINES)/materials/$(MATERIALS).tsv) 2>/dev/null))
# The mean pressure of the paddle, kPa, at which a compression ends before REDUCTION, as in clinical practice. Table II is too
# stiff for it.
PRESSURE ?= $(if $(slides),10)
# As printed, elements on the edge of the cuboid fold early (docs/validation/contact.md).
AT_LEAST ?= $(if $(PAPER),30,40)
# The supports of the breast at its back; if empty, those with which the material set was found, or a held wall and a free cut.
SUPPORT = $(addprefix --wall ,$(WALL)) $(addprefix --cut ,$(CUT))
# As printed in the paper: cuboid, skin as a layer of elements, plain invariants, free cut.
PRINTED_HEXMESH = --template cuboid --elements $(ELEMENTS) --skin-as layer
PRINTED_MECHANICS = --materials $(MATERIALS) --invariants plain --element q1p0
ifdef PAPER
  # Everything as printed: no gravity in compression and augmented Lagrangian too.
  HEXMESH_OPTIONS ?= $(PRINTED_HEXMESH)
  MECHANICS ?= $(PRINTED_MECHANICS)
  COMPRESS_OPTIONS ?= --gravity off --contact al
else
  # A breast that slides does so with the muscle behind it; one that is held needs none.
  MUSCLE ?= $(if $(slides),measured,0)
  HEXMESH_OPTIONS ?= --elements $(ELEMENTS) $(addprefix --muscle ,$(filter-out 0,$(MUSCLE)))
  # An empty ELEMENT is the programs' default. ACCURACY=MM chooses ELEMENTS and ELEMENT.
  MECHANICS ?= --materials $(MATERIALS) $(addprefix --element ,$(ELEMENT))
endif
# The plates stop at the first of these limits.
STOPS = --reduction $(REDUCTION) $(addprefix --pressure ,$(PRESSURE))
$(check_values)
# With landmarks in a second posture, or a supine scan of the same patient, the set MATERIALS is the prior, and the chain runs with
# the set that identify finds.
ifneq ($(LANDMARKS)$(SUPINE),)
  prior_set := $(MATERIALS)
  override MATERIALS := $(RUN)/identified.tsv
endif
# Parts of the model to leave out; studies/leaveout.tsv measures the effect of each.
left_out = $(if $(filter $1,$(LEAVE_OUT)),$2,$3)
override HEXMESH_OPTIONS += $(call left_out,no-skin,--skin 0)
override PRONE := $(call left_out,no-backward,--gravity 0$(comma)0$(comma)0,$(PRONE))
override COMPRESS_OPTIONS += $(call left_out,no-gravity-in-compression,--gravity off)
whole_set := $(call left_out,no-gland,$(or $(wildcard $(MATERIALS)),$(PIPELINES)/materials/$(MATERIALS).tsv))
override MATERIALS := $(call left_out,no-gland,$(RUN)/fat-only.tsv,$(MATERIALS))

# Options of every program: its JSON report next to its first output, and its share of the cores. A stage for which all others wait
# has every core, unless this make is one of several (a case of a cohort).
share = --threads $$($(PIPELINES)/threads.sh)
alone = --threads $$($(PIPELINES)/threads.sh $(if $(filter 0,$(MAKELEVEL)),alone))
common = --report $(basename $@).json $(share)
