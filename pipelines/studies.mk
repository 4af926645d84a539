# SPDX-License-Identifier: GPL-3.0-or-later
# A study is a table, pipelines/studies/NAME.tsv; each row is a variant of the case, the folder RUN/studies/NAME/VARIANT with a
# .json report of every stage it makes (pipelines/stages.mk). One more experiment is one more line. STUDY=FILE.tsv is one's own:
#   make -f Makefile.pipeline STUDY=softer.tsv study      solves every row; RUN/studies/softer.tsv says what became of each
# Columns, in any order and but for the first two as needed; cells are separated by tabs, `-` is as in `from`:
#   variant     its name
#   starts_at   its first stage (the list STAGES); the files of those before are those of `from`
#   ends_at     the stages that `study` asks for (-: supine and curve)
#   from        another row above, STUDY/VARIANT, or the case (-)
#   given       stages whose files an explicit rule makes
#   if          another row without whose supine shape this one is not tried
#   segment fit hexmesh prone mechanics wall cut compress    options; +TEXT adds to those of `from`, TEXT replaces them
#   materials   takes the place of the set in `mechanics`
#   slopes      parameters of the stage `slopes`
#   plates      truth: they stand where the phantom's truth has them
# {NAME} in a cell is the value of NAME, one of `placeholders`; {tumour} the place of the tumour in the mesh of `from`.
study_columns := variant starts_at ends_at from given if $(ATTRIBUTES)
placeholders := tumour ELEMENTS MATERIALS RUN PRINTED_HEXMESH PRINTED_MECHANICS FINDINGS_FINEST BUDGET_HEXMESH
tumour_there := {tumour}
BUDGET_HEXMESH = --elements $(BUDGET_FINER) $(subst --elements $(ELEMENTS),,$(HEXMESH_OPTIONS))
study_dir = $(RUN)/studies/$1
# $(call results,STUDY,VARIANTS,STAGES): their reports.
results = $(foreach v,$2,$(foreach s,$3,$(call study_dir,$1/$v)/$s.json))

# A table is data: nothing in it is code. Looked at before a line of it is evaluated.
check_table = $(foreach line,$(call without,$(call table_lines,$1),$(placeholders:%={%})),$(call check_line,$1,$(call strange,line,$(shell_characters))))
check_line = $(if $2,$(error $1: the character $(firstword $2) may not stand in a study; {NAME} is one of $(placeholders)))
# A cell with its names as references to make's variables; an option with what it adds to; stages from one on.
opening := $$(
closing := )
named = $(subst {,$(opening),$(subst },$(closing),$(subst {tumour},{tumour_there},$(call text,$1))))
option = $(if $(call cell,$1),$(if $(filter +%,$(call cell,$1)),$($(from)@$1) )$(call named,$(patsubst +%,%,$(call cell,$1))),$($(from)@$1))
from_on = $(if $2,$(if $(filter $1,$(firstword $2)),$2,$(call from_on,$1,$(wordlist 2,99,$2))))
dir_of = $(if $1,$(call study_dir,$(if $(findstring /,$1),,$(study)/)$1),$(base))
fault = $(if $1,$(error $(study_file): $(name) $2))
define variant
name := $(call cell,variant)
dir := $(call study_dir,$(study)/$(name))
from := $(call dir_of,$(call cell,from))
$(call check_name,name)
$(call fault,$(filter-out $(words $(columns)),$(words $(call cells,$(line)))),has $(words $(call cells,$(line))) cells and not $(words $(columns)); write - for an empty one)
$(call fault,$(findstring /,$(name))$(filter $(name),$($(study)_variants)),is no name of a row of its own)
$(call fault,$(if $(call cell,starts_at),,none),does not say at which stage it starts_at: $(STAGES))
$(call none_of,$(study_file),$(call text,$(call cell,starts_at) $(call cell,ends_at) $(call cell,given)),$(STAGES))
$(call fault,$(if $($(from)@stages),,none),comes from '$(call cell,from)'$(comma) which no row above is)
$(study)_variants += $(name)
$(dir)@from := $(from)
$(dir)@given := $(call text,$(call cell,given))
$(dir)@stages := $($(dir)@given) $(call from_on,$(call cell,starts_at),$(STAGES))
$(dir)@ends_at := $(or $(call text,$(call cell,ends_at)),supine $(if $(no_tumour),cc mlo,curve))
$(dir)@if := $(if $(call cell,if),$(call dir_of,$(call cell,if)))
$(foreach a,$(ATTRIBUTES),$(eval $(dir)@$a := $(call option,$a)))
$(dir)@mechanics := $(subst --materials $($(from)@materials),--materials $($(dir)@materials),$($(dir)@mechanics))
$(call case_rules,$(dir),$(filter-out $($(dir)@given),$($(dir)@stages)))
endef
# $(call load_study,NAME,FILE,FOLDER): the rows of FILE as variants of the case in FOLDER.
define load_study
study := $1
study_file := $2
base := $3
$1_variants :=
$$(call check_table,$$(study_file))
$$(call read_table,$$(study_file))
$$(call none_of,$$(study_file),$$(columns),$$(study_columns))
$$(call each_row,variant)
$(call study_dir,$1).tsv: $$(foreach v,$$($1_variants),$$(call results,$1,$$v,$$($$(call study_dir,$1/$$v)@ends_at))) $(TABULATE)
	$$(call table,$$(tabulate) study $$(basename $$@) $$(landmarks) $$($1_variants))
endef
studies := $(sort $(wildcard $(PIPELINES)/studies/*.tsv))
$(foreach s,$(studies),$(eval $(call load_study,$(basename $(notdir $s)),$s,$(RUN))))
# The rows of Tables III to VI once more, as the paper printed them.
$(eval $(call load_study,scaled-as-printed,$(PIPELINES)/studies/scaled.tsv,$(call study_dir,findings/as-printed)))

.PHONY: study
ifeq ($(STUDY),)
study:
	$(error study: name a table of variants, STUDY=FILE.tsv, or one of $(basename $(notdir $(studies))))
else
study_name := $(subst $(comma),_,$(basename $(notdir $(STUDY))))
ifeq ($($(study_name)_variants),)
  $(if $(wildcard $(STUDY)),,$(error STUDY: '$(STUDY)' is neither a file nor one of $(basename $(notdir $(studies)))))
  $(eval $(call load_study,$(study_name),$(STUDY),$(RUN)))
endif
study: $(call study_dir,$(study_name)).tsv
	@cat $<
endif
