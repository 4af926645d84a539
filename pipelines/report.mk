# Expected values, and one self-contained page of everything a run produced.
EXPECTED ?= $(wildcard pipelines/expected/$(CASE)$(if $(PAPER),-as-printed).tsv)
verify: $(RUN)/verify.tsv
$(RUN)/verify.tsv: $(EXPECTED) pipelines/verify.sh pipelines/values.sh $(RUN)/summary.txt $(TABLES)/conclusions.tsv
	$(if $(EXPECTED),,$(error no expected values for case $(CASE): name a file with EXPECTED=))
	@pipelines/verify.sh $(EXPECTED) $(RUN) > $@.part || { cat $@.part; exit 1; }
	@mv $@.part $@
	@cat $@

report: $(RUN)/report.html
all: figures tables $(if $(EXPECTED),verify) report
.PHONY: verify report all

# What the slow targets left behind is embedded with its date; they are not run for the report.
REPORT_EXTRAS = $(wildcard $(LEAVEOUT)/table.tsv $(RUN)/cost/*.tsv $(RUN)/cost/*.png $(RUNS)/stability/*.tsv $(RUNS)/compare/*.tsv $(RUN)/sensitivity/*.tsv)
$(RUN)/report.html: $(RUN)/summary.txt $(TABLES)/table2.tsv $(TABLES)/conclusions.tsv $(F)/cc-points.png $(F)/mlo-curves.png \
  $(if $(EXPECTED),$(RUN)/verify.tsv) pipelines/report.sh pipelines/values.sh pipelines/limits.txt $(REPORT_EXTRAS)
	pipelines/report.sh $(RUN) $(RUNS) $(BIN) > $@.part
	@mv $@.part $@
	@echo "$@"
