# SPDX-License-Identifier: GPL-3.0-or-later
# A patient is described by a small case file (MR, SIDE, MATERIALS, ...: one KEY = VALUE per line). A cohort is a folder of case
# files: COHORT/*/case.txt or COHORT/*.case. Every case is run; a case that fails is recorded with its reason and does not stop the
# others. If all cases fail, make fails.
# CLUSTER=slurm submits the cases to Slurm as one job array (`cases submit`); otherwise they run as processes on this machine.
# RESUME submits only the cases of a cohort that are missing or out of date. Local runs always do so.
ifneq ($(COHORT),)
# The names of the cases. Every case file must be readable and name its scan or preset.
COHORT_CASES := $(call said,$(shell $(BIN)/cases cohort $(COHORT) $(PIPELINES) --quiet 2>&1))
COHORT_RUNS := $(RUNS)/cohort-$(notdir $(patsubst %/,%,$(if $(filter . .. %/. %/..,$(COHORT)),$(abspath $(COHORT)),$(COHORT))))

# The list of cases contains one line per case: CASE, its case file, and its kind. It is a file, because ten thousand cases do not
# fit on a command line.
CASE_LIST := $(COHORT_RUNS)/.cases
$(CASE_LIST): FORCE
	@mkdir -p $(@D)
	@$(BIN)/cases list $(COHORT) $(PIPELINES) --quiet > $@.part && mv $@.part $@

# Sides only go from the scan to the supine shape, without plates.
cohort_goal := $(if $(filter sides sides-table,$(MAKECMDGOALS)),side,summary)

# This rule always runs: the make of each case decides what is out of date. Its exit code is recorded and not passed on.
cohort_make = $(MAKE) -f $(PIPELINE) COHORT= CLUSTER= RUNS=$(COHORT_RUNS)
$(COHORT_CASES:%=$(COHORT_RUNS)/%.status): $(COHORT_RUNS)/%.status: FORCE | $(CASE_LIST)
	@$(BIN)/cases run $(COHORT_RUNS) $* --quiet -- $(cohort_make) $(cohort_goal)

# The table of the cases that have ended so far, and its pages.
cohort_results = $(tabulate) cohort $(COHORT_RUNS) $(BIN)/population
cohort-table: $(CASE_LIST)
	@$(cohort_results)

ifeq ($(CLUSTER),slurm)
# The make of a task uses the programs as they are: no task builds anything.
task_make = make -f $(PIPELINE) -o $(ROOT)build/built-$(PRESET_BUILD).mk -o $(ROOT)build/.packages
task_settings = $(foreach v,$(filter-out COHORT RUNS CASE CASE_FILE CLUSTER% RESUME,$(given)),'$v=$(value $v)')
slurm = $(BIN)/cases $1 $(COHORT_RUNS) $(COHORT) --quiet --cost $(PIPELINES)/cohort-cost.tsv --elements $(ELEMENTS) \
  $(addprefix --element=,$(ELEMENT)) $(addprefix --partition=,$(CLUSTER_PARTITION)) $(addprefix --account=,$(CLUSTER_ACCOUNT)) \
  $(addprefix --time=,$(CLUSTER_TIME)) $(addprefix --memory=,$(CLUSTER_MEMORY)) --cores $(CLUSTER_CORES) \
  $(if $(CLUSTER_OPTIONS),'--options=$(CLUSTER_OPTIONS)') $(if $(RESUME),--resume) -- $(task_make) $(task_settings)
cohort cohort-script: $(CASE_LIST) | $(BIN)/identify
	@$(call slurm,$(if $(filter cohort-script,$@),script,submit))
else
cohort: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status)
	@$(cohort_results)
	@$(BIN)/cases any-done $(COHORT_RUNS)/cohort.tsv --quiet
endif
sides: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status)
	@$(tabulate) sides $(COHORT_RUNS)
	@$(BIN)/cases any-done $(COHORT_RUNS)/sides.tsv --quiet
.PHONY: cohort cohort-table cohort-script sides
endif

# One side of a cohort (`make COHORT=FOLDER sides`): from the scan to the supine shape, and the labels against the truth where the
# case names some (LABELS_TRUTH, with EVALUATE_OPTIONS such as its codes).
.PHONY: side
side: $(if $(LABELS_TRUTH),$(RUN)/labels-truth.tsv) $(RUN)/supine.vtkhdf
labels-truth_settings := $(BIN)/evaluate $(call named,$(LABELS_TRUTH)) $(EVALUATE_OPTIONS)
$(RUN)/labels-truth.tsv: $(RUN)/labels.vtkhdf $(LABELS_TRUTH) $(BIN)/evaluate $(call changed,labels-truth)
	$(call prints,labels-truth,$@) $(BIN)/evaluate $< $(LABELS_TRUTH) $(EVALUATE_OPTIONS) --quiet
