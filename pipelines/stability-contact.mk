# SPDX-License-Identifier: GPL-3.0-or-later
# Compression far from the ordinary: one row a case in runs/stability/contact.tsv. With the case's
# stress-free mesh at the end when it has been made. A case that stops short (code 3) is a row of the table.
STABILITY := $(RUNS)/stability
.PHONY: stability-contact
stability-contact: $(STABILITY)/contact.tsv
	@cat $<
$(STABILITY)/contact.tsv: $(COMPRESS) tests/fixtures/contact_cases.hpp tests/bench/stability_contact.cpp \
  $(wildcard $(RUN)/reference.vtkhdf)
	@mkdir -p $(STABILITY)
	cmake -B $(BUILD) -DBREAST_BENCH=ON > $(STABILITY)/.build.log
	cmake --build $(BUILD) --target stability_contact >> $(STABILITY)/.build.log
	$(BIN)/stability_contact $(wildcard $(RUN)/reference.vtkhdf) > $@.part || [ $$? -eq 3 ]
	@mv $@.part $@

# Both tables, and one page of what became of every case.
.PHONY: stability
stability: $(STABILITY)/summary.tsv
	@cat $<
$(STABILITY)/summary.tsv: $(STABILITY)/mechanics.tsv $(STABILITY)/contact.tsv $(TABULATE)
	$(tabulate) stability $(STABILITY)/mechanics.tsv $(STABILITY)/contact.tsv > $@.part
	@mv $@.part $@
