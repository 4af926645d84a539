# SPDX-License-Identifier: GPL-3.0-or-later
# What is learnt from the studies of a case: leaveout, wall-sensitivity and band, cost, accuracy, and the tables of the
# validation pages.

# ---- what each part is worth -------------------------------------------------------------------------------
# The change at the landmarks and on the MLO curve in mm, and the CPU time saved (studies/leaveout.tsv); then, for each
# question, the least model that stays within LEAVEOUT_MM, solved and measured.
LEAVEOUT := $(RUN)/leaveout
LEAVEOUT_PARTS := $(filter no-%,$(leaveout_variants))
LEAVEOUT_QUESTIONS := surgery matching
leaveout: $(LEAVEOUT)/table.tsv $(LEAVEOUT)/recommendation.tsv
	@cat $^
$(LEAVEOUT)/table.tsv: $(call results,leaveout,$(LEAVEOUT_VARIANTS),supine curve) $(RUN)/curve.vtp $(RUN)/supine.vtkhdf $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) leaveout $(RUN) $(LEAVEOUT_VARIANTS))
# The parts a question can do without are known when the table is: this makefile once more, from the case's labels and geometry.
least = $(call study_dir,leaveout)/least-$1
define least_rules
leaveout-least-$1_record = $(LEAVEOUT)/.least-$1.settings
leaveout-least-$1_settings = $(LEAVEOUT_MM)
$(call least,$1)/curve.tsv: $(LEAVEOUT)/table.tsv $(TABULATE) $$(call changed,leaveout-least-$1)
	@$$(call forget,leaveout-least-$1)
	mkdir -p $$(@D) && cp -p $(addprefix $(RUN)/,labels.vtkhdf points.vtp labels.json geometry.vtkhdf geometry.json .labels.settings .geometry.settings) $$(@D)
	+$$(MAKE) -f $(PIPELINE) RUN=$$(@D) MR=$(MR) $(addprefix TUMOUR=,$(TUMOUR)) MATERIALS=$(or $(prior_set),$(MATERIALS)) \
	  LEAVE_OUT="$$$$($(tabulate) least $(LEAVEOUT)/table.tsv $1 $(LEAVEOUT_MM) $(LEAVEOUT_PARTS))" chain
	@$$(call record,leaveout-least-$1)
	@touch $$@
endef
$(foreach q,$(LEAVEOUT_QUESTIONS),$(eval $(call least_rules,$q)))
$(LEAVEOUT)/recommendation.tsv: $(foreach q,$(LEAVEOUT_QUESTIONS),$(call least,$q)/curve.tsv) $(TABULATE)
	$(call table,$(tabulate) recommendation $(RUN) $(LEAVEOUT_MM) $(LEAVEOUT_PARTS))

# ---- what the chest wall's own uncertainty does ------------------------------------------------------------
# The whole chain with the wall of studies/wall.tsv, and how far the predictions move.
WALL_SHIFTS := $(RUN)/wall
WALL_VARIANTS := $(wall_variants)
wall-sensitivity: $(WALL_SHIFTS)/table.tsv
$(WALL_SHIFTS)/table.tsv: $(call results,wall,$(WALL_VARIANTS),supine curve) $(RUN)/supine.vtkhdf $(RUN)/curve.vtp \
  $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) wall $(RUN) $(WALL_VARIANTS))
	@cat $@
# Derivatives by stiffness, plates and chest wall in one file a view, and the band they give the tumour's curve.
$(RUN)/cc-band.vtkhdf $(RUN)/mlo-band.vtkhdf: $(RUN)/%-band.vtkhdf: $(RUN)/%-sensitivity.vtkhdf $(call results,wall,$(WALL_VARIANTS),curve) $(DIFFERENCE)
	$(DIFFERENCE) $< $(foreach v,$(WALL_VARIANTS),$(call study_dir,wall/$v)/$*.vtkhdf) $@ --parameter chest_wall $(common)
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
$(COST)/cost.tsv: $(call results,cost,$(sort $(COST_POINTS) $(COST_FINEST)),supine) $(TABULATE)
	@mkdir -p $(@D)
	$(call table,$(tabulate) cost $(call study_dir,cost) $(COST_FINEST) $(COST_POINTS))
$(COST)/cost.png: $(COST)/cost.tsv $(RENDER)
	$(call plot,cost)

.PHONY: leaveout wall-sensitivity band cost
