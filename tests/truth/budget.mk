# SPDX-License-Identifier: GPL-3.0-or-later
# The error budget of the chain: the result of each stage is replaced in turn by the truth of the phantom (studies/budget.tsv). The
# table lists the errors that remain at the true positions (stress-free, supine, MLO curve) and the cost of the stage. In the row
# `chain` nothing is replaced. The breast is compressed between plates at the positions of the truth. The last column states why a
# cell is empty.
BUDGET := $(RUN)/budget
BUDGET_ROWS := $(budget_variants)
budget_row = $(call study_dir,budget/$1)
budget: $(BUDGET)/budget.tsv $(BUDGET)/budget.png
	@cat $<
.PHONY: budget

# The files taken from the truth: its labels, its mesh, and the mesh of the chain deformed as the true body. Their reports name
# `truth` as their tool.
truth_report = printf '{\n  "tool": "truth",\n  "status": "ok",\n  "reason": ""\n}\n' > $@
$(foreach row,segmentation tissue,$(call budget_row,$(row))/labels.json): $(PHANTOM_MR)
	@mkdir -p $(@D)
	cp $(PHANTOM_TRUTH)/labels-$(SIDE).vtkhdf $(basename $@).vtkhdf
	@$(truth_report)
$(call budget_row,body)/mesh.json: $(TRUTH_AT)-coarse.vtkhdf
	@mkdir -p $(@D)
	cp $< $(basename $@).vtkhdf
	@$(truth_report)
$(call budget_row,backward)/reference.json $(call budget_row,compression)/cc.json $(call budget_row,compression)/mlo.json: \
  $(RUN)/mesh.vtkhdf $(TRUTH_TABLE) tests/truth/follow_shape.cpp
	@mkdir -p $(@D)
	$(call bench,follow_shape) && $(BIN)/follow_shape $< $(subst -reference,,$(TRUTH_AT)-fine-$(basename $(@F))).vtkhdf $(basename $@).vtkhdf > $(basename $@)-outside.tsv
	@$(truth_report)

# The remaining errors; the file is empty if a shape was not found: $(call unless_missing,SHAPES,COMMAND).
unless_missing = if [ -e $(firstword $1) ] && [ -e $(lastword $1) ]; then $2; else rm -f $(basename $@)-summary.tsv; : > $@; fi
budget_curves = $(call unless_missing,$1,$(CC2MLO) $1 $(basename $@).vtp --truth $(TRUTH_TABLE) --table $@ $(common))
budget_landmarks = $(call unless_missing,$1,$(BIN)/probe $1 --truth $(TRUTH_TABLE) > $@.part; mv $@.part $@)
$(BUDGET_ROWS:%=$(BUDGET)/%/curves.tsv): $(BUDGET)/%/curves.tsv: $(call budget_row,%)/cc.json $(call budget_row,%)/mlo.json $(TRUTH_TABLE) $(CC2MLO)
	@mkdir -p $(@D)
	$(call budget_curves,$(call budget_row,$*)/cc.vtkhdf $(call budget_row,$*)/mlo.vtkhdf)
$(patsubst %,$(BUDGET)/%/landmarks.tsv,$(filter-out compression,$(BUDGET_ROWS))): $(BUDGET)/%/landmarks.tsv: $(call budget_row,%)/supine.json $(TRUTH_TABLE) $(BIN)/probe
	@mkdir -p $(@D)
	$(call budget_landmarks,$(call budget_row,$*)/reference.vtkhdf $(call budget_row,$*)/supine.vtkhdf)
$(BUDGET)/chain/curves.tsv: $(RUN)/truth-cc.vtkhdf $(RUN)/truth-mlo.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	@mkdir -p $(@D)
	$(call budget_curves,$(wordlist 1,2,$^))
$(BUDGET)/chain/landmarks.tsv: $(RUN)/reference.vtkhdf $(RUN)/supine.vtkhdf $(TRUTH_TABLE) $(BIN)/probe
	@mkdir -p $(@D)
	$(call budget_landmarks,$(wordlist 1,2,$^))

$(BUDGET)/budget.tsv: $(foreach row,chain $(BUDGET_ROWS),$(BUDGET)/$(row)/curves.tsv) \
  $(foreach row,chain $(filter-out compression,$(BUDGET_ROWS)),$(BUDGET)/$(row)/landmarks.tsv) \
  $(RUN)/cc.vti $(RUN)/mlo.vti $(BIN)/tabulate
	$(call table,$(tabulate) budget $(RUN) $(BUDGET_ROWS))
$(BUDGET)/budget.png: $(BUDGET)/budget.tsv $(RENDER)
	$(call plot,budget)
