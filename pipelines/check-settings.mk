# SPDX-License-Identifier: GPL-3.0-or-later
# Settings are looked at before make or a shell expands them: unknown names, values that are none of the choices, and
# file names with characters that make or a shell would read as code are refused in one line, before anything runs.
comma := ,
empty :=
space := $(empty) $(empty)
hash := \#

# What a case file may set: pipelines/case-file.sh reads these lists here.
path_settings := MR CHEST_WALL MATERIALS LANDMARKS
name_settings := SIDE SERIES CASE PRESET WALL CUT MUSCLE ELEMENT PAPER REDUCTION PRESSURE AT_LEAST ELEMENTS TUMOUR ACCURACY LEAVEOUT_MM POINTS \
  PAGE_SCAN
text_settings := LEAVE_OUT PRONE MECHANICS SEGMENT_OPTIONS FIT_OPTIONS HEXMESH_OPTIONS COMPRESS_OPTIONS PROJECT_OPTIONS \
  PHANTOM_OPTIONS SLICER_OPTIONS
case_settings := $(path_settings) $(name_settings) $(text_settings)
# The rest is for the command line only.
programs := SEGMENT FIT_HERMITE HEXMESH BACKWARD FORWARD COMPRESS PROJECT CC2MLO PHANTOM PHANTOM_MESH TRUTH_TABLE_TOOL \
  CALIBRATE CALIBRATE_SOFTNESS IDENTIFY PROBE RENDER SENSITIVITY DIFFERENCE MATCH_LOOKUP EXPORT_DECK EXPORT_SLICER CHROMIUM
known_settings := $(case_settings) $(programs) CASE_FILE COHORT RUNS RUN EXPECTED PRESET_BUILD ACCURACY_LADDER COST_POINTS \
  COST_FINEST FINDINGS_FINEST BUDGET_FINER BAND_SAMPLES BAND_DRAWS BAND_PLACES STABILITY_LIMIT COMPARE_ELEMENTS \
  COMPARE_SCENES COMPARE_PRESSED SCALES SCALES_tumour LEAVEOUT_VARIANTS WALL_VARIANTS POPULATION_SCANS \
  POPULATION_TOOL POPULATION_ELEMENTS POPULATION_MATERIALS CLUSTER CLUSTER_PARTITION CLUSTER_ACCOUNT CLUSTER_TIME CLUSTER_MEMORY \
  CLUSTER_CORES CLUSTER_OPTIONS RESUME MINUTES FUZZ_MINUTES FUZZ_INPUTS FAULT_ALLOCATIONS share

# Characters that are code to a shell or to make. In options blanks, colons, equals signs, % and ~ are no harm.
shell_characters := $$ ` ; & | < > ( ) { } [ ] * ? ! " ' \ ^ $(hash)
name_characters := $(shell_characters) = : % ~
strange = $(strip $(foreach c,$2,$(findstring $c,$(value $1))))
refuse_strange = $(if $(call strange,$1,$2),$(error $1: the character $(firstword $(call strange,$1,$2)) may not stand in it; \
  give a name without it, or a link of such a name))
refuse_blanks = $(if $(word 2,$(value $1)),$(error $1: blanks may not stand in it; give a name without them, or a link of such a \
  name (ln -s)))
refuse_dash = $(if $(filter -%,$(firstword $(value $1))),$(error $1: may not begin with a dash; write ./$(firstword $(value $1))))
# A tumour at x,y,z:radius has a colon, and so have springs.
allowed_TUMOUR := :
allowed_WALL := :
allowed_CUT := :
allowed_CLUSTER_TIME := :
words_settings := $(text_settings) $(programs) share SCALES SCALES_tumour ACCURACY_LADDER COST_POINTS LEAVEOUT_VARIANTS \
  WALL_VARIANTS COMPARE_SCENES COMPARE_PRESSED EXPECTED POPULATION_SCANS POPULATION_TOOL CLUSTER_OPTIONS
check_words = $(call refuse_strange,$1,$(shell_characters))
check_name = $(call refuse_blanks,$1)$(call refuse_strange,$1,$(filter-out $(allowed_$1),$(name_characters)))$(if \
  $(filter TUMOUR,$1),,$(call refuse_dash,$1))
check_setting = $(if $(filter undefined default,$(origin $1)),,$(if \
  $(filter $1,$(words_settings)),$(call check_words,$1),$(call check_name,$1)))
# Names given on the command line that are no settings.
given := $(filter-out -% .% MAKE% GNUMAKEFLAGS,$(foreach v,$(.VARIABLES),$(if $(findstring command,$(origin $v)),$v)))
unknown := $(filter-out $(known_settings),$(given))
ifneq ($(unknown),)
  bad_name := $(call strange,unknown,$(name_characters))
  $(error $(firstword $(unknown)): no such setting$(if $(bad_name),,$(shell $(PIPELINES)/suggest.sh $(firstword $(unknown)) \
    $(known_settings))); `make -f Makefile.pipeline help` lists them)
endif
$(foreach v,$(filter-out share $(if $(findstring command,$(origin CHROMIUM)),,CHROMIUM),$(known_settings)),$(call check_setting,$v))

# $(call among,SETTING,CHOICES): every word of it is one of them.
among = $(foreach w,$(filter-out $2,$($1)),$(error $1: '$w' is none of $2$(shell $(PIPELINES)/suggest.sh $w $2)))
# A plain number: nothing is left without its digits and one point.
without_digits = $(subst 0,,$(subst 1,,$(subst 2,,$(subst 3,,$(subst 4,,$(subst 5,,$(subst 6,,$(subst 7,,$(subst \
  8,,$(subst 9,,$1))))))))))
plain_number = $(if $(filter-out .,$(call without_digits,$($1))),$(error $1: '$($1)' is not a number))
# Called when all settings have their values; paths and option texts are looked at by the programs.
define check_values
$(call among,SIDE,left right)
$(call among,PRESET,$(sliding_presets) paper flat small large pendulous)
$(call among,WALL,held slide $(filter slide:% spring:%,$(WALL)))
$(call among,CUT,free fixed roller $(filter spring:%,$(CUT)))
$(call among,ELEMENT,q1p0 q2p1)
$(call among,PAPER,1)
$(call among,PAGE_SCAN,yes no)
$(call among,LEAVE_OUT,no-skin no-gland no-backward no-gravity-in-compression)
$(call plain_number,REDUCTION)
$(call plain_number,PRESSURE)
$(call plain_number,AT_LEAST)
$(call plain_number,ELEMENTS)
$(call plain_number,ACCURACY)
$(call plain_number,SERIES)
$(if $(wildcard $(MATERIALS)),,$(call among,MATERIALS,$(material_sets)))
$(if $(RUNS),,$(error RUNS: is empty; name the folder of all runs, or leave RUNS out))
$(if $(CASE),,$(error CASE: is empty; name the folder of the run, or leave CASE out))
$(if $(filter .% ..,$(CASE))$(findstring /,$(CASE)),$(error CASE: '$(CASE)' is not a plain name of a folder below $(RUNS)))
endef
material_sets := $(patsubst $(PIPELINES)/materials/%.tsv,%,$(wildcard $(PIPELINES)/materials/*.tsv))
