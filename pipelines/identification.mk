# SPDX-License-Identifier: GPL-3.0-or-later
# The patient's own material set is identified from a second posture: from landmarks (LANDMARKS=pairs.tsv, or marks of 3D Slicer,
# PRONE.mrk.json,SUPINE.mrk.json), from a supine scan (SUPINE=scan, or SUPINE=phantom for that of the phantom), or from both. The
# chain runs with this set. landmarks.tsv contains the distance of each landmark from its observed position with this set, with
# Table II (seed2008) and with the prior set; figures/postures.png shows both postures. All files of the second scan are in
# RUN/second.
ifneq ($(LANDMARKS)$(SUPINE),)
landmark_files := $(subst $(comma), ,$(LANDMARKS))
second_marks := $(if $(LANDMARKS),--landmarks $(firstword $(landmark_files)) $(addprefix --second-landmarks ,$(word 2,$(landmark_files))))
ifneq ($(SUPINE),)
PHANTOM_SUPINE := $(RUNS)/phantom/$(PRESET)-supine.nrrd
supine_scan := $(if $(filter phantom,$(SUPINE)),$(PHANTOM_SUPINE),$(SUPINE))
ifeq ($(SUPINE),phantom)
supine_truth := $(PHANTOM_SUPINE:.nrrd=-truth)/landmarks.tsv
phantom-supine_record := $(RUNS)/phantom/.$(PRESET)-supine.settings
phantom-supine_settings := $(phantom_settings)
$(PHANTOM_SUPINE) $(supine_truth) &: $(BIN)/phantom $(call changed,phantom-supine)
	$(call stage,phantom-supine) $(call phantom_scan,$(PRESET)-supine,--posture supine --misalign 4$(comma)2)
endif
second-labels_record := $(RUN)/second/.second-labels.settings
second-labels_settings := $(SEGMENT) $(call content,$(SUPINE)) $(call named,$(supine_scan)) --side $(SIDE)
$(RUN)/second/labels.vtkhdf $(RUN)/second/points.vtp &: $(supine_scan) $(SEGMENT) $(call changed,second-labels)
	$(call stage,second-labels) $(SEGMENT) $(supine_scan) $(RUN)/second/labels.vtkhdf --side $(SIDE) --posture supine --points $(RUN)/second/points.vtp \
	  --overlay $(RUN)/second/contours.png --report $(RUN)/second/labels.json $(share)
second_scan := $(RUN)/second/points.vtp $(RUN)/second/labels.vtkhdf $(RUN)/labels.vtkhdf
second_skin := --surface $(RUN)/second/points.vtp --labels $(RUN)/labels.vtkhdf --second-labels $(RUN)/second/labels.vtkhdf \
  --seen $(RUN)/second/seen.vtp --second $(RUN)/second/predicted.vtkhdf
# The supine landmarks of a phantom are used to judge the set, which was identified without them.
second_judge := $(if $(supine_truth),$(if $(LANDMARKS),,--judge $(supine_truth)))
second_states := $(RUN)/second/predicted.vtkhdf $(RUN)/second/seen.vtp
$(RUN)/figures/postures.png: $(RUN)/second/predicted.vtkhdf $(RUN)/second/seen.vtp $(RENDER)
	@mkdir -p $(@D) && $(RENDER) $(filter %.vtkhdf %.vtp,$^) --figure postures -o $@
endif
identified_settings := $(BIN)/identify $(call content,$(landmark_files)) $(content_MATERIALS) $(prior_set) $(SUPPORT) $(second_marks) $(second_skin) $(second_judge)
$(RUN)/identified.tsv $(RUN)/landmarks.tsv $(second_states) &: $(RUN)/mesh.vtkhdf $(landmark_files) $(second_scan) $(supine_truth) $(BIN)/identify \
  $(call changed,identified)
	$(call prints,identified,$(RUN)/identified.txt) $(BIN)/identify $< $(RUN)/identified.tsv $(second_marks) --align $(second_skin) $(second_judge) --materials $(prior_set) $(SUPPORT) \
	  $(addprefix --compare ,$(sort seed2008 $(prior_set))) --table $(RUN)/landmarks.tsv \
	  --report $(RUN)/identified.json $(share)
	@cat $(RUN)/identified.txt
endif
