# SPDX-License-Identifier: GPL-3.0-or-later
# Expected values, and one self-contained page of everything a run produced.
EXPECTED ?= $(wildcard $(PIPELINES)/expected/$(CASE)$(if $(PAPER),-as-printed).tsv)
verify: $(RUN)/verify.tsv
$(RUN)/verify.tsv: $(EXPECTED) $(TABULATE) $(RUN)/summary.txt $(TABLE_FILES)
	$(if $(EXPECTED),,$(error no expected values for case $(CASE): name a file with EXPECTED=))
	@$(tabulate) verify $(EXPECTED) $(RUN) > $@.part
	@mv $@.part $@
	@cat $@

CHROMIUM ?= $(shell command -v chromium || command -v chromium-browser || command -v google-chrome)
report: $(RUN)/report.html $(if $(CHROMIUM),$(RUN)/report.pdf)
	@$(if $(CHROMIUM),,echo "report: no PDF: chromium is not installed (apt-get install chromium); any browser prints the page" >&2)
all: figures tables $(if $(EXPECTED),verify) report
.PHONY: verify report all

# What the slow targets left behind is embedded with its date. Named as prerequisites they would be solved anew where a
# program is newer; so the page remembers which files they were, of when.
REPORT_EXTRAS = $(wildcard $(LEAVEOUT)/*.tsv $(RUN)/cost/*.tsv $(RUN)/cost/*.png $(RUN)/budget/*.tsv $(RUN)/budget/*.png \
  $(RUNS)/stability/*.tsv $(RUNS)/compare/all.tsv $(RUNS)/compare/pressed.tsv)
report_settings = $(foreach file,$(REPORT_EXTRAS),$(file) $(shell stat -c %Y $(file)))
report_record = $(RUN)/report.settings
$(RUN)/report.html: $(RUN)/summary.txt $(TABLE_FILES) $(F)/cc-points.png $(F)/mlo-curves.png \
  $(if $(EXPECTED),$(RUN)/verify.tsv) $(TABULATE) $(PIPELINES)/limits.txt $(PIPELINES)/advice.tsv $(call changed,report)
	$(tabulate) report $(RUN) $(RUNS) > $@.part
	@mv $@.part $@
	@$(call record,report)
	@echo "$@"
$(RUN)/report.pdf: $(RUN)/report.html
	$(PIPELINES)/print.sh "$(CHROMIUM)" $< $@
	@echo "$@"
