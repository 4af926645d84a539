# SPDX-License-Identifier: GPL-3.0-or-later
# Of docs/validation/same-side.md: the sides of a cohort (COHORT=DIR) in other voxels, positions and qualities, from the scan to the
# supine shape, and how far the results move; then how well the scores of segment show the errors of all of them whose tissue is known.
CHANGED := $(RUNS)/changed
changed_tool := $(BIN)/changed_scan
same-scan:
	cmake -B $(BUILD) -DBREAST_BENCH=ON > /dev/null
	cmake --build $(BUILD) --target changed_scan
	tests/bench/changed-scans.sh $(changed_tool) $(COHORT) $(CHANGED)
	+-$(MAKE) -f $(PIPELINE) COHORT=$(CHANGED) RUNS=$(RUNS) sides
	tests/bench/changed-walls.sh $(changed_tool) $(BIN)/evaluate $(RUNS)/cohort-changed
	@$(tabulate) same-scan $(RUNS)/cohort-changed
	@$(tabulate) flags $(RUNS)/cohort-changed
same-scan-table: same-scan
	$(call published,same-scan,$(RUNS)/cohort-changed/same-scan.tsv,$(RUNS)/cohort-changed/same-scan.tsv)
# What segment costs, of one scan (MR, SIDE) in 1 to 250 million voxels.
segment-cost-table:
	cmake -B $(BUILD) -DBREAST_BENCH=ON > /dev/null
	cmake --build $(BUILD) --target changed_scan
	tests/bench/segment-cost.sh $(BIN) $(MR) $(SIDE) 1 4 12 35 100 250 > $(TABLES_OF_PAGE)/segment-cost.tsv
	$(tabulate) made $(TABLES_OF_PAGE)/segment-cost.tsv $(TABLES_OF_PAGE)/segment-cost.tsv
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
.PHONY: same-scan same-scan-table segment-cost-table
