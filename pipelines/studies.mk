# SPDX-License-Identifier: GPL-3.0-or-later
# A study is a table, pipelines/studies/NAME.tsv, whose columns are described in pipelines/studies/README.md. Each row is a variant
# of the case: the folder RUN/studies/NAME/VARIANT, with a .json report of every stage that it makes (stages.mk). A further
# experiment needs only a further row. A study in a file of the user:
#   make -f Makefile.pipeline STUDY=softer.tsv study      solves every row; RUN/studies/softer.tsv lists the results
# `cases` reads and checks the tables; nothing in them is executed.
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
all_studies := $(studies) scaled-as-printed $(if $(study_file),$(study_name))
# The rows of Tables III to VI are solved a second time, with the model as printed in the paper.
tables_of_studies := $(join $(studies:%=%=),$(own_studies)) scaled-as-printed=$(PIPELINES)/studies/scaled.tsv@findings/as-printed \
  $(addprefix $(study_name)=,$(study_file))
variant_dirs :=
$(call ask,$(CASES) variants $(RUN) '$(STAGES)' 'supine $(if $(no_tumour),cc mlo,curve)' $(foreach a,$(ATTRIBUTES),'@$a=$(strip $($(RUN)@$a))') \
  '{tumour={tumour}' $(foreach p,$(placeholders),'{$p=$(strip $($p))') $(tables_of_studies))
$(foreach d,$(variant_dirs),$(call case_rules,$d,$(filter-out $($d@given),$($d@stages))))

define study_rule
$(call study_dir,$1).tsv: $(foreach v,$($1_variants),$(call results,$1,$v,$($(call study_dir,$1/$v)@ends_at))) $(TABULATE)
	$$(call table,$$(tabulate) study $$(basename $$@) $$(landmarks) $($1_variants))
endef
$(foreach s,$(all_studies),$(eval $(call study_rule,$s)))

# What a cell without a leading + leaves out is said before anything is solved.
say_drops = $(foreach v,$($1_variants),$(if $($(call study_dir,$1/$v)@drops),$(info $1/$v leaves out of $(or \
  $(patsubst $(RUN)/%,%,$(filter-out $(RUN),$($(call study_dir,$1/$v)@from))),the case) $($(call study_dir,$1/$v)@drops) (a + at the beginning of the cell keeps it))))
$(if $(filter study,$(MAKECMDGOALS)),$(call say_drops,$(study_name)))
.PHONY: study
study: $(addprefix $(call study_dir,),$(addsuffix .tsv,$(study_name)))
	$(if $(STUDY),,$(error study: no study is named; give a table of variants with STUDY=FILE.tsv$(comma) or one of $(studies)))
	@cat $<
