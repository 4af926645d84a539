# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures in the manner of the paper's Figs 4-7 (figures.tsv), drawn off-screen; fig4 ... fig7 are the panels of one of them.
F := $(RUN)/figures
FIGURES :=
on_scan = --scan $(MR) --labels $(RUN)/labels.vtkhdf $(addprefix --series ,$(SERIES))
$(foreach n,4 5 6 7,$(eval fig$n :=))
define picture
file := $(F)/$(cell_picture).png
FIGURES += $(if $(filter all $(if $(no_tumour),,tumour),$(cell_of)),$(file))
$(foreach p,$(cell_panels),$(eval $p += $(file)))
$(file): figure := $(cell_figure) $(if $(cell_scan),$(on_scan))
$(file): $(patsubst $(RUN)/CURVE,$(CURVE),$(addprefix $(RUN)/,$(cell_files))) \
  $(if $(cell_scan),$(RUN)/labels.vtkhdf) $(RENDER)
	@mkdir -p $(@D) && $(RENDER) $(filter-out %/labels.vtkhdf,$(filter %.vtkhdf %.vtp %.vti,$^)) --figure $(figure) -o $@
endef
$(call ask,$(CASES) rows $(PIPELINES)/figures.tsv picture)
FIGURES += $(if $(SUPINE),$(F)/postures.png)
$(foreach n,4 5 6 7,$(eval fig$n: $(fig$n)))
.PHONY: fig4 fig5 fig6 fig7

# Figs 6c and 6d show several points: a grid of them in the CC view.
curves_settings := $(CC2MLO) $(POINTS)
$(RUN)/curves.vtp $(RUN)/curves.tsv &: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(CC2MLO) $(call changed,curves)
	$(CC2MLO) $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(RUN)/curves.vtp --grid $(POINTS) --table $(RUN)/curves.tsv --report $(RUN)/curves.json $(share)
	@$(call record,curves)
