# The paper's Tables II to VI: prone-to-supine displacements of tumour and nipple when one tissue's stiffness
# is scaled. Each row is a backward and a forward solve; each table puts the paper's row beside ours. The paper's
# data set is private: with the phantom the rows are comparable, with a scan only the trends are.
TABLES := $(RUN)/tables
SCALED_TISSUES := fat fibroglandular skin tumour
SCALES := 10 50 90 110 200 1000
SCALES_tumour := 150 200 500 1000 2000
scales_of = $(or $(SCALES_$1),$(SCALES))

table2: $(TABLES)/table2.tsv
table3: $(TABLES)/table3.tsv
table4: $(TABLES)/table4.tsv
table5: $(TABLES)/table5.tsv
table6: $(TABLES)/table6.tsv
tables: $(TABLES)/table2.tsv $(TABLES)/table3.tsv $(TABLES)/table4.tsv $(TABLES)/table5.tsv $(TABLES)/table6.tsv \
  $(TABLES)/conclusions.tsv
.PHONY: table2 table3 table4 table5 table6 tables

# Table VI has one whole element of tumour, round the tumour point of the base mesh.
tumour-mesh_settings = $(HEXMESH) $(HEXMESH_OPTIONS) element
$(RUN)/scaled/tumour-mesh.vtkhdf: $(RUN)/geometry.vtkhdf $(RUN)/labels.vtkhdf $(RUN)/mesh.vtkhdf $(HEXMESH) \
  $(call changed,tumour-mesh)
	@mkdir -p $(@D)
	$(HEXMESH) $< $(RUN)/labels.vtkhdf $@ $(HEXMESH_OPTIONS) \
	  --tumour $$(pipelines/landmark.sh $(RUN)/mesh.json tumour):0.1 $(common)
	@$(call record,tumour-mesh)

# $(call scaled_rules,TISSUE,PERCENT,MESH): stress-free and supine shape with one tissue's stiffness scaled. A
# material that has no stress-free body leaves an empty mark NAME.failed and a row of dashes, not a stop.
define scaled_rules
scaled-$1-$2_settings = $(BACKWARD) $(FORWARD) $(MECHANICS) --cut $(CUT)
$(RUN)/scaled/$1-$2.done: $3 $(BACKWARD) $(FORWARD) $(MATERIAL_FILE) \
  pipelines/posture-change.sh pipelines/values.sh $$(call changed,scaled-$1-$2)
	@mkdir -p $$(@D)
	pipelines/posture-change.sh $3 $(RUN)/scaled/$1-$2 "$(BACKWARD)" "$(FORWARD)" $(MECHANICS) --scale $1=$2 \
	  --cut $(CUT) $$(share)
	@$$(call record,scaled-$1-$2)
	@touch $$@
endef
$(foreach t,fat fibroglandular skin,$(foreach s,$(SCALES),$(eval $(call scaled_rules,$t,$s,$(RUN)/mesh.vtkhdf))))
$(foreach s,100 $(SCALES_tumour),$(eval $(call scaled_rules,tumour,$s,$(RUN)/scaled/tumour-mesh.vtkhdf)))

rows_of = $(patsubst %,$(RUN)/scaled/$1-%.done,$(call scales_of,$1))
MATERIAL_TABLE := $(or $(MATERIAL_FILE),pipelines/materials/$(MATERIALS).tsv)
table2_settings := pipelines/table2.sh $(MATERIAL_TABLE)
$(TABLES)/table2.tsv: pipelines/paper/table2.tsv $(MATERIAL_TABLE) pipelines/table2.sh $(call changed,table2)
	@mkdir -p $(@D)
	pipelines/table2.sh $< $(MATERIAL_TABLE) > $@.part
	@mv $@.part $@
	@$(call record,table2)
define table_rules
$(TABLES)/table$1.tsv: pipelines/paper/table$1.tsv $(call rows_of,$2) $(RUN)/supine.vtkhdf pipelines/scaled-table.sh $(PROBE)
	@mkdir -p $$(@D)
	pipelines/scaled-table.sh $$< $(RUN)/scaled/$2 $3 $(PROBE) > $$@.part
	@mv $$@.part $$@
endef
$(eval $(call table_rules,3,fat,$(RUN)/supine.vtkhdf))
$(eval $(call table_rules,4,fibroglandular,$(RUN)/supine.vtkhdf))
$(eval $(call table_rules,5,skin,$(RUN)/supine.vtkhdf))
$(TABLES)/table6.tsv: $(RUN)/scaled/tumour-100.done
$(eval $(call table_rules,6,tumour,$(RUN)/scaled/tumour-100-supine.vtkhdf))

$(TABLES)/conclusions.tsv: $(TABLES)/table3.tsv $(TABLES)/table4.tsv $(TABLES)/table5.tsv $(TABLES)/table6.tsv \
  pipelines/conclusions.sh pipelines/values.sh
	pipelines/conclusions.sh $(TABLES) > $@.part
	@mv $@.part $@
