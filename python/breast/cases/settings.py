# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a run of the pipeline: checked before make expands them, and completed from the case file and the defaults."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from ..command.nearest import suggestion
from ..errors import BreastError
from ..text_table import read_text
from .case_file import read_case_file
from .claim import claim_run
from .goals import CaseKind, Goals
from .make_text import LINE_END, make_assignment
from .scan_identity import content_of, mixed_up
from .settings_table import Setting, check_characters, check_choice, material_set_file, read_settings

DEFAULT_MATERIAL_SET = "invivo"
# Breasts of these presets slide on their rib cage; the others are held at the chest wall, as in the paper.
_SLIDING_PRESETS = ("average", "slim", "broad", "heavy")
# Settings that name a file which users edit; LANDMARKS may name two.
_EDITED = ("MATERIALS", "TUMOUR", "CHEST_WALL", "LANDMARKS", "SUPINE")
_ENDINGS = (".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd", ".vtkhdf")


@dataclass
class SettingsRequest:
    """What make knows before any setting has a meaning.

    pipelines: folder of settings.tsv and goals.tsv; programs: folder of the programs, as make writes it; installed: false in a
    source tree; maker: the process that will make the case, 0 if it only plans; command_line: names given to make, with their values before any expansion; environment: the same of the
    environment, where names that are not settings are ignored.
    """

    pipelines: Path
    programs: str
    installed: bool = False
    goals: Sequence[str] = ()
    maker: int = 0
    command_line: Mapping[str, str] = field(default_factory=dict)
    environment: Mapping[str, str] = field(default_factory=dict)


def settings_for_make(request: SettingsRequest) -> str:
    """Lines of make that define every setting which the command line and the environment do not define, and what follows from them.

        known_settings, case_settings     names of all settings, and of those of a case file
        RUN, scan, slides, body_slides    folder and scan of the case; whether the material set and the body of the phantom slide on
                                          the chest wall
        PHANTOM_MR, PHANTOM_TRUTH, TRUTH  files of the phantom; TRUTH is empty for a scan
        no_tumour                         not empty if the case has no tumour to follow
        prior_set, whole_set              the material set before an identification, and before the gland was left out
        content_SETTING                   a digest of the file of the user's that the setting names, by whose content a stage knows it

    The command line overrides a case file, which overrides the environment. Raises BreastError, in one sentence that names the
    setting or the goal, for an unknown setting, a value or a case file that is refused, a goal that this case cannot have, and a
    folder that belongs to another scan.
    """
    return _Decisions(request).text()


def _scan_name(scan: str) -> str:
    """The name of a scan without its extension: pat.001.nrrd and pat.002.nrrd differ, and the name of a folder keeps its dots."""
    name = os.path.basename(scan) or os.path.basename(os.path.dirname(scan))
    ending = next((e for e in _ENDINGS if name.endswith(e)), "")
    return name.removesuffix(ending)


def _has_wall(set_file: Path) -> bool:
    """Whether it is a material set for a sliding breast, which contains the support at its chest wall."""
    return set_file.is_file() and any(line.startswith("wall") for line in read_text(set_file).split("\n"))


class _Decisions:
    def __init__(self, request: SettingsRequest) -> None:
        self.request = request
        self.settings = read_settings(request.pipelines)
        self.goals = Goals(request.pipelines, request.goals)
        self.values: dict[str, str] = {}
        self.lines: list[str] = []
        self.phantom = self.body_slides = self.has_tumour = False

    def text(self) -> str:
        self._refuse_unknown()
        self._name_settings()
        self._take_given()
        # A script whose variable is empty must not get the results of the phantom.
        if not self._value("CASE_FILE") and "CASE_FILE" in self.request.command_line:
            raise BreastError("CASE_FILE: is empty; name the case file, or leave CASE_FILE out")
        if self._value("CASE_FILE"):
            self._take_case_file()
        self._take_defaults()
        for setting in self.settings:
            value = self._value(setting.name)
            if not value.startswith(self._value("RUNS") + "/"):  # a rule may make this file before it is read
                check_choice(setting, value, self.request.pipelines)
        self._decide_scan()
        self._decide_folder()
        self._decide_model()
        self.goals.check(CaseKind(self.request.installed, self.phantom, self.has_tumour, self.body_slides, self._printed,
                                  self._value("CLUSTER") == "slurm"), self._value("PRESET"))
        if self.goals.about_case():
            reason = mixed_up(Path(self._value("RUN")), self._value("SIDE"), self._value("scan"))
            if reason:
                raise BreastError(reason)
        self._check_files()
        self._know_contents()
        self._derive_sets()
        self._leave_out()
        if self.goals.about_case() and self.request.maker:
            claim_run(Path(self._value("RUN")), self.request.maker,
                      {s.name: self._value(s.name) for s in self.settings if s.of_case or s.kind == "program"})
        return "".join(self.lines)

    def _value(self, name: str) -> str:
        return self.values.get(name, "")

    @property
    def _printed(self) -> bool:
        return bool(self._value("PAPER"))

    def _set(self, name: str, value: str) -> None:
        self.values[name] = value
        self.lines.append(make_assignment(name, value))

    def _default(self, name: str, value: str) -> None:
        if name not in self.values:
            self._set(name, value)

    def _default_text(self, name: str, text: str) -> None:
        """Text that make expands where it is used, because MATERIALS and ELEMENTS may still change."""
        if name not in self.values:
            self.values[name] = text
            self.lines.append(f"{name} = {text}{LINE_END}")

    def _refuse_unknown(self) -> None:
        known = ["share", *(setting.name for setting in self.settings)]
        for name in sorted(self.request.command_line):
            if name not in known:
                raise BreastError(f"{name} is not a setting{suggestion(name, known)} (`make -f Makefile.pipeline help` lists all "
                                  "settings)")

    def _name_settings(self) -> None:
        names = ["share", *(setting.name for setting in self.settings)]
        self.lines.append(make_assignment("known_settings", " ".join(names)))
        self.lines.append(make_assignment("case_settings", " ".join(s.name for s in self.settings if s.of_case)))

    def _take_given(self) -> None:
        for setting in self.settings:
            # Other programs read CHROMIUM from the environment, where it may be any command.
            for given in ({} if setting.name == "CHROMIUM" else self.request.environment, self.request.command_line):
                if setting.name in given:
                    check_characters(setting, given[setting.name])
                    self.values[setting.name] = given[setting.name]
        if "share" in self.request.command_line:
            check_characters(Setting("share", "words"), self.request.command_line["share"])

    def _take_case_file(self) -> None:
        given = read_case_file(self._value("CASE_FILE"), [s.name for s in self.settings if s.of_case])
        for setting in self.settings:
            if setting.name in given:
                check_characters(setting, given[setting.name])
                if setting.name not in self.request.command_line:
                    self._set(setting.name, given[setting.name])

    def _take_defaults(self) -> None:
        for setting in self.settings:
            if setting.default:
                program = self.request.programs + "/" if setting.kind == "program" else ""
                self._default(setting.name, program + setting.default)
        self._default("PRESET", "paper" if self._printed or self.goals.of_paper() else "average")
        if not self._value("RUNS"):
            raise BreastError("RUNS: is empty; name the folder of all runs, or leave RUNS out")

    def _decide_scan(self) -> None:
        preset, side, scan = self._value("PRESET"), self._value("SIDE"), self._value("MR")
        at = f"{self._value('RUNS')}/phantom/{preset}"
        self.phantom = not scan
        # A script whose variable is empty must not get the result of a phantom.
        if self.phantom and "MR" in self.values and ("MR" in self.request.command_line or "MR" not in self.request.environment):
            raise BreastError("MR: is empty; name the scan, or leave MR out for the phantom PRESET")
        self.body_slides = preset in _SLIDING_PRESETS
        self._set("body_slides", "yes" if self.body_slides else "")
        self._set("PHANTOM_MR", at + ".nrrd")
        self._set("PHANTOM_TRUTH", at + "-truth")
        self._default("CASE", preset + ("-right" if side == "right" else "") if self.phantom else f"{_scan_name(scan)}-{side}")
        self._set("TRUTH", at + "-truth/landmarks.tsv" if self.phantom else "")
        self._set("scan", "phantom:" + preset if self.phantom else scan)
        # The paper places its tumour freely, at the margin of the gland; that of the phantom has a known displacement. No tumour is
        # added to a patient's scan unless the user asks for one.
        self._default("TUMOUR", f"{at}-truth/tumour-{side}.tsv" if self.phantom else "none")
        if self.phantom:
            self._set("MR", at + ".nrrd")

    def _decide_folder(self) -> None:
        name, runs = self._value("CASE"), self._value("RUNS")
        if not name:
            raise BreastError("CASE: is empty; name the folder of the run, or leave CASE out")
        if name.startswith(".") or "/" in name:
            raise BreastError(f"CASE: '{name}' is not a plain name of a folder below {runs}")
        if "RUN" not in self.request.command_line:
            self._set("RUN", f"{runs}/{name}{'-as-printed' if self._printed else ''}")

    def _decide_model(self) -> None:
        """A living breast slides on the chest wall and is soft; the breast of the paper is held there and has the materials of Table
        II."""
        living = not self._printed and (not self.phantom or self.body_slides)
        self._default("MATERIALS", DEFAULT_MATERIAL_SET if living else "seed2008")
        self._default("POPULATION_MATERIALS", DEFAULT_MATERIAL_SET)
        slides = not self._printed and _has_wall(material_set_file(self._value("MATERIALS"), self.request.pipelines))
        self._set("slides", "yes" if slides else "")
        # The mean pressure of the paddle, kPa, at which a compression ends before REDUCTION, as in clinical practice. Table II is
        # too stiff for it.
        self._default("PRESSURE", "10" if slides else "")
        # As printed, elements on the edge of the cuboid fold early (docs/validation/contact.md).
        self._default("AT_LEAST", "30" if self._printed else "40")
        if self._printed:
            # Everything as printed: no gravity in compression and augmented Lagrangian, too.
            self._default_text("HEXMESH_OPTIONS", "$(PRINTED_HEXMESH)")
            self._default_text("MECHANICS", "$(PRINTED_MECHANICS)")
            self._default("COMPRESS_OPTIONS", "--gravity off --contact al")
        else:
            # A breast that slides does so with the muscle behind it; one that is held needs none. The tissue around it moves with it.
            self._default("MUSCLE", "measured" if slides else "0")
            self._default("SURROUNDINGS", "16" if slides else "0")
            self._default_text("HEXMESH_OPTIONS", "--elements $(ELEMENTS) $(addprefix --muscle ,$(filter-out 0,$(MUSCLE))) "
                               "$(addprefix --surroundings ,$(filter-out 0,$(SURROUNDINGS)))")
            # An empty ELEMENT is the default of the programs. ACCURACY=MM chooses ELEMENTS and ELEMENT.
            self._default_text("MECHANICS", "--materials $(MATERIALS) $(addprefix --element ,$(ELEMENT))")
        hexmesh = self._value("HEXMESH_OPTIONS")
        self.has_tumour = "--tumour none" not in hexmesh if "--tumour" in hexmesh else self._value("TUMOUR") != "none"
        self._set("no_tumour", "" if self.has_tumour else "yes")

    def _check_files(self) -> None:
        """Refuses a program or a file that a setting names and that is not there, unless a rule makes it."""
        for setting in self.settings:
            value, given = self._value(setting.name), setting.name in self.request.command_line
            if setting.kind == "program" and value and (given or self.request.installed):
                program = value.split()[0]
                if not (os.path.isfile(program) and os.access(program, os.X_OK)):
                    raise BreastError(f"{setting.name}: '{program}' is no program that can be run; give its path, or leave "
                                      f"{setting.name} out for libbreast's own")
            for file in value.split(",") if setting.name in ("CHEST_WALL", "LANDMARKS", "SUPINE", "LABELS_TRUTH") and value else ():
                if file != "phantom" and not file.startswith(self._value("RUNS") + "/") and not os.path.exists(file):
                    raise BreastError(f"{setting.name}: '{file}' does not exist; check its name and folder")

    def _know_contents(self) -> None:
        """A file that was replaced by one with an older date is another file, and one that was only touched is the same."""
        for name in _EDITED:
            value = self._value(name)
            names = [str(material_set_file(value, self.request.pipelines))] if name == "MATERIALS" else value.split(",")
            contents = [content_of(file)[:12] for file in names
                        if os.path.isfile(file) and not file.startswith(self._value("RUNS") + "/")]
            self.lines.append(make_assignment("content_" + name, " ".join(contents)))

    def _derive_sets(self) -> None:
        """With landmarks in a second posture, or a supine scan of the same patient, the set MATERIALS is the prior, and the chain runs
        with the set that `identify` finds."""
        if not self._value("LANDMARKS") and not self._value("SUPINE"):
            return
        if self._value("SUPINE") == "phantom" and not self.phantom:
            raise BreastError(f"SUPINE: phantom is the supine scan of a phantom, but MR={self._value('MR')} is the scan of a patient; "
                              "name the supine scan of this patient")
        self._set("prior_set", self._value("MATERIALS"))
        self.values["MATERIALS"] = self._value("RUN") + "/identified.tsv"
        self.lines.append(make_assignment("override MATERIALS", self._value("MATERIALS")))

    def _leave_out(self) -> None:
        """Parts of the model that the user leaves out; studies/leaveout.tsv measures the effect of each."""
        run, materials = self._value("RUN"), self._value("MATERIALS")
        whole = materials if materials.startswith(run + "/") else material_set_file(materials, self.request.pipelines)
        for part, text in (("no-skin", "HEXMESH_OPTIONS += --skin 0"),
                           ("no-backward", "PRONE := --gravity 0,0,0"),
                           ("no-gravity-in-compression", "COMPRESS_OPTIONS += --gravity off"),
                           ("no-gland", f"whole_set := {whole}"),
                           ("no-gland", f"MATERIALS := {run}/fat-only.tsv")):
            if part in self._value("LEAVE_OUT").split():
                self.lines.append(f"override {text}{LINE_END}")
