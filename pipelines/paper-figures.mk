# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's Figs 4 to 7, by panel. Figs 6c and 6d show several points: a grid of them in the CC view.
fig4: $(addprefix $(F)/,points.png geometry.png mesh.png tissues.png)
fig5: $(addprefix $(F)/,mesh.png cc-compression.png mlo-compression.png)
fig6: $(addprefix $(F)/,cc-mammogram.png mlo-mammogram.png cc-points.png mlo-curves.png)
fig7: $(addprefix $(F)/,cc-matching.png mlo-matching.png)
.PHONY: fig4 fig5 fig6 fig7

POINTS ?= 4
curves_settings := $(CC2MLO) $(POINTS)
$(RUN)/curves.vtp $(RUN)/curves.tsv &: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(CC2MLO) $(call changed,curves)
	$(CC2MLO) $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(RUN)/curves.vtp --grid $(POINTS) \
	  --table $(RUN)/curves.tsv --report $(RUN)/curves.json $(share)
	@$(call record,curves)
$(F)/cc-points.png: $(RUN)/cc.vti $(RUN)/curves.vtp $(RENDER)
	@$(call render,mammogram)
$(F)/mlo-curves.png: $(RUN)/mlo.vti $(RUN)/curves.vtp $(RENDER)
	@$(call render,mammogram)
