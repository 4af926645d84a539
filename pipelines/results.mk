# SPDX-License-Identifier: GPL-3.0-or-later
# What is made of the chain of Makefile.pipeline: displacements, errors against the phantom's truth, the summary; the page of both views,
# the run for 3D Slicer, expected values, and one self-contained report.
CHAIN_FILES := $(addprefix $(RUN)/,labels.vtkhdf geometry.vtkhdf mesh.vtkhdf reference.vtkhdf \
  supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti) $(CURVE) $(addprefix $(RUN)/,$(if $(and $(PAPER),$(CURVE)),,lookup.h5 page.html))

# Material sets: of the model without gland, in which the law of fat replaces that of fibroglandular tissue, and of a row of Table VIII.
$(RUN)/fat-only.tsv: $(whole_set)
$(RUN)/columns.tsv: $(PIPELINES)/materials/seed2008.tsv
$(RUN)/fat-only.tsv $(RUN)/columns.tsv:
	$(call table,$(tabulate) set $(basename $(@F)) $<)

# The same with the lateral cut held, which shows the effect of this boundary condition at the landmarks;
# its discretisation error is not estimated again.
cut-fixed_settings := $(BACKWARD) $(FORWARD) $(MECHANICS) $(content_MATERIALS)
$(RUN)/reference-cut-fixed.vtkhdf: $(RUN)/mesh.vtkhdf $(BACKWARD) $(MADE_MATERIALS) $(call changed,cut-fixed)
	$(call stage,cut-fixed) $(BACKWARD) $< $@ --posture prone $(MECHANICS) --cut fixed --estimate none $(common)
supine-cut-fixed_settings = $(cut-fixed_settings)
$(RUN)/supine-cut-fixed.vtkhdf: $(RUN)/reference-cut-fixed.vtkhdf $(FORWARD)
	$(call stage,supine-cut-fixed) $(FORWARD) $< $@ --posture supine $(MECHANICS) --cut fixed --estimate none $(common)

# Tables come from stdout; a rename makes them complete or absent: $(call table,COMMAND).
table = mkdir -p $(@D) && $1 > $@.part && mv $@.part $@
SHOWN := $(addprefix $(RUN)/,mesh.vtkhdf reference.vtkhdf supine.vtkhdf)
displacements_settings := $(BIN)/probe $(landmarks)
$(RUN)/displacements.tsv: $(SHOWN) $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf) $(BIN)/probe $(call changed,displacements)
	$(call prints,displacements,$@) $(BIN)/probe $(filter %.vtkhdf,$^) --landmarks $(landmarks)
cut_settings := $(displacements_settings)
$(RUN)/cut.tsv: $(RUN)/supine-cut-fixed.vtkhdf $(RUN)/supine.vtkhdf $(BIN)/probe $(call changed,cut)
	$(call prints,cut,$@) $(BIN)/probe $< --base $(word 2,$^) --landmarks $(landmarks)

# Errors against the phantom's truth (stress-free, prone, supine); a real scan has none.
ifdef TRUTH
truth_settings := $(BIN)/probe $(TRUTH)
$(RUN)/truth.tsv: $(TRUTH) $(SHOWN) $(BIN)/probe $(call changed,truth)
truth-cut-fixed_settings := $(truth_settings)
$(RUN)/truth-cut-fixed.tsv: $(TRUTH) $(RUN)/mesh.vtkhdf $(RUN)/reference-cut-fixed.vtkhdf $(RUN)/supine-cut-fixed.vtkhdf $(BIN)/probe \
  $(call changed,truth-cut-fixed)
$(RUN)/truth.tsv $(RUN)/truth-cut-fixed.tsv:
	$(call prints,$(basename $(@F)),$@) $(BIN)/probe $(filter %.vtkhdf,$^) --truth $(TRUTH)
endif

# (A breast that slides is held by springs at its cut: there a held cut would be another model.)
$(RUN)/summary.txt: $(CHAIN_FILES) $(RUN)/displacements.tsv $(if $(slides),,$(RUN)/cut.tsv) \
  $(if $(TRUTH),$(RUN)/truth.tsv $(if $(body_slides),,$(RUN)/truth-cut-fixed.tsv)) $(FIGURES) \
  $(BIN)/tabulate $(PIPELINES)/advice.tsv
	@$(call table,$(tabulate) summary $(RUN) $(if $(TRUTH),$(PHANTOM_MR:.nrrd=.json)))

# ---- pointing at either view draws curve, band and arc in the other -----------------------------------------
page_options := $(or $(SERIES),0) $(filter no,$(PAGE_SCAN))
# The derivatives of the compressed shapes, for the bands of curves: of those of the chain, and between the plates of the truth.
$(foreach v,cc mlo truth-cc truth-mlo,$(RUN)/$v-sensitivity.vtkhdf): $(RUN)/%-sensitivity.vtkhdf: $(RUN)/%.vtkhdf $(RUN)/reference.vtkhdf $(BIN)/sensitivity
	$(call staged,$(RUN)/.$*-sensitivity.settings,$(BIN)/sensitivity $(reference_options),$(if $(filter cc mlo,$*),--of $< --spared $@)) \
	  $(BIN)/sensitivity $(RUN)/reference.vtkhdf $< $@ $(reference_options) --table $(basename $@).tsv $(common)
# Where one of the compressions has no derivatives (augmented Lagrangian, an unstable equilibrium), the page shows curves without bands.
both_views := $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf)
derivatives := $(both_views:%.vtkhdf=%-sensitivity.vtkhdf)
page_states = $$(if ls $(derivatives) > /dev/null 2>&1; then echo $(derivatives); else echo $(both_views); fi)
of_both_views = $(call named_stage,$1,--of '$(both_views)')
lookup_settings := $(BIN)/match-lookup
$(RUN)/lookup.h5: $(both_views) $(derivatives) $(BIN)/match-lookup $(call changed,lookup)
	$(call of_both_views,lookup) $(BIN)/match-lookup $(page_states) $@ --both-ways --pitch 1 $(common)
# The patient's own mammograms as they are hung, and where the simulated views lie in them. cc2mlo asks for some point.
ifneq ($(MAMMOGRAMS),)
mammograms := $(subst $(comma), ,$(MAMMOGRAMS))
of_patient := $(addprefix $(RUN)/patient,.json -cc.png -mlo.png)
patient_settings := $(CC2MLO) $(call named,$(firstword $(mammograms))) $(call named,$(lastword $(mammograms))) $(call content,$(mammograms))
$(of_patient) &: $(both_views) $(mammograms) $(CC2MLO) $(call changed,patient)
	$(call of_both_views,patient) $(CC2MLO) $(both_views) $(RUN)/patient.vtp --grid 1 --table $(RUN)/patient.tsv --cc-image $(firstword $(mammograms)) \
	  --mlo-image $(lastword $(mammograms)) --cc-hung $(RUN)/patient-cc.png --mlo-hung $(RUN)/patient-mlo.png --report $(RUN)/patient.json $(share)
endif
# The page is also made of what there is when the plates do not hold the breast: it says so. Animated pictures that `states` has made are
# shown; as prerequisites their equilibria would be solved again, so that the page records them and their dates instead. It repeats the
# warnings of every stage, hence comes after all.
# (Asked of a shell: make remembers which files there were when it began.)
dated = $(shell stat -c '%n %Y' $1 2> /dev/null)
page_settings = $(BIN)/tabulate $(call named,$(MR)) $(page_options) $(of_patient) $(call dated,$(call pictures,supine-states cc-states mlo-states))
$(RUN)/page.html: $(RUN)/lookup.h5 $(addprefix $(RUN)/,cc.vti mlo.vti labels.vtkhdf mesh.vtkhdf supine.vtkhdf) $(CURVE) $(of_patient) $(MR_FILES) $(BIN)/tabulate \
  $(if $(no_tumour),,$(BIN)/cc2mlo) $(call changed,page)
	@$(if $(of_patient),,rm -f $(addprefix $(RUN)/patient,.json .vtp .tsv -cc.png -mlo.png))
	$(call prints,page,$@) $(tabulate) page $(RUN) $(MR) $(page_options)
page: $(RUN)/page.html
	$(gripped)

# ---- 3D Slicer: images, labels, shapes, displacement fields, points and scene.mrml, which opens them ---------
slicer_settings := $(BIN)/export-slicer $(MR) $(SLICER_OPTIONS)
$(RUN)/slicer/scene.mrml: $(addprefix $(RUN)/,labels.vtkhdf mesh.vtkhdf reference.vtkhdf supine.vtkhdf cc.vtkhdf mlo.vtkhdf) $(CURVE) \
  $(BIN)/export-slicer $(call changed,slicer)
	$(call prints,slicer,$(RUN)/slicer-fields.tsv) $(BIN)/export-slicer $(RUN) $(RUN)/slicer --scan $(MR) $(addprefix --series ,$(SERIES)) \
	  $(SLICER_OPTIONS) --report $(RUN)/slicer.json $(share)
	@cat $(RUN)/slicer-fields.tsv
slicer: $(RUN)/slicer/scene.mrml

# ---- expected values, and the report ------------------------------------------------------------------------
verify: $(RUN)/verify.tsv
$(RUN)/verify.tsv: $(EXPECTED) $(BIN)/tabulate $(RUN)/summary.txt $(TABLE_FILES)
	$(if $(EXPECTED),,$(error verify: there are no expected values of the case $(CASE); name a file of them with EXPECTED=FILE.tsv))
	@$(call table,$(tabulate) verify $(EXPECTED) $(RUN))
	@cat $@

report: $(RUN)/report.html $(if $(CHROMIUM),$(RUN)/report.pdf)
	$(gripped)
	@$(if $(CHROMIUM),,echo "report: no PDF: chromium is not installed (apt-get install chromium); any browser prints the page" >&2)
all: $(FIGURES) tables $(if $(EXPECTED),verify) report
.PHONY: page slicer verify report all
# Results of the slow targets are embedded with their dates. As prerequisites they would be solved again whenever a program is
# newer; therefore the page records these files and their dates instead.
report_settings = $(BIN)/tabulate $(call dated,$(addprefix $(RUN)/,leaveout/*.tsv cost/*.tsv cost/*.png budget/*.tsv budget/*.png) \
  $(addprefix $(RUNS)/,stability/*.tsv compare/all.tsv compare/pressed.tsv population/judging.tsv population/motion.png))
report_record = $(RUN)/report.settings
# The motion of the breast compared with living women, if the breast slides on its chest wall.
$(RUN)/population.tsv: $(RUN)/supine.vtkhdf $(PIPELINES)/invivo/women.tsv $(BIN)/population
	$(BIN)/population $< --women $(word 2,$^) --table $(RUN)/motion.tsv --summary $@ --report $(RUN)/population.json --quiet
$(F)/motion.png: $(RUN)/population.tsv $(RENDER)
	$(call plot,motion)
$(RUN)/report.html: $(RUN)/summary.txt $(TABLE_FILES) $(if $(slides),$(RUN)/population.tsv $(F)/motion.png) $(F)/cc-points.png $(F)/mlo-curves.png \
  $(if $(EXPECTED),$(RUN)/verify.tsv) $(BIN)/tabulate $(addprefix $(PIPELINES)/,limits.txt advice.tsv) $(call changed,report)
	$(call prints,report,$@) $(tabulate) report $(RUN) $(RUNS)
	@echo "$@"
$(RUN)/report.pdf: $(RUN)/report.html
	$(tabulate) pdf '$(CHROMIUM)' $< $@
	@echo "$@"
