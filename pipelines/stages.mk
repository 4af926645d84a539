# SPDX-License-Identifier: GPL-3.0-or-later
# What else is made of the chain of Makefile.pipeline: the table of displacements, the errors against the phantom's truth, the summary.
CHAIN_FILES := $(addprefix $(RUN)/,labels.vtkhdf geometry.vtkhdf mesh.vtkhdf reference.vtkhdf \
  supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti $(if $(no_tumour),,curve.vtp) $(if $(PAPER),$(if $(no_tumour),lookup.h5 page.html),lookup.h5 page.html))

# The model without gland uses the set in which the law of fat replaces that of fibroglandular tissue.
$(RUN)/fat-only.tsv: $(whole_set)
	@mkdir -p $(@D)
	$(call table,$(tabulate) set fat-only $<)

# The same with the lateral cut held, which shows the effect of this boundary condition at the landmarks;
# its discretisation error is not estimated again.
cut-fixed_settings := $(BACKWARD) $(FORWARD) $(MECHANICS) $(content_MATERIALS)
$(RUN)/reference-cut-fixed.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD) $(MADE_MATERIALS) $(call changed,cut-fixed)
	$(call stage,cut-fixed) $(BACKWARD) $< $@ --posture prone $(MECHANICS) --cut fixed --estimate none $(common)
supine-cut-fixed_settings = $(cut-fixed_settings)
$(RUN)/supine-cut-fixed.vtkhdf: $(RUN)/reference-cut-fixed.vtkhdf $(FORWARD)
	$(call stage,supine-cut-fixed) $(FORWARD) $< $@ --posture supine $(MECHANICS) --cut fixed --estimate none $(common)

# Tables come from stdout; a rename makes them complete or absent: $(call table,COMMAND).
table = $1 > $@.part && mv $@.part $@
SHOWN := $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf)
displacements_settings := $(PROBE) $(landmarks)
$(RUN)/displacements.tsv: $(SHOWN) $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf) $(PROBE) $(call changed,displacements)
	$(call prints,displacements,$@) $(PROBE) $(filter %.vtkhdf,$^) --landmarks $(landmarks)
cut_settings := $(displacements_settings)
$(RUN)/cut.tsv: $(RUN)/supine-cut-fixed.vtkhdf $(RUN)/supine.vtkhdf $(PROBE) $(call changed,cut)
	$(call prints,cut,$@) $(PROBE) $< --base $(word 2,$^) --landmarks $(landmarks)

# Errors against the phantom's truth (stress-free, prone, supine); a real scan has none.
ifdef TRUTH
truth_settings := $(PROBE) $(TRUTH)
$(RUN)/truth.tsv: $(TRUTH) $(SHOWN) $(PROBE) $(call changed,truth)
truth-cut-fixed_settings := $(truth_settings)
$(RUN)/truth-cut-fixed.tsv: $(TRUTH) $(RUN)/mesh.vtkhdf $(RUN)/reference-cut-fixed.vtkhdf $(RUN)/supine-cut-fixed.vtkhdf $(PROBE) \
  $(call changed,truth-cut-fixed)
$(RUN)/truth.tsv $(RUN)/truth-cut-fixed.tsv:
	$(call prints,$(basename $(@F)),$@) $(PROBE) $(filter %.vtkhdf,$^) --truth $(TRUTH)
endif

# (A breast that slides is held by springs at its cut: there a held cut would be another model.)
$(RUN)/summary.txt: $(CHAIN_FILES) $(RUN)/displacements.tsv $(if $(slides),,$(RUN)/cut.tsv) \
  $(if $(TRUTH),$(RUN)/truth.tsv $(if $(body_slides),,$(RUN)/truth-cut-fixed.tsv)) $(FIGURES) \
  $(TABULATE) $(PIPELINES)/advice.tsv
	@$(call table,$(tabulate) summary $(RUN) $(if $(TRUTH),$(PHANTOM_MR:.nrrd=.json)))
