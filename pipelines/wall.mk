# SPDX-License-Identifier: GPL-3.0-or-later
# What the chest wall's own uncertainty does to the result: the whole chain with the wall moved everywhere by
# one standard deviation, backwards and forwards, same tumour, and how far the predictions move. A coherent
# shift is the worst the band allows: real errors change sign from place to place.
WALL_SHIFTS := $(RUN)/wall
WALL_VARIANTS := back front
wall_back := 1
wall_front := -1

wall-sensitivity: $(WALL_SHIFTS)/table.tsv
.PHONY: wall-sensitivity

define wall_rules
$(WALL_SHIFTS)/$1/curve.tsv: $(RUN)/curve.tsv $(SEGMENT)
	@mkdir -p $$(@D)
	+$$(MAKE) -f $(PIPELINE) RUN=$(WALL_SHIFTS)/$1 MR=$(MR) \
	  SEGMENT_OPTIONS='$(SEGMENT_OPTIONS) --chest-wall-shift $(wall_$1)' \
	  HEXMESH_OPTIONS="$(HEXMESH_OPTIONS) --tumour $$$$($(tabulate) place $(RUN)/mesh.json tumour)" chain
	@touch $$@
endef
$(foreach v,$(WALL_VARIANTS),$(eval $(call wall_rules,$v)))

$(WALL_SHIFTS)/table.tsv: $(WALL_VARIANTS:%=$(WALL_SHIFTS)/%/curve.tsv) $(RUN)/supine.vtkhdf $(TABULATE)
	$(tabulate) wall $(RUN) $(WALL_VARIANTS) > $@.part
	@mv $@.part $@
	@cat $@

# Derivatives by stiffness, plates and chest wall in one file a view, and the band they give the tumour's curve.
DIFFERENCE ?= $(BIN)/difference
$(RUN)/cc-band.vtkhdf $(RUN)/mlo-band.vtkhdf: $(RUN)/%-band.vtkhdf: $(RUN)/%-sensitivity.vtkhdf \
  $(WALL_VARIANTS:%=$(WALL_SHIFTS)/%/curve.tsv) $(DIFFERENCE)
	$(DIFFERENCE) $< $(WALL_SHIFTS)/back/$*.vtkhdf $(WALL_SHIFTS)/front/$*.vtkhdf $@ --parameter chest_wall $(common)
$(RUN)/band.tsv: $(RUN)/cc-band.vtkhdf $(RUN)/mlo-band.vtkhdf $(CC2MLO)
	$(CC2MLO) $(wordlist 1,2,$^) $(RUN)/band.vtp --landmark tumour --band --table $@ --curve-table $(RUN)/band-curve.tsv \
	  $(common)
band: $(RUN)/band.tsv
	@sed -n '/"band"/,/}/p' $(RUN)/band.json
.PHONY: band
