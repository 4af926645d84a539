# The phantom: a breast MR with known truth. Its stress-free shape is solved to prone on a template and
# a mesh the chain never uses.
PHANTOM_MR := $(RUNS)/phantom/$(PRESET).nrrd
PHANTOM_TRUTH := $(RUNS)/phantom/$(PRESET)-truth
ifndef MR
  MR := $(PHANTOM_MR)
  TRUTH := $(PHANTOM_TRUTH)/landmarks.tsv
  # The paper puts its tumour where it likes, on the gland's margin; ours is the phantom's, whose way is known.
  TUMOUR ?= $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv
endif

phantom_record := $(RUNS)/phantom/.$(PRESET).settings
phantom_settings := $(PHANTOM) $(PRESET) $(PHANTOM_OPTIONS)
$(PHANTOM_MR) $(PHANTOM_TRUTH)/landmarks.tsv $(PHANTOM_TRUTH)/tumour-$(SIDE).tsv &: $(PHANTOM) $(call changed,phantom)
	@mkdir -p $(dir $(PHANTOM_MR))
	$(PHANTOM) $(PHANTOM_MR) --preset $(PRESET) --truth $(PHANTOM_TRUTH) $(PHANTOM_OPTIONS) \
	  --report $(basename $(PHANTOM_MR)).json $(share)
	@$(call record,phantom)

# Compressed truth of the phantom: the same body (cut held) on eight times the chain's elements, and on an
# eighth of them, whose distance is the truth's own error. The finer plates close to the coarser's gap.
# Many minutes, so a target of its own; TRUTH_TABLE is a truth for probe --truth. The stand-off is 35 mm: nearer
# to the wall the plates' bevel squeezes the fat between them and the held cut, which the chain's mesh does not have.
TRUTH_STANDOFF ?= 35
TRUTH_AT := $(PHANTOM_TRUTH)/$(SIDE)
TRUTH_TABLE := $(PHANTOM_TRUTH)/$(SIDE)-compressed.tsv
TRUTH_MESHES := $(foreach level,fine coarse,$(foreach what,$(level) $(level)-supine $(level)-cc $(level)-mlo,\
  $(TRUTH_AT)-$(what).vtkhdf))
truth_mesh = $(PHANTOM_MESH) $(TRUTH_AT)-$1.vtkhdf --supine $(TRUTH_AT)-$1-supine.vtkhdf --level $2 \
  --preset $(PRESET) --side $(SIDE) --report $(TRUTH_AT)-$1.json $(share)
$(TRUTH_AT)-coarse.vtkhdf $(TRUTH_AT)-coarse-supine.vtkhdf &: $(PHANTOM_MR) $(PHANTOM_MESH)
	$(call truth_mesh,coarse,1)
$(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-fine-supine.vtkhdf &: $(PHANTOM_MR) $(PHANTOM_MESH)
	$(call truth_mesh,fine,2)
truth_compress = $(COMPRESS) $< $@ --view $(call upper,$*) --cut fixed --standoff $(TRUTH_STANDOFF) \
  --at-least $(AT_LEAST) $(common)
$(TRUTH_AT)-coarse-%.vtkhdf: $(TRUTH_AT)-coarse.vtkhdf $(COMPRESS)
	$(truth_compress) --reduction $(REDUCTION)
$(TRUTH_AT)-fine-%.vtkhdf: $(TRUTH_AT)-fine.vtkhdf $(TRUTH_AT)-coarse-%.vtkhdf $(COMPRESS)
	$(truth_compress) --thickness $(call thickness,$(TRUTH_AT)-coarse-$*.json)
$(TRUTH_TABLE): $(PHANTOM_TRUTH)/landmarks.tsv $(TRUTH_MESHES) $(TRUTH_TABLE_TOOL)
	$(TRUTH_TABLE_TOOL) $< $@ $(TRUTH_MESHES) $(common)
upper = $(if $(filter cc,$1),CC,MLO)
thickness = $$(. pipelines/values.sh; key $1 thickness_mm)

# The chain between plates as far apart and as far from the wall as the truth's, and its errors.
$(RUN)/truth-%.vtkhdf: $(RUN)/reference.vtkhdf $(TRUTH_TABLE) $(COMPRESS)
	$(COMPRESS) $< $@ --view $(call upper,$*) --thickness $(call thickness,$(TRUTH_AT)-fine-$*.json) \
	  --standoff $(TRUTH_STANDOFF) --at-least $(AT_LEAST) $(COMPRESS_OPTIONS) $(MECHANICS) --cut $(CUT) $(common)
$(RUN)/truth-compressed.tsv: $(TRUTH_TABLE) $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf \
  truth-cc.vtkhdf truth-mlo.vtkhdf) $(PROBE)
	$(PROBE) $(filter %.vtkhdf,$^) --truth $< > $@.part
	@mv $@.part $@
truth: $(RUN)/truth-compressed.tsv
	@cat $<

# How the preset `paper` was found: motions of the paper's Tables III and IV for a chain that moves the
# nipple 1.28 and the tumour 1.39 times as far as the phantom does (PAPER=1, measured on a phantom near the one
# found). Prints the values that stand in libbreast/phantom/parameters.cpp.
calibrate: $(CALIBRATE)
	$(CALIBRATE) --preset paper --gain 1.28,1.39 --evaluations 24 $(share)
