# SPDX-License-Identifier: GPL-3.0-or-later
# Every breast of pipelines/invivo/cohort.tsv is solved from the scan to the supine shape, and a table compares the motion of its
# tissue with that of living women (pipelines/invivo/women.tsv). Cases with a scan are included if POPULATION_SCANS names its file.
#   make population                                the table, and the figure of motion against depth
#   make compressed-population                     the same breasts between plates, CC and MLO, one row each
# The calibration half of the cohort is used by `make calibrate-invivo` (calibrate.mk).
POPULATION_ELEMENTS ?= 10
POPULATION_MATERIALS ?= invivo
POPULATION_RUNS := $(RUNS)/population
population_files = $(patsubst %,$(POPULATION_RUNS)/%/$2.vtkhdf,$1)
population_both = $(population_calibration) $(population_judging)
ifneq ($(filter population population-table compressed-population calibrate-invivo calibrate-invivo-sternum calibrate-invivo-borders,$(MAKECMDGOALS)),)
# Both sides share one phantom; therefore the cases run one after the other.
.NOTPARALLEL:
# The rows of cohort.tsv as words, case:preset:scan:side:use, and $(call cell,CASE,COLUMN).
population_rows := $(filter-out case:%,$(shell grep -v '^\#' $(PIPELINES)/invivo/cohort.tsv | tr '\t' :))
cell = $(word $2,$(subst :, ,$(filter $1:%,$(population_rows))))
# MR=SCAN or PRESET=NAME; empty if the scan of the row is not among POPULATION_SCANS.
scan_file = $(firstword $(foreach s,$(POPULATION_SCANS),$(if $(filter $1.%,$(notdir $s)),$s)))
source_of = $(if $(filter -,$(call cell,$1,3)),PRESET=$(call cell,$1,2),$(addprefix MR=,$(call scan_file,$(call cell,$1,3))))
population_of = $(strip $(foreach case,$(foreach row,$(filter %:$1,$(population_rows)),$(firstword $(subst :, ,$(row)))),$(if $(call source_of,$(case)),$(case))))
population_calibration := $(call population_of,calibration)
population_judging := $(call population_of,judging)
population_women := $(call population_of,women)
population_all := $(population_both) $(population_women)
breast = $(notdir $(@D))
make_breast = $(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) CASE=$(breast) SIDE=$(call cell,$(breast),4) $(call source_of,$(breast)) \
  MATERIALS=$(POPULATION_MATERIALS) ELEMENTS=$(POPULATION_ELEMENTS) TUMOUR=none $@
$(foreach shape,mesh supine,$(call population_files,$(population_all),$(shape))): FORCE
	@+$(make_breast)
# A compression that ends early is a row of the table, if its report says so.
$(foreach shape,cc mlo,$(call population_files,$(population_all),$(shape))): FORCE
	@+$(make_breast) || test -s $(basename $@).json
endif

population_compare = $(BIN)/population $(call population_files,$1,supine) --women $(PIPELINES)/invivo/women.tsv \
  --table $(POPULATION_RUNS)/$2-motion.tsv --summary $(POPULATION_RUNS)/$2.tsv --report $(POPULATION_RUNS)/$2.json
population: $(call population_files,$(population_both),supine) $(BIN)/population $(RENDER)
	$(call population_compare,$(population_both),cohort)
	$(call population_compare,$(population_judging),judging)
	$(RENDER) $(POPULATION_RUNS)/judging.tsv --figure motion -o $(POPULATION_RUNS)/motion.png
	@cat $(POPULATION_RUNS)/judging.tsv
compressed-population: $(foreach b,$(population_both),$(call population_files,$b,cc) $(call population_files,$b,mlo)) $(BIN)/tabulate
	@$(tabulate) compressions $(patsubst %.vtkhdf,%.json,$(filter %.vtkhdf,$^)) | tee $(POPULATION_RUNS)/compressed.tsv
.PHONY: population compressed-population
