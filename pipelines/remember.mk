# SPDX-License-Identifier: GPL-3.0-or-later
# A stage's settings (program, options, contents of files that users edit) are recorded beside its output when it has succeeded, and the
# record goes before it starts. When the record differs from what is asked now, the stage depends on FORCE and runs again; `make -q` and
# `make -n` read the record and write nothing.
#   $(call changed,STAGE)  FORCE when STAGE_settings differs from the record of an existing output
#   $(call stage,STAGE)    before the stage's program in a recipe: shows one line, records STAGE_settings in STAGE_record (default
#                          RUN/.STAGE.settings); all the program says is in log.txt beside it
#   $(call pressed,STAGE)  the same of compress, whose shape is kept even if the plates do not grip the breast
#   $(call of_pressed,STAGE)  the same of a program that is run only if the compressed shapes it reads are there and are compressions
#   $(call stale,FILE,TEXT), $(call staged,FILE,TEXT)  the same for a record and settings that have no NAME
#   $(call named,SCAN)     a scan as records name it: by its own name and a digest of its path. Another scan differs, but the
#                          folders above it, in which a patient's name may stand, are not told: a run may be sent to somebody
named = $(if $1,$(notdir $(patsubst %/,%,$1)):$(shell printf %s '$1' | sha256sum | cut -c1-12))
record_file = $(or $($1_record),$(RUN)/.$1.settings)
stale = $(if $(subst x$(strip $(file < $1))x,,x$(strip $2)x),FORCE)
staged = @$(BIN)/cases stage $1 $(call quoted,$(strip $2)) $3 --quiet --
named_stage = $(call staged,$(call record_file,$1),$($1_settings),$2)
# In the folder of a study's row: the same, with the row's own options. A solve may end early, and what needed it with it.
changed_in = $(call stale,$1/.$2.settings,$($2_settings))
attempt = $(call staged,$(@D)/.$1.settings,$($1_settings)) $(BIN)/cases attempt $@ '$2' --quiet --
changed = $(call stale,$(call record_file,$1),$($1_settings))
# $(call prints,STAGE,FILE): the same of a program that prints FILE.
prints = $(call named_stage,$1,--prints $2)
stage = $(call named_stage,$1)
pressed = $(call named_stage,$1,--keep $@)
of_pressed = $(call named_stage,$1,--of '$(filter $(made_of_pressed),$^)')
made_of_pressed = $(addprefix $(RUN)/,cc.% mlo.% cc-sensitivity.% mlo-sensitivity.%)
