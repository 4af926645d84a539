# SPDX-License-Identifier: GPL-3.0-or-later
# ACCURACY=MM selects the cheapest mesh and element whose estimated error at the landmarks, stress-free and supine, is below
# MM. ELEMENTS and ELEMENT come from a makefile of two lines, which make brings up to date before anything else. The meshes
# tried are rows of pipelines/studies/cost.tsv, in the order of their measured cost (docs/validation/mechanics.md).
ifneq ($(strip $(ACCURACY)),)
accuracy_settings = $(ACCURACY) $(ACCURACY_LADDER) $(MATERIALS) $(content_MATERIALS) $(SUPPORT)
ifneq ($(planning),)
# A plan solves nothing: it shows the mesh chosen last, or the default if none has been chosen.
-include $(wildcard $(RUN)/accuracy.mk)
else
$(RUN)/accuracy.mk: $(RUN)/labels.vtkhdf $(RUN)/geometry.vtkhdf \
  $(HEXMESH) $(BACKWARD) $(FORWARD) $(call changed,accuracy)
	@rm -f $(RUN)/.accuracy.settings
	+$(BIN)/cases ladder $(RUN) $(ACCURACY) '$(strip $(ACCURACY_LADDER))' --quiet -- $(MAKE) -f $(PIPELINE) ACCURACY=
	@echo '$(strip $(accuracy_settings))' > $(RUN)/.accuracy.settings
include $(RUN)/accuracy.mk
endif
endif
