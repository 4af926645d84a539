# SPDX-License-Identifier: GPL-3.0-or-later
# Before a release: what takes hours. Every program under failing writes and allocations, small limits, full disks, damaged files
# of every format in our own checks (100000 inputs a format, and FUZZ_MINUTES more in all) and in whole programs under
# sanitizers (FUZZ_INPUTS a format); the package in an empty Debian 12; a cohort on a Slurm of its own.
FUZZ_MINUTES ?= 240
FUZZ_INPUTS ?= 2000
FAULT_ALLOCATIONS ?= 200
SANITIZED := build/asan
# Programs that read the formats of tests/fuzz/whole-tools.py.
readers := probe evaluate laws export-deck match-lookup segment hexmesh cc2mlo truth-table

.PHONY: release-check faults full-disk whole-tools slurm
release-check: check faults full-disk whole-tools clean-root slurm
	tests/fuzz/run.sh inputs=100000
	tests/fuzz/run.sh $(FUZZ_MINUTES)

faults:
	cmake --build $(BUILD) -j $$(nproc) --target programs tetrahedra tools_faults tools_limits
	BREAST_FAULT_ALLOCATIONS=$(FAULT_ALLOCATIONS) OPENBLAS_THREAD_TIMEOUT=4 $(BUILD)/tests/tools_faults
	BREAST_FAULT_ALLOCATIONS=$(FAULT_ALLOCATIONS) OPENBLAS_THREAD_TIMEOUT=4 $(BUILD)/tests/tools_limits

full-disk:
	cmake --build $(BUILD) -j $$(nproc) --target programs tools_full_disk tools_killed_writer
	$(BUILD)/tests/tools_full_disk
	$(BUILD)/tests/tools_killed_writer

whole-tools:
	cmake --build $(BUILD) -j $$(nproc) --target programs fault_inputs
	cmake --preset asan > /dev/null
	cmake --build $(SANITIZED) -j $$(nproc) --target $(readers)
	rm -rf build/whole-tools
	$(BUILD)/tests/fault_inputs build/whole-tools
	tests/fuzz/whole-tools.py $(SANITIZED)/bin build/whole-tools $(FUZZ_INPUTS)

# Needs root, slurm-wlm, munge and netpbm; without them it says so and fails.
slurm:
	cmake --build $(BUILD) -j $$(nproc) --target programs
	tests/tools/slurm.sh $(BUILD)
