# SPDX-License-Identifier: GPL-3.0-or-later
# The page of a case: pointing at either view draws curve, band and arc in the other. page-check opens it in a headless
# browser (Debian package chromium, not installed by setup).
# A page is easily sent on: voxels of a patient's scan are in it only with PAGE_SCAN=yes; a phantom's may be seen by all.
PAGE_SCAN ?= $(if $(TRUTH),yes,no)
page_scan := $(if $(filter yes,$(PAGE_SCAN)),--scan $(MR) $(if $(SERIES),--series $(SERIES)))
# With friction or a wall on springs there are no derivatives yet: the page then shows curves without bands.
derivatives := $(if $(findstring --friction,$(COMPRESS_OPTIONS))$(findstring spring:,$(COMPRESS_OPTIONS)),,-sensitivity)
page_states := $(RUN)/cc$(derivatives).vtkhdf $(RUN)/mlo$(derivatives).vtkhdf
lookup_settings := $(MATCH_LOOKUP) $(page_states) $(page_scan)
$(RUN)/lookup.h5 $(RUN)/page.html &: $(page_states) $(RUN)/cc.vti $(RUN)/mlo.vti $(if $(page_scan),$(MR_FILES)) $(MATCH_LOOKUP) $(call changed,lookup)
	$(MATCH_LOOKUP) $(page_states) $(RUN)/lookup.h5 --page $(RUN)/page.html --pitch 1 \
	  --from-image $(RUN)/cc.vti --to-image $(RUN)/mlo.vti $(page_scan) --report $(RUN)/lookup.json $(share)
	@$(call record,lookup)

.PHONY: page page-check
page: $(RUN)/page.html
page-check: $(RUN)/page.html $(CC2MLO)
	tests/page/check.sh $(BIN) $(RUN) $(RUN)
