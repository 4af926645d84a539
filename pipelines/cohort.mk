# SPDX-License-Identifier: GPL-3.0-or-later
# A patient is one small case file (MR, SIDE, MATERIALS, ...: KEY = VALUE a line), a cohort a folder of them: COHORT/*.case or
# COHORT/*/case.txt (and, as version 0.1 called them, *.mk and */case.mk). Every case is run; one that fails is recorded with its
# reason and does not stop the others. When all fail, make fails.
# CLUSTER=slurm gives the cases to Slurm as one job array (`cases submit`); without it they are processes of this machine.
# RESUME: of a cohort given to Slurm submit only the cases that are missing or out of date. Local processes always do so.
ifneq ($(COHORT),)
# COHORT_CASES, and of each its case file and what it is of, scan or phantom. Each must be readable and say whose scan it is.
COHORT_CASES :=
$(call ask,cohort $(COHORT) $(case_settings))
COHORT_RUNS := $(RUNS)/cohort-$(notdir $(patsubst %/,%,$(if $(filter . .. %/. %/..,$(COHORT)),$(abspath $(COHORT)),$(COHORT))))
.DEFAULT_GOAL := cohort

# CASE, its file, and what it is of, a line each: a file, because ten thousand do not fit a command line.
CASE_LIST := $(COHORT_RUNS)/.cases
$(CASE_LIST): FORCE
	@mkdir -p $(@D)
	@$(CASES) list $(COHORT) $(case_settings) --quiet > $@.part && mv $@.part $@

# Always entered: the case's own make decides what is out of date. Its exit code is kept, not passed on.
cohort_make = $(MAKE) -f $(PIPELINE) COHORT= CLUSTER= RUNS=$(COHORT_RUNS)
$(COHORT_CASES:%=$(COHORT_RUNS)/%.status): $(COHORT_RUNS)/%.status: FORCE | $(CASE_LIST)
	@$(CASES) run $@ $(COHORT_RUNS)/$*.log $(kind_$*) --quiet -- $(cohort_make) CASE_FILE=$(file_$*) CASE=$* summary

# The table of what has ended so far, and its pages.
cohort_results = $(tabulate) cohort $(COHORT_RUNS) $(POPULATION_TOOL)
cohort-table: $(CASE_LIST)
	@$(cohort_results)

ifeq ($(CLUSTER),slurm)
# The make of a task takes programs as they are: no task builds anything.
task_make = make -f $(PIPELINE) -o $(ROOT)build/built-$(PRESET_BUILD).mk -o $(ROOT)build/.packages
task_settings = $(foreach v,$(filter-out COHORT RUNS CASE CASE_FILE CLUSTER% RESUME,$(given)),'$v=$(value $v)')
slurm = $(CASES) $1 $(COHORT_RUNS) $(COHORT) --quiet --cost $(PIPELINES)/cohort-cost.tsv --elements $(ELEMENTS) \
  $(addprefix --element=,$(ELEMENT)) $(addprefix --partition=,$(CLUSTER_PARTITION)) $(addprefix --account=,$(CLUSTER_ACCOUNT)) \
  $(addprefix --time=,$(CLUSTER_TIME)) $(addprefix --memory=,$(CLUSTER_MEMORY)) --cores $(CLUSTER_CORES) \
  $(if $(CLUSTER_OPTIONS),'--options=$(CLUSTER_OPTIONS)') $(if $(RESUME),--resume) -- $(task_make) $(task_settings)
cohort: $(CASE_LIST)
	@$(call slurm,submit)
cohort-script: $(CASE_LIST)
	@$(call slurm,script)
else
cohort: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status)
	@$(cohort_results)
	@$(CASES) any-done $(COHORT_RUNS)/cohort.tsv --quiet
cohort-script:
	$(error cohort-script: is for CLUSTER=slurm)
endif
.PHONY: cohort cohort-table cohort-script
endif
