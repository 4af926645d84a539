# The chain, one rule a stage; every file lies in runs/CASE with its report beside it.
MR_FILES := $(MR) $(if $(wildcard $(MR)/.),$(wildcard $(MR)/*))
CHAIN_FILES := $(addprefix $(RUN)/,labels.vtkhdf geometry.vtkhdf mesh.vtkhdf reference.vtkhdf \
  supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti curve.vtp)

$(RUN)/labels.vtkhdf $(RUN)/points.vtp &: $(MR_FILES) $(CHEST_WALL) $(SEGMENT)
	@mkdir -p $(RUN)
	$(SEGMENT) $(MR) $(RUN)/labels.vtkhdf --side $(SIDE) $(if $(SERIES),--series $(SERIES)) \
	  $(if $(CHEST_WALL),--chest-wall $(CHEST_WALL)) --points $(RUN)/points.vtp $(SEGMENT_OPTIONS) \
	  --report $(RUN)/labels.json $(share)

$(RUN)/geometry.vtkhdf: $(RUN)/labels.vtkhdf $(FIT_HERMITE)
	$(FIT_HERMITE) $< $@ $(FIT_OPTIONS) $(common)

$(RUN)/mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(HEXMESH)
	$(HEXMESH) $< $(RUN)/labels.vtkhdf $@ $(HEXMESH_OPTIONS) $(common)

$(RUN)/reference.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD)
	$(BACKWARD) $< $@ --posture prone $(MECHANICS) $(common)

$(RUN)/supine.vtkhdf: $(RUN)/reference.vtkhdf $(FORWARD)
	$(FORWARD) $< $@ --posture supine $(MECHANICS) $(common)

$(RUN)/cc.vtkhdf: $(RUN)/reference.vtkhdf $(COMPRESS)
	$(COMPRESS) $< $@ --view CC --reduction $(REDUCTION) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) \
	  $(MECHANICS) $(common)

$(RUN)/mlo.vtkhdf: $(RUN)/reference.vtkhdf $(COMPRESS)
	$(COMPRESS) $< $@ --view MLO --reduction $(REDUCTION) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) \
	  $(MECHANICS) $(common)

# The mammogram's report must not overwrite the compression's.
$(RUN)/%.vti: $(RUN)/%.vtkhdf $(RUN)/labels.vtkhdf $(PROJECT)
	$(PROJECT) $< $@ --labels $(RUN)/labels.vtkhdf --png $(RUN)/$*.png $(PROJECT_OPTIONS) \
	  --report $(RUN)/$*-mammogram.json $(share)

$(RUN)/curve.vtp: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(CC2MLO)
	$(CC2MLO) $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $@ --landmark tumour --table $(RUN)/curve.tsv $(common)

# The same with the lateral cut held: what this boundary condition changes at the landmarks.
$(RUN)/reference-cut-fixed.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD)
	$(BACKWARD) $< $@ --posture prone $(MECHANICS) --cut fixed $(common)
$(RUN)/supine-cut-fixed.vtkhdf: $(RUN)/reference-cut-fixed.vtkhdf $(FORWARD)
	$(FORWARD) $< $@ --posture supine $(MECHANICS) --cut fixed $(common)

$(RUN)/displacements.tsv: $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf \
  supine-cut-fixed.vtkhdf cc.vtkhdf mlo.vtkhdf) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --landmarks tumour,nipple > $@

# Errors against the phantom's truth (stress-free, prone, supine); a real scan has none.
ifdef TRUTH
$(RUN)/truth.tsv: $(TRUTH) $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --truth $(TRUTH) > $@
endif

$(RUN)/summary.txt: $(CHAIN_FILES) $(RUN)/displacements.tsv $(if $(TRUTH),$(RUN)/truth.tsv) $(FIGURES)
	@pipelines/summary.sh $(RUN) > $@
	@cat $@
