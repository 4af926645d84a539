# ACCURACY=MM: the cheapest mesh and element whose error at the landmarks, stress-free and supine, is said to be below
# MM. ELEMENTS and ELEMENT come from a makefile of two lines, which make brings up to date before anything else; each
# rung of the ladder, cheapest first, is a point of pipelines/cost.mk.
ACCURACY_LADDER ?= $(foreach n,4 6 8 10 12 14 16 20 24 32,q1p0-dome-$n)
ifneq ($(strip $(ACCURACY)),)
accuracy_settings = $(ACCURACY) $(ACCURACY_LADDER) $(MATERIALS) $(CUT)
accuracy_record = $(RUN)/.accuracy.settings
ifneq ($(planning),)
# A plan solves nothing: it shows the mesh chosen last, or the default where none was chosen yet.
-include $(wildcard $(RUN)/accuracy.mk)
else
$(RUN)/accuracy.mk: $(RUN)/labels.vtkhdf $(RUN)/geometry.vtkhdf pipelines/accuracy.sh pipelines/values.sh \
  $(HEXMESH) $(BACKWARD) $(FORWARD) $(call changed,accuracy)
	+pipelines/accuracy.sh $(RUN) $(ACCURACY) "$(ACCURACY_LADDER)" $(MAKE) -f Makefile.pipeline ACCURACY=
	@$(call record,accuracy)
include $(RUN)/accuracy.mk
endif
endif
