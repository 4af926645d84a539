# SPDX-License-Identifier: GPL-3.0-or-later
# Settings (settings.tsv) are checked before make or a shell expands them: unknown names, values that are not among the choices,
# and file names with characters that make or a shell would interpret as code are refused in one line, before anything runs.
comma := ,
empty :=
space := $(empty) $(empty)
hash := \#
tab := $(subst x,	,x)
define newline


endef

# Tables as data of make: $(call read_table,FILE) makes `lines` its lines but the comments, a word each, in which ␣ stands for a
# blank and ␉ for a tab. $(call each_row,NAME) evaluates the text NAME for every line below the header; in it $(call cell,COLUMN)
# is a cell, empty where it is "-" or has no column, and $(call text,CELL) has its blanks.
text = $(subst ␣,$(space),$1)
cells = $(subst ␉,$(space),$1)
table_lines = $(filter-out $(hash)%,$(subst $(newline),$(space),$(subst $(tab),␉,$(subst $(space),␣,$(file < $1)))))
read_table = $(eval lines := $(call table_lines,$1))$(eval columns := $(call cells,$(firstword $(lines))))
each_row = $(foreach line,$(wordlist 2,9999,$(lines)),$(eval row := $(join $(columns:%=%=),$(call cells,$(line))))$(eval $(value $1)))
cell = $(filter-out -,$(patsubst $1=%,%,$(filter $1=%,$(row))))

known_settings := share
$(foreach k,path name text program words case command,$(eval $k_settings :=))
define setting
name := $(call cell,setting)
known_settings += $(name)
$(call cell,of)_settings += $(name)
$(call cell,kind)_settings += $(name)
default_$(name) := $(call text,$(call cell,default))
choices_$(name) := $(call text,$(call cell,choices))
may_hold_$(name) := $(call cell,may_hold)
endef
$(call read_table,$(PIPELINES)/settings.tsv)
$(call each_row,setting)
words_settings += share $(text_settings) $(program_settings)

# Characters that are code to a shell or to make. In options blanks, colons, equals signs, % and ~ are no harm.
shell_characters := $$ ` ; & | < > ( ) { } [ ] * ? ! " ' \ ^ $(hash)
name_characters := $(shell_characters) = : % ~
strange = $(strip $(foreach c,$2,$(findstring $c,$(value $1))))
refuse_strange = $(if $(call strange,$1,$2),$(error $1: the character $(firstword $(call strange,$1,$2)) may not stand in it; \
  give a name without it, or a link of such a name))
refuse_blanks = $(if $(word 2,$(value $1)),$(error $1: blanks may not stand in it; give a name without them, or a link of such a \
  name (ln -s)))
refuse_dash = $(if $(filter -%,$(firstword $(value $1))),$(error $1: may not begin with a dash; write ./$(firstword $(value $1))))
check_name = $(call refuse_blanks,$1)$(call refuse_strange,$1,$(filter-out $(may_hold_$1),$(name_characters)))$(if \
  $(filter TUMOUR,$1),,$(call refuse_dash,$1))
check_setting = $(if $(filter undefined default,$(origin $1)),,$(if $(filter $1,$(words_settings)),$(call \
  refuse_strange,$1,$(shell_characters)),$(call check_name,$1)))
# Programs of libbreast, either built or installed.
BUILD := $(ROOT)build/release
BIN := $(or $(INSTALLED),$(BUILD)/bin)
# The text "; did you mean X?" if WORD may be a misspelling of a candidate: $(call suggest,WORD,CANDIDATES). It is empty before
# the first build.
suggest = $(if $(wildcard $(BIN)/cases),$(shell $(BIN)/cases nearest $1 $2 --quiet))

# Names given on the command line that are not settings.
given := $(filter-out -% .% MAKE% GNUMAKEFLAGS,$(foreach v,$(.VARIABLES),$(if $(findstring command,$(origin $v)),$v)))
unknown := $(filter-out $(known_settings),$(given))
ifneq ($(unknown),)
  bad_name := $(call strange,unknown,$(name_characters))
  $(error $(firstword $(unknown)): no such setting$(if $(bad_name),,$(call suggest,$(firstword $(unknown)),$(known_settings))); \
    `make -f Makefile.pipeline help` lists them)
endif
$(foreach v,$(filter-out share $(if $(findstring command,$(origin CHROMIUM)),,CHROMIUM),$(known_settings)),$(call check_setting,$v))
$(foreach v,$(program_settings),$(eval $v ?= $(BIN)/$(default_$v)))

# Case files, cohorts and studies are read by the program `cases`, which make calls with $(call ask,ARGUMENTS). The answer consists
# of lines of make, separated by a byte that $(shell) does not change, or it is an error message. Before the first build the
# program does not exist and is not called: make builds it first and then reads all makefiles again.
goals = $(or $(MAKECMDGOALS),$(.DEFAULT_GOAL))
line_end := $(shell printf '\036')
answer = $(if $(filter 0,$(.SHELLSTATUS)),$(eval $(subst $(line_end),$(newline),$1)),$(error $(filter-out cases:,$1)$(outdated)))
asking = $(if $(wildcard $(CASES)),$(filter-out help setup build clean settings,$(goals)))
ask = $(if $(asking),$(call answer,$(shell $(CASES) $1 --quiet 2>&1)))
older = $(if $(INSTALLED),,$(shell find $(SOURCES) -newer $(CASES)))
outdated = $(if $(older),; the programs are older than their sources: make -f $(PIPELINE) build)

# $(call refuse_goals,CONDITION,GOALS,WHY): if CONDITION is not empty, the first of these goals on the command line is refused.
refuse_goals = $(if $1,$(foreach goal,$(firstword $(filter $2,$(MAKECMDGOALS))),$(error $(goal): $3)))
# $(call among,SETTING,CHOICES): every word of the setting must be one of the choices. An empty list of choices is not checked:
# before the first build, `cases` cannot be asked for it.
among = $(if $2,$(foreach w,$(filter-out $2,$($1)),$(error $1: '$w' is none of $2$(call suggest,$w,$2))))
# A plain number: nothing remains after its digits and one point are removed.
without = $(if $2,$(call without,$(subst $(firstword $2),,$1),$(wordlist 2,99,$2)),$1)
plain_number = $(if $(filter-out .,$(call without,$($1),0 1 2 3 4 5 6 7 8 9)),$(error $1: '$($1)' is not a number))
# Called when all settings have their values; paths and option texts are checked by the programs.
define check_values
$(foreach v,$(known_settings),$(if $(filter number,$(choices_$v)),$(call plain_number,$v),$(if $(choices_$v),$(call among,$v,$(choices_$v)))))
$(if $(wildcard $(MATERIALS)),,$(call among,MATERIALS,$(material_sets)))
$(if $(RUNS),,$(error RUNS: is empty; name the folder of all runs, or leave RUNS out))
$(if $(CASE),,$(error CASE: is empty; name the folder of the run, or leave CASE out))
$(if $(filter .% ..,$(CASE))$(findstring /,$(CASE)),$(error CASE: '$(CASE)' is not a plain name of a folder below $(RUNS)))
endef
material_sets := $(patsubst $(PIPELINES)/materials/%.tsv,%,$(wildcard $(PIPELINES)/materials/*.tsv))
