# The page of a case: pointing at CC draws curve and band in MLO. page-check opens it in a headless browser
# (Debian package chromium, not installed by setup).
# With friction or a wall on springs there are no derivatives yet: the page then shows curves without bands.
MATCH_LOOKUP ?= $(BIN)/match-lookup
derivatives := $(if $(findstring --friction,$(COMPRESS_OPTIONS))$(findstring spring:,$(COMPRESS_OPTIONS)),,-sensitivity)
page_states := $(RUN)/cc$(derivatives).vtkhdf $(RUN)/mlo$(derivatives).vtkhdf
lookup_settings := $(MATCH_LOOKUP) $(page_states)
$(RUN)/lookup.h5 $(RUN)/page.html &: $(page_states) $(RUN)/cc.vti $(RUN)/mlo.vti $(MATCH_LOOKUP) $(call changed,lookup)
	$(MATCH_LOOKUP) $(page_states) $(RUN)/lookup.h5 --page $(RUN)/page.html --pitch 1 \
	  --from-image $(RUN)/cc.vti --to-image $(RUN)/mlo.vti --report $(RUN)/lookup.json $(share)
	@$(call record,lookup)

.PHONY: page page-check
page: $(RUN)/page.html
page-check: $(RUN)/page.html $(CC2MLO)
	tests/page/check.sh $(BIN) $(RUN) $(RUN)
