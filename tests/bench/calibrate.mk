# SPDX-License-Identifier: GPL-3.0-or-later
# How the preset `paper` and the material set `invivo`, which stand in the source tree, were found.

# How the preset `paper` was found: motions of the paper's Tables III and IV for a chain that moves the
# nipple 1.28 and the tumour 1.39 times as far as the phantom does (PAPER=1, measured on a phantom near the one
# found). Prints the values that stand in libbreast/phantom/parameters.cpp.
calibrate: $(CALIBRATE)
	$(CALIBRATE) --preset paper --gain 1.28,1.39 --evaluations 24 $(share)

ifneq ($(filter calibrate-invivo,$(MAKECMDGOALS)),)
# The breast that is pressed is the phantom large, as held in the paper's mode.
pressed := $(call population_files,large-left,mesh)
$(pressed): FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) CASE=large-left SIDE=left PRESET=large ELEMENTS=$(POPULATION_ELEMENTS) TUMOUR=none $@
endif
calibrate-invivo: $(call population_files,$(population_calibration),mesh) $(pressed) $(CALIBRATE_SOFTNESS)
	$(CALIBRATE_SOFTNESS) $(call population_files,$(population_calibration),mesh) --pressed $(pressed) \
	  --women $(PIPELINES)/invivo/women.tsv --set $(POPULATION_RUNS)/invivo.tsv --report $(POPULATION_RUNS)/calibration.json $(share)
	@{ echo '# Calibrated to the motion of living women (pipelines/invivo/women.tsv) and a paddle pressure of 10 kPa by'; \
	  echo '# make calibrate-invivo on: $(population_calibration). Table II of Pathmanathan et al. 2008, scaled.'; \
	  cat $(POPULATION_RUNS)/invivo.tsv; } > $(PIPELINES)/materials/invivo.tsv.part
	@mv $(PIPELINES)/materials/invivo.tsv.part $(PIPELINES)/materials/invivo.tsv
	@cat $(PIPELINES)/materials/invivo.tsv
.PHONY: calibrate-invivo
