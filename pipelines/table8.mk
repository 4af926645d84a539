# SPDX-License-Identifier: GPL-3.0-or-later
# Table VIII, ours: the paper's conclusions on the case's mesh under other material sets, slopes from one solve each.
#   columns        seed2008 with Table II's second-order constants as Samani and Plewes are sometimes quoted: its three
#                  columns stand for a11, a20, a02 instead of a20, a02, a11
#   mira2018       soft, in vivo: gravity matters ten times more
#   mira2018-x10   the same ten times as stiff, about the least at which the phantom's imaged shape has a stress-free body
ifndef PAPER
TABLE8 := columns mira2018 mira2018-x10
columns_set := $(VARIANTS)/columns.tsv
mira2018_set := mira2018
mira2018-x10_set := mira2018 $(foreach t,fat fibroglandular skin tumour,--scale $t=1000)
set_mechanics = $(subst --materials $(MATERIALS),--materials $($1_set),$(MECHANICS))
# A second --scale of tumour takes the place of the set's: ten times as stiff of ten times as stiff.
set_mechanics_tumour = $(if $(filter mira2018-x10,$1),$(subst --scale tumour=1000,--scale tumour=$20,$(call set_mechanics,$1)),$(call set_mechanics,$1) --scale tumour=$2)

$(columns_set): $(PIPELINES)/materials/seed2008.tsv
	@mkdir -p $(@D)
	awk -F'\t' -v OFS='\t' '/^#/ { print; next } $$1 == "tissue" { for (i = 1; i <= NF; i++) at[$$i] = i; print; next } \
	  { first = $$at["a20_Pa"]; second = $$at["a02_Pa"]; third = $$at["a11_Pa"]; \
	    $$at["a11_Pa"] = first; $$at["a20_Pa"] = second; $$at["a02_Pa"] = third; print }' $< > $@.part
	@mv $@.part $@

# $(call table8_rules,SET): base, slopes, and the rows of a tumour 1, 10 and 20 times as stiff; none where the base fails.
define table8_rules
$(call variant_rules,$1,$(own_mesh),$(call set_mechanics,$1),$(filter %.tsv,$($1_set)))
$(foreach s,100 1000 2000,$(call table8_tumour_rules,$1,$s)$(newline))
$(VARIANTS)/$1-tumour.tsv: $(PIPELINES)/paper/table6.tsv $(foreach s,100 1000 2000,$(VARIANTS)/$1-tumour-$s.done) \
  $(TABULATE)
	awk -F'\t' 'NR == 1 || $$$$1 ~ /^(100|1000|2000)$$$$/' $$< > $$@.rows
	$(tabulate) scaled $$@.rows $(VARIANTS)/$1-tumour $(VARIANTS)/$1-tumour-100-supine.vtkhdf > $$@.part
	@rm -f $$@.rows
	@mv $$@.part $$@
$(VARIANTS)/.$1.values: $(VARIANTS)/$1-slopes.tsv $(VARIANTS)/$1-tumour.tsv $(TABULATE)
	@$(tabulate) conclusions-of-slopes $(VARIANTS)/$1-slopes.tsv $(VARIANTS)/$1-tumour.tsv > $$@.part
	@mv $$@.part $$@
endef
define table8_tumour_rules
variant-$1-tumour-$2_settings = $(BACKWARD) $(FORWARD) $(call set_mechanics_tumour,$1,$2) $(SUPPORT)
$(VARIANTS)/$1-tumour-$2.done: $(own_folder)/tumour-mesh.vtkhdf $(VARIANTS)/$1.done $$(call changed,variant-$1-tumour-$2)
	if [ -f $(VARIANTS)/$1.failed ]; then cp $(VARIANTS)/$1.failed $(VARIANTS)/$1-tumour-$2.failed; \
	else $(PIPELINES)/posture-change.sh $$< $(VARIANTS)/$1-tumour-$2 "$(BACKWARD)" "$(FORWARD)" \
	  $(call set_mechanics_tumour,$1,$2) $(SUPPORT) $$(share); fi
	@$$(call record,variant-$1-tumour-$2)
	@touch $$@
endef
$(foreach set,$(TABLE8),$(eval $(call table8_rules,$(set))))
$(VARIANTS)/.ours.values: $(RUN)/base-slopes.tsv $(TABLES)/table6.tsv $(TABULATE)
	@$(tabulate) conclusions-of-slopes $(wordlist 1,2,$^) > $@.part
	@mv $@.part $@

$(TABLES)/table8.tsv: $(PIPELINES)/paper/conclusions.tsv $(TABLES)/.conclusions-paper.values $(VARIANTS)/.ours.values \
  $(TABLE8:%=$(VARIANTS)/.%.values) $(TABULATE)
	$(tabulate) survival $< $(RUN) $(TABLE8) > $@.part
	@mv $@.part $@
endif
