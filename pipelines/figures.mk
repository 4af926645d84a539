# SPDX-License-Identifier: GPL-3.0-or-later
# Pictures in the manner of the paper's Figs 4-7, drawn off-screen. One call of render draws all of a run: which of its files a picture
# shows stands in python/breast/figures/of_run.py. fig4 ... fig7 are the panels of one of the paper's figures, of what they need alone.
F := $(RUN)/figures
pictures = $(addprefix $(F)/,$(addsuffix .png,$1))
of_points := points geometry mesh tissues
of_both := $(foreach view,cc mlo,$(view)-compression)
of_curve := cc-matching mlo-matching
of_run := slices $(of_points) outlines $(of_both) pressure force-thickness cc-mammogram mlo-mammogram $(if $(CURVE),$(of_curve)) summary
FIGURES := $(call pictures,$(of_run)) $(if $(SUPINE),$(F)/postures.png)
on_scan = --scan $(MR) --labels $(RUN)/labels.vtkhdf $(addprefix --series ,$(SERIES))
# $(call draw,PICTURES,FILES,OPTIONS); no picture is named: all that the files allow, without those that could not be made
draw = mkdir -p $(F) && $(RENDER) $(if $1,$2,$$(ls -d $2 2> /dev/null)) --all $(F) $(if $1,--only $(subst $(space),$(comma),$(strip $1))) $3
figure_files := $(addprefix $(RUN)/,geometry.vtkhdf points.vtp mesh.vtkhdf reference.vtkhdf supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti) $(CURVE)
$(call pictures,$(of_run)) &: $(figure_files) $(RUN)/labels.vtkhdf $(RENDER)
	@$(call draw,,$(figure_files),$(on_scan))
	@rm -f $(call pictures,$(if $(CURVE),,$(of_curve)))

# How the breast moves: STATES equilibria while gravity turns from prone to supine, and while the plates close, each an animated
# picture. The last equilibrium of each is that of the chain, which stays as it is.
of_states := $(addprefix $(RUN)/states/,supine.vtkhdf cc.vtkhdf mlo.vtkhdf)
supine-states_settings = $(supine_settings) --states $(STATES)
cc-states_settings = $(cc_settings) --states $(STATES)
mlo-states_settings = $(mlo_settings) --states $(STATES)
$(RUN)/states/supine.vtkhdf: $(RUN)/reference.vtkhdf $(FORWARD) $(MADE_MATERIALS) $(call changed,supine-states)
	@mkdir -p $(@D)
	$(call stage,supine-states) $(FORWARD) $< $@ --posture supine $(model) --states $(STATES) $(common)
$(RUN)/states/cc.vtkhdf $(RUN)/states/mlo.vtkhdf: $(RUN)/states/%.vtkhdf: $(RUN)/reference.vtkhdf $(RUN)/%.vtkhdf $(COMPRESS) $(MADE_MATERIALS) \
  $$(call changed,$$*-states)
	@mkdir -p $(@D)
	$(call of_pressed,$*-states) $(COMPRESS) $< $@ --view $(view_$*) $($*_options) --states $(STATES) $(common)
$(F)/%-states.png: $(RUN)/states/%.vtkhdf $(CURVE) $(RENDER)
	@mkdir -p $(@D)
	@[ ! -e $< ] || $(RENDER) $(basename $<)-states/state_*.vtkhdf $(if $(CURVE),$$(ls $(CURVE) 2> /dev/null)) --figure states -o $@
.SECONDARY: $(of_states)
# The page shows them, but is not made again for them whenever a program is newer (results.mk).
states: $(call pictures,supine-states cc-states mlo-states) $(RUN)/page.html
	$(gripped)
ifneq ($(filter states,$(goals)),)
$(RUN)/page.html: $(call pictures,supine-states cc-states mlo-states)
endif
.PHONY: states

fig4: $(addprefix $(RUN)/,points.vtp geometry.vtkhdf mesh.vtkhdf labels.vtkhdf)
	@$(call draw,slices $(of_points),$(filter-out %/labels.vtkhdf,$^),$(on_scan))
fig5: $(addprefix $(RUN)/,mesh.vtkhdf cc.vtkhdf mlo.vtkhdf)
	@$(call draw,mesh $(of_both),$^)
fig6: $(addprefix $(RUN)/,cc.vti mlo.vti) $(CURVE) $(call pictures,cc-points mlo-curves)
	@$(call draw,cc-mammogram mlo-mammogram,$(filter %.vti %.vtp,$^))
fig7: $(addprefix $(RUN)/,cc.vtkhdf mlo.vtkhdf) $(CURVE)
	$(if $(CURVE),,$(error fig7 shows the column of a tumour and the case has none; name its place with TUMOUR=x$(comma)y$(comma)z (mm)))
	@$(call draw,$(of_curve),$^)
.PHONY: fig4 fig5 fig6 fig7

# Figs 6c and 6d show several points: a grid of them in the CC view.
curves_settings := $(CC2MLO) $(POINTS)
$(RUN)/curves.vtp $(RUN)/curves.tsv &: $(RUN)/cc.vtkhdf $(RUN)/mlo.vtkhdf $(CC2MLO) $(call changed,curves)
	$(call of_pressed,curves) $(CC2MLO) $(wordlist 1,2,$^) $(RUN)/curves.vtp --grid $(POINTS) --table $(RUN)/curves.tsv $(call common_of,curves)
$(call pictures,cc-points mlo-curves) &: $(addprefix $(RUN)/,cc.vti mlo.vti curves.vtp) $(RENDER)
	@[ ! -e $(RUN)/curves.vtp ] || { $(call draw,cc-points mlo-curves,$(filter-out $(RENDER),$^)); }

# $(call plot,FIGURE): the picture of a table, its first prerequisite.
plot = @mkdir -p $(@D) && $(RENDER) $< --figure $1 -o $@
