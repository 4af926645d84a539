# What each optional part of the model is worth: the chain without it, the change at the landmarks and on the
# MLO curve in mm, and the time saved. Each variant is a case of its own below RUN/leaveout that starts from the
# base's labels and geometry.
LEAVEOUT := $(RUN)/leaveout
LEAVEOUT_VARIANTS := no-skin no-gland no-gravity-in-compression no-backward sharp-edge tumour-element cut-fixed quadratic

leaveout_no-skin := HEXMESH_OPTIONS='$(HEXMESH_OPTIONS) --skin 0'
leaveout_no-gland := MATERIALS=$(LEAVEOUT)/fat-only.tsv
leaveout_no-gravity-in-compression := COMPRESS_OPTIONS='$(COMPRESS_OPTIONS) --gravity off'
leaveout_no-backward := PRONE='--gravity 0,0,0'
leaveout_sharp-edge := COMPRESS_OPTIONS='$(COMPRESS_OPTIONS) --edge-radius 7.5'
leaveout_tumour-element := HEXMESH_OPTIONS="$(HEXMESH_OPTIONS) --tumour $$(pipelines/landmark.sh $(RUN)/mesh.json tumour):0.1" \
  MECHANICS='$(MECHANICS) --scale tumour=1000'
leaveout_cut-fixed := CUT=fixed
leaveout_quadratic := MECHANICS='$(MECHANICS) --element q2p1'

leaveout: $(LEAVEOUT)/table.tsv
.PHONY: leaveout

# The base set with the fibroglandular law replaced by fat's.
$(LEAVEOUT)/fat-only.tsv: $(MATERIAL_TABLE)
	@mkdir -p $(@D)
	awk -F'\t' -v OFS='\t' '$$1 == "fat" { fat = $$0 } $$1 == "fibroglandular" { $$0 = fat; $$1 = "fibroglandular" } { print }' $< > $@.part
	@mv $@.part $@

# A variant's chain is this makefile once more, with the base's labels and geometry as they are.
define leaveout_rules
$(LEAVEOUT)/$1/curve.tsv: $(RUN)/curve.tsv $(RUN)/geometry.vtkhdf $(if $(filter no-gland,$1),$(LEAVEOUT)/fat-only.tsv)
	@mkdir -p $$(@D)
	cp -p $(RUN)/labels.vtkhdf $(RUN)/points.vtp $(RUN)/labels.json $(RUN)/geometry.vtkhdf $(RUN)/geometry.json \
	  $(RUN)/.labels.settings $(RUN)/.geometry.settings $$(@D)
	+$$(MAKE) -f Makefile.pipeline RUN=$(LEAVEOUT)/$1 MR=$(MR) $$(leaveout_$1) chain
	@touch $$@
endef
$(foreach v,$(LEAVEOUT_VARIANTS),$(eval $(call leaveout_rules,$v)))

$(LEAVEOUT)/table.tsv: $(LEAVEOUT_VARIANTS:%=$(LEAVEOUT)/%/curve.tsv) $(RUN)/supine.vtkhdf $(PROBE) \
  pipelines/leaveout.sh pipelines/values.sh
	pipelines/leaveout.sh $(RUN) $(PROBE) $(LEAVEOUT_VARIANTS) > $@.part
	@mv $@.part $@
	@cat $@
