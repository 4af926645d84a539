# The error budget of the chain: each stage's result replaced in turn by the phantom's truth, what is left of the
# errors at the truth's places (stress-free, supine, MLO curve), and what the stage costs. Rows of the table:
#   chain         nothing replaced; compressed between plates that stand as the truth's
#   segmentation  true labels: fit, mesh and all that follows anew
#   body          true surfaces and tissue: the phantom's own coarse mesh instead of segmentation, fit and mesh
#   tissue        the chain's mesh with tissue from the true labels
#   cut           the cut held, as in the phantom, where the chain leaves it free
#   discretisation  the chain's geometry on BUDGET_FINER elements
#   backward      the true stress-free shape on the chain's mesh
#   compression   the true compressed shapes on the chain's mesh: what is left is projection and matching
BUDGET := $(RUN)/budget
BUDGET_FINER ?= 20
budget_finer = --elements $(BUDGET_FINER) $(subst --elements $(ELEMENTS),,$(HEXMESH_OPTIONS))
BUDGET_ROWS := segmentation body tissue cut discretisation backward compression
upper = $(if $(filter cc,$1),CC,MLO)
budget_truth := $(PHANTOM_TRUTH)/labels-$(SIDE).vtkhdf

budget: $(BUDGET)/budget.tsv $(BUDGET)/budget.png
	@cat $<
.PHONY: budget

# Meshes that start a row; the rows cut, backward and compression use the chain's own.
$(BUDGET)/segmentation/geometry.vtkhdf: $(PHANTOM_MR) $(FIT_HERMITE)
	@mkdir -p $(@D)
	$(FIT_HERMITE) $(budget_truth) $@ $(FIT_OPTIONS) $(common)
$(BUDGET)/segmentation/mesh.vtkhdf: $(BUDGET)/segmentation/geometry.vtkhdf $(HEXMESH)
	$(HEXMESH) $< $(budget_truth) $@ $(HEXMESH_OPTIONS) $(tumour) $(common)
$(BUDGET)/tissue/mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(HEXMESH)
	@mkdir -p $(@D)
	$(HEXMESH) $< $(budget_truth) $@ $(HEXMESH_OPTIONS) $(tumour) $(common)
$(BUDGET)/discretisation/mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(HEXMESH)
	@mkdir -p $(@D)
	$(HEXMESH) $< $(RUN)/labels.vtkhdf $@ $(budget_finer) $(tumour) $(common)
$(BUDGET)/body/mesh.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf
	@mkdir -p $(@D)
	cp $< $@
$(BUDGET)/cut/mesh.vtkhdf: $(RUN)/mesh.vtkhdf
	@mkdir -p $(@D)
	cp $< $@

# $(call budget_follow,TRUE): the chain's mesh deformed as the true body.
budget_follow = $(call bench,follow_shape) && $(BIN)/follow_shape $(RUN)/mesh.vtkhdf $1 $@ > $(basename $@)-outside.tsv
$(BUDGET)/backward/reference.vtkhdf: $(RUN)/mesh.vtkhdf $(TRUTH_AT)-fine.vtkhdf tests/truth/follow_shape.cpp
	@mkdir -p $(@D)
	$(call budget_follow,$(TRUTH_AT)-fine.vtkhdf)
$(BUDGET)/compression/cc.vtkhdf $(BUDGET)/compression/mlo.vtkhdf: $(BUDGET)/compression/%.vtkhdf: \
  $(RUN)/mesh.vtkhdf $(TRUTH_TABLE) tests/truth/follow_shape.cpp
	@mkdir -p $(@D)
	$(call budget_follow,$(TRUTH_AT)-fine-$*.vtkhdf)

# $(call budget_rules,ROW,CUT): the stages after the mesh.
define budget_rules
$(if $(filter backward,$1),,$(BUDGET)/$1/reference.vtkhdf: $(BUDGET)/$1/mesh.vtkhdf $(BACKWARD)
	$(BACKWARD) $$< $$@ $(PRONE) $(MECHANICS) --cut $2 $$(common))
$(BUDGET)/$1/supine.vtkhdf: $(BUDGET)/$1/reference.vtkhdf $(FORWARD)
	$(FORWARD) $$< $$@ --posture supine $(MECHANICS) --cut $2 $$(common)
$(BUDGET)/$1/cc.vtkhdf $(BUDGET)/$1/mlo.vtkhdf: $(BUDGET)/$1/%.vtkhdf: $(BUDGET)/$1/reference.vtkhdf \
  $(TRUTH_TABLE) $(COMPRESS)
	$(COMPRESS) $$< $$@ --view $$(call upper,$$*) $$(call same_plates,$(TRUTH_AT)-fine-$$*.json) \
	  --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) $(MECHANICS) --cut $2 $$(common)
endef
$(foreach row,$(filter-out cut compression,$(BUDGET_ROWS)),$(eval $(call budget_rules,$(row),$(CUT))))
$(eval $(call budget_rules,cut,fixed))

$(foreach row,$(BUDGET_ROWS),$(BUDGET)/$(row)/curves.tsv): %/curves.tsv: %/cc.vtkhdf %/mlo.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	$(CC2MLO) $*/cc.vtkhdf $*/mlo.vtkhdf $*/curves.vtp --truth $(TRUTH_TABLE) --table $@ $(common)
$(BUDGET)/chain/curves.tsv: $(RUN)/truth-cc.vtkhdf $(RUN)/truth-mlo.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	@mkdir -p $(@D)
	$(CC2MLO) $(wordlist 1,2,$^) $(basename $@).vtp --truth $(TRUTH_TABLE) --table $@ $(common)
$(foreach row,$(filter-out compression,$(BUDGET_ROWS)),$(BUDGET)/$(row)/landmarks.tsv): %/landmarks.tsv: \
  %/reference.vtkhdf %/supine.vtkhdf $(TRUTH_TABLE) $(PROBE)
	$(PROBE) $*/reference.vtkhdf $*/supine.vtkhdf --truth $(TRUTH_TABLE) > $@.part
	@mv $@.part $@
$(BUDGET)/chain/landmarks.tsv: $(RUN)/reference.vtkhdf $(RUN)/supine.vtkhdf $(TRUTH_TABLE) $(PROBE)
	@mkdir -p $(@D)
	$(PROBE) $(wordlist 1,2,$^) --truth $(TRUTH_TABLE) > $@.part
	@mv $@.part $@

$(BUDGET)/budget.tsv: $(foreach row,chain $(BUDGET_ROWS),$(BUDGET)/$(row)/curves.tsv) \
  $(foreach row,chain $(filter-out compression,$(BUDGET_ROWS)),$(BUDGET)/$(row)/landmarks.tsv) \
  $(RUN)/cc.vti $(RUN)/mlo.vti pipelines/budget.sh pipelines/values.sh
	pipelines/budget.sh $(RUN) $(BUDGET_ROWS) > $@.part
	@mv $@.part $@
$(BUDGET)/budget.png: $(BUDGET)/budget.tsv pipelines/budget.gp
	gnuplot -e "table='$<'; picture='$@.part'" pipelines/budget.gp
	@mv $@.part $@
