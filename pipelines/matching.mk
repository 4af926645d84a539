# From view to view, judged: derivatives of the compressed shapes for the band, and the matched curves of the
# phantom's landmarks against their true places (target `truth` makes these, many minutes).
SENSITIVITY ?= $(BIN)/sensitivity
BAND_STATES := cc mlo truth-cc truth-mlo
$(BAND_STATES:%=$(RUN)/%-sensitivity.vtkhdf): $(RUN)/%-sensitivity.vtkhdf: $(RUN)/%.vtkhdf $(RUN)/reference.vtkhdf $(SENSITIVITY)
	$(SENSITIVITY) $(RUN)/reference.vtkhdf $< $@ $(PRONE) $(MECHANICS) --cut $(CUT) \
	  --table $(basename $@).tsv $(common)

# matching.tsv: the chain from the MR; matching-true-mesh.tsv: the true body on as many elements as the chain's.
# Both are read against the true body on eight times as many.
$(RUN)/matching.tsv: $(RUN)/truth-cc-sensitivity.vtkhdf $(RUN)/truth-mlo-sensitivity.vtkhdf $(TRUTH_TABLE) $(CC2MLO)
	$(CC2MLO) $(wordlist 1,2,$^) $(basename $@).vtp --truth $(TRUTH_TABLE) --band --table $@ $(common)
$(RUN)/matching-true-mesh.tsv: $(TRUTH_TABLE) $(CC2MLO)
	$(CC2MLO) $(TRUTH_AT)-coarse-cc.vtkhdf $(TRUTH_AT)-coarse-mlo.vtkhdf $(basename $@).vtp \
	  --truth $(TRUTH_TABLE) --table $@ $(common)
matching: $(RUN)/matching.tsv $(RUN)/matching-true-mesh.tsv
	@for table in $^; do echo "$$table"; grep -E '^(query|-)' $$table | cut -f2,15-18,21,22; done
.PHONY: matching

# The band against solving the chain again with parameters drawn from its priors, on a coarse mesh of the case.
BAND_SAMPLES ?= 220
$(RUN)/band-check-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(HEXMESH)
	$(HEXMESH) $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $@ --elements 8 --tumour none $(common)
$(RUN)/band-samples.tsv: $(RUN)/band-check-mesh.vtkhdf tests/bench/band_check.cpp $(COMPRESS)
	cmake -B $(BUILD) -DBREAST_BENCH=ON > $(RUN)/.band-check.log
	cmake --build $(BUILD) --target band_check >> $(RUN)/.band-check.log
	$(BIN)/band_check $< 1 $(BAND_SAMPLES) > $@.part
	@mv $@.part $@
band-check: $(RUN)/band-samples.tsv
	@pipelines/band-check.sh $<
.PHONY: band-check

# What they cost, on an idle machine: a 0.1 mm image, one curve, the full grid.
mammo-times: $(addprefix $(RUN)/,cc-sensitivity.vtkhdf mlo-sensitivity.vtkhdf labels.vtkhdf)
	@pipelines/mammo-times.sh $(BIN) $(RUN)
.PHONY: mammo-times
