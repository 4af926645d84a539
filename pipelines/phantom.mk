# SPDX-License-Identifier: GPL-3.0-or-later
# The phantom is a breast MR with known truth. Its prone shape is computed from its stress-free shape on a template and a mesh
# that the chain never uses.
# The preset `paper` was fitted to results of this chain; tabulate marks the rows to which it was fitted.
export CALIBRATED := $(if $(TRUTH),$(if $(filter paper,$(PRESET)),$(PHANTOM_MR:.nrrd=.json) $(SIDE)))

# $(call phantom_scan,NAME,OPTIONS): the program that makes the scan RUNS/phantom/NAME.nrrd and its truth NAME-truth.
phantom_scan = $(BIN)/phantom $(RUNS)/phantom/$1.nrrd --preset $(PRESET) $2 --truth $(RUNS)/phantom/$1-truth $(PHANTOM_OPTIONS) \
  --report $(RUNS)/phantom/$1.json $(alone)
phantom_record := $(RUNS)/phantom/.$(PRESET).settings
phantom_settings := $(BIN)/phantom $(PRESET) $(PHANTOM_OPTIONS)
$(PHANTOM_MR) $(PHANTOM_TRUTH)/landmarks.tsv $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv &: $(BIN)/phantom $(call changed,phantom)
	$(call stage,phantom) $(call phantom_scan,$(PRESET))

# Makes only the scan, which all cases of one phantom share (cohort.mk).
.PHONY: phantom-scan
phantom-scan: $(if $(TRUTH),$(MR))

# What the phantom's body is between the plates: a truth for probe --truth, and for rows of a study whose plates are its own. Only the
# source tree makes it (tests/truth/compressed.mk).
TRUTH_AT := $(PHANTOM_TRUTH)/$(SIDE)
TRUTH_TABLE := $(TRUTH_AT)-compressed.tsv
