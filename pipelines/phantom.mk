# SPDX-License-Identifier: GPL-3.0-or-later
# The phantom is a breast MR with known truth. Its prone shape is computed from its stress-free shape on a template and a mesh
# that the chain never uses.
PHANTOM_MR := $(RUNS)/phantom/$(PRESET).nrrd
PHANTOM_TRUTH := $(RUNS)/phantom/$(PRESET)-truth
ifndef MR
  MR := $(PHANTOM_MR)
  TRUTH := $(PHANTOM_TRUTH)/landmarks.tsv
  # The paper places its tumour freely, at the margin of the gland; ours is the phantom's, whose displacement is known.
  TUMOUR ?= $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv
else
  # No tumour is added to a patient's scan by default: TUMOUR=x,y,z names one, TUMOUR=auto makes an artificial one.
  TUMOUR ?= none
endif
# A run belongs to one scan and one side: another scan or side is refused before it overwrites anything.
scan := $(if $(TRUTH),phantom:$(PRESET),$(MR))
ifneq ($(filter-out help setup build check package clean calibrate cohort cohort-table cohort-script population calibrate-invivo identification,$(goals)),)
  $(call ask,check $(RUN) $(SIDE) $(scan))
endif
# The preset `paper` was fitted to results of this chain; tabulate marks the rows to which it was fitted.
export CALIBRATED := $(if $(TRUTH),$(if $(filter paper,$(PRESET)),$(PHANTOM_MR:.nrrd=.json) $(SIDE)))
# `tumour` is the option that gives hexmesh the tumour, unless HEXMESH_OPTIONS names another. If `no_tumour` is not empty, there is
# no tumour, and the chain ends with the curves of all CC points and their page instead of one curve.
tumour = $(if $(findstring --tumour,$(HEXMESH_OPTIONS)),,--tumour $(TUMOUR))
no_tumour := $(findstring --tumour none,$(HEXMESH_OPTIONS)$(tumour))
landmarks := $(if $(no_tumour),,tumour$(comma))nipple
CURVE := $(if $(no_tumour),,$(RUN)/curve.vtp)
# Targets that need the displacement of the tumour.
need_tumour := tables table3 table4 table5 table6 table7 table8 findings fig7 leaveout wall-sensitivity band
$(call refuse_goals,$(no_tumour),$(need_tumour),needs a tumour to follow. Name its place with TUMOUR=x$(comma)y$(comma)z (patient LPS$(comma) \
  mm)$(comma) a table or labels; or TUMOUR=auto for an artificial one)

phantom_record := $(RUNS)/phantom/.$(PRESET).settings
phantom_settings := $(PHANTOM) $(PRESET) $(PHANTOM_OPTIONS)
$(PHANTOM_MR) $(PHANTOM_TRUTH)/landmarks.tsv $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv &: $(PHANTOM) $(call changed,phantom)
	@mkdir -p $(dir $(PHANTOM_MR))
	$(PHANTOM) $(PHANTOM_MR) --preset $(PRESET) --truth $(PHANTOM_TRUTH) $(PHANTOM_OPTIONS) \
	  --report $(basename $(PHANTOM_MR)).json $(alone)
	@$(call record,phantom)

# Makes only the scan, which all cases of one phantom share (cohort.mk).
.PHONY: phantom-scan
phantom-scan: $(if $(TRUTH),$(MR))

# These targets compare a chain with the true body of the phantom. A scan has no such body; the model as printed in the paper is
# that of a breast held at its chest wall, and some targets hold it there.
body_slides := $(filter $(sliding_presets),$(PRESET))
of_truth := truth matching band-truth budget
$(call refuse_goals,$(if $(TRUTH),,scan),$(of_truth),a scan has no truth; leave MR out$(comma) PRESET=NAME names a phantom)
$(call refuse_goals,$(body_slides),budget band-check calibrate,holds the breast at its wall$(comma) where preset $(PRESET) slides; give \
  PRESET=paper or leave PRESET out)
$(call refuse_goals,$(if $(PAPER),$(body_slides)),$(of_truth),with PAPER=1 the breast is held at its wall$(comma) where preset $(PRESET) \
  slides; leave one of the two out)

# Compressed truth of the phantom: the same body (its cut held, or sliding on its ribs with its own supports) on meshes of two
# levels (phantom-mesh), whose distance is the truth's own error: 4280 and 34240 elements if the cut is held, 900 and 2176
# elements if friction makes every step expensive. The plates have the same positions on both meshes.
# This takes many minutes and is therefore a separate target; TRUTH_TABLE is a truth for probe --truth.
# In CC the plates start 20 mm in front of the chest wall: this body continues below its inframammary fold, and a raised detector
# nearer to the wall would press the skin there into a pleat (docs/validation/truth-sliding.md).
TRUTH_AT := $(PHANTOM_TRUTH)/$(SIDE)
TRUTH_COARSE ?= $(if $(body_slides),0.5,1)
TRUTH_FINE ?= $(if $(body_slides),0.75,2)
TRUTH_SET := $(TRUTH_AT)-set.tsv
truth_edge_cc := 20
truth_edge_mlo := auto
truth_body = $(if $(body_slides),--materials $(TRUTH_SET) --image-edge $(truth_edge_$1),--cut fixed)
# The part of PHANTOM_OPTIONS that describes the same body.
truth_alike = $(filter --seed=% --materials=% --coarse=%,$(subst --seed ,--seed=,$(subst --materials ,--materials=,$(subst \
  --coarse ,--coarse=,$(strip $(PHANTOM_OPTIONS))))))
TRUTH_TABLE := $(PHANTOM_TRUTH)/$(SIDE)-compressed.tsv
TRUTH_MESHES := $(foreach level,fine coarse,$(foreach what,$(level) $(level)-supine $(level)-cc $(level)-mlo,\
  $(TRUTH_AT)-$(what).vtkhdf))
truth_mesh = $(PHANTOM_MESH) $(TRUTH_AT)-$1.vtkhdf --supine $(TRUTH_AT)-$1-supine.vtkhdf --level $2 \
  --preset $(PRESET) --side $(SIDE) $(truth_alike) --report $(TRUTH_AT)-$1.json $(share)
truth-meshes_record := $(PHANTOM_TRUTH)/.$(SIDE)-meshes.settings
truth-meshes_settings := $(PHANTOM_MESH) $(TRUTH_COARSE) $(TRUTH_FINE) $(phantom_settings)
$(TRUTH_AT)-coarse.vtkhdf $(TRUTH_AT)-coarse-supine.vtkhdf $(TRUTH_SET) &: $(PHANTOM_MR) $(PHANTOM_MESH) $(call changed,truth-meshes)
	$(call truth_mesh,coarse,$(TRUTH_COARSE)) --set $(TRUTH_SET)
	@$(call record,truth-meshes)
$(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-fine-supine.vtkhdf &: $(PHANTOM_MR) $(TRUTH_SET) $(PHANTOM_MESH)
	$(call truth_mesh,fine,$(TRUTH_FINE))
truth_compress = $(COMPRESS) $< $@ $(call truth_body,$1) --at-least $(AT_LEAST) $(common)
define truth_view
truth-$1_record := $(PHANTOM_TRUTH)/.$(SIDE)-$1.settings
truth-$1_settings := $(COMPRESS) $(REDUCTION) $(AT_LEAST) $(truth_edge_$1) $(phantom_settings)
$(TRUTH_AT)-coarse-$1.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf $(TRUTH_SET) $(COMPRESS) $$(call changed,truth-$1)
	$$(call truth_compress,$1) --view $2 --reduction $(REDUCTION)
	@$$(call record,truth-$1)
$(TRUTH_AT)-fine-$1.vtkhdf: $(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-coarse-$1.vtkhdf $(COMPRESS)
	$$(call truth_compress,$1) --view $2 $$(call same_plates,$(TRUTH_AT)-coarse-$1.json)
# The chain, compressed between plates with the distance and position of those of the truth.
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
