# SPDX-License-Identifier: GPL-3.0-or-later
# What each optional part of the model is worth: the chain without it, the change at the landmarks and on the
# MLO curve in mm, and the CPU time saved; then, for each question, the least model that stays within LEAVEOUT_MM, solved
# and measured. Each variant is a case of its own below RUN/leaveout that starts from the base's labels and geometry.
LEAVEOUT := $(RUN)/leaveout
LEAVEOUT_MM ?= 1
LEAVEOUT_PARTS := no-skin no-gland no-backward no-gravity-in-compression
LEAVEOUT_VARIANTS := $(LEAVEOUT_PARTS) sharp-edge tumour-element cut-fixed quadratic

leaveout_sharp-edge := COMPRESS_OPTIONS='$(COMPRESS_OPTIONS) --edge-radius 7.5'
leaveout_tumour-element := HEXMESH_OPTIONS="$(HEXMESH_OPTIONS) --tumour $$($(tabulate) place $(RUN)/mesh.json tumour):0.1" \
  MECHANICS='$(MECHANICS) --scale tumour=1000'
leaveout_cut-fixed := CUT=fixed
leaveout_quadratic := MECHANICS='$(MECHANICS) --element q2p1'

leaveout: $(LEAVEOUT)/table.tsv $(LEAVEOUT)/recommendation.tsv
	@cat $^
.PHONY: leaveout

# A variant's chain is this makefile once more, with the base's labels and geometry as they are.
leaveout_chain = mkdir -p $(@D) && cp -p $(RUN)/labels.vtkhdf $(RUN)/points.vtp $(RUN)/labels.json $(RUN)/geometry.vtkhdf \
  $(RUN)/geometry.json $(RUN)/.labels.settings $(RUN)/.geometry.settings $(@D)
leaveout_make = $(MAKE) -f $(PIPELINE) RUN=$(@D) MR=$(MR) $(addprefix TUMOUR=,$(TUMOUR))
define leaveout_rules
$(LEAVEOUT)/$1/curve.tsv: $(RUN)/curve.tsv $(RUN)/geometry.vtkhdf
	$$(leaveout_chain)
	+$$(leaveout_make) $$(or $$(leaveout_$1),LEAVE_OUT=$1) chain
	@touch $$@
endef
$(foreach v,$(LEAVEOUT_VARIANTS),$(eval $(call leaveout_rules,$v)))

$(LEAVEOUT)/table.tsv: $(LEAVEOUT_VARIANTS:%=$(LEAVEOUT)/%/curve.tsv) $(RUN)/supine.vtkhdf $(TABULATE)
	$(tabulate) leaveout $(RUN) $(LEAVEOUT_VARIANTS) > $@.part
	@mv $@.part $@

# The parts a question can do without, solved without them.
LEAVEOUT_QUESTIONS := surgery matching
define least_rules
leaveout-least-$1_record = $(LEAVEOUT)/.least-$1.settings
leaveout-least-$1_settings = $(LEAVEOUT_MM)
$(LEAVEOUT)/least-$1/curve.tsv: $(LEAVEOUT)/table.tsv $(TABULATE) $$(call changed,leaveout-least-$1)
	$$(leaveout_chain)
	+$$(leaveout_make) LEAVE_OUT="$$$$($(tabulate) least $(LEAVEOUT)/table.tsv $1 $(LEAVEOUT_MM) $(LEAVEOUT_PARTS))" chain
	@$$(call record,leaveout-least-$1)
	@touch $$@
endef
$(foreach q,$(LEAVEOUT_QUESTIONS),$(eval $(call least_rules,$q)))
$(LEAVEOUT)/recommendation.tsv: $(LEAVEOUT_QUESTIONS:%=$(LEAVEOUT)/least-%/curve.tsv) $(TABULATE)
	$(tabulate) recommendation $(RUN) $(LEAVEOUT_MM) $(LEAVEOUT_PARTS) > $@.part
	@mv $@.part $@
