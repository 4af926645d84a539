# SPDX-License-Identifier: GPL-3.0-or-later
# Calibration of the preset `paper` and of the material set `invivo`, which are part of the source tree.

# The preset `paper` is fitted to the displacements in Tables III and IV of the paper. The fit assumes that the chain displaces the
# nipple 1.28 times and the tumour 1.39 times as far as the phantom does; these factors were measured with PAPER=1 on a phantom
# close to the fitted one. The target prints the values that are in libbreast/phantom/parameters.cpp.
calibrate:
	@mkdir -p $(RUN)
	$(call bench,calibrate)
	$(BIN)/calibrate --preset paper --gain 1.28,1.39 --evaluations 24 $(share)

# Weights of the prior for women's shapes. Gravity hardly sees the linear constants: they are expected where the small-strain
# stiffness measured in vivo begins (Mira 2018: a shear modulus of 80 Pa, 7 % of that of Table II). The quadratic ones are what plates see, and are
# held near the softest with which all breasts of the cohort stand with a margin.
calibrate-invivo-borders: $(call population_files,$(population_women),mesh) $(BIN)/calibrate-softness
	$(BIN)/calibrate-softness $(call population_files,$(population_women),mesh) --women $(PIPELINES)/invivo/women.tsv \
	  --set $(POPULATION_RUNS)/invivo-borders.tsv --report $(POPULATION_RUNS)/calibration-invivo-borders.json --expected 7$(comma)1.1$(comma)700 \
	  --law-ln-sd 0.2 --expected-ln-sd 0.7 --wall slide:0.002$(comma)L=20 \
	  --cut spring:0.001$(comma)medial=0.1$(comma)superior=0.015$(comma)L=25 --corner-bulk 20000 $(share)
	@{ echo '# Calibrated to the motion of living women (pipelines/invivo/women.tsv) by'; \
	  echo '# make calibrate-invivo-borders on: $(population_women). Table II of Pathmanathan et al. 2008, scaled.'; \
	  cat $(POPULATION_RUNS)/invivo-borders.tsv; } > $(PIPELINES)/materials/invivo-borders.tsv.part
	@mv $(PIPELINES)/materials/invivo-borders.tsv.part $(PIPELINES)/materials/invivo-borders.tsv
	@cat $(PIPELINES)/materials/invivo-borders.tsv
ifneq ($(filter calibrate-invivo calibrate-invivo-sternum,$(MAKECMDGOALS)),)
# The compressed breast is the phantom `large`, held at its chest wall as in the paper.
pressed := $(call population_files,large-left,mesh)
$(pressed): FORCE
	@+$(MAKE) -f $(PIPELINE) RUNS=$(POPULATION_RUNS) CASE=large-left SIDE=left PRESET=large ELEMENTS=$(POPULATION_ELEMENTS) TUMOUR=none $@
endif
# $(call calibrate_set,NAME,OPTIONS)
define calibrate_set
	$(BIN)/calibrate-softness $(call population_files,$(population_calibration),mesh) --pressed $(pressed) \
	  --women $(PIPELINES)/invivo/women.tsv --set $(POPULATION_RUNS)/$1.tsv --report $(POPULATION_RUNS)/calibration-$1.json $2 $(share)
	@{ echo '# Calibrated to the motion of living women (pipelines/invivo/women.tsv) and a paddle pressure of 10 kPa by'; \
	  echo '# make calibrate-$1 on: $(population_calibration). Table II of Pathmanathan et al. 2008, scaled.'; \
	  cat $(POPULATION_RUNS)/$1.tsv; } > $(PIPELINES)/materials/$1.tsv.part
	@mv $(PIPELINES)/materials/$1.tsv.part $(PIPELINES)/materials/$1.tsv
	@cat $(PIPELINES)/materials/$1.tsv
endef
calibrate-invivo calibrate-invivo-sternum: $(call population_files,$(population_calibration),mesh) $(pressed) $(BIN)/calibrate-softness
calibrate-invivo:
	$(call calibrate_set,invivo,)
# The cut is attached to the sternum and carries the weight of the tissue beyond. The centre of the prior of the attachment: skin of
# 20 kPa, 2 mm thick, and superficial fascia of 120 kPa (Mira 2018), 0.5 mm thick, in a cut of 10 mm, over the 25 mm to the middle of
# the sternum, which the other breast holds. Muscle is 8 times as stiff as fibroglandular tissue (Garcia et al. 2019). The quadratic
# constants are expected at the same share of Table II as the linear ones.
calibrate-invivo-sternum:
	$(call calibrate_set,invivo-sternum,--cut tissue:0.01$(comma)0.4 --muscle-stiffness 8 \
	  --expected 3$(comma)3$(comma)100 --pressure 10$(comma)5)
.PHONY: calibrate calibrate-invivo-borders calibrate-invivo calibrate-invivo-sternum
