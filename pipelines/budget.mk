# SPDX-License-Identifier: GPL-3.0-or-later
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
# A solve without result leaves its reason in ROW/NAME.failed and the table's last column, not a stop.
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
budget-geometry_settings = $(FIT_HERMITE) $(FIT_OPTIONS)
$(BUDGET)/segmentation/geometry.vtkhdf: $(PHANTOM_MR) $(FIT_HERMITE) $(call changed,budget-geometry)
	@mkdir -p $(@D)
	$(FIT_HERMITE) $(budget_truth) $@ $(FIT_OPTIONS) $(common)
	@$(call record,budget-geometry)
# $(call budget_mesh_rules,ROW,GEOMETRY,LABELS,HEXMESH OPTIONS)
define budget_mesh_rules
budget-mesh-$1_settings = $(HEXMESH) $4 $(tumour)
$(BUDGET)/$1/mesh.vtkhdf: $2 $(or $(filter $(RUN)/%,$3),$(PHANTOM_MR)) $(HEXMESH) $$(call changed,budget-mesh-$1)
	@mkdir -p $$(@D)
	$(HEXMESH) $$< $3 $$@ $4 $(tumour) $$(common)
	@$$(call record,budget-mesh-$1)
endef
$(eval $(call budget_mesh_rules,segmentation,$(BUDGET)/segmentation/geometry.vtkhdf,$(budget_truth),$(HEXMESH_OPTIONS)))
# The truth's breast ends elsewhere on the chest than the one segmented.
$(eval $(call budget_mesh_rules,tissue,$(RUN)/geometry.vtkhdf,$(budget_truth),$(HEXMESH_OPTIONS) --accept-mismatch))
$(eval $(call budget_mesh_rules,discretisation,$(RUN)/geometry.vtkhdf,$(RUN)/labels.vtkhdf,$(budget_finer)))
$(BUDGET)/body/mesh.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf
	@mkdir -p $(@D)
	cp $< $@
$(BUDGET)/cut/mesh.vtkhdf: $(RUN)/mesh.vtkhdf
	@mkdir -p $(@D)
	cp $< $@

# $(call budget_rules,ROW,SUPPORT): the stages after the mesh; a row is solved anew when any of its settings changes.
define budget_rules
budget-$1_settings = $(BACKWARD) $(FORWARD) $(COMPRESS) $(PRONE) $(COMPRESS_OPTIONS) $(AT_LEAST) $(MECHANICS) $2
$(if $(filter backward,$1),,$(BUDGET)/$1/reference.done: $(BUDGET)/$1/mesh.vtkhdf $(BACKWARD) $(MATERIAL_FILE) \
  $(PIPELINES)/attempt.sh $$(call changed,budget-$1)
	$(PIPELINES)/attempt.sh $$(basename $$@) $(BACKWARD) $$< $(PRONE) $(MECHANICS) $2 $$(share)
	@$$(call record,budget-$1)
	@touch $$@)
$(BUDGET)/$1/supine.done: $(BUDGET)/$1/reference.done $(FORWARD) $(PIPELINES)/attempt.sh
	$(PIPELINES)/attempt.sh $$(basename $$@) $(FORWARD) $$(<:.done=.vtkhdf) --posture supine $(MECHANICS) $2 $$(share)
	@touch $$@
$(BUDGET)/$1/cc.done $(BUDGET)/$1/mlo.done: $(BUDGET)/$1/%.done: $(BUDGET)/$1/reference.done \
  $(TRUTH_TABLE) $(COMPRESS) $(PIPELINES)/attempt.sh
	$(PIPELINES)/attempt.sh $$(basename $$@) $(COMPRESS) $$(<:.done=.vtkhdf) --view $$(call upper,$$*) \
	  $$(call same_plates,$(TRUTH_AT)-fine-$$*.json) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) $(MECHANICS) $2 $$(share)
	@touch $$@
endef
$(foreach row,$(filter-out cut compression,$(BUDGET_ROWS)),$(eval $(call budget_rules,$(row),$(SUPPORT))))
$(eval $(call budget_rules,cut,$(addprefix --wall ,$(WALL)) --cut fixed))

# $(call budget_follow,TRUE): the chain's mesh deformed as the true body.
budget_follow = $(call bench,follow_shape) && $(BIN)/follow_shape $(RUN)/mesh.vtkhdf $1 $(basename $@).vtkhdf > $(basename $@)-outside.tsv
$(BUDGET)/backward/reference.done: $(RUN)/mesh.vtkhdf $(TRUTH_AT)-fine.vtkhdf tests/truth/follow_shape.cpp $(call changed,budget-backward)
	@mkdir -p $(@D)
	$(call budget_follow,$(TRUTH_AT)-fine.vtkhdf)
	@$(call record,budget-backward)
	@touch $@
$(BUDGET)/compression/cc.done $(BUDGET)/compression/mlo.done: $(BUDGET)/compression/%.done: \
  $(RUN)/mesh.vtkhdf $(TRUTH_TABLE) tests/truth/follow_shape.cpp
	@mkdir -p $(@D)
	$(call budget_follow,$(TRUTH_AT)-fine-$*.vtkhdf)
	@touch $@

# Empty tables where a shape they need was not found.
$(foreach row,$(BUDGET_ROWS),$(BUDGET)/$(row)/curves.tsv): %/curves.tsv: %/cc.done %/mlo.done $(TRUTH_TABLE) $(CC2MLO)
	if [ -f $*/cc.failed ] || [ -f $*/mlo.failed ]; then : > $@; else \
	  $(CC2MLO) $*/cc.vtkhdf $*/mlo.vtkhdf $*/curves.vtp --truth $(TRUTH_TABLE) --table $@ $(common); fi
$(foreach row,$(filter-out compression,$(BUDGET_ROWS)),$(BUDGET)/$(row)/landmarks.tsv): %/landmarks.tsv: \
  %/reference.done %/supine.done $(TRUTH_TABLE) $(PROBE)
	if [ -f $*/reference.failed ] || [ -f $*/supine.failed ]; then : > $@; else \
	  $(PROBE) $*/reference.vtkhdf $*/supine.vtkhdf --truth $(TRUTH_TABLE) > $@.part; mv $@.part $@; fi
$(BUDGET)/chain/curves.tsv: $(RUN)/truth-cc.vtkhdf $(RUN)/truth-mlo.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	@mkdir -p $(@D)
	$(CC2MLO) $(wordlist 1,2,$^) $(basename $@).vtp --truth $(TRUTH_TABLE) --table $@ $(common)
$(BUDGET)/chain/landmarks.tsv: $(RUN)/reference.vtkhdf $(RUN)/supine.vtkhdf $(TRUTH_TABLE) $(PROBE)
	@mkdir -p $(@D)
	$(PROBE) $(wordlist 1,2,$^) --truth $(TRUTH_TABLE) > $@.part
	@mv $@.part $@

$(BUDGET)/budget.tsv: $(foreach row,chain $(BUDGET_ROWS),$(BUDGET)/$(row)/curves.tsv) \
  $(foreach row,chain $(filter-out compression,$(BUDGET_ROWS)),$(BUDGET)/$(row)/landmarks.tsv) \
  $(RUN)/cc.vti $(RUN)/mlo.vti $(TABULATE)
	$(tabulate) budget $(RUN) $(BUDGET_ROWS) > $@.part
	@mv $@.part $@
$(BUDGET)/budget.png: $(BUDGET)/budget.tsv $(PIPELINES)/budget.gp
	gnuplot -e "table='$<'; picture='$@.part'" $(PIPELINES)/budget.gp
	@mv $@.part $@
