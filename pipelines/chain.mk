# SPDX-License-Identifier: GPL-3.0-or-later
# The chain, one rule a stage; every file lies in runs/CASE with its report beside it. A stage runs again
# when its inputs, its program or its settings have changed (pipelines/remember.mk).
MR_FILES := $(MR) $(if $(wildcard $(MR)/.),$(wildcard $(MR)/*))
CHAIN_FILES := $(addprefix $(RUN)/,labels.vtkhdf geometry.vtkhdf mesh.vtkhdf reference.vtkhdf \
  supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti $(if $(no_tumour),lookup.h5 page.html,curve.vtp))
MATERIAL_FILE := $(or $(wildcard $(MATERIALS)),$(filter $(RUN)/%,$(MATERIALS)))
# LEAVE_OUT=no-gland: the set with the fibroglandular law replaced by fat's.
$(RUN)/fat-only.tsv: $(whole_set)
	@mkdir -p $(@D)
	awk -F'\t' -v OFS='\t' '$$1 == "fat" { fat = $$0 } $$1 == "fibroglandular" { $$0 = fat; $$1 = "fibroglandular" } { print }' $< > $@.part
	@mv $@.part $@

labels_settings := $(SEGMENT) $(MR) --side $(SIDE) $(if $(SERIES),--series $(SERIES)) \
  $(if $(CHEST_WALL),--chest-wall $(CHEST_WALL)) $(SEGMENT_OPTIONS)
# Contours to judge the result by; a program in the place of segment need not draw them.
contours = $(if $(filter $(BIN)/segment,$(SEGMENT)),--overlay $(RUN)/contours.png)
$(RUN)/labels.vtkhdf $(RUN)/points.vtp &: $(MR_FILES) $(CHEST_WALL) $(SEGMENT) $(call changed,labels)
	@$(PIPELINES)/scan-identity.sh record $(RUN) $(SIDE) $(scan)
	$(SEGMENT) $(MR) $(RUN)/labels.vtkhdf --side $(SIDE) $(if $(SERIES),--series $(SERIES)) \
	  $(if $(CHEST_WALL),--chest-wall $(CHEST_WALL)) --points $(RUN)/points.vtp $(contours) $(SEGMENT_OPTIONS) \
	  --report $(RUN)/labels.json $(share)
	@$(call record,labels)

geometry_settings := $(FIT_HERMITE) $(FIT_OPTIONS)
$(RUN)/geometry.vtkhdf: $(RUN)/labels.vtkhdf $(FIT_HERMITE) $(call changed,geometry)
	$(FIT_HERMITE) $< $@ $(FIT_OPTIONS) $(common)
	@$(call record,geometry)

mesh_settings := $(HEXMESH) $(HEXMESH_OPTIONS) $(tumour)
$(RUN)/mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(wildcard $(TUMOUR)) $(HEXMESH) $(call changed,mesh)
	$(HEXMESH) $< $(RUN)/labels.vtkhdf $@ $(HEXMESH_OPTIONS) $(tumour) $(common)
	@$(call record,mesh)

reference_settings := $(BACKWARD) $(PRONE) $(MECHANICS) $(SUPPORT)
$(RUN)/reference.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD) $(MATERIAL_FILE) $(call changed,reference)
	$(BACKWARD) $< $@ $(PRONE) $(MECHANICS) $(SUPPORT) $(common)
	@$(call record,reference)

supine_settings := $(FORWARD) $(MECHANICS) $(SUPPORT)
$(RUN)/supine.vtkhdf: $(RUN)/reference.vtkhdf $(FORWARD) $(MATERIAL_FILE) $(call changed,supine)
	$(FORWARD) $< $@ --posture supine $(MECHANICS) $(SUPPORT) $(common)
	@$(call record,supine)

# The two views: compress, then project. The mammogram's report must not overwrite the compression's.
define view_rules
$1_settings := $(COMPRESS) --reduction $(REDUCTION) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) \
  $(MECHANICS) $(SUPPORT)
$(RUN)/$1.vtkhdf: $(RUN)/reference.vtkhdf $(COMPRESS) $(MATERIAL_FILE) $$(call changed,$1)
	$(COMPRESS) $$< $$@ --view $2 --reduction $(REDUCTION) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) \
	  $(MECHANICS) $(SUPPORT) $$(common)
	@$$(call record,$1)

$1-mammogram_settings := $(PROJECT) $(PROJECT_OPTIONS)
$(RUN)/$1.vti $(RUN)/$1.png &: $(RUN)/$1.vtkhdf $(RUN)/labels.vtkhdf $(PROJECT) $$(call changed,$1-mammogram)
	$(PROJECT) $(RUN)/$1.vtkhdf $(RUN)/$1.vti --labels $(RUN)/labels.vtkhdf --png $(RUN)/$1.png \
	  $(PROJECT_OPTIONS) --report $(RUN)/$1-mammogram.json $$(share)
	@$$(call record,$1-mammogram)
endef
$(eval $(call view_rules,cc,CC))
$(eval $(call view_rules,mlo,MLO))

curve_settings := $(CC2MLO)
$(RUN)/curve.vtp $(RUN)/curve.tsv &: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(CC2MLO) $(call changed,curve)
	$(CC2MLO) $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(RUN)/curve.vtp --landmark tumour \
	  --table $(RUN)/curve.tsv --report $(RUN)/curve.json $(share)
	@$(call record,curve)

# The same with the lateral cut held: what this boundary condition changes at the landmarks.
cut-fixed_settings := $(BACKWARD) $(FORWARD) $(MECHANICS)
$(RUN)/reference-cut-fixed.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD) $(MATERIAL_FILE) $(call changed,cut-fixed)
	$(BACKWARD) $< $@ --posture prone $(MECHANICS) --cut fixed $(common)
	@$(call record,cut-fixed)
$(RUN)/supine-cut-fixed.vtkhdf: $(RUN)/reference-cut-fixed.vtkhdf $(FORWARD)
	$(FORWARD) $< $@ --posture supine $(MECHANICS) --cut fixed $(common)

# Tables come from stdout; a rename makes them complete or absent.
SHOWN := $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf)
$(RUN)/displacements.tsv: $(SHOWN) $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --landmarks $(landmarks) > $@.part
	@mv $@.part $@
$(RUN)/cut.tsv: $(RUN)/supine-cut-fixed.vtkhdf $(RUN)/supine.vtkhdf $(PROBE)
	$(PROBE) $< --base $(RUN)/supine.vtkhdf --landmarks $(landmarks) > $@.part
	@mv $@.part $@

# Errors against the phantom's truth (stress-free, prone, supine); a real scan has none.
ifdef TRUTH
$(RUN)/truth.tsv: $(TRUTH) $(SHOWN) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --truth $(TRUTH) > $@.part
	@mv $@.part $@
$(RUN)/truth-cut-fixed.tsv: $(TRUTH) $(RUN)/mesh.vtkhdf $(RUN)/reference-cut-fixed.vtkhdf \
  $(RUN)/supine-cut-fixed.vtkhdf $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --truth $(TRUTH) > $@.part
	@mv $@.part $@
endif

$(RUN)/summary.txt: $(CHAIN_FILES) $(RUN)/displacements.tsv $(RUN)/cut.tsv \
  $(if $(TRUTH),$(RUN)/truth.tsv $(if $(filter $(sliding_presets),$(PRESET)),,$(RUN)/truth-cut-fixed.tsv)) $(FIGURES) $(TABULATE) $(PIPELINES)/advice.tsv
	@$(tabulate) summary $(RUN) $(if $(TRUTH),$(PHANTOM_MR:.nrrd=.json)) > $@.part
	@mv $@.part $@
	@cat $@
