# SPDX-License-Identifier: GPL-3.0-or-later
# A patient is one small case file (MR, SIDE, MATERIALS, ...: KEY = VALUE a line, read as data by pipelines/case-file.sh), a
# cohort a folder of them: COHORT/*.case or COHORT/*/case.txt (and, as version 0.1 called them, *.mk and */case.mk). Every case
# is run; one that fails is recorded with its reason and does not stop the others. When all fail, make fails.
# CLUSTER=slurm gives the cases to Slurm as one job array (pipelines/slurm.sh); without it they are processes of this machine.
# RESUME: of a cohort given to Slurm submit only the cases that are missing or out of date. Local processes always do so.
ifneq ($(COHORT),)
case_patterns := *.case */case.txt *.mk */case.mk
COHORT_FILES := $(sort $(wildcard $(addprefix $(COHORT)/,$(case_patterns))))
ifeq ($(COHORT_FILES),)
  $(error COHORT=$(COHORT) holds no case: none of $(case_patterns))
endif
# Names of folders and files below COHORT go into recipes: those with blanks come in pieces here, and are refused with the rest.
strange_cases := $(shell $(PIPELINES)/cohort.sh strange $(COHORT))
$(if $(strange_cases),$(error $(strange_cases)))
cohort_case = $(if $(filter case.mk case.txt,$(notdir $1)),$(notdir $(patsubst %/,%,$(dir $1))),$(basename $(notdir $1)))
COHORT_CASES := $(foreach f,$(COHORT_FILES),$(call cohort_case,$f))
ignored := $(foreach c,$(COHORT_CASES),$(if $(word 2,$(filter $c,$(COHORT_CASES))),$(error COHORT=$(COHORT): two case files are called $c: $(strip \
  $(foreach f,$(COHORT_FILES),$(if $(filter $c,$(call cohort_case,$f)),$f))))))
# Each must be readable and say whose scan it is: a slip in MR would run the phantom as that patient.
lines_of = $(shell $(PIPELINES)/case-file.sh $1 $(case_settings) 2> /dev/null)
nameless = !case file $1: names neither MR nor PRESET
case_problem = $(or $(filter !%,$2),$(if $(filter MR=% PRESET=%,$2),,$(nameless)))
remember_kind = $(eval kind_$(call cohort_case,$1) := $(if $(filter MR=%,$2),scan,phantom))
look_at_case = $(call remember_kind,$1,$2)$(call case_problem,$1,$2)
problems := $(strip $(foreach f,$(COHORT_FILES),$(call look_at_case,$f,$(call lines_of,$f))))
$(if $(problems),$(error $(subst $(shell printf '\037'),$(space),$(patsubst !%,%,$(problems)))))
COHORT_RUNS := $(RUNS)/cohort-$(notdir $(patsubst %/,%,$(if $(filter . .. %/. %/..,$(COHORT)),$(abspath $(COHORT)),$(COHORT))))
.DEFAULT_GOAL := cohort

# CASE, its file, and what it is of (scan or phantom), a line each: a file, because ten thousand do not fit a command line.
case_lines_of_all = $(subst $(newline)$(space),$(newline),$(foreach f,$(COHORT_FILES),$(call cohort_case,$f)$(tab)$f$(tab)$(kind_$(call \
  cohort_case,$f))$(newline)))
CASE_LIST := $(COHORT_RUNS)/.cases
$(COHORT_RUNS)/.folder:
	@mkdir -p $(@D)
	@touch $@
$(CASE_LIST): FORCE | $(COHORT_RUNS)/.folder
	@$(if $(planning),,$(file > $@,$(case_lines_of_all))):

# Always entered: the case's own make decides what is out of date. Its exit code is kept, not passed on.
cohort_make = $(MAKE) -f $(PIPELINE) COHORT= CLUSTER= RUNS=$(COHORT_RUNS)
define cohort_rules
$(COHORT_RUNS)/$1.status: FORCE | $(COHORT_RUNS)/.folder
	@$(PIPELINES)/cohort.sh run $$@ $(COHORT_RUNS)/$1.log $(kind_$1) $$(cohort_make) CASE_FILE=$2 CASE=$1 summary
endef
$(foreach f,$(COHORT_FILES),$(eval $(call cohort_rules,$(call cohort_case,$f),$f)))

# The table of what has ended so far, and its pages.
cohort_results = $(tabulate) cohort $(COHORT_RUNS) $(POPULATION_TOOL)
cohort-table: $(CASE_LIST)
	@$(cohort_results)

ifeq ($(CLUSTER),slurm)
# The make command of a task, a word a line. Programs are taken as they are: no task builds anything.
task_make = make -f $(PIPELINE) -o $(ROOT)build/built-$(PRESET_BUILD).mk -o $(ROOT)build/.packages
task_settings = $(foreach v,$(filter-out COHORT RUNS CASE CASE_FILE CLUSTER% RESUME,$(given)),$(newline)$v=$(value $v))
task_command = $(subst $(space)$(newline),$(newline),$(subst $(space),$(newline),$(task_make))$(task_settings))
slurm = $(foreach v,PARTITION ACCOUNT TIME MEMORY CORES OPTIONS,CLUSTER_$v='$(CLUSTER_$v)') RESUME='$(RESUME)' \
  COST_ELEMENTS='$(ELEMENTS)' COST_ELEMENT='$(ELEMENT)' COHORT_TABULATE='$(tabulate)' $(PIPELINES)/slurm.sh
$(COHORT_RUNS)/.command: FORCE | $(COHORT_RUNS)/.folder
	@$(if $(planning),,$(file > $@,$(task_command))):
cohort: $(CASE_LIST) $(COHORT_RUNS)/.command
	@$(slurm) submit $(COHORT_RUNS) $(COHORT)
cohort-script: $(CASE_LIST) $(COHORT_RUNS)/.command
	@$(slurm) script $(COHORT_RUNS) $(COHORT)
else
cohort: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status) $(CASE_LIST)
	@$(cohort_results)
	@$(PIPELINES)/cohort.sh any-done $(COHORT_RUNS)/cohort.tsv
cohort-script:
	$(error cohort-script: is for CLUSTER=slurm)
endif
.PHONY: cohort cohort-table cohort-script
endif
