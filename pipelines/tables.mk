# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's Tables II to VI: prone-to-supine displacements of tumour and nipple if the stiffness of one tissue
# is scaled. Each row is a backward and a forward solve (studies/scaled.tsv); each table shows the paper's values and ours. The
# paper's data set is private: with the phantom the rows are comparable, with a scan only the trends are. Every table is made
# twice: with the case's own mesh and mechanics (tableN.tsv), and as printed in the paper (tableN-as-printed.tsv).
# Not in the paper: Table VII, slopes from one solve compared with the rows solved again (`sensitivity` on the base state); Table VIII,
# the paper's conclusions under the material sets of studies/table8.tsv; and findings, the numerical part of the paper's values, from
# comparison with the finest solution (about FINDINGS_FINEST^3 27-node elements).
TABLES := $(RUN)/tables
PRINTED := $(if $(PAPER),,-as-printed)
TABLE_NAMES := table2 $(foreach n,3 4 5 6,table$n $(addprefix table$n,$(PRINTED))) conclusions table7 $(if $(PAPER),,table8 findings)
TABLE_FILES := $(if $(no_tumour),,$(TABLE_NAMES:%=$(TABLES)/%.tsv))

# The rows of a table that are solved: all except the case itself. Table VI has a mesh of its own, on which 100 per cent is solved.
rows_of = $(foreach ending,own $(PRINTED),$(call results,scaled$(ending:own=),$(filter $1-%,$(filter-out tumour-mesh,$(scaled_variants))),supine))
case_of := $(RUN)/supine.vtkhdf $(if $(PRINTED),$(call study_dir,findings/as-printed)/supine.json)
# The sets of Table VIII; their slopes come from one solve each.
SETS := $(filter-out %-100 %-1000 %-2000,$(table8_variants))
# What each table is made from.
of_table2 := $(MATERIAL_TABLE)
of_table3 := $(call rows_of,fat) $(case_of)
of_table4 := $(call rows_of,fibroglandular) $(case_of)
of_table5 := $(call rows_of,skin) $(case_of)
of_table6 := $(call rows_of,tumour)
of_conclusions := $(foreach n,3 4 5 6,$(of_table$n)) $(CURVE) $(RUN)/cc.vti $(RUN)/mlo.vti
of_table7 := $(RUN)/slopes.tsv $(call results,scaled,tumour-100,slopes) $(foreach n,3 4 5 6,$(of_table$n))
of_table8 := $(of_conclusions) $(RUN)/slopes.tsv $(call results,table8,$(SETS),slopes) \
  $(call results,table8,$(filter-out $(SETS),$(table8_variants)),supine)
of_findings := $(RUN)/slopes.tsv $(call results,findings,$(findings_variants),slopes)

# One call makes all tables.
tables: $(TABLE_FILES)
	$(if $(planning),,@$(if $(TABLE_FILES),$(tabulate) show $(RUN),:))
tables_settings := $(MATERIAL_TABLE) $(content_MATERIALS)
$(TABLE_FILES) &: $(sort $(foreach t,$(TABLE_NAMES),$(of_$t))) $(wildcard $(PIPELINES)/paper/*.tsv) $(BIN)/tabulate $(call changed,tables)
	$(call stage,tables) $(tabulate) tables $(RUN) $(MATERIAL_TABLE) $(TABLE_NAMES)
# One table alone, after the solves that it needs: table8 is judged from Tables III to VI.
first_table8 := table3 table4 table5 table6
single := table2 table3 table4 table5 table6 table7 table8 findings
$(single): $$(of_$$@) $(BIN)/tabulate
	$(tabulate) tables $(RUN) $(MATERIAL_TABLE) $(filter $(foreach t,$(first_$@) $@,$t $t-as-printed),$(TABLE_NAMES))
	@cat $(TABLES)/$@.tsv
.PHONY: tables $(single)
