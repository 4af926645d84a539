# SPDX-License-Identifier: GPL-3.0-or-later
# Comparison with CalculiX (Debian: calculix-ccx), really run beside ours: gravity on the block and on the
# case's breast without skin, and the block between plates; the same nodes, law and bulk modulus. One row a scene in
# runs/compare/*.tsv. Scenes of the block are named block-N-LAW-BULKRATIO-ELEMENT, poly is the set seed2008's fat, and
# pressed-N-BULKRATIO-ELEMENT-GAP-MODE (tests/bench/press.sh).
COMPARE_ELEMENTS ?= 10
COMPARE_SCENES ?= block-8-poly-1000-C3D8I block-8-poly-1000-C3D8 block-8-mr-100-C3D8I \
  block-8-mr-1000-C3D8I block-4-poly-1000-C3D20R breast-1000-C3D8I block-16-poly-1000-C3D8I
COMPARE_PRESSED ?= pressed-8-10000-C3D8I-60-contact pressed-8-10000-C3D8I-50-prescribed \
  pressed-16-10000-C3D8I-60-contact
COMPARE := $(RUNS)/compare
COMPARE_FILES := $(COMPARE_SCENES:%=$(COMPARE)/%.tsv)
PRESSED_FILES := $(COMPARE_PRESSED:%=$(COMPARE)/%.tsv)
compare_run = BIN=$(BIN) tests/bench/compare.sh
compare_needs := $(FORWARD) $(BIN)/export-deck tests/bench/compare.sh $(BIN)/tabulate

.PHONY: compare
ifeq ($(shell command -v ccx),)
compare:
	@echo "compare: skipped, CalculiX (ccx) is not installed; apt-get install calculix-ccx" >&2
else
compare: $(COMPARE)/all.tsv $(COMPARE)/pressed.tsv
	@cat $^
endif
$(COMPARE)/all.tsv: $(COMPARE_FILES)
$(COMPARE)/pressed.tsv: $(PRESSED_FILES)
$(COMPARE)/all.tsv $(COMPARE)/pressed.tsv:
	@$(call table,awk 'NR == 1 || FNR > 1' $^)

$(COMPARE)/block-%.tsv: $(compare_needs) $(PIPELINES)/compare/mooney-rivlin.tsv
	@mkdir -p $(COMPARE)
	cmake --build $(BUILD) --target block_mesh > $(COMPARE)/.build.log
	$(BIN)/block_mesh $(call part,1,$*) $(COMPARE)/block-$*.vtkhdf
	$(compare_run) $(COMPARE)/block-$*.vtkhdf $@ $(call part,3,$*) $(call part,4,$*) \
	  $(if $(filter mr,$(call part,2,$*)),$(PIPELINES)/compare/mooney-rivlin.tsv,seed2008) --gravity 0,0,-9810
$(COMPARE)/pressed-%.tsv: $(BIN)/export-deck tests/bench/bench_pressed_block.cpp tests/bench/press.sh
	@mkdir -p $(COMPARE)
	cmake --build $(BUILD) --target block_mesh bench_pressed_block > $(COMPARE)/.build.log
	BIN=$(BIN) tests/bench/press.sh $@ $(call part,1,$*) $(call part,2,$*) $(call part,3,$*) $(call part,4,$*) $(call part,5,$*)
part = $(word $1,$(subst -, ,$2))

# The case's breast, stress-free to supine, without skin.
compare_record := $(COMPARE)/.breast.settings
compare_settings := $(RUN) $(COMPARE_ELEMENTS) $(MATERIALS)
$(COMPARE)/breast-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(HEXMESH) $(call changed,compare)
	$(call stage,compare) $(HEXMESH) $(wordlist 1,2,$^) $@ --elements $(COMPARE_ELEMENTS) --skin 0
$(COMPARE)/breast-reference.vtkhdf: $(COMPARE)/breast-mesh.vtkhdf $(BACKWARD) $(MADE_MATERIALS)
	$(BACKWARD) $< $@ --posture prone --materials $(MATERIALS)
$(COMPARE)/breast-%.tsv: $(COMPARE)/breast-reference.vtkhdf $(compare_needs)
	$(compare_run) $< $@ $(call part,1,$*) $(call part,2,$*) $(MATERIALS) --posture supine
