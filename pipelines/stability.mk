# SPDX-License-Identifier: GPL-3.0-or-later
# The table of extreme cases of gravity (tests/extreme/table/cases.cpp), a row for each direction of each
# case: counts, residual, seconds, outcome. Its program is built on demand.
STABILITY_LIMIT ?= 20000
stability-mechanics: $(RUNS)/stability/mechanics.tsv
.PHONY: stability-mechanics
$(RUNS)/stability/mechanics.tsv: $(SOURCES) $(wildcard tests/extreme/table/*)
	@mkdir -p $(@D)
	cmake --build $(BUILD) --target print_extreme_mechanics -j $$(nproc)
	$(BUILD)/tests/print_extreme_mechanics --limit $(STABILITY_LIMIT) > $@.part
	@mv $@.part $@
	@cut -f1-11 $@
