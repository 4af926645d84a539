# SPDX-License-Identifier: GPL-3.0-or-later
# Targets of the source tree alone, which an installation has not: tests, extreme cases, what takes hours before a release, the
# Debian package. Makefile.pipeline includes it.
.PHONY: check page-check fuzz release-check faults fields python-pages full-disk whole-tools slurm clean-root stability stability-mechanics stability-contact
# What the tests need besides: their packages, then the tests themselves, which are left out without them.
check fuzz faults full-disk whole-tools stability-mechanics stability-contact: | $(ROOT)build/.packages-check
check:
	$(call build,all)
	OPENBLAS_THREAD_TIMEOUT=4 ctest --test-dir $(BUILD) --output-on-failure --no-tests=error -j $$(nproc)
	printf '%s\n' tests/tools/reproduce.sh tests/tools/pipeline.sh 'tests/fuzz/run.sh inputs=2000' \
	  'tests/tools/docs-current.sh $(BIN)' | xargs -d '\n' -P $$(nproc) -I{} sh -c 'echo "{}:"; {} || { echo "FAILED: {}"; exit 1; }'

page-check: $(RUN)/page.html $(CC2MLO)
	tests/page/check.sh $(BIN) $(RUN) $(RUN)

FUZZ_MINUTES ?= 240
FUZZ_INPUTS ?= 2000
FAULT_ALLOCATIONS ?= 200
fuzz:
	tests/fuzz/run.sh $(or $(MINUTES),5)

# Before a release: what takes hours. Every program under failing writes and allocations, small limits, full disks, damaged files
# of every format in our own checks (100000 inputs a format, and FUZZ_MINUTES more in all) and in whole programs under
# sanitizers (FUZZ_INPUTS a format); the package in an empty Debian 12; a cohort on a Slurm of its own.
release-check: check faults fields python-pages full-disk whole-tools clean-root slurm
	tests/fuzz/run.sh inputs=100000
	tests/fuzz/run.sh $(FUZZ_MINUTES)

FAULT_TESTS := tools_faults tools_limits tools_hostile_names tools_hostile_texts tools_locales
faults:
	$(call build,programs tetrahedra $(FAULT_TESTS))
	for test in $(FAULT_TESTS); do BREAST_FAULT_ALLOCATIONS=$(FAULT_ALLOCATIONS) OPENBLAS_THREAD_TIMEOUT=4 $(BUILD)/tests/$$test; done

# Every field of every file, damaged in four ways, for every tool that reads it.
fields:
	$(call build,programs)
	tests/faults/fields.py $(BUILD)/bin whole

# The examples of docs/python.md and of the tutorial on the run itself.
python-pages: $(CHAIN_FILES)
	BREAST_RUN=$(RUN) tests/python/run_tests.py $(BUILD)/bin test_pages test_parts

full-disk:
	$(call build,programs tools_full_disk tools_killed_writer)
	$(BUILD)/tests/tools_full_disk
	$(BUILD)/tests/tools_killed_writer

# Programs that read the formats of tests/fuzz/whole-tools.py, and of which what reads is sanitized.
readers := export-slicer probe evaluate laws export-deck pairs match-lookup segment hexmesh cc2mlo truth-table
SANITIZED := build/readers
whole-tools:
	$(call build,programs fault_inputs)
	cmake --preset readers > /dev/null
	cmake --build $(SANITIZED) -j $$(nproc) --target $(readers)
	rm -rf build/whole-tools
	$(BUILD)/tests/fault_inputs build/whole-tools
	tests/fuzz/whole-tools.py $(SANITIZED)/bin build/whole-tools $(FUZZ_INPUTS)

# Needs root, slurm-wlm and munge; without them it says so and fails.
slurm:
	$(call build,programs)
	tests/tools/slurm.sh $(BUILD)

# Installs the package in an empty Debian 12 and runs the demonstration there; needs root, network and debootstrap.
clean-root: package
	tests/tools/clean-root.sh build/package/libbreast_*.deb

# ---- extreme cases -----------------------------------------------------------------------------------------
# Of gravity (tests/extreme/table/cases.cpp), a row for each direction of each case; of compression, with the case's stress-free
# mesh at the end when it has been made. A case that stops short (code 3) is a row of the table. Then one page of their ends.
STABILITY := $(RUNS)/stability
STABILITY_LIMIT ?= 20000
stability-mechanics: $(STABILITY)/mechanics.tsv
	@cut -f1-11 $<
stability-contact: $(STABILITY)/contact.tsv
	@cat $<
stability: $(STABILITY)/summary.tsv
	@cat $<
$(STABILITY)/mechanics.tsv: $(SOURCES) $(wildcard tests/extreme/table/*)
	$(call build,print_extreme_mechanics)
	$(call table,$(BUILD)/tests/print_extreme_mechanics --limit $(STABILITY_LIMIT))
$(STABILITY)/contact.tsv: $(COMPRESS) tests/fixtures/contact_cases.hpp tests/bench/stability_contact.cpp \
  $(wildcard $(RUN)/reference.vtkhdf)
	@mkdir -p $(STABILITY)
	cmake -B $(BUILD) -DBREAST_BENCH=ON > $(STABILITY)/.build.log
	cmake --build $(BUILD) --target stability_contact >> $(STABILITY)/.build.log
	$(BIN)/stability_contact $(wildcard $(RUN)/reference.vtkhdf) > $@.part || [ $$? -eq 3 ]
	@mv $@.part $@
$(STABILITY)/summary.tsv: $(STABILITY)/mechanics.tsv $(STABILITY)/contact.tsv $(BIN)/tabulate
	$(call table,$(tabulate) stability $(STABILITY)/mechanics.tsv $(STABILITY)/contact.tsv)

# $(call bench,NAME): builds the benchmark program NAME, one recipe at a time.
bench = flock $(BUILD)/.bench $(SHELL) -c 'cmake -B $(BUILD) -DBREAST_BENCH=ON && cmake --build $(BUILD) --target $1' > $(RUN)/.$1.log

include $(addprefix $(ROOT)tests/,truth/compressed.mk truth/budget.mk)
include $(addprefix $(ROOT)tests/bench/,population.mk compare.mk bands.mk identification.mk calibrate.mk same-scan.mk)
include $(ROOT)tests/validation.mk
