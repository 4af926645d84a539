# SPDX-License-Identifier: GPL-3.0-or-later
# Every breast of pipelines/invivo/cohort.tsv is solved from the scan to the supine shape, and a table compares the motion of its
# tissue with that of living women (pipelines/invivo/women.tsv). Cases with a scan are included if POPULATION_SCANS names its file.
#   make population                                the table, and the figure of motion against depth
#   make compressed-population                     the same breasts between plates, CC and MLO, one row each
# The calibration half of the cohort is used by `make calibrate-invivo` (tests/bench/calibrate.mk).
POPULATION_RUNS := $(RUNS)/population
population_files = $(patsubst %,$(POPULATION_RUNS)/%/$2.vtkhdf,$1)
population_both = $(population_calibration) $(population_judging)
ifneq ($(filter population population-table compressed-population calibrate-invivo calibrate-invivo-sternum calibrate-invivo-borders,$(MAKECMDGOALS)),)
# Both sides share one phantom; therefore the cases run one after the other.
.NOTPARALLEL:
population_calibration :=
population_judging :=
population_women :=
scan_file = $(firstword $(foreach s,$(POPULATION_SCANS),$(if $(filter $1.%,$(notdir $s)),$s)))
make_breast = $(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) $(breast) ELEMENTS=$(POPULATION_ELEMENTS) TUMOUR=none $@
define breast
name := $(cell_case)
source := $(if $(cell_scan),$(addprefix MR=,$(call scan_file,$(cell_scan))),PRESET=$(cell_preset))
population_$(cell_use) += $(if $(source),$(name))
$(foreach shape,mesh supine cc mlo,$(call population_files,$(name),$(shape))): breast := CASE=$(name) SIDE=$(cell_side) $(source) MATERIALS=$(POPULATION_MATERIALS)
$(call population_files,$(name),mesh) $(call population_files,$(name),supine): FORCE
	@+$(make_breast)
# A compression that ends early is a row of the table, if its report says so.
$(call population_files,$(name),cc) $(call population_files,$(name),mlo): FORCE
	@+$(make_breast) || test -s $(basename $@).json
endef
$(call ask,$(CASES) rows $(PIPELINES)/invivo/cohort.tsv breast)
endif

population_compare = $(POPULATION_TOOL) $(call population_files,$1,supine) --women $(PIPELINES)/invivo/women.tsv \
  --table $(POPULATION_RUNS)/$2-motion.tsv --summary $(POPULATION_RUNS)/$2.tsv --report $(POPULATION_RUNS)/$2.json
population: $(call population_files,$(population_both),supine) $(POPULATION_TOOL) $(RENDER)
	$(call population_compare,$(population_both),cohort)
	$(call population_compare,$(population_judging),judging)
	$(RENDER) $(POPULATION_RUNS)/judging.tsv --figure motion -o $(POPULATION_RUNS)/motion.png
	@cat $(POPULATION_RUNS)/judging.tsv
compressed-population: $(foreach b,$(population_both),$(call population_files,$b,cc) $(call population_files,$b,mlo)) $(TABULATE)
	@$(tabulate) compressions $(patsubst %.vtkhdf,%.json,$(filter %.vtkhdf,$^)) | tee $(POPULATION_RUNS)/compressed.tsv
.PHONY: population compressed-population
