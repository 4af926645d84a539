# SPDX-License-Identifier: GPL-3.0-or-later
# Calibration of the preset `paper` and of the material set `invivo`, which are part of the source tree.

# The preset `paper` is fitted to the displacements in Tables III and IV of the paper. The fit assumes that the chain displaces the
# nipple 1.28 times and the tumour 1.39 times as far as the phantom does; these factors were measured with PAPER=1 on a phantom
# close to the fitted one. The target prints the values that are in libbreast/phantom/parameters.cpp.
calibrate: $(CALIBRATE)
	$(CALIBRATE) --preset paper --gain 1.28,1.39 --evaluations 24 $(share)

ifneq ($(filter calibrate-invivo,$(MAKECMDGOALS)),)
# The compressed breast is the phantom `large`, held at its chest wall as in the paper.
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
