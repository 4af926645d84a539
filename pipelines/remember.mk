# SPDX-License-Identifier: GPL-3.0-or-later
# A stage's settings (program, options, contents of files that users edit) are recorded beside its output when it has succeeded, and the
# record goes before it starts. When the record differs from what is asked now, the stage depends on FORCE and runs again; `make -q` and
# `make -n` read the record and write nothing.
# The settings of STAGE are STAGE_settings, its record is STAGE_record (otherwise RUN/.STAGE.settings); all that its program says is in
# log.txt beside it. Makefile.pipeline says what `changed`, `stage`, `pressed` and `of_pressed` do in a rule; `stale` and `staged` do the
# same for a record and settings without a STAGE.

# $(call named,SCAN): its own name and a digest of its path. Another scan differs, but the folders above it, in which a patient's name
# may stand, are not told: a run may be sent to somebody.
named = $(if $1,$(notdir $(patsubst %/,%,$1)):$(shell printf %s '$1' | sha256sum | cut -c1-12))
record_file = $(or $($1_record),$(RUN)/.$1.settings)
# Only the times of its files decide whether a stage without settings is made again.
recorded = $(or $(strip $1),none)
stale = $(if $(subst x$(strip $(file < $1))x,,x$(call recorded,$2)x),FORCE)
staged = @$(BIN)/cases stage $1 $(call quoted,$(call recorded,$2)) $3 --quiet --
named_stage = $(call staged,$(call record_file,$1),$($1_settings),$2)
# In the folder of a study's row: the same, with the row's own options. A solve may end early, and what needed it with it.
changed_in = $(call stale,$1/.$2.settings,$($2_settings))
attempt = $(call staged,$(@D)/.$1.settings,$($1_settings)) $(BIN)/cases attempt $@ '$2' --quiet --
changed = $(call stale,$(call record_file,$1),$($1_settings))
# $(call prints,STAGE,FILE): a stage whose program prints FILE.
prints = $(call named_stage,$1,--prints $2)
stage = $(call named_stage,$1)
pressed = $(call named_stage,$1,--keep $@)
of_pressed = $(call named_stage,$1,--of '$(filter $(made_of_pressed),$^)')
made_of_pressed = $(addprefix $(RUN)/,cc.% mlo.% cc-sensitivity.% mlo-sensitivity.%)
