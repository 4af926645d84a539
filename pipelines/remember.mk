# SPDX-License-Identifier: GPL-3.0-or-later
# A stage's settings (program and options) are recorded beside its output when it has succeeded. When the
# record differs from what is asked now, the stage depends on FORCE and runs again; `make -q` and
# `make -n` read the record and write nothing.
#   $(call changed,STAGE)  FORCE when STAGE_settings differs from the record of an existing output
#   $(call record,STAGE)   shell command that records them in STAGE_record (default RUN/.STAGE.settings)
record_file = $(or $($1_record),$(RUN)/.$1.settings)
squeeze = $(strip $1)
differ = $(subst x$(call squeeze,$1)x,,x$(call squeeze,$2)x)
changed = $(if $(call differ,$(file < $(call record_file,$1)),$($1_settings)),FORCE)
record = printf '%s\n' '$(subst ','\'',$(call squeeze,$($1_settings)))' > $(call record_file,$1)
.PHONY: FORCE
FORCE:
