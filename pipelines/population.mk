# SPDX-License-Identifier: GPL-3.0-or-later
# Every breast of pipelines/invivo/cohort.tsv is solved from the scan to the supine shape, and a table compares the motion of its
# tissue with that of living women (pipelines/invivo/women.tsv). Cases of scans take part when POPULATION_SCANS names the scan's file.
#   make population                                the table, and the figure of motion against depth
#   make calibrate-invivo                          pipelines/materials/invivo.tsv from the calibration half of the cohort
POPULATION_SCANS ?=
# 936 elements a breast; 16 gives 4000.
POPULATION_ELEMENTS ?= 10
POPULATION_MATERIALS ?= invivo
POPULATION_RUNS := $(RUNS)/population
POPULATION_TOOL ?= $(BIN)/population
CALIBRATE_SOFTNESS ?= $(BIN)/calibrate-softness
cohort_file := $(PIPELINES)/invivo/cohort.tsv
ifneq ($(filter population calibrate-invivo,$(MAKECMDGOALS)),)
# CASE,PRESET,SCAN,SIDE,USE of every row.
cohort_rows := $(shell grep -v '^\#' $(cohort_file) | sed 1d | tr '\t' ',')
cohort_scan = $(firstword $(foreach s,$(POPULATION_SCANS),$(if $(filter $1,$(call without_ending,$(notdir $s))),$s)))
cohort_field = $(word $1,$(subst $(comma), ,$2))
define cohort_case
ifneq ($(if $(filter -,$3),phantom,$(call cohort_scan,$3)),)
population_$5 += $1
$(POPULATION_RUNS)/$1/mesh.vtkhdf $(POPULATION_RUNS)/$1/supine.vtkhdf: FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) CASE=$1 SIDE=$4 $(if $(filter -,$3),PRESET=$2,MR=$(call cohort_scan,$3)) \
	  ELEMENTS=$(POPULATION_ELEMENTS) MATERIALS=$(POPULATION_MATERIALS) TUMOUR=none $$@
endif
endef
$(foreach row,$(cohort_rows),$(eval $(call cohort_case,$(call cohort_field,1,$(row)),$(call cohort_field,2,$(row)),$(call cohort_field,3,$(row)),$(call cohort_field,4,$(row)),$(call cohort_field,5,$(row)))))
endif
# One phantom serves both its sides: cases run one after the other.
ifneq ($(filter population calibrate-invivo,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

population_compare = $(POPULATION_TOOL) $(patsubst %,$(POPULATION_RUNS)/%/supine.vtkhdf,$1) --women $(PIPELINES)/invivo/women.tsv \
  --table $(POPULATION_RUNS)/$2-motion.tsv --summary $(POPULATION_RUNS)/$2.tsv --report $(POPULATION_RUNS)/$2.json
population: $(patsubst %,$(POPULATION_RUNS)/%/supine.vtkhdf,$(population_calibration) $(population_judging)) $(POPULATION_TOOL)
	$(call population_compare,$(population_calibration) $(population_judging),cohort)
	$(call population_compare,$(population_judging),judging)
	gnuplot -e "table='$(POPULATION_RUNS)/judging.tsv'; picture='$(POPULATION_RUNS)/motion.png'" $(PIPELINES)/population.gp
	@cat $(POPULATION_RUNS)/judging.tsv

# The breast that is pressed is the phantom large, as held in the paper's mode.
pressed := $(POPULATION_RUNS)/large-left/mesh.vtkhdf
$(pressed): FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) CASE=large-left SIDE=left PRESET=large ELEMENTS=$(POPULATION_ELEMENTS) TUMOUR=none $@
calibrate-invivo: $(patsubst %,$(POPULATION_RUNS)/%/mesh.vtkhdf,$(population_calibration)) $(pressed) $(CALIBRATE_SOFTNESS)
	$(CALIBRATE_SOFTNESS) $(patsubst %,$(POPULATION_RUNS)/%/mesh.vtkhdf,$(population_calibration)) --pressed $(pressed) \
	  --women $(PIPELINES)/invivo/women.tsv --set $(POPULATION_RUNS)/invivo.tsv --report $(POPULATION_RUNS)/calibration.json $(share)
	@{ echo '# Calibrated to the motion of living women (pipelines/invivo/women.tsv) and a paddle pressure of 10 kPa by'; \
	  echo '# make calibrate-invivo on: $(population_calibration). Table II of Pathmanathan et al. 2008, scaled.'; \
	  cat $(POPULATION_RUNS)/invivo.tsv; } > $(PIPELINES)/materials/invivo.tsv.part
	@mv $(PIPELINES)/materials/invivo.tsv.part $(PIPELINES)/materials/invivo.tsv
	@cat $(PIPELINES)/materials/invivo.tsv
.PHONY: population calibrate-invivo
