# SPDX-License-Identifier: GPL-3.0-or-later
# What users give, on the command line, in the environment or in a case file, is data. `cases given` refuses in one line a name that is
# no setting, and every value that make or a shell would read as code, before make expands any of them.
comma := ,
empty :=
space := $(empty) $(empty)
define newline


endef
quoted = '$(subst ','\'',$1)'
# $(call said,$(shell COMMAND)): what the program says; make ends with its message if it refuses.
said = $(if $(filter 0,$(.SHELLSTATUS)),$1,$(error $(filter-out cases:,$1)))

# $(shell) would end its command at a line break, before `cases` could refuse it.
$(foreach v,$(given),$(if $(findstring $(newline),$(value $v)),$(error $v: a line break may not stand in it; give a name \
  without it$(comma) or a link that has such a name (ln -s))))
$(call said,$(shell $(BIN)/cases given $(PIPELINES) $(foreach v,$(given),$(call quoted,$v=$(value $v))) --quiet 2>&1))

# The lines of a case file, KEY = VALUE, as a makefile that overrides the environment and is overridden by the command line.
RUNS ?= runs
include $(if $(CASE_FILE),$(call said,$(shell $(BIN)/cases case-file $(PIPELINES) $(CASE_FILE) $(RUNS)/.make --quiet 2>&1)))

# The settings and their defaults. Another value is given on the command line (make -f Makefile.pipeline MATERIALS=wellman), in a case
# file, or in the environment; the first of these counts. settings.tsv says what each does and accepts; those that have no default here
# are empty, but for those of the targets of the source tree (tests/*.mk).

# ---- the case ----------------------------------------------------------------------------------------------
PRESET ?= $(if $(PAPER)$(filter $(goals_of_paper),$(goals)),paper,average)
SIDE ?= left
CASE ?= $(if $(phantom),$(PRESET)$(if $(filter right,$(SIDE)),-right),$(scan_name)-$(SIDE))
# The paper places its tumour freely, at the margin of the gland; that of the phantom has a known displacement. No tumour is added to a
# patient's scan unless the user asks for one.
TUMOUR ?= $(if $(phantom),$(PHANTOM_TRUTH)/tumour-$(SIDE).tsv,none)

# Targets that make results of the paper (goals.tsv).
goals_of_paper := $(shell awk -F '\t' '$$2 ~ /paper/ { print $$1 }' $(PIPELINES)/goals.tsv)
# Without a scan, the case is a phantom. Bodies of these presets slide on their rib cage (libbreast/phantom/parameters.cpp); the others are
# held at the chest wall, as in the paper.
phantom := $(if $(strip $(MR)),,yes)
body_slides := $(filter average slim broad heavy,$(PRESET))
PHANTOM_MR := $(RUNS)/phantom/$(PRESET).nrrd
PHANTOM_TRUTH := $(RUNS)/phantom/$(PRESET)-truth
TRUTH := $(if $(phantom),$(PHANTOM_TRUTH)/landmarks.tsv)
ifdef phantom
MR := $(PHANTOM_MR)
endif
# pat.001.nrrd and pat.002.nrrd are two cases, and the name of a folder keeps its dots.
scan_file := $(notdir $(patsubst %/,%,$(MR)))
scan_name := $(firstword $(foreach e,.nii.gz .nii .nrrd .nhdr .mha .mhd .vtkhdf,$(if $(filter %$e,$(scan_file)),$(scan_file:%$e=%))) $(scan_file))
RUN := $(RUNS)/$(CASE)$(if $(PAPER),-as-printed)

# ---- the model ---------------------------------------------------------------------------------------------
# A living breast slides on the chest wall and is soft, and its borders are held as in women; the phantoms that slide were shaped for
# the set invivo. The breast of the paper is held at the chest wall and has the materials of Table II.
MATERIALS ?= $(if $(PAPER),seed2008,$(if $(phantom),$(if $(body_slides),invivo,seed2008),invivo-borders))
# $(call set_of,NAME): the file of a material set: one that a rule makes, one of the user's, or one of ours. $(call rows_in,FILE): its
# rows as tissue=law. A set with a support at the chest wall is one for a breast that slides.
set_of = $(or $(filter $(RUN)/%,$1),$(wildcard $1),$(PIPELINES)/materials/$1.tsv)
rows_in = $(if $(wildcard $1),$(shell awk -F '\t' '/^\#/ { next } !header++ { for (i = 1; i <= NF; i++) at[$$i] = i; next } \
  { print $$at["tissue"] "=" $$at["law"] }' $1))
slides := $(if $(PAPER),,$(filter wall=support,$(call rows_in,$(call set_of,$(MATERIALS)))))
PRONE ?= --posture prone
ELEMENTS ?= 16
ACCURACY_LADDER ?= q1p0-dome-4 q1p0-dome-6 q1p0-dome-8 q1p0-dome-10 q1p0-dome-12 q2p1-dome-8 q1p0-dome-16 q2p1-dome-10 q1p0-dome-20 \
  q2p1-dome-12 q2p1-dome-16
# A breast that slides does so with the muscle behind it; one that is held needs none. The tissue around it moves with it.
MUSCLE ?= $(if $(PAPER),,$(if $(slides),measured,0))
SURROUNDINGS ?= $(if $(PAPER),,$(if $(slides),16,0))
# The plates close to the first of these: force of the paddle, N; thickness, mm; reduction of the thickness, percent; mean pressure of the
# paddle, kPa. If all are empty, as in screening (docs/tools/compress.md). The paper halves the thickness, and a breast whose wall is held
# has no other limit: Table II is too stiff for a clinical force.
REDUCTION ?= $(if $(slides)$(FORCE)$(THICKNESS)$(PRESSURE),,50)
# A compression that stops early is accepted from this reduction on. Between plates as in the clinic compress judges by what mammograms
# are like. As printed, elements on the edge of the cuboid fold early (docs/validation/contact.md).
AT_LEAST ?= $(if $(PAPER),30,$(if $(slides),,40))
POINTS ?= 4
# Equilibria of each way that `states` shows.
STATES ?= 13

# ---- programs of the stages and their further options; all other programs are those in BIN -----------------
# As printed in the paper: cuboid, skin as a layer of elements, plain invariants, free cut, no gravity in compression.
PRINTED_HEXMESH = --template cuboid --elements $(ELEMENTS) --skin-as layer
PRINTED_MECHANICS = --materials $(MATERIALS) --invariants plain --element q1p0
HEXMESH_OPTIONS ?= $(if $(PAPER),$(PRINTED_HEXMESH),--elements $(ELEMENTS) $(addprefix --muscle ,$(filter-out 0,$(MUSCLE))) \
  $(addprefix --surroundings ,$(filter-out 0,$(SURROUNDINGS))) $(if $(filter q2p1,$(ELEMENT)),--order 2))
MECHANICS ?= $(if $(PAPER),$(PRINTED_MECHANICS),--materials $(MATERIALS) $(addprefix --element ,$(ELEMENT)))
COMPRESS_OPTIONS ?= $(if $(PAPER),--gravity off --contact al)
SEGMENT ?= $(BIN)/segment
FIT_HERMITE ?= $(BIN)/fit-hermite
HEXMESH ?= $(BIN)/hexmesh
BACKWARD ?= $(BIN)/backward
FORWARD ?= $(BIN)/forward
COMPRESS ?= $(BIN)/compress
PROJECT ?= $(BIN)/project-mammogram
CC2MLO ?= $(BIN)/cc2mlo
RENDER ?= $(BIN)/render

# ---- results, studies --------------------------------------------------------------------------------------
# A page is easily forwarded. It therefore contains voxels of a patient's scan only with PAGE_SCAN=yes; a phantom may be shown.
PAGE_SCAN ?= $(if $(TRUTH),yes,no)
EXPECTED ?= $(wildcard $(PIPELINES)/expected/$(CASE)$(if $(PAPER),-as-printed).tsv)
# The PDF is printed by a headless browser (Debian package chromium, which setup does not install).
CHROMIUM ?= $(shell command -v chromium || command -v chromium-browser || command -v google-chrome)
COST_POINTS ?= $(cost_variants)
COST_FINEST ?= q2p1-dome-24
FINDINGS_FINEST ?= 10
LEAVEOUT_MM ?= 1
LEAVEOUT_VARIANTS ?= $(leaveout_variants)
BUDGET_FINER ?= 20

# ---- cohorts -----------------------------------------------------------------------------------------------
CLUSTER ?= local
CLUSTER_CORES ?= 1
