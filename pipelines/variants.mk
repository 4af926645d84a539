# SPDX-License-Identifier: GPL-3.0-or-later
# Prone to supine once more with another mesh, law or element, and the slopes d ln u / d ln s of each: what Table VIII and
# the findings compare. A variant lies in RUN/variants as NAME-{reference,supine}.vtkhdf, NAME-slopes.tsv; where its
# material has no stress-free body, NAME.failed says so and its cells are dashes.
VARIANTS := $(RUN)/variants

# $(call variant_mesh_rules,NAME,HEXMESH OPTIONS)
define variant_mesh_rules
variant-mesh-$1_settings = $(HEXMESH) $2 $(tumour)
$(VARIANTS)/$1-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(wildcard $(TUMOUR)) $(HEXMESH) \
  $$(call changed,variant-mesh-$1)
	@mkdir -p $$(@D)
	$(HEXMESH) $$< $(RUN)/labels.vtkhdf $$@ $2 $(tumour) $$(common)
	@$$(call record,variant-mesh-$1)
endef

# $(call variant_rules,NAME,MESH,MECHANICS[,MATERIAL FILE])
define variant_rules
variant-$1_settings = $(BACKWARD) $(FORWARD) $3 $(SUPPORT)
$(VARIANTS)/$1.done: $2 $4 $(BACKWARD) $(FORWARD) $(PIPELINES)/posture-change.sh $$(call changed,variant-$1)
	@mkdir -p $$(@D)
	$(PIPELINES)/posture-change.sh $2 $(VARIANTS)/$1 "$(BACKWARD)" "$(FORWARD)" $3 $(SUPPORT) $$(share)
	@$$(call record,variant-$1)
	@touch $$@
$(call slopes_rules,$(VARIANTS)/$1,$(VARIANTS)/$1.done,$(VARIANTS)/$1-reference.vtkhdf,$(VARIANTS)/$1-supine.vtkhdf,$3,fat$(comma)fibroglandular$(comma)skin)
endef

# $(call slopes_rules,NAME,NEEDS,STRESS-FREE,SUPINE,MECHANICS,PARAMETERS): NAME-slopes.tsv, empty when NAME.failed stands.
define slopes_rules
$1-slopes.tsv: $2 $(SENSITIVITY)
	@mkdir -p $$(@D)
	if [ -f $1.failed ]; then : > $$@; else $(SENSITIVITY) $3 $4 $1-sensitivity.vtkhdf $(PRONE) $5 $(SUPPORT) \
	  --parameters $6 --table $$@ --report $1-sensitivity.json $$(share); fi
endef
comma := ,
SENSITIVITY ?= $(BIN)/sensitivity
