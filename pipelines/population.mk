# Breasts beside women's: each case of POPULATION (PRESET-SIDE) and both sides of every scan in POPULATION_SCANS from the scan to
# supine with the model POPULATION_MATERIALS, and a table of how tissue moves beside pipelines/invivo/women.tsv.
POPULATION ?= $(foreach p,paper flat small large pendulous,$p-left $p-right)
POPULATION_SCANS ?=
POPULATION_RUNS := $(RUNS)/population
POPULATION_TOOL ?= $(BIN)/population
population_side = $(lastword $(subst -, ,$1))
population_scan = $(basename $(basename $(notdir $1)))
POPULATION_CASES := $(POPULATION) $(foreach s,$(POPULATION_SCANS),$(foreach d,left right,$(call population_scan,$s)-$d))
population_make = $(MAKE) -f Makefile.pipeline RUNS=$(POPULATION_RUNS)

$(foreach c,$(POPULATION),$(eval $(POPULATION_RUNS)/$c/supine.vtkhdf: FORCE ; \
  @+$$(population_make) CASE=$c PRESET=$(firstword $(subst -, ,$c)) SIDE=$(call population_side,$c) $$@))
$(foreach s,$(POPULATION_SCANS),$(foreach d,left right,$(eval $(POPULATION_RUNS)/$(call population_scan,$s)-$d/supine.vtkhdf: FORCE ; \
  @+$$(population_make) CASE=$(call population_scan,$s)-$d MR=$s SIDE=$d $$@)))

population_files := $(POPULATION_CASES:%=$(POPULATION_RUNS)/%/supine.vtkhdf)
$(POPULATION_RUNS)/motion.tsv $(POPULATION_RUNS)/population.tsv &: $(population_files) $(POPULATION_TOOL) pipelines/invivo/women.tsv
	$(POPULATION_TOOL) $(population_files) --women pipelines/invivo/women.tsv --table $(POPULATION_RUNS)/motion.tsv \
	  --summary $(POPULATION_RUNS)/population.tsv --report $(POPULATION_RUNS)/population.json
population: $(POPULATION_RUNS)/population.tsv
	@cat $<
.PHONY: population
