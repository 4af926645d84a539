# SPDX-License-Identifier: GPL-3.0-or-later
# Values of the settings (settings.tsv), each to be given on the command line: make -f Makefile.pipeline MATERIALS=wellman
# A case file gives them one a line, KEY = VALUE; the command line overrides it. It is data: `cases` checks every key and value, and
# nothing in it is executed.
ifneq ($(CASE_FILE),)
  $(call ask,read $(CASE_FILE) $(case_settings))
  $(foreach v,$(path_settings) $(name_settings),$(call check_setting,$v))
endif
$(foreach v,$(filter-out $(program_settings),$(known_settings)),$(if $(default_$v),$(eval $v ?= $(default_$v))))

# Every table, verdict and page is made by tabulate, from reports, tables and shapes.
tabulate = $(TABULATE) --quiet --pipelines $(PIPELINES)

# ---- the case -----------------------------------------------------------------------------------------
# Breasts of these presets slide on their rib cage; the others are held, as in the paper, whose tables, figures and studies are
# theirs: these targets take the phantom `paper` unless told otherwise.
sliding_presets := average slim broad heavy
paper_goals := $(filter all tables table% fig4 fig5 fig6 fig7 findings verify report validation calibrate truth matching band \
  band-check band-truth budget leaveout wall-sensitivity cost compare stability%,$(MAKECMDGOALS))
PRESET ?= $(if $(PAPER)$(paper_goals),paper,average)
scan_endings := .nii.gz .nii .nrrd .nhdr .mha .mhd .vtkhdf
# The name of a scan without its ending: pat.001.nrrd is another than pat.002.nrrd, and a folder keeps its dots.
without_ending = $(firstword $(foreach e,$(scan_endings),$(patsubst %$e,%,$(filter %$e,$1))) $1)
ifdef MR
  scan_name := $(notdir $(patsubst %/,%,$(MR)))
  CASE ?= $(call without_ending,$(scan_name))-$(SIDE)
else
  CASE ?= $(PRESET)$(if $(filter right,$(SIDE)),-right)
endif
RUN := $(RUNS)/$(CASE)$(if $(PAPER),-as-printed)

# ---- choices ------------------------------------------------------------------------------------------
# A living breast slides on its wall and is soft; the paper's is held and has its Table II.
# (Decided here, because a phantom's MR is set later.)
ifeq ($(origin MATERIALS),undefined)
  MATERIALS := $(if $(PAPER),seed2008,$(if $(MR)$(filter $(sliding_presets),$(PRESET)),invivo,seed2008))
endif
# Sets with which a breast slides say how its wall holds.
slides := $(if $(PAPER),,$(shell grep -l '^wall' $(or $(wildcard $(MATERIALS)),$(PIPELINES)/materials/$(MATERIALS).tsv) 2>/dev/null))
# Mean pressure of the paddle, kPa, that ends a compression before REDUCTION: what a clinic aims at. Table II is too stiff for it.
PRESSURE ?= $(if $(slides),10)
# As printed, elements on the edge of the cuboid fold early (docs/validation/contact.md).
AT_LEAST ?= $(if $(PAPER),30,40)
# What holds the breast at its back; empty: what the material set was found with, or a held wall and a free cut.
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
# Where the plates stop: at the first of these.
STOPS = --reduction $(REDUCTION) $(addprefix --pressure ,$(PRESSURE))
$(check_values)
# Landmarks in a second posture, or a supine scan of the same patient: the set MATERIALS is what is expected, the chain runs with what
# identify makes of it.
ifneq ($(LANDMARKS)$(SUPINE),)
  prior_set := $(MATERIALS)
  override MATERIALS := $(RUN)/identified.tsv
endif
# Parts of the model to do without; what each is worth: studies/leaveout.tsv.
left_out = $(if $(filter $1,$(LEAVE_OUT)),$2,$3)
override HEXMESH_OPTIONS += $(call left_out,no-skin,--skin 0)
override PRONE := $(call left_out,no-backward,--gravity 0$(comma)0$(comma)0,$(PRONE))
override COMPRESS_OPTIONS += $(call left_out,no-gravity-in-compression,--gravity off)
whole_set := $(call left_out,no-gland,$(or $(wildcard $(MATERIALS)),$(PIPELINES)/materials/$(MATERIALS).tsv))
override MATERIALS := $(call left_out,no-gland,$(RUN)/fat-only.tsv,$(MATERIALS))

# Options every program gets: its JSON report beside its first output, its share of the cores.
share = --threads $$($(PIPELINES)/threads.sh)
common = --report $(basename $@).json $(share)
