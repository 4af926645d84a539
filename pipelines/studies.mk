# SPDX-License-Identifier: GPL-3.0-or-later
# A study is a table, pipelines/studies/NAME.tsv, whose columns are described in pipelines/studies/README.md. Each row is a variant
# of the case: the folder RUN/studies/NAME/VARIANT, with a .json report of every stage that it makes. A further
# experiment needs only a further row. A study in a file of the user:
#   make -f Makefile.pipeline STUDY=softer.tsv study      solves every row; RUN/studies/softer.tsv lists the results
# `cases studies` reads and checks the tables, in which nothing is executed, and writes RUNS/.make/CASE-studies.mk: for each row its
# options and the rules of the chain (Makefile.pipeline) in its folder.
study_dir = $(RUN)/studies/$1
# $(call results,STUDY,VARIANTS,STAGES): the reports of these stages.
results = $(foreach v,$2,$(foreach s,$3,$(call study_dir,$1/$v)/$s.json))
placeholders := ELEMENTS MATERIALS RUN PRINTED_HEXMESH PRINTED_MECHANICS FINDINGS_FINEST BUDGET_HEXMESH
BUDGET_HEXMESH = --elements $(BUDGET_FINER) $(subst --elements $(ELEMENTS),,$(HEXMESH_OPTIONS))

own_studies := $(sort $(wildcard $(PIPELINES)/studies/*.tsv))
studies := $(basename $(notdir $(own_studies)))
study_name := $(subst $(comma),_,$(basename $(notdir $(STUDY))))
study_file := $(if $(filter $(study_name),$(studies)),,$(STUDY))
$(if $(study_file),$(if $(wildcard $(study_file)),,$(error STUDY: '$(STUDY)' is neither a file nor one of the studies $(studies))))
# The rows of Tables III to VI are solved a second time, with the model as printed in the paper.
tables_of_studies := $(join $(studies:%=%=),$(own_studies)) scaled-as-printed=$(PIPELINES)/studies/scaled.tsv@findings/as-printed \
  $(addprefix $(study_name)=,$(study_file))
study_rules := $(RUNS)/.make/$(notdir $(RUN))-studies.mk
$(call said,$(shell $(CASES) studies $(study_rules) $(PIPELINE) $(RUN) 'supine $(if $(no_tumour),cc mlo,curve)' '$(tabulate) place' \
  $(foreach c,$(study_columns),'@$c=$(strip $(its_$c))') '{tumour={tumour}' $(foreach p,$(placeholders),'{$p=$(strip $($p))') \
  $(tables_of_studies) --quiet 2>&1))
.SECONDEXPANSION:
include $(study_rules)

# What a cell without a leading + leaves out is said before anything is solved.
$(if $(filter study,$(MAKECMDGOALS)),$(if $($(study_name)_drops),))
.PHONY: study
study: $(addprefix $(call study_dir,),$(addsuffix .tsv,$(study_name)))
	$(if $(STUDY),,$(error study: no study is named; give a table of variants with STUDY=FILE.tsv$(comma) or one of $(studies)))
	@cat $<
