# SPDX-License-Identifier: GPL-3.0-or-later
# The matching between views, compared with the phantom's truth (made by the target `truth`, which takes many minutes), and checks of its
# bands with benchmark programs that are not installed.

BAND_SAMPLES ?= 220
BAND_DRAWS ?= 400
BAND_PLACES ?= 150

# If the material set contains uncertainties, they replace the priors of softness and supports.
band_set = $(if $(filter %=uncertainty,$(call rows_in,$(MATERIAL_TABLE))),$(MATERIALS))
# matching.tsv: the chain from the MR; matching-true-mesh.tsv: the true body on as many elements as the chain's.
# Both are read against the true body on eight times as many.
$(RUN)/matching.tsv: $(RUN)/truth-cc-sensitivity.vtkhdf $(RUN)/truth-mlo-sensitivity.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	$(CC2MLO) $(wordlist 1,2,$^) $(basename $@).vtp --truth $(TRUTH_TABLE) --band $(addprefix --materials ,$(band_set)) \
	  --table $@ $(common)
$(RUN)/matching-true-mesh.tsv: $(TRUTH_TABLE) $(CC2MLO)
	$(CC2MLO) $(TRUTH_AT)-coarse-cc.vtkhdf $(TRUTH_AT)-coarse-mlo.vtkhdf $(basename $@).vtp \
	  --truth $(TRUTH_TABLE) --table $@ $(common)
matching: $(RUN)/matching.tsv $(RUN)/matching-true-mesh.tsv
	@for table in $(basename $^); do echo "$$table.tsv"; cat $$table-summary.tsv; done
.PHONY: matching

# The band is compared with repeated solves of the chain with parameters drawn from the priors, on a coarse mesh of the case.
$(RUN)/band-check-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(HEXMESH)
	$(HEXMESH) $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $@ --elements 8 --tumour none $(common)
$(RUN)/band-samples.tsv: $(RUN)/band-check-mesh.vtkhdf tests/bench/band_check.cpp $(COMPRESS)
	$(call bench,band_check)
	$(call table,$(BIN)/band_check $< 1 $(BAND_SAMPLES))
band-check: $(RUN)/band-samples.tsv
	@$(tabulate) coverage $<
.PHONY: band-check

# The band of the chain from the MR scan is compared with the true body of the phantom: with its points at their true positions
# (band-nominal), and with its points displaced along the derivatives of the true body by parameters drawn from the priors
# (band-drawn, with BAND_DRAWS draws).
TRUE_SENSITIVITIES := $(foreach view,cc mlo,$(TRUTH_AT)-coarse-$(view)-sensitivity.vtkhdf)
$(TRUE_SENSITIVITIES): %-sensitivity.vtkhdf: %.vtkhdf $(TRUTH_AT)-coarse.vtkhdf $(BIN)/sensitivity
	$(BIN)/sensitivity $(TRUTH_AT)-coarse.vtkhdf $< $@ --posture prone --table $(basename $@).tsv $(common)
band_bodies := $(RUN)/truth-cc-sensitivity.vtkhdf $(RUN)/truth-mlo-sensitivity.vtkhdf $(TRUE_SENSITIVITIES)
# $(call band_rows,COUNT,SPREAD)
band_rows = $(BIN)/band_truth $(band_bodies) 1 $1 $(BAND_PLACES) $2 $(band_set)
$(RUN)/band-nominal.tsv $(RUN)/band-drawn.tsv &: $(band_bodies) tests/truth/band_truth.cpp
	$(call bench,band_truth)
	$(call band_rows,1,0) > $(RUN)/band-nominal.tsv.part
	$(call band_rows,$(BAND_DRAWS),1) > $(RUN)/band-drawn.tsv.part
	@for rows in nominal drawn; do mv $(RUN)/band-$$rows.tsv.part $(RUN)/band-$$rows.tsv; done
band-truth: $(RUN)/band-nominal.tsv $(RUN)/band-drawn.tsv
	@$(tabulate) coverage $^
.PHONY: band-truth

# The cost of a 0.1 mm image, of one curve, and of the full grid, measured on an idle machine.
mammo-times: $(addprefix $(RUN)/,cc-sensitivity.vtkhdf mlo-sensitivity.vtkhdf labels.vtkhdf)
	@tests/bench/mammo-times.sh $(BIN) $(RUN)
.PHONY: mammo-times
