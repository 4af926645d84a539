# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures in the manner of the paper's Figs 4-7, drawn off-screen.
FIGURE_NAMES := slices points geometry mesh tissues outlines cc-compression mlo-compression pressure force-thickness cc-mammogram mlo-mammogram \
  $(if $(no_tumour),,cc-matching mlo-matching) summary
FIGURES := $(FIGURE_NAMES:%=$(RUN)/figures/%.png)
F := $(RUN)/figures
render = mkdir -p $(@D) && $(RENDER) $(filter-out %/labels.vtkhdf,$(filter %.vtkhdf %.vtp %.vti,$^)) --figure $1 $2 -o $@
on_scan = --scan $(MR) --labels $(RUN)/labels.vtkhdf $(if $(SERIES),--series $(SERIES))

$(F)/slices.png: $(RUN)/labels.vtkhdf $(RUN)/mesh.vtkhdf $(RENDER)
	@$(call render,slices,$(on_scan))

$(F)/points.png: $(RUN)/points.vtp $(RENDER)
	@$(call render,points)
$(F)/geometry.png: $(RUN)/geometry.vtkhdf $(RENDER)
	@$(call render,geometry)
$(F)/mesh.png: $(RUN)/mesh.vtkhdf $(RENDER)
	@$(call render,mesh)
$(F)/tissues.png: $(RUN)/mesh.vtkhdf $(RENDER)
	@$(call render,tissues)
$(F)/outlines.png: $(RUN)/reference.vtkhdf $(RUN)/supine.vtkhdf $(RENDER)
	@$(call render,outlines)
$(F)/%-compression.png: $(RUN)/%.vtkhdf $(RENDER)
	@$(call render,compression)
$(F)/pressure.png: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(RENDER)
	@$(call render,pressure)
$(F)/force-thickness.png: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(RENDER)
	@$(call render,force-thickness)
$(F)/cc-mammogram.png: $(RUN)/cc.vti $(CURVE) $(RENDER)
	@$(call render,mammogram)
$(F)/mlo-mammogram.png: $(RUN)/mlo.vti $(CURVE) $(RENDER)
	@$(call render,mammogram)
$(F)/%-matching.png: $(RUN)/%.vtkhdf $(RUN)/curve.vtp $(RENDER)
	@$(call render,matching)
$(F)/summary.png: $(RUN)/mesh.vtkhdf $(RUN)/reference.vtkhdf $(RUN)/supine.vtkhdf $(RUN)/cc.vtkhdf \
  $(RUN)/mlo.vtkhdf $(RUN)/cc.vti $(RUN)/mlo.vti $(CURVE) $(RUN)/labels.vtkhdf $(RENDER)
	@$(call render,summary,$(on_scan))
