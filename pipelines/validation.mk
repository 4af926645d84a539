# SPDX-License-Identifier: GPL-3.0-or-later
# Tables of the validation pages that runs can make, so that none of them goes stale by hand: each is a file in docs/tables, which
# `make validation` writes from the case's runs and copies into the page between its markers. The test tools_validation (part of
# `check`) holds page and files equal.
VALIDATION := $(RUN)/validation
VALIDATION_EDGES ?= 8 10 12 16 20
TABLES_OF_PAGE := docs/tables
PAGES_WITH_TABLES := docs/architecture.md docs/validation.md $(wildcard docs/validation/*.md)

validation: $(addprefix $(TABLES_OF_PAGE)/,compression-convergence.tsv calibration.tsv truth.tsv)
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
validation-page:
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: validation validation-page

# How the compressed shapes converge with the mesh.
define convergence_rules
convergence-mesh-$1_settings = $(HEXMESH) $(tumour)
convergence-mesh-$1_record = $(VALIDATION)/.$1-mesh.settings
$(VALIDATION)/$1-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(wildcard $(TUMOUR)) $(HEXMESH) \
  $$(call changed,convergence-mesh-$1)
	@mkdir -p $$(@D)
	$(HEXMESH) $$< $(RUN)/labels.vtkhdf $$@ --elements $1 $(tumour) $$(common)
	@$$(call record,convergence-mesh-$1)
convergence-$1_settings = $(BACKWARD) $(COMPRESS) $(MECHANICS) $(COMPRESS_OPTIONS) $(REDUCTION) $(AT_LEAST) $(SUPPORT)
convergence-$1_record = $(VALIDATION)/.$1.settings
$(VALIDATION)/$1.done: $(VALIDATION)/$1-mesh.vtkhdf $(BACKWARD) $(COMPRESS) $(MATERIAL_FILE) $(PIPELINES)/attempt.sh \
  $$(call changed,convergence-$1)
	$(PIPELINES)/attempt.sh $(VALIDATION)/$1-reference $(BACKWARD) $$< $(PRONE) $(MECHANICS) $(SUPPORT) $$(share)
	for view in CC MLO; do $(PIPELINES)/attempt.sh $(VALIDATION)/$1-$$$$view $(COMPRESS) $(VALIDATION)/$1-reference.vtkhdf \
	  --view $$$$view --reduction $(REDUCTION) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) $(MECHANICS) $(SUPPORT) $$(share); done
	@$$(call record,convergence-$1)
	@touch $$@
endef
$(foreach n,$(VALIDATION_EDGES),$(eval $(call convergence_rules,$n)))
$(TABLES_OF_PAGE)/compression-convergence.tsv: $(VALIDATION_EDGES:%=$(VALIDATION)/%.done) $(TABULATE)
	@mkdir -p $(@D)
	$(tabulate) convergence $(VALIDATION) $(VALIDATION_EDGES) > $@.part
	@mv $@.part $@

# What the preset was fitted to, beside what its truth moves: the chain as solved and as printed.
$(TABLES_OF_PAGE)/calibration.tsv: $(RUN)/displacements.tsv $(VARIANTS)/as-printed.done $(PHANTOM_MR) $(TABULATE)
	@mkdir -p $(@D)
	$(tabulate) calibration $(RUN) $(PHANTOM_MR:.nrrd=.json) $(SIDE) > $@.part
	@mv $@.part $@

# Errors against the truth, as the summary has them.
$(TABLES_OF_PAGE)/truth.tsv: $(RUN)/truth.tsv $(TABULATE)
	@mkdir -p $(@D)
	$(tabulate) truth $< > $@.part
	@mv $@.part $@
