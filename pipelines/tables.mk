# SPDX-License-Identifier: GPL-3.0-or-later
# The paper's Tables II to VI: prone-to-supine displacements of tumour and nipple if the stiffness of one tissue
# is scaled. Each row is a backward and a forward solve (studies/scaled.tsv); each table shows the paper's values and ours. The
# paper's data set is private: with the phantom the rows are comparable, with a scan only the trends are. Every table is made
# twice: with the case's own mesh and mechanics (tableN.tsv), and as printed in the paper (tableN-as-printed.tsv).
# Tables VII and VIII are not in the paper: slopes from one solve, and the conclusions under other material sets.
TABLES := $(RUN)/tables
PAPER_TABLES := 3 4 5 6
tissue_3 := fat
tissue_4 := fibroglandular
tissue_5 := skin
tissue_6 := tumour
# The rows of a table that are solved: all except the case itself. Table VI has a mesh of its own, on which 100 per cent is solved.
rows_of = $(call results,$1,$(filter $2-%,$(filter-out tumour-mesh,$(scaled_variants))),supine)
BOTH := own $(if $(PAPER),,printed)
ending_printed := -as-printed
base_own := $(RUN)/supine.vtkhdf
base_printed := $(call study_dir,findings/as-printed)/supine.json

$(foreach n,2 7 8,$(eval table$n: $(TABLES)/table$n.tsv))
findings: $(TABLES)/findings.tsv
	@cat $<
TABLE_FILES := $(if $(no_tumour),,$(foreach m,$(BOTH),$(foreach n,$(PAPER_TABLES),$(TABLES)/table$n$(ending_$m).tsv)) \
  $(addprefix $(TABLES)/,table2.tsv conclusions.tsv table7.tsv $(if $(PAPER),,table8.tsv findings.tsv)))
tables: $(TABLE_FILES)
	@for table in $(TABLES)/conclusions.tsv $(if $(PAPER),,$(TABLES)/table8.tsv $(TABLES)/findings.tsv); do echo; cat $$table; done
.PHONY: table2 table3 table4 table5 table6 table7 table8 tables findings
$(TABLE_FILES): | $(TABLES)/.
$(TABLES)/.:
	@mkdir -p $@

# $(call table_rules,MODEL,NUMBER,TISSUE): the relative displacements in Table VI refer to its own mesh.
define table_rules
table$2: $(TABLES)/table$2$(ending_$1).tsv
$(TABLES)/table$2$(ending_$1).tsv: $(PIPELINES)/paper/table$2.tsv $(call rows_of,scaled$(ending_$1),$3) $(base_$1) $(TABULATE)
	$$(call table,$$(tabulate) scaled $$< $$(call study_dir,scaled$(ending_$1))/$3 $(if $(filter tumour,$3),$$(call \
	  study_dir,scaled$(ending_$1)/tumour-100)/supine.vtkhdf,$$(basename $$(base_$1)).vtkhdf))
endef
$(foreach m,$(BOTH),$(foreach n,$(PAPER_TABLES),$(eval $(call table_rules,$m,$n,$(tissue_$n)))))

table2_settings := $(MATERIAL_TABLE)
$(TABLES)/table2.tsv: $(PIPELINES)/paper/table2.tsv $(MATERIAL_TABLE) $(TABULATE) $(call changed,table2)
	$(call table,$(tabulate) constants $< $(MATERIAL_TABLE))
	@$(call record,table2)

# The conclusions, from three models: the values of the paper, the model as printed, and the case as solved.
$(TABLES)/conclusions.tsv: $(PIPELINES)/paper/conclusions.tsv $(foreach m,$(BOTH),$(PAPER_TABLES:%=$(TABLES)/table%$(ending_$m).tsv)) $(TABULATE)
	$(call table,$(tabulate) conclusions $< $(TABLES) $(if $(PAPER),,as-printed))

# Table VII (not in the paper): all slopes from one solve of `sensitivity` on the base state, compared with the rows solved again.
$(TABLES)/table7.tsv: $(RUN)/slopes.tsv $(call results,scaled,tumour-100,slopes) $(foreach n,$(PAPER_TABLES),$(call rows_of,scaled,$(tissue_$n))) \
  $(TABULATE)
	$(call table,$(tabulate) slopes $(RUN)/supine.json $(call study_dir,scaled) $< $(call study_dir,scaled/tumour-100)/slopes.tsv)
	@cat $@

# The numerical part of the paper's values, from comparison with the finest solution (about FINDINGS_FINEST^3 27-node elements).
$(TABLES)/findings.tsv: $(RUN)/slopes.tsv $(call results,findings,$(findings_variants),slopes) $(TABULATE)
	$(call table,$(tabulate) findings $(RUN) $(findings_variants))

# Table VIII (not in the paper): the paper's conclusions on the mesh of the case with the sets of studies/table8.tsv; the slopes of
# each set come from one solve.
SETS := $(filter-out %-100 %-1000 %-2000,$(table8_variants))
$(RUN)/columns.tsv: $(PIPELINES)/materials/seed2008.tsv
	@mkdir -p $(@D)
	$(call table,$(tabulate) set columns $<)
$(TABLES)/table8.tsv: $(PIPELINES)/paper/conclusions.tsv $(PAPER_TABLES:%=$(TABLES)/table%.tsv) $(RUN)/slopes.tsv \
  $(call results,table8,$(SETS),slopes) $(call results,table8,$(filter-out $(SETS),$(table8_variants)),supine) $(TABULATE)
	$(call table,$(tabulate) survival $< $(RUN) $(SETS))
