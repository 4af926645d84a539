# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's Tables II to VI: prone-to-supine displacements of tumour and nipple when one tissue's stiffness
# is scaled. Each row is a backward and a forward solve; each table puts the paper's row beside ours. The paper's
# data set is private: with the phantom the rows are comparable, with a scan only the trends are. Every table is made
# twice: with the case's own mesh and mechanics (tableN.tsv), and as printed in the paper (tableN-as-printed.tsv).
# Table VII and VIII are ours: slopes in one solve, and the conclusions under other material sets.
TABLES := $(RUN)/tables
SCALES := 10 50 90 110 200 1000
SCALES_tumour := 150 200 500 1000 2000
scales_of = $(or $(SCALES_$1),$(SCALES))
PAPER_TABLES := 3 4 5 6
tissue_3 := fat
tissue_4 := fibroglandular
tissue_5 := skin
tissue_6 := tumour
BOTH := own $(if $(PAPER),,printed)
ending_printed := -as-printed

table2: $(TABLES)/table2.tsv
table7: $(TABLES)/table7.tsv
table8: $(TABLES)/table8.tsv
define table_target
table$1: $(foreach m,$(BOTH),$(TABLES)/table$1$(ending_$m).tsv)
endef
$(foreach n,$(PAPER_TABLES),$(eval $(call table_target,$n)))
TABLE_FILES := $(if $(no_tumour),,$(foreach m,$(BOTH),$(foreach n,$(PAPER_TABLES),$(TABLES)/table$n$(ending_$m).tsv)) \
  $(addprefix $(TABLES)/,table2.tsv conclusions.tsv table7.tsv $(if $(PAPER),,table8.tsv findings.tsv)))
tables: $(TABLE_FILES)
	@for table in $(TABLES)/conclusions.tsv $(if $(PAPER),,$(TABLES)/table8.tsv $(TABLES)/findings.tsv); do echo; cat $$table; done
.PHONY: table2 table3 table4 table5 table6 table7 table8 tables

# The two models: folder of its scaled solves, mesh, hexmesh options, mechanics, supine shape.
own_folder := $(RUN)/scaled
own_mesh := $(RUN)/mesh.vtkhdf
own_hexmesh = $(HEXMESH_OPTIONS)
own_mechanics = $(MECHANICS)
own_supine := $(RUN)/supine.vtkhdf
printed_folder := $(VARIANTS)/scaled-as-printed
printed_mesh := $(VARIANTS)/as-printed-mesh.vtkhdf
printed_hexmesh = $(PRINTED_HEXMESH)
printed_mechanics = $(PRINTED_MECHANICS)
printed_supine := $(VARIANTS)/as-printed-supine.vtkhdf
# What a model's tables wait for; a variant's shapes are those of its mark.
own_solved := $(own_supine)
printed_solved := $(VARIANTS)/as-printed.done

# Table VI has one whole element of tumour, round the tumour point of the base mesh.
define tumour_mesh_rules
tumour-mesh-$1_settings = $(HEXMESH) $($1_hexmesh) element
$($1_folder)/tumour-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $($1_mesh) $(HEXMESH) \
  $$(call changed,tumour-mesh-$1)
	@mkdir -p $$(@D)
	$(HEXMESH) $$< $(RUN)/labels.vtkhdf $$@ $($1_hexmesh) \
	  --tumour $$$$($(tabulate) place $($1_mesh:.vtkhdf=.json) tumour):0.1 $$(common)
	@$$(call record,tumour-mesh-$1)
endef

# $(call scaled_rules,FOLDER,TISSUE,PERCENT,MESH,MECHANICS[,NEEDS]): stress-free and supine shape with one tissue's
# stiffness scaled. A material that has no stress-free body leaves a mark NAME.failed and a row of dashes, not a stop.
define scaled_rules
scaled-$1-$2-$3_record = $1/.$2-$3.settings
scaled-$1-$2-$3_settings = $(BACKWARD) $(FORWARD) $5 $(SUPPORT)
$1/$2-$3.done: $4 $6 $(BACKWARD) $(FORWARD) $(MATERIAL_FILE) $(PIPELINES)/posture-change.sh $$(call changed,scaled-$1-$2-$3)
	@mkdir -p $$(@D)
	$(PIPELINES)/posture-change.sh $4 $1/$2-$3 "$(BACKWARD)" "$(FORWARD)" $5 --scale $2=$3 $(SUPPORT) $$(share)
	@$$(call record,scaled-$1-$2-$3)
	@touch $$@
endef
rows_of = $(patsubst %,$1/$2-%.done,$(call scales_of,$2))
define model_rules
$(call tumour_mesh_rules,$1)
$(foreach t,fat fibroglandular skin,$(foreach s,$(SCALES),$(call \
  scaled_rules,$($1_folder),$t,$s,$($1_mesh),$($1_mechanics))$(newline)))
$(foreach s,100 $(SCALES_tumour),$(call \
  scaled_rules,$($1_folder),tumour,$s,$($1_folder)/tumour-mesh.vtkhdf,$($1_mechanics))$(newline))
$(foreach n,$(PAPER_TABLES),$(call table_rules,$1,$n,$(tissue_$n))$(newline))
endef
# $(call table_rules,MODEL,NUMBER,TISSUE): relative displacements of Table VI refer to its own mesh.
define table_rules
$(TABLES)/table$2$(ending_$1).tsv: $(PIPELINES)/paper/table$2.tsv $(call rows_of,$($1_folder),$3) $($1_solved) \
  $(if $(filter tumour,$3),$($1_folder)/tumour-100.done) $(TABULATE)
	@mkdir -p $$(@D)
	$(tabulate) scaled $$< $($1_folder)/$3 $(if $(filter tumour,$3),$($1_folder)/tumour-100-supine.vtkhdf,$($1_supine)) > $$@.part
	@mv $$@.part $$@
endef
define newline


endef
$(foreach m,$(BOTH),$(eval $(call model_rules,$m)))

MATERIAL_TABLE := $(or $(MATERIAL_FILE),$(PIPELINES)/materials/$(MATERIALS).tsv)
table2_settings := $(MATERIAL_TABLE)
$(TABLES)/table2.tsv: $(PIPELINES)/paper/table2.tsv $(MATERIAL_TABLE) $(TABULATE) $(call changed,table2)
	@mkdir -p $(@D)
	$(tabulate) constants $< $(MATERIAL_TABLE) > $@.part
	@mv $@.part $@
	@$(call record,table2)

# The conclusions in numbers: from the paper's own rows, as printed, and as the case is solved.
conclusion_values = $(addprefix $(TABLES)/.conclusions-,$(addsuffix .values,paper $(BOTH)))
$(TABLES)/.conclusions-paper.values: prefix := paper_
$(TABLES)/.conclusions-paper.values $(TABLES)/.conclusions-own.values: $(PAPER_TABLES:%=$(TABLES)/table%.tsv) $(TABULATE)
	@$(tabulate) conclusions $(filter %.tsv,$^) $(prefix) > $@.part
	@mv $@.part $@
$(TABLES)/.conclusions-printed.values: $(PAPER_TABLES:%=$(TABLES)/table%-as-printed.tsv) $(TABULATE)
	@$(tabulate) conclusions $(filter %.tsv,$^) > $@.part
	@mv $@.part $@
$(TABLES)/conclusions.tsv: $(PIPELINES)/paper/conclusions.tsv $(conclusion_values) $(TABULATE)
	$(tabulate) judge $< paper=$(TABLES)/.conclusions-paper.values \
	  $(if $(PAPER),,as_printed=$(TABLES)/.conclusions-printed.values) ours=$(TABLES)/.conclusions-own.values > $@.part
	@mv $@.part $@

# Table VII, ours: all slopes from one solve of `sensitivity` on the base state, against the rows solved again.
$(eval $(call slopes_rules,$(RUN)/base,$(own_supine),$(RUN)/reference.vtkhdf,$(own_supine),$(MECHANICS),fat$(comma)fibroglandular$(comma)skin))
$(eval $(call slopes_rules,$(own_folder)/tumour-100,$(own_folder)/tumour-100.done,$(own_folder)/tumour-100-reference.vtkhdf,$(own_folder)/tumour-100-supine.vtkhdf,$(MECHANICS),tumour))
$(TABLES)/table7.tsv: $(RUN)/base-slopes.tsv $(own_folder)/tumour-100-slopes.tsv \
  $(foreach n,$(PAPER_TABLES),$(call rows_of,$(own_folder),$(tissue_$n))) $(TABULATE)
	@mkdir -p $(@D)
	$(tabulate) slopes $(own_supine:.vtkhdf=.json) $(own_folder) $(wordlist 1,2,$^) > $@.part
	@mv $@.part $@
	@cat $@
