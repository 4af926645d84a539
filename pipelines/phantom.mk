# The phantom: a breast MR with known truth. Its stress-free shape is solved to prone on a template and
# a mesh the chain never uses.
PHANTOM_MR := $(RUNS)/phantom/$(PRESET).nrrd
PHANTOM_TRUTH := $(RUNS)/phantom/$(PRESET)-truth
ifndef MR
  MR := $(PHANTOM_MR)
  TRUTH := $(PHANTOM_TRUTH)/landmarks.tsv
endif

phantom_record := $(RUNS)/phantom/.$(PRESET).settings
phantom_settings := $(PHANTOM) $(PRESET) $(PHANTOM_OPTIONS)
$(PHANTOM_MR) $(PHANTOM_TRUTH)/landmarks.tsv &: $(PHANTOM) $(call changed,phantom)
	@mkdir -p $(dir $(PHANTOM_MR))
	$(PHANTOM) $(PHANTOM_MR) --preset $(PRESET) --truth $(PHANTOM_TRUTH) $(PHANTOM_OPTIONS) \
	  --report $(basename $(PHANTOM_MR)).json $(share)
	@$(call record,phantom)

# Compressed truth of the phantom, on the phantom's own mesh and element (quadratic, cut held): minutes,
# so a target of its own.
TRUTH_FILES := $(addprefix $(PHANTOM_TRUTH)/$(SIDE)-,cc.vtkhdf mlo.vtkhdf)
truth: $(TRUTH_FILES)
$(PHANTOM_TRUTH)/$(SIDE)-%.vtkhdf: $(PHANTOM_MR) $(COMPRESS)
	$(COMPRESS) $(PHANTOM_TRUTH)/$(SIDE).vtkhdf $@ --view $(call upper,$*) --reduction $(REDUCTION) \
	  --at-least $(AT_LEAST) --materials $(MATERIALS) --element q2p1 --cut fixed $(common)
upper = $(if $(filter cc,$1),CC,MLO)
