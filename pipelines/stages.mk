# SPDX-License-Identifier: GPL-3.0-or-later
# The stages of the chain, each defined once: the files it reads, its program, its settings. A case is a folder with all stages
# ($(RUN)); a variant is a folder with some stages, which takes the others from the folder it starts from (pipelines/studies.mk).
#   $(call case_rules,DIR,STAGES)   the rules of these stages in DIR, whose settings are the variables DIR@ATTRIBUTE
# In the case, the target is STAGE.vtkhdf, and make fails if a stage fails. In a variant, the target is STAGE.json: a solve that
# ends early is a result, and its report states the reason (`cases attempt`).
STAGES := labels geometry mesh reference supine cc mlo cc-mammogram mlo-mammogram curve slopes

# ---- what a stage is: $1 is the folder it is made in -------------------------------------------------------
# reads_STAGE      the stages whose files it reads, in the order of its arguments; also_STAGE: further stages it depends on
# writes_STAGE     its file, if not STAGE.vtkhdf, and files made with it; needs_STAGE: other files it depends on
# fixed_STAGE      arguments that follow from the stage; options_STAGE: its settings; known_STAGE: digests of files of the user's
program_labels = $(SEGMENT)
# The first stage reads the scan, where the others read the files of stages; the scan is also a setting.
scan_labels = $(MR)
needs_labels = $(MR_FILES)
writes_labels := labels.vtkhdf points.vtp
fixed_labels = --points $1/points.vtp $(if $(filter $(RUN),$1),$(contours))
known_labels = $(content_CHEST_WALL)
options_labels = --side $(SIDE) $(addprefix --series ,$(SERIES)) $(addprefix --chest-wall ,$(CHEST_WALL)) $($1@segment)
# Contours for checking the result; a program that replaces segment need not draw them.
contours = $(if $(filter $(BIN)/segment,$(SEGMENT)),--overlay $(RUN)/contours.png)
before_labels = $(if $(filter $(RUN),$1),@$(CASES) record $(RUN) $(SIDE) $(scan) --quiet)

program_geometry = $(FIT_HERMITE)
reads_geometry := labels
options_geometry = $($1@fit)

program_mesh = $(HEXMESH)
reads_mesh := geometry labels
needs_mesh = $(filter $(RUNS)/%,$(TUMOUR))
known_mesh = $(content_TUMOUR)
# What only the run of a tumour has: another mesh may have none.
before_mesh = @rm -f $(addprefix $(RUN)/,curve.vtp curve.tsv curve.json .curve.settings band.vtp band.tsv band-curve.tsv band.json \
  figures/*-matching.png slicer/scene.mrml slicer/column-* slicer/curve-*)
options_mesh = $($1@hexmesh) $(if $(findstring --tumour,$($1@hexmesh)),,--tumour $(TUMOUR))

program_reference = $(BACKWARD)
reads_reference := mesh
options_reference = $($1@prone) $(mechanics)
# Options of all solves: law, element and supports of the breast.
mechanics = $($1@mechanics) $(support)
support = $(addprefix --wall ,$($1@wall)) $(addprefix --cut ,$($1@cut))
needs_reference = $(filter $(RUN)/%,$($1@materials))
known_reference = $($1@content)
known_supine = $($1@content)

program_supine = $(FORWARD)
reads_supine := reference
fixed_supine := --posture supine
options_supine = $(mechanics)
needs_supine = $(needs_reference)

# The two views: compression, then projection. The plates have the distance that the case asks for, or their true positions.
define view_stages
program_$1 = $$(COMPRESS)
reads_$1 := reference
fixed_$1 = --view $2 $$(if $$($$1@plates),$$(call same_plates,$$(TRUTH_AT)-fine-$1.json) $$(if $$(body_slides),$$(wordlist 2,3,$$(truth_edge_$1))))
options_$1 = $$(if $$($$1@plates),,$$(STOPS)) --at-least $$(AT_LEAST) $$($$1@compress) $$(mechanics)
known_$1 = $$($$1@content)
needs_$1 = $$(needs_reference) $$(if $$($$1@plates),$$(TRUTH_TABLE))

program_$1-mammogram = $$(PROJECT)
reads_$1-mammogram := $1
also_$1-mammogram := labels
writes_$1-mammogram := $1.vti $1.png
fixed_$1-mammogram = --labels $$(call file_of,$$1,labels) --png $$1/$1.png
options_$1-mammogram = $$(PROJECT_OPTIONS)
endef
$(eval $(call view_stages,cc,CC))
$(eval $(call view_stages,mlo,MLO))

program_curve = $(CC2MLO)
reads_curve := cc mlo
writes_curve := curve.vtp curve.tsv
fixed_curve = --landmark tumour --table $1/curve.tsv

# Slopes d ln u / d ln s of the prone-to-supine displacement u with respect to the stiffness factors s of the tissues.

program_slopes = $(SENSITIVITY)
reads_slopes := reference supine
writes_slopes := slopes.vtkhdf slopes.tsv
fixed_slopes = --table $1/slopes.tsv
options_slopes = $($1@prone) $(mechanics) --parameters $($1@slopes)

# ---- the rules ---------------------------------------------------------------------------------------------
# The folder from which DIR takes a stage (DIR or the folder it starts from), the file of the stage, and the target that makes it.
home = $(if $(filter $2,$($1@stages)),$1,$(call home,$($1@from),$2))
file_of = $(call home,$1,$2)/$2.vtkhdf
made_in = $(if $(filter $(RUN),$1),$(addprefix $1/,$(or $(writes_$2),$2.vtkhdf)),$1/$2.json)
target_of = $(firstword $(call made_in,$(call home,$1,$2),$2))
# {tumour} in the options is the position of the tumour in the mesh from which the variant starts.
placed = $(if $(findstring {tumour},$2),$(if $(no_tumour),$(error $1: this variant needs a tumour to follow$(comma) \
  and the case has none; name its place with TUMOUR=x$(comma)y$(comma)z (mm)))$(subst \
  {tumour},$$($(tabulate) place $(call home,$($1@from),mesh)/mesh.json tumour),$2),$2)
# The solve of a variant may end early. A variant that depends on another one (column `if`) then ends for the same reason.
inputs_of = $(foreach s,$(reads_$2),$(call file_of,$1,$s))
attempt = $(if $(filter $(RUN),$1),,$(CASES) attempt $1/$2.json '$(strip $(call inputs_of,$1,$2) $(addsuffix /supine.vtkhdf,$($1@if)))' --quiet --)
# All others wait for the first stages of the case.
threads_of = $(if $(filter $(addprefix $(RUN)@,labels geometry mesh reference),$1@$2),$(alone),$(share))
run_stage = $(strip $(call attempt,$1,$2) $(program_$2) $(scan_$2) $(call inputs_of,$1,$2) $(addprefix $1/,$(firstword $(or $(writes_$2),$2.vtkhdf))) \
  $(fixed_$2) $(call placed,$1,$(options_$2)) --report $1/$2.json $(call threads_of,$1,$2))
settings_of = $(program_$2) $(call named,$(scan_$2)) $(options_$2) $(known_$2)
# The name of a folder may contain a comma; it must not separate arguments when the text is expanded later.
define stage_rule
$(call made_in,$1,$2) $(if $(word 2,$(call made_in,$1,$2)),&): $(foreach s,$(reads_$2) $(also_$2),$(call target_of,$1,$s)) \
  $(program_$2) $(needs_$2) $(if $(findstring {tumour},$(options_$2)),$(call target_of,$($1@from),mesh)) \
  $(addsuffix /supine.json,$($1@if)) $(call stale,$1/.$2.settings,$(settings_of))
	$(if $(filter $(RUN),$1),$(call before_$2,$1))
	$$(call staged,$$(@D)/.$2.settings,$$(call settings_of,$$(@D),$2)) $$(call run_stage,$$(@D),$2)
endef
case_rules = $(foreach s,$2,$(eval $(call stage_rule,$1,$s)))

# ---- the case itself ---------------------------------------------------------------------------------------
MR_FILES := $(MR) $(if $(wildcard $(MR)/.),$(wildcard $(MR)/*))
CHAIN_FILES := $(addprefix $(RUN)/,labels.vtkhdf geometry.vtkhdf mesh.vtkhdf reference.vtkhdf \
  supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti $(if $(no_tumour),lookup.h5 page.html,curve.vtp))
ATTRIBUTES := segment fit hexmesh prone mechanics wall cut compress plates slopes materials
$(RUN)@stages := $(STAGES)
$(RUN)@segment := $(SEGMENT_OPTIONS)
$(RUN)@fit := $(FIT_OPTIONS)
$(RUN)@hexmesh := $(HEXMESH_OPTIONS)
$(RUN)@prone := $(PRONE)
$(RUN)@mechanics := $(MECHANICS)
$(RUN)@wall := $(WALL)
$(RUN)@cut := $(CUT)
$(RUN)@compress := $(COMPRESS_OPTIONS)
$(RUN)@slopes := fat,fibroglandular,skin
$(RUN)@materials := $(MATERIALS)
$(RUN)@content := $(content_MATERIALS)
MATERIAL_FILE := $(call needs_reference,$(RUN))
MATERIAL_TABLE := $(or $(MATERIAL_FILE),$(wildcard $(MATERIALS)),$(PIPELINES)/materials/$(MATERIALS).tsv)
$(call case_rules,$(RUN),$(STAGES))

# The model without gland uses the set in which the law of fat replaces that of fibroglandular tissue.
$(RUN)/fat-only.tsv: $(or $(whole_set),$(MATERIAL_TABLE))
	@mkdir -p $(@D)
	$(call table,$(tabulate) set fat-only $<)

# The same with the lateral cut held, which shows the effect of this boundary condition at the landmarks;
# its discretisation error is not estimated again.
cut-fixed_settings := $(BACKWARD) $(FORWARD) $(MECHANICS) $(content_MATERIALS)
$(RUN)/reference-cut-fixed.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD) $(MATERIAL_FILE) $(call changed,cut-fixed)
	$(call stage,cut-fixed) $(BACKWARD) $< $@ --posture prone $(MECHANICS) --cut fixed --estimate none $(common)
supine-cut-fixed_settings = $(cut-fixed_settings)
$(RUN)/supine-cut-fixed.vtkhdf: $(RUN)/reference-cut-fixed.vtkhdf $(FORWARD)
	$(call stage,supine-cut-fixed) $(FORWARD) $< $@ --posture supine $(MECHANICS) --cut fixed --estimate none $(common)

# Tables come from stdout; a rename makes them complete or absent: $(call table,COMMAND).
table = $1 > $@.part && mv $@.part $@
SHOWN := $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf)
$(RUN)/displacements.tsv: $(SHOWN) $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf) $(PROBE)
	$(call table,$(PROBE) $(filter %.vtkhdf,$^) --landmarks $(landmarks))
$(RUN)/cut.tsv: $(RUN)/supine-cut-fixed.vtkhdf $(RUN)/supine.vtkhdf $(PROBE)
	$(call table,$(PROBE) $< --base $(RUN)/supine.vtkhdf --landmarks $(landmarks))

# Errors against the phantom's truth (stress-free, prone, supine); a real scan has none.
ifdef TRUTH
$(RUN)/truth.tsv: $(TRUTH) $(SHOWN) $(PROBE)
$(RUN)/truth-cut-fixed.tsv: $(TRUTH) $(RUN)/mesh.vtkhdf $(RUN)/reference-cut-fixed.vtkhdf $(RUN)/supine-cut-fixed.vtkhdf $(PROBE)
$(RUN)/truth.tsv $(RUN)/truth-cut-fixed.tsv:
	$(call table,$(PROBE) $(filter %.vtkhdf,$^) --truth $(TRUTH))
endif

# (A breast that slides is held by springs at its cut: there a held cut would be another model.)
$(RUN)/summary.txt: $(CHAIN_FILES) $(RUN)/displacements.tsv $(if $(slides),,$(RUN)/cut.tsv) \
  $(if $(TRUTH),$(RUN)/truth.tsv $(if $(body_slides),,$(RUN)/truth-cut-fixed.tsv)) $(FIGURES) \
  $(TABULATE) $(PIPELINES)/advice.tsv
	@$(call table,$(tabulate) summary $(RUN) $(if $(TRUTH),$(PHANTOM_MR:.nrrd=.json)))
