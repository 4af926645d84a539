# SPDX-License-Identifier: GPL-3.0-or-later
# Tables of the validation pages that runs can make, so that none of them goes stale by hand: each is a file in docs/tables, which
# `make validation` writes from the case's runs and copies into the page between its markers. The test tools_validation (part of
# `check`) holds page and files equal.
TABLES_OF_PAGE := docs/tables
PAGES_WITH_TABLES := docs/architecture.md docs/validation.md $(wildcard docs/validation/*.md)

validation: $(addprefix $(TABLES_OF_PAGE)/,compression-convergence.tsv calibration.tsv truth.tsv)
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
validation-page:
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
# Of docs/validation/slicer.md, from the default case.
slicer-table: slicer
	cp $(RUN)/slicer-fields.tsv $(TABLES_OF_PAGE)/slicer-fields.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/slicer-fields.tsv $(RUN)/slicer.json
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: validation validation-page slicer-table

# Records the run from which a table was made, which the page states below the table: $(call made_by,REPORT.json). The date is that
# of the report.
made_by = flock $(TABLES_OF_PAGE) $(tabulate) made $@ $1

# How the compressed shapes converge with the mesh (studies/convergence.tsv).
$(TABLES_OF_PAGE)/compression-convergence.tsv: $(call results,convergence,$(convergence_variants),cc mlo) $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) convergence $(call study_dir,convergence) $(convergence_variants))
	$(call made_by,$<)

# The displacements to which the preset was fitted and those of its truth, with those of the chain as solved and as printed.
$(TABLES_OF_PAGE)/calibration.tsv: $(RUN)/displacements.tsv $(base_printed) $(PHANTOM_MR) $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) calibration $(RUN) $(PHANTOM_MR:.nrrd=.json) $(SIDE))
	$(call made_by,$(RUN)/supine.json)

# Errors against the truth, as in the summary.
$(TABLES_OF_PAGE)/truth.tsv: $(RUN)/truth.tsv $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) truth $<)
	$(call made_by,$(RUN)/supine.json)
