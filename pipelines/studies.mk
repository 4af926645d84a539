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
$(call said,$(shell $(BIN)/cases studies $(study_rules) $(PIPELINE) $(RUN) 'supine $(if $(no_tumour),cc mlo,curve)' '$(tabulate) place' \
  $(foreach c,$(study_columns),'@$c=$(strip $($(lastword $(subst :, ,$c))))') '{tumour={tumour}' $(foreach p,$(placeholders),'{$p=$(strip $($p))') \
  $(tables_of_studies) --quiet 2>&1))
include $(study_rules)

# What a cell without a leading + leaves out is said before anything is solved.
$(if $(filter study,$(MAKECMDGOALS)),$(if $($(study_name)_drops),))
.PHONY: study
study: $(addprefix $(call study_dir,),$(addsuffix .tsv,$(study_name)))
	$(if $(STUDY),,$(error study: no study is named; give a table of variants with STUDY=FILE.tsv$(comma) or one of $(studies)))
	@cat $<

# ---- what each part is worth -------------------------------------------------------------------------------
# The change at the landmarks and on the MLO curve in mm, and the CPU time saved (studies/leaveout.tsv); then, for each
# question, the least model that stays within LEAVEOUT_MM, solved and measured.
LEAVEOUT := $(RUN)/leaveout
LEAVEOUT_PARTS := $(filter no-%,$(leaveout_variants))
leaveout: $(LEAVEOUT)/table.tsv $(LEAVEOUT)/recommendation.tsv
	@cat $^
$(LEAVEOUT)/table.tsv: $(call results,leaveout,$(LEAVEOUT_VARIANTS),supine curve) $(RUN)/curve.vtp $(RUN)/supine.vtkhdf $(BIN)/tabulate
	$(call table,$(tabulate) leaveout $(RUN) $(LEAVEOUT_VARIANTS))
# The parts a question can do without are known when the table is: this makefile once more, from the case's labels and geometry.
least := $(foreach question,surgery matching,$(call study_dir,leaveout)/least-$(question)/curve.tsv)
least_record = $(LEAVEOUT)/.least-$1.settings
$(least): $(call study_dir,leaveout)/least-%/curve.tsv: $(LEAVEOUT)/table.tsv $(BIN)/tabulate $$(call stale,$$(call least_record,$$*),$(LEAVEOUT_MM))
	@rm -f $(call least_record,$*)
	mkdir -p $(@D) && cp -p $(addprefix $(RUN)/,labels.vtkhdf points.vtp labels.json geometry.vtkhdf geometry.json .labels.settings .geometry.settings) $(@D)
	+$(MAKE) -f $(PIPELINE) RUN=$(@D) MR=$(MR) $(addprefix TUMOUR=,$(TUMOUR)) MATERIALS=$(or $(prior_set),$(MATERIALS)) \
	  LEAVE_OUT="$$($(tabulate) least $(LEAVEOUT)/table.tsv $* $(LEAVEOUT_MM) $(LEAVEOUT_PARTS))" chain
	@echo $(LEAVEOUT_MM) > $(call least_record,$*)
	@touch $@
$(LEAVEOUT)/recommendation.tsv: $(least) $(BIN)/tabulate
	$(call table,$(tabulate) recommendation $(RUN) $(LEAVEOUT_MM) $(LEAVEOUT_PARTS))

# ---- what the chest wall's own uncertainty does ------------------------------------------------------------
# The whole chain with the wall of studies/wall.tsv, and how far the predictions move.
wall-sensitivity: $(RUN)/wall/table.tsv
	@cat $<
$(RUN)/wall/table.tsv: $(call results,wall,$(wall_variants),supine curve) $(RUN)/supine.vtkhdf $(RUN)/curve.vtp \
  $(BIN)/tabulate
	$(call table,$(tabulate) wall $(RUN) $(wall_variants))
# Derivatives by stiffness, plates and chest wall in one file a view, and the band they give the tumour's curve.
$(RUN)/cc-band.vtkhdf $(RUN)/mlo-band.vtkhdf: $(RUN)/%-band.vtkhdf: $(RUN)/%-sensitivity.vtkhdf $(call results,wall,$(wall_variants),curve) $(BIN)/difference
	$(BIN)/difference $< $(foreach v,$(wall_variants),$(call study_dir,wall/$v)/$*.vtkhdf) $@ --parameter chest_wall $(common)
$(RUN)/band.tsv: $(RUN)/cc-band.vtkhdf $(RUN)/mlo-band.vtkhdf $(CC2MLO)
	$(CC2MLO) $(wordlist 1,2,$^) $(RUN)/band.vtp --landmark tumour --band --table $@ --curve-table $(RUN)/band-curve.tsv \
	  $(common)
band: $(RUN)/band.tsv
	@sed -n '/"band"/,/}/p' $(RUN)/band.json

# ---- error against run time --------------------------------------------------------------------------------
# The error is the landmarks' distance to the finest solution (COST_FINEST) of the same geometry, stress-free and supine.
COST := $(RUN)/cost
cost: $(COST)/cost.tsv $(COST)/cost.png
	@cat $<
$(COST)/cost.tsv: $(call results,cost,$(sort $(COST_POINTS) $(COST_FINEST)),supine) $(BIN)/tabulate
	$(call table,$(tabulate) cost $(call study_dir,cost) $(COST_FINEST) $(COST_POINTS))
$(COST)/cost.png: $(COST)/cost.tsv $(RENDER)
	$(call plot,cost)

.PHONY: leaveout wall-sensitivity band cost
