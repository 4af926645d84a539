# SPDX-License-Identifier: GPL-3.0-or-later
# How much of the paper's own figures is numerical: the case's prone-to-supine motion with its choices made one at a time,
# against the finest solution (FINDINGS_FINEST of about N^3 27-node elements on the dome).
FINDINGS_FINEST ?= 10
findings: $(TABLES)/findings.tsv
	@cat $<
.PHONY: findings
ifndef PAPER
FINDINGS := plain-invariants cuboid skin-layer as-printed finest
plain-invariants_mechanics = $(MECHANICS) --invariants plain
cuboid_hexmesh = $(HEXMESH_OPTIONS) --template cuboid
skin-layer_hexmesh = $(HEXMESH_OPTIONS) --skin-as layer
as-printed_hexmesh = $(PRINTED_HEXMESH)
as-printed_mechanics = $(PRINTED_MECHANICS)
finest_hexmesh = --elements $(FINDINGS_FINEST)
finest_mechanics = --materials $(MATERIALS) --element q2p1
finding_mesh = $(if $($1_hexmesh),$(VARIANTS)/$1-mesh.vtkhdf,$(own_mesh))
finding_mechanics = $(or $($1_mechanics),$(MECHANICS))
$(foreach f,$(FINDINGS),$(if $($f_hexmesh),$(eval $(call variant_mesh_rules,$f,$($f_hexmesh)))))
$(foreach f,$(FINDINGS),$(eval $(call variant_rules,$f,$(call finding_mesh,$f),$(call finding_mechanics,$f),$(MATERIAL_FILE))))

$(TABLES)/findings.tsv: $(RUN)/base-slopes.tsv $(FINDINGS:%=$(VARIANTS)/%-slopes.tsv) $(TABULATE)
	@mkdir -p $(@D)
	$(tabulate) findings $(RUN) $(FINDINGS) > $@.part
	@mv $@.part $@
endif
