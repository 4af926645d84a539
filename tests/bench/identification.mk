# SPDX-License-Identifier: GPL-3.0-or-later
# The program identify is tested against truths that it does not know (tests/bench/identification_study.cpp), on coarse meshes of
# two phantoms; bodies with other laws are on a finer mesh:
#   make identification                            docs/tables/identification.tsv, about 10 minutes on one processor
IDENTIFICATION_RUNS := $(RUNS)/identification
define identification_case
$(IDENTIFICATION_RUNS)/$1-$2/mesh.vtkhdf: FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(IDENTIFICATION_RUNS) CASE=$1-$2 SIDE=right PRESET=$1 ELEMENTS=$2 MATERIALS=invivo TUMOUR=none $$@
endef
ifneq ($(filter identification,$(MAKECMDGOALS)),)
.NOTPARALLEL:
$(eval $(call identification_case,average,8))
$(eval $(call identification_case,slim,8))
$(eval $(call identification_case,average,10))
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
identification: $(identification_parts:%=$(IDENTIFICATION_RUNS)/%.tsv) $(TABULATE)
	$(tabulate) identification $(identification_parts:%=$(IDENTIFICATION_RUNS)/%.tsv) > docs/tables/identification.tsv.part
	@mv docs/tables/identification.tsv.part docs/tables/identification.tsv
	@$(tabulate) made docs/tables/identification.tsv $<
	@$(tabulate) pages fill $(PAGES_WITH_TABLES)
	@cat docs/tables/identification.tsv
.PHONY: identification
