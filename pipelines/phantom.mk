# SPDX-License-Identifier: GPL-3.0-or-later
# The phantom: a breast MR with known truth. Its stress-free shape is solved to prone on a template and
# a mesh the chain never uses.
PHANTOM_MR := $(RUNS)/phantom/$(PRESET).nrrd
PHANTOM_TRUTH := $(RUNS)/phantom/$(PRESET)-truth
ifndef MR
  MR := $(PHANTOM_MR)
  TRUTH := $(PHANTOM_TRUTH)/landmarks.tsv
  # The paper puts its tumour where it likes, on the gland's margin; ours is the phantom's, whose way is known.
  TUMOUR ?= $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv
else
  # A patient's scan gets no tumour that nobody found: TUMOUR=x,y,z names one, TUMOUR=auto makes an artificial one.
  TUMOUR ?= none
endif
# A run belongs to one scan and one side: another is refused before it overwrites anything (pipelines/scan-identity.sh).
scan := $(if $(TRUTH),phantom:$(PRESET),$(MR))
ifneq ($(filter-out help setup build check package clean calibrate cohort cohort-table cohort-script population calibrate-invivo identification,$(or $(MAKECMDGOALS),$(.DEFAULT_GOAL))),)
  mixed_up := $(shell $(PIPELINES)/scan-identity.sh check $(RUN) $(SIDE) $(scan))
  $(if $(mixed_up),$(error $(mixed_up)))
endif
# The preset `paper` was fitted to the answer of this chain: the rows it was fitted to say so (tabulate).
export CALIBRATED := $(if $(TRUTH),$(if $(filter paper,$(PRESET)),$(PHANTOM_MR:.nrrd=.json) $(SIDE)))
# The tumour as hexmesh is told, unless HEXMESH_OPTIONS names another; no_tumour: none, so that the chain ends with the
# curves of all CC points and their page instead of one curve.
tumour = $(if $(findstring --tumour,$(HEXMESH_OPTIONS)),,--tumour $(TUMOUR))
no_tumour := $(findstring --tumour none,$(HEXMESH_OPTIONS)$(tumour))
landmarks := $(if $(no_tumour),,tumour$(comma))nipple
CURVE := $(if $(no_tumour),,$(RUN)/curve.vtp)
# What asks where the tumour goes.
need_tumour := tables table3 table4 table5 table6 table7 table8 findings fig7 leaveout wall-sensitivity band
ifneq ($(no_tumour),)
ifneq ($(filter $(need_tumour),$(MAKECMDGOALS)),)
  $(error $(firstword $(filter $(need_tumour),$(MAKECMDGOALS))): needs a tumour to follow. Name its place with TUMOUR=x,y,z (patient LPS, mm), a table or labels; or TUMOUR=auto for an artificial one)
endif
endif

phantom_record := $(RUNS)/phantom/.$(PRESET).settings
phantom_settings := $(PHANTOM) $(PRESET) $(PHANTOM_OPTIONS)
$(PHANTOM_MR) $(PHANTOM_TRUTH)/landmarks.tsv $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv &: $(PHANTOM) $(call changed,phantom)
	@mkdir -p $(dir $(PHANTOM_MR))
	$(PHANTOM) $(PHANTOM_MR) --preset $(PRESET) --truth $(PHANTOM_TRUTH) $(PHANTOM_OPTIONS) \
	  --report $(basename $(PHANTOM_MR)).json $(share)
	@$(call record,phantom)

# The scan alone: what cases of one phantom share (pipelines/cohort.sh).
.PHONY: phantom-scan
phantom-scan: $(if $(TRUTH),$(MR))

# Compressed truth of the phantom: the same body (cut held) on eight times the chain's elements, and on an
# eighth of them, whose distance is the truth's own error. The finer plates close to the coarser's gap.
# Many minutes, so a target of its own; TRUTH_TABLE is a truth for probe --truth.
TRUTH_AT := $(PHANTOM_TRUTH)/$(SIDE)
TRUTH_TABLE := $(PHANTOM_TRUTH)/$(SIDE)-compressed.tsv
TRUTH_MESHES := $(foreach level,fine coarse,$(foreach what,$(level) $(level)-supine $(level)-cc $(level)-mlo,\
  $(TRUTH_AT)-$(what).vtkhdf))
truth_mesh = $(PHANTOM_MESH) $(TRUTH_AT)-$1.vtkhdf --supine $(TRUTH_AT)-$1-supine.vtkhdf --level $2 \
  --preset $(PRESET) --side $(SIDE) --report $(TRUTH_AT)-$1.json $(share)
$(TRUTH_AT)-coarse.vtkhdf $(TRUTH_AT)-coarse-supine.vtkhdf &: $(PHANTOM_MR) $(PHANTOM_MESH)
	$(call truth_mesh,coarse,1)
$(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-fine-supine.vtkhdf &: $(PHANTOM_MR) $(PHANTOM_MESH)
	$(call truth_mesh,fine,2)
truth_compress = $(COMPRESS) $< $@ --cut fixed --at-least $(AT_LEAST) $(common)
define truth_view
truth-$1_record := $(PHANTOM_TRUTH)/.$(SIDE)-$1.settings
truth-$1_settings := $(COMPRESS) $(REDUCTION) $(AT_LEAST) $(phantom_settings)
$(TRUTH_AT)-coarse-$1.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf $(COMPRESS) $$(call changed,truth-$1)
	$$(truth_compress) --view $2 --reduction $(REDUCTION)
	@$$(call record,truth-$1)
$(TRUTH_AT)-fine-$1.vtkhdf: $(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-coarse-$1.vtkhdf $(COMPRESS)
	$$(truth_compress) --view $2 $$(call same_plates,$(TRUTH_AT)-coarse-$1.json)
# The chain between plates as far apart and at the same place as the truth's.
$(RUN)/truth-$1.vtkhdf: $(RUN)/reference.vtkhdf $(TRUTH_TABLE) $(COMPRESS)
	$(COMPRESS) $$< $$@ --view $2 $$(call same_plates,$(TRUTH_AT)-fine-$1.json) \
	  --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) $(MECHANICS) $(SUPPORT) $$(common)
endef
$(eval $(call truth_view,cc,CC))
$(eval $(call truth_view,mlo,MLO))
$(TRUTH_TABLE): $(PHANTOM_TRUTH)/landmarks.tsv $(TRUTH_MESHES) $(TRUTH_TABLE_TOOL)
	$(TRUTH_TABLE_TOOL) $< $@ $(TRUTH_MESHES) $(common)
same_plates = --thickness $$($(tabulate) key $1 thickness_mm) --edge-at $$($(tabulate) key $1 edge_at_mm) \
  --middle-at $$($(tabulate) key $1 middle_at_mm) --turn $$($(tabulate) key $1 turn_deg)
$(RUN)/truth-compressed.tsv: $(TRUTH_TABLE) $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf \
  truth-cc.vtkhdf truth-mlo.vtkhdf) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --truth $< > $@.part
	@mv $@.part $@
truth: $(RUN)/truth-compressed.tsv
	@cat $<

# How the preset `paper` was found: motions of the paper's Tables III and IV for a chain that moves the
# nipple 1.28 and the tumour 1.39 times as far as the phantom does (PAPER=1, measured on a phantom near the one
# found). Prints the values that stand in libbreast/phantom/parameters.cpp.
calibrate: $(CALIBRATE)
	$(CALIBRATE) --preset paper --gain 1.28,1.39 --evaluations 24 $(share)
