# SPDX-License-Identifier: GPL-3.0-or-later
# Error against run time: stress-free and supine shape with each element, mesh, template and linear solver, as one
# table and one plot. The error is the landmarks' distance to the finest solution (COST_FINEST) of the same geometry.
# A point is named ELEMENT-TEMPLATE-N[-SOLVER]; its solves are cached below RUN/cost.
COST := $(RUN)/cost
COST_FINEST ?= q2p1-dome-24
COST_POINTS ?= $(addprefix q1p0-dome-,4 6 8 10 12 14 16 20 24 32) $(addprefix q2p1-dome-,4 6 8 10 12 16 20 24) \
  $(addprefix q1p0-cuboid-,8 12 16 24) $(addsuffix -direct,$(addprefix q1p0-dome-,12 16 20 24) q2p1-dome-12)
cost: $(COST)/cost.tsv $(COST)/cost.png
	@cat $<
.PHONY: cost

# $(call cost_part,POINT,K): the K-th part of its name.
cost_part = $(word $2,$(subst -, ,$1))
cost_mesh = $(COST)/mesh-$(call cost_part,$1,2)-$(call cost_part,$1,3).vtkhdf
cost_points := $(sort $(COST_POINTS) $(COST_FINEST) $(ACCURACY_LADDER))

define cost_mesh_rules
cost-$(notdir $1)_settings = $(HEXMESH) $(tumour)
cost-$(notdir $1)_record = $1.settings
$1: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(wildcard $(TUMOUR)) $(HEXMESH) $$(call changed,cost-$(notdir $1))
	@mkdir -p $$(@D)
	$(HEXMESH) $$< $(RUN)/labels.vtkhdf $$@ --template $2 --elements $3 $(tumour) $$(common)
	@$$(call record,cost-$(notdir $1))
endef
$(foreach m,$(sort $(foreach p,$(cost_points),$(call cost_part,$p,2)-$(call cost_part,$p,3))),$(eval \
  $(call cost_mesh_rules,$(COST)/mesh-$m.vtkhdf,$(call cost_part,$m,1),$(call cost_part,$m,2))))

define cost_rules
cost-$1_settings = $(BACKWARD) $(FORWARD) $(MATERIALS) $(SUPPORT)
cost-$1_record = $(COST)/$1.settings
$(COST)/$1.done: $(call cost_mesh,$1) $(BACKWARD) $(FORWARD) $(MATERIAL_FILE) $(PIPELINES)/posture-change.sh \
  $$(call changed,cost-$1)
	$(PIPELINES)/posture-change.sh $$< $(COST)/$1 "$(BACKWARD)" "$(FORWARD)" --materials $(MATERIALS) $(SUPPORT) \
	  --element $(call cost_part,$1,1) $(addprefix --solver ,$(call cost_part,$1,4)) $$(share)
	@$$(call record,cost-$1)
	@touch $$@
endef
$(foreach p,$(cost_points),$(eval $(call cost_rules,$p)))

$(COST)/cost.tsv: $(addprefix $(COST)/,$(sort $(COST_POINTS:%=%.done) $(COST_FINEST).done)) $(TABULATE)
	$(tabulate) cost $(COST) $(COST_FINEST) $(COST_POINTS) > $@.part
	@mv $@.part $@
$(COST)/cost.png: $(COST)/cost.tsv $(PIPELINES)/cost.gp
	gnuplot -e "table='$<'; picture='$@.part'" $(PIPELINES)/cost.gp
	@mv $@.part $@
