# SPDX-License-Identifier: GPL-3.0-or-later
# The program identify is tested against truths that it does not know (tests/bench/identification_study.cpp), on coarse meshes of
# two phantoms; bodies with other laws are on a finer mesh:
#   make identification           docs/tables/identification.tsv and identification-cost.tsv, about 25 minutes on one processor
IDENTIFICATION_RUNS := $(RUNS)/identification
define identification_case
$(IDENTIFICATION_RUNS)/$1-$2/mesh.vtkhdf: FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(IDENTIFICATION_RUNS) CASE=$1-$2 SIDE=right PRESET=$1 ELEMENTS=$2 MATERIALS=invivo TUMOUR=none $$@
endef
ifneq ($(filter identification,$(MAKECMDGOALS)),)
.NOTPARALLEL:
$(eval $(call identification_case,average,8))
$(eval $(call identification_case,slim,8))
$(foreach n,10 12 16 20,$(eval $(call identification_case,average,$n)))
endif
# STUDY-PHANTOM-FIRST-COUNT: COUNT draws of a study, from number FIRST, on the mesh of a phantom.
identification_parts := same-average-1-20 same-slim-21-20 misaligned-average-1-5 other-average-1-5 surface-average-1-2
identification_part = $(word $1,$(subst -, ,$2))
# The finer mesh, for studies whose truth is on another mesh than the identification.
identification_finer = $(if $(filter other surface,$(call identification_part,1,$1)),$(IDENTIFICATION_RUNS)/$(call identification_part,2,$1)-10/mesh.vtkhdf)
define identification_rows
$(IDENTIFICATION_RUNS)/$1.tsv: $(IDENTIFICATION_RUNS)/$(call identification_part,2,$1)-8/mesh.vtkhdf $(call identification_finer,$1) \
  tests/bench/identification_study.cpp
	@mkdir -p $(RUN)
	$$(call bench,identification_study)
	OMP_NUM_THREADS=1 $(BIN)/identification_study $(call identification_part,1,$1) $$< $(call identification_part,3,$1) \
	  $(call identification_part,4,$1) $(call identification_finer,$1) > $$@.part
	@mv $$@.part $$@
endef
$(foreach p,$(identification_parts),$(eval $(call identification_rows,$p)))
# Error beside cost: one draw of each of the other laws, identified on coarser and finer meshes; the truths are on the finest.
identification_costs := 8 10 12 16
$(identification_costs:%=$(IDENTIFICATION_RUNS)/cost-%.tsv): $(IDENTIFICATION_RUNS)/cost-%.tsv: $(IDENTIFICATION_RUNS)/average-%/mesh.vtkhdf \
  $(IDENTIFICATION_RUNS)/average-20/mesh.vtkhdf tests/bench/identification_study.cpp
	@mkdir -p $(RUN)
	$(call bench,identification_study)
	OMP_NUM_THREADS=1 $(BIN)/identification_study other $< 1 1 $(word 2,$^) > $@.part
	@mv $@.part $@
# $(call identification_table,NAME,PARTS): docs/tables/NAME.tsv.
define identification_table
docs/tables/$1.tsv: $(2:%=$(IDENTIFICATION_RUNS)/%.tsv) $(BIN)/tabulate
	$$(call table,$$(tabulate) identification $$(filter %.tsv,$$^))
	@$$(tabulate) made $$@ $$<
endef
$(eval $(call identification_table,identification,$(identification_parts)))
$(eval $(call identification_table,identification-cost,$(identification_costs:%=cost-%)))
identification: docs/tables/identification.tsv docs/tables/identification-cost.tsv
	@$(tabulate) pages fill $(PAGES_WITH_TABLES)
	@cat $^
.PHONY: identification
