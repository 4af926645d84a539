# The page of a case: pointing at CC draws curve and band in MLO. page-check opens it in a headless browser
# (Debian package chromium, not installed by setup).
MATCH_LOOKUP ?= $(BIN)/match-lookup
$(RUN)/lookup.h5 $(RUN)/page.html &: $(addprefix $(RUN)/,cc-sensitivity.vtkhdf mlo-sensitivity.vtkhdf cc.vti mlo.vti) \
  $(MATCH_LOOKUP)
	$(MATCH_LOOKUP) $(RUN)/cc-sensitivity.vtkhdf $(RUN)/mlo-sensitivity.vtkhdf $(RUN)/lookup.h5 --page $(RUN)/page.html --pitch 1 \
	  --from-image $(RUN)/cc.vti --to-image $(RUN)/mlo.vti --report $(RUN)/lookup.json $(share)

.PHONY: page page-check
page: $(RUN)/page.html
page-check: $(RUN)/page.html $(CC2MLO)
	tests/page/check.sh $(BIN) $(RUN) $(RUN)
