# SPDX-License-Identifier: GPL-3.0-or-later
# The program identify is tested against truths that it does not know (tests/bench/identification_study.cpp), on coarse meshes of
# two phantoms; bodies with other laws are on a finer mesh:
#   make identification           docs/tables/identification.tsv and identification-cost.tsv, about 25 minutes on one processor
IDENTIFICATION_RUNS := $(RUNS)/identification
# $(call identification_part,NUMBER,NAME): a part of a name between dashes.
identification_part = $(word $1,$(subst -, ,$2))
# The mesh of a phantom, PHANTOM-ELEMENTS, whose chain make is started for.
identification_meshes := average-8 slim-8 average-10 average-12 average-16 average-20
ifneq ($(filter identification,$(MAKECMDGOALS)),)
.NOTPARALLEL:
$(identification_meshes:%=$(IDENTIFICATION_RUNS)/%/mesh.vtkhdf): $(IDENTIFICATION_RUNS)/%/mesh.vtkhdf: FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(IDENTIFICATION_RUNS) CASE=$* SIDE=right PRESET=$(call identification_part,1,$*) \
	  ELEMENTS=$(call identification_part,2,$*) MATERIALS=invivo TUMOUR=none $@
endif
# STUDY-PHANTOM-FIRST-COUNT: COUNT draws of a study, from number FIRST, on the mesh of a phantom.
identification_parts := same-average-1-20 same-slim-21-20 misaligned-average-1-5 other-average-1-5 surface-average-1-2
# $(call identification_mesh,PART,ELEMENTS); the finer mesh, for studies whose truth is on another mesh than the identification.
identification_mesh = $(IDENTIFICATION_RUNS)/$(call identification_part,2,$1)-$2/mesh.vtkhdf
identification_finer = $(if $(filter other surface,$(call identification_part,1,$1)),$(call identification_mesh,$1,10))
$(identification_parts:%=$(IDENTIFICATION_RUNS)/%.tsv): $(IDENTIFICATION_RUNS)/%.tsv: $$(call identification_mesh,$$*,8) \
  $$(call identification_finer,$$*) tests/bench/identification_study.cpp
	@mkdir -p $(RUN)
	$(call bench,identification_study)
	$(call table,OMP_NUM_THREADS=1 $(BIN)/identification_study $(call identification_part,1,$*) $< $(call identification_part,3,$*) \
	  $(call identification_part,4,$*) $(call identification_finer,$*))
# Error beside cost: one draw of each of the other laws, identified on coarser and finer meshes; the truths are on the finest.
identification_costs := 8 10 12 16
$(identification_costs:%=$(IDENTIFICATION_RUNS)/cost-%.tsv): $(IDENTIFICATION_RUNS)/cost-%.tsv: $(IDENTIFICATION_RUNS)/average-%/mesh.vtkhdf \
  $(IDENTIFICATION_RUNS)/average-20/mesh.vtkhdf tests/bench/identification_study.cpp
	@mkdir -p $(RUN)
	$(call bench,identification_study)
	$(call table,OMP_NUM_THREADS=1 $(BIN)/identification_study other $< 1 1 $(word 2,$^))
docs/tables/identification.tsv: $(identification_parts:%=$(IDENTIFICATION_RUNS)/%.tsv) $(BIN)/tabulate
docs/tables/identification-cost.tsv: $(identification_costs:%=$(IDENTIFICATION_RUNS)/cost-%.tsv) $(BIN)/tabulate
docs/tables/identification.tsv docs/tables/identification-cost.tsv:
	$(call table,$(tabulate) identification $(filter %.tsv,$^))
	@$(tabulate) made $@ $<
identification: docs/tables/identification.tsv docs/tables/identification-cost.tsv
	@$(tabulate) pages fill $(PAGES_WITH_TABLES)
	@cat $^
.PHONY: identification
