# SPDX-License-Identifier: GPL-3.0-or-later
# Tables of the validation pages that runs can make, so that none of them goes stale by hand: each is a file in docs/tables, which
# `make validation` writes from the case's runs and copies into the page between its markers. The test tools_validation (part of
# `check`) holds page and files equal.
TABLES_OF_PAGE := docs/tables
PAGES_WITH_TABLES := docs/architecture.md docs/validation.md $(wildcard docs/validation/*.md)

# $(call published,NAME,TABLE,REPORT): copies a table to docs/tables/NAME.tsv, with the run that its report names, and into its page.
define published
	cp $2 $(TABLES_OF_PAGE)/$1.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/$1.tsv $3
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
endef
validation: $(addprefix $(TABLES_OF_PAGE)/,compression-convergence.tsv calibration.tsv truth.tsv)
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
validation-page:
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
# Of docs/validation/slicer.md, from the default case.
slicer-table: slicer
	$(call published,slicer-fields,$(RUN)/slicer-fields.tsv,$(RUN)/slicer.json)
# Of docs/validation/sliding.md: the judging half of the cohort beside living women.
population-table: population
	$(call published,sliding,$(POPULATION_RUNS)/judging.tsv,$(POPULATION_RUNS)/judging.json)
.PHONY: population-table
# Of docs/validation/geometry.md: sides of real women (COHORT=DIR).
sides-table: sides
	$(call published,sides,$(COHORT_RUNS)/sides.tsv,$(COHORT_RUNS)/sides.tsv)
.PHONY: sides-table

# Of docs/validation/sliding.md: the cohort between plates, and how the compressed shape depends on the mesh, on friction and on the
# length of the steps (tests/bench/plates.tsv), of the preset average by 50 %.
compression-tables: $(BIN)/tabulate
	@+$(MAKE) -f $(PIPELINE) REDUCTION=50 compressed-population
	cp $(POPULATION_RUNS)/compressed.tsv $(TABLES_OF_PAGE)/compression-cohort.tsv
	@+$(MAKE) -f $(PIPELINE) REDUCTION=50 PRESET=average STUDY=tests/bench/plates.tsv study
	@+$(MAKE) -f $(PIPELINE) REDUCTION=50 PRESET=average plates-tables
.PHONY: compression-tables plates-tables
plates = $(tabulate) plates $(call study_dir,plates)
plates-tables:
	$(plates) next 10 12 16 20 25 31 > $(TABLES_OF_PAGE)/compression-mesh.tsv
	$(plates) 12 friction-0.1 12 friction-0.2 friction-0.3 > $(TABLES_OF_PAGE)/compression-friction.tsv
	$(plates) 16 half-cc half-mlo > $(TABLES_OF_PAGE)/compression-steps.tsv
	for name in mesh friction steps; do \
	  $(tabulate) made $(TABLES_OF_PAGE)/compression-$$name.tsv $(call study_dir,plates/10)/cc.json; done
	$(tabulate) made $(TABLES_OF_PAGE)/compression-cohort.tsv $(POPULATION_RUNS)/average-left/cc.json
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: validation validation-page slicer-table

# Records the run from which a table was made, which the page states below the table: $(call made_by,REPORT.json). The date is that
# of the report.
made_by = flock $(TABLES_OF_PAGE) $(tabulate) made $@ $1

# Of docs/validation/errors.md: error against run time of the case (`make PRESET=average cost`), and what all tables say together.
cost-table: cost
	cp $(COST)/cost.tsv $(TABLES_OF_PAGE)/cost.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/cost.tsv $(call study_dir,cost)/$(COST_FINEST)/supine.json
# Of the same page: how friction moves the tumour between the plates of screening, and what a lookup loses between its nodes.
lookups := $(foreach pitch,16 8 4 2 1,$(RUN)/lookups/pitch-$(pitch).h5)
default_plates = $(call study_dir,friction)/friction-0.3
errors-tables: $(BIN)/tabulate $(BIN)/match-lookup
	@+$(MAKE) -f $(PIPELINE) STUDY=tests/bench/friction.tsv study
	$(tabulate) plates $(call study_dir,friction) friction-0.3 friction-0.2 friction-0.3 friction-0.4 > $(TABLES_OF_PAGE)/friction.tsv.part
	mv $(TABLES_OF_PAGE)/friction.tsv.part $(TABLES_OF_PAGE)/friction.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/friction.tsv $(default_plates)/cc.json
	@mkdir -p $(RUN)/lookups
	for file in $(lookups); do \
	  pitch=$${file##*-}; \
	  $(BIN)/match-lookup $(default_plates)/cc.vtkhdf $(default_plates)/mlo.vtkhdf $$file --pitch $${pitch%.h5} --report $${file%.h5}.json $(share); done
	$(tabulate) lookup-cost $(lastword $(lookups)) $(filter-out $(lastword $(lookups)),$(lookups)) > $(TABLES_OF_PAGE)/lookup-cost.tsv.part
	mv $(TABLES_OF_PAGE)/lookup-cost.tsv.part $(TABLES_OF_PAGE)/lookup-cost.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/lookup-cost.tsv $(RUN)/lookups/pitch-1.json
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: errors-tables
errors-page: $(BIN)/tabulate $(RENDER)
	for name in error-sources methods-cost; do \
	  $(tabulate) $$name $(TABLES_OF_PAGE) > $(TABLES_OF_PAGE)/$$name.tsv.part; \
	  mv $(TABLES_OF_PAGE)/$$name.tsv.part $(TABLES_OF_PAGE)/$$name.tsv; \
	  $(RENDER) $(TABLES_OF_PAGE)/$$name.tsv --figure $$name -o docs/validation/$$name.png; done
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: cost-table errors-page
# The pictures of docs/gallery.md, of this case.
gallery: chain
	tests/bench/gallery.sh $(BIN) $(RUN) $(MR) docs/gallery.md
.PHONY: gallery

# How the compressed shapes converge with the mesh (studies/convergence.tsv).
$(TABLES_OF_PAGE)/compression-convergence.tsv: $(call results,convergence,$(convergence_variants),cc mlo) $(BIN)/tabulate
	$(call table,$(tabulate) convergence $(call study_dir,convergence) $(convergence_variants))
	$(call made_by,$<)

# The displacements to which the preset was fitted and those of its truth, with those of the chain as solved and as printed.
$(TABLES_OF_PAGE)/calibration.tsv: $(RUN)/displacements.tsv $(base_printed) $(PHANTOM_MR) $(BIN)/tabulate
	$(call table,$(tabulate) calibration $(RUN) $(PHANTOM_MR:.nrrd=.json) $(SIDE))
	$(call made_by,$(RUN)/supine.json)

# Errors against the truth, as in the summary.
$(TABLES_OF_PAGE)/truth.tsv: $(RUN)/truth.tsv $(BIN)/tabulate
	$(call table,$(tabulate) truth $<)
	$(call made_by,$(RUN)/supine.json)
