# SPDX-License-Identifier: GPL-3.0-or-later
# Compressed truth of the phantom: the same body (its cut held, or sliding on its ribs with its own supports) on meshes of two
# levels (phantom-mesh), whose distance is the truth's own error: 4280 and 34240 elements if the cut is held, 900 and 2176
# elements if friction makes every step expensive. The plates have the same positions on both meshes.
# This takes many minutes and is therefore a separate target; TRUTH_TABLE is a truth for probe --truth.
# In CC the plates start 20 mm in front of the chest wall: this body continues below its inframammary
# fold, where a raised detector nearer to the wall would press the skin into a pleat (docs/validation/truth-sliding.md).
TRUTH_COARSE ?= $(if $(body_slides),0.5,1)
TRUTH_FINE ?= $(if $(body_slides),0.75,2)
truth_edge_cc := 20
truth_edge_mlo := auto
# Half the thickness, whatever the force. At 49.5 % an element of the finer mesh folds in MLO, where this body has touched itself.
truth_reduction_cc = $(or $(REDUCTION),50)
truth_reduction_mlo = $(if $(and $(body_slides),$(filter 50,$(truth_reduction_cc))),48,$(truth_reduction_cc))
# The model is the one that the file of the body states.
truth_plates = $(if $(body_slides),--image-edge $(truth_edge_$1))
# The part of PHANTOM_OPTIONS that describes the same body.
truth_alike = $(filter --seed=% --materials=% --coarse=%,$(subst --seed ,--seed=,$(subst --materials ,--materials=,$(subst \
  --coarse ,--coarse=,$(strip $(PHANTOM_OPTIONS))))))
TRUTH_MESHES := $(foreach level,fine coarse,$(foreach what,$(level) $(level)-supine $(level)-cc $(level)-mlo,\
  $(TRUTH_AT)-$(what).vtkhdf))
truth_mesh = $(BIN)/phantom-mesh $(TRUTH_AT)-$1.vtkhdf --supine $(TRUTH_AT)-$1-supine.vtkhdf --level $2 \
  --preset $(PRESET) --side $(SIDE) $(truth_alike) --report $(TRUTH_AT)-$1.json $(share)
truth-meshes_record := $(PHANTOM_TRUTH)/.$(SIDE)-meshes.settings
truth-meshes_settings := $(BIN)/phantom-mesh $(TRUTH_COARSE) $(TRUTH_FINE) $(phantom_settings)
$(TRUTH_AT)-coarse.vtkhdf $(TRUTH_AT)-coarse-supine.vtkhdf &: $(PHANTOM_MR) $(BIN)/phantom-mesh $(call changed,truth-meshes)
	$(call stage,truth-meshes) $(call truth_mesh,coarse,$(TRUTH_COARSE))
$(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-fine-supine.vtkhdf &: $(PHANTOM_MR) $(BIN)/phantom-mesh $(TRUTH_AT)-coarse.vtkhdf
	$(call truth_mesh,fine,$(TRUTH_FINE))
truth_plates_record = $(PHANTOM_TRUTH)/.$(SIDE)-$1.settings
truth_plates_settings = $(COMPRESS) $(truth_reduction_$1) $(AT_LEAST) $(truth_edge_$1) $(phantom_settings)
truth_compress = $(COMPRESS) $< $@ $(call truth_plates,$1) $(addprefix --at-least ,$(AT_LEAST)) $(common) --view $(view_$1)
$(TRUTH_AT)-coarse-cc.vtkhdf $(TRUTH_AT)-coarse-mlo.vtkhdf: $(TRUTH_AT)-coarse-%.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf $(COMPRESS) \
  $$(call stale,$$(call truth_plates_record,$$*),$$(call truth_plates_settings,$$*))
	$(call staged,$(call truth_plates_record,$*),$(call truth_plates_settings,$*),--keep $@) $(call truth_compress,$*) --reduction $(truth_reduction_$*)
$(TRUTH_AT)-fine-cc.vtkhdf $(TRUTH_AT)-fine-mlo.vtkhdf: $(TRUTH_AT)-fine-%.vtkhdf: $(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-coarse-%.vtkhdf $(COMPRESS)
	$(call staged,$(call truth_plates_record,fine-$*),$(call truth_plates_settings,$*),--keep $@) $(call truth_compress,$*) $(call same_plates,$(TRUTH_AT)-coarse-$*.json)
# The chain, compressed between plates with the distance and position of those of the truth.
$(RUN)/truth-cc.vtkhdf $(RUN)/truth-mlo.vtkhdf: $(RUN)/truth-%.vtkhdf: $(RUN)/reference.vtkhdf $(TRUTH_TABLE) $(COMPRESS)
	$(call pressed,truth-$*-of-chain) $(COMPRESS) $< $@ --view $(view_$*) $(call plates_of_truth,$*) $(addprefix --at-least ,$(AT_LEAST)) \
	  $(COMPRESS_OPTIONS) $(MECHANICS) $(SUPPORT) $(common)
$(TRUTH_TABLE): $(PHANTOM_TRUTH)/landmarks.tsv $(TRUTH_MESHES) $(BIN)/truth-table
	$(BIN)/truth-table $< $@ $(TRUTH_MESHES) $(common)
plates_of_truth = $(call same_plates,$(TRUTH_AT)-fine-$1.json)
same_plates = --thickness $$($(tabulate) key $1 thickness_mm) --edge-at $$($(tabulate) key $1 edge_at_mm) \
  --middle-at $$($(tabulate) key $1 middle_at_mm) --turn $$($(tabulate) key $1 turn_deg) --lean $$($(tabulate) key $1 lean_deg) \
  --bend $$($(tabulate) key $1 bend_deg)
truth-compressed_settings := $(BIN)/probe
$(RUN)/truth-compressed.tsv: $(TRUTH_TABLE) $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf \
  truth-cc.vtkhdf truth-mlo.vtkhdf) $(BIN)/probe $(call changed,truth-compressed)
	$(call prints,truth-compressed,$@) $(BIN)/probe $(filter %.vtkhdf,$^) --truth $<
truth: $(RUN)/truth-compressed.tsv
	@cat $<
.PHONY: truth
