# SPDX-License-Identifier: GPL-3.0-or-later
# Evaluation of the matching between views: derivatives of the compressed shapes for the band, and the matched curves of the
# phantom's landmarks compared with their true positions (made by the target `truth`, which takes many minutes).
BAND_STATES := cc mlo truth-cc truth-mlo
$(BAND_STATES:%=$(RUN)/%-sensitivity.vtkhdf): $(RUN)/%-sensitivity.vtkhdf: $(RUN)/%.vtkhdf $(RUN)/reference.vtkhdf $(SENSITIVITY)
	$(call staged,$(RUN)/.$*-sensitivity.settings,$(SENSITIVITY) $(PRONE) $(MECHANICS) $(SUPPORT),$(if $(filter cc mlo,$*),--of $< --spared $@)) $(SENSITIVITY) $(RUN)/reference.vtkhdf $< $@ $(PRONE) $(MECHANICS) $(SUPPORT) \
	  --table $(basename $@).tsv $(common)

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
