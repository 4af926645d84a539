# A patient is one small case file (MR, SIDE, MATERIALS, ...: KEY = VALUE a line, read as data by pipelines/case-file.sh), a
# cohort a folder of them: COHORT/*.case or COHORT/*/case.txt (and, as version 0.1 called them, *.mk and */case.mk). Every case
# is run; one that fails is recorded with its reason and does not stop the others. When all fail, make fails.
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
problems := $(strip $(foreach f,$(COHORT_FILES),$(call case_problem,$f,$(call lines_of,$f))))
$(if $(problems),$(error $(subst $(shell printf '\037'),$(space),$(patsubst !%,%,$(problems)))))
COHORT_RUNS := $(RUNS)/cohort-$(notdir $(patsubst %/,%,$(if $(filter . .. %/. %/..,$(COHORT)),$(abspath $(COHORT)),$(COHORT))))
.DEFAULT_GOAL := cohort

cohort: $(COHORT_RUNS)/cohort.tsv
.PHONY: cohort

# Always entered: the case's own make decides what is out of date. Its exit code is kept, not passed on.
cohort_make = $(MAKE) -f $(PIPELINE) COHORT= RUNS=$(COHORT_RUNS)
define cohort_rules
$(COHORT_RUNS)/$1.status: FORCE
	@mkdir -p $$(@D)
	@$(PIPELINES)/cohort.sh run $$@ $(COHORT_RUNS)/$1.log $$(cohort_make) CASE_FILE=$2 CASE=$1 summary
endef
$(foreach f,$(COHORT_FILES),$(eval $(call cohort_rules,$(call cohort_case,$f),$f)))

$(COHORT_RUNS)/cohort.tsv: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status) $(PIPELINES)/cohort.sh $(PIPELINES)/values.sh
	@$(PIPELINES)/cohort.sh table $(COHORT_RUNS) $(COHORT_CASES) > $@.part
	@mv $@.part $@
	@cat $@
	@$(PIPELINES)/cohort.sh any-done $@
endif
