# SPDX-License-Identifier: GPL-3.0-or-later
# The run for 3D Slicer, in RUN/slicer: images, labels, shapes, displacement fields, points and scene.mrml, which opens them.
EXPORT_SLICER ?= $(BIN)/export-slicer
SLICER_OPTIONS ?=
slicer_settings := $(EXPORT_SLICER) $(MR) $(SLICER_OPTIONS)
$(RUN)/slicer/scene.mrml: $(addprefix $(RUN)/,labels.vtkhdf mesh.vtkhdf reference.vtkhdf supine.vtkhdf cc.vtkhdf mlo.vtkhdf) $(CURVE) \
  $(EXPORT_SLICER) $(call changed,slicer)
	$(EXPORT_SLICER) $(RUN) $(RUN)/slicer --scan $(MR) $(if $(SERIES),--series $(SERIES)) $(SLICER_OPTIONS) \
	  --report $(RUN)/slicer.json $(share) > $(RUN)/slicer-fields.tsv.part
	@mv $(RUN)/slicer-fields.tsv.part $(RUN)/slicer-fields.tsv
	@cat $(RUN)/slicer-fields.tsv
	@$(call record,slicer)

.PHONY: slicer slicer-table
slicer: $(RUN)/slicer/scene.mrml
# The table of docs/validation/slicer.md, from the default case.
slicer-table: slicer
	cp $(RUN)/slicer-fields.tsv $(TABLES_OF_PAGE)/slicer-fields.tsv
	$(tabulate) pages fill $(PAGES_WITH_TABLES)
