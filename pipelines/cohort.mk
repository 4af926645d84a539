# A patient is one small case.mk (MR, SIDE, MATERIALS, ...: any setting of pipelines/settings.mk), a cohort a
# folder of them: COHORT/*.mk or COHORT/*/case.mk. Every case is run; one that fails is recorded with its
# reason and does not stop the others.
ifdef COHORT
COHORT_FILES := $(sort $(wildcard $(COHORT)/*.mk $(COHORT)/*/case.mk))
ifeq ($(COHORT_FILES),)
  $(error COHORT=$(COHORT) holds no case: neither *.mk nor */case.mk)
endif
cohort_case = $(if $(filter case.mk,$(notdir $1)),$(notdir $(patsubst %/,%,$(dir $1))),$(basename $(notdir $1)))
COHORT_CASES := $(foreach f,$(COHORT_FILES),$(call cohort_case,$f))
COHORT_RUNS := $(RUNS)/cohort-$(notdir $(patsubst %/,%,$(abspath $(COHORT))))
.DEFAULT_GOAL := cohort

cohort: $(COHORT_RUNS)/cohort.tsv
.PHONY: cohort

# Always entered: the case's own make decides what is out of date. Its exit code is kept, not passed on.
cohort_make = $(MAKE) -f Makefile.pipeline COHORT= RUNS=$(COHORT_RUNS)
define cohort_rules
$(COHORT_RUNS)/$1.status: FORCE
	@mkdir -p $$(@D)
	@pipelines/cohort.sh run $$@ $(COHORT_RUNS)/$1.log $$(cohort_make) CASE_FILE=$2 CASE=$1 summary
endef
$(foreach f,$(COHORT_FILES),$(eval $(call cohort_rules,$(call cohort_case,$f),$f)))

$(COHORT_RUNS)/cohort.tsv: $(COHORT_CASES:%=$(COHORT_RUNS)/%.status) pipelines/cohort.sh pipelines/values.sh
	@pipelines/cohort.sh table $(COHORT_RUNS) $(COHORT_CASES) > $@.part
	@mv $@.part $@
	@cat $@
endif
