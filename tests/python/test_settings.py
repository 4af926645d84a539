# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a run: what is refused before make expands anything, and what follows from what is given."""
import tempfile
import unittest
from pathlib import Path

from breast.cases.make_text import LINE_END, rows_for_make
from breast.cases.scan_identity import remember_scan
from breast.cases.settings import DEFAULT_MATERIAL_SET, SettingsRequest, settings_for_make
from breast.errors import BreastError
from breast.text_table import parse_table

SETTINGS = """# what they are
setting kind of default choices may_hold
MR path case - - -
MATERIALS path case - set -
LANDMARKS path case - - -
CHEST_WALL path case - - -
SUPINE path case - - -
SIDE name case left left|right -
CASE name case - - -
PRESET name case - average|paper -
WALL name case - held|slide:% :
MUSCLE name case - - -
SURROUNDINGS name case - number|0|60 -
PAPER name case - 1 -
REDUCTION name case 50 number|1|95 -
PRESSURE name case - number -
AT_LEAST name case - number -
TUMOUR name case - auto|none|place :
ELEMENTS name case 16 integer|4|64 -
LEAVE_OUT text case - no-skin|no-gland|no-backward -
MECHANICS text case - - -
HEXMESH_OPTIONS text case - - -
COMPRESS_OPTIONS text case - - -
FORWARD program command forward - -
CLUSTER name command local local|slurm -
CHROMIUM words command - - -
CASE_FILE name command - - -
COST_POINTS words command - rows:cost -
RUNS name command runs - -
RUN name command - - -
"""


class CaseSettings(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.pipelines = self.folder / "pipelines"
        for name in ("materials", "studies"):
            (self.pipelines / name).mkdir(parents=True)
        (self.pipelines / "settings.tsv").write_text(SETTINGS.replace(" ", "\t").replace("|", " "))
        (self.pipelines / "goals.tsv").write_text("goal\tneeds\ntables\tpaper tumour\ntruth\ttruth\nbudget\tpaper truth held source\n"
                                                  "cohort\tany\ncohort-script\tslurm any\n")
        (self.pipelines / "materials/invivo.tsv").write_text("tissue\tc\nfat\t1\nwall\t2\n")
        (self.pipelines / "materials/seed2008.tsv").write_text("tissue\tc\nfat\t1\n")
        for name in ("a.tsv", "a.nrrd"):
            (self.folder / name).write_text("x")
        (self.pipelines / "studies/cost.tsv").write_text("variant\tstarts_at\nfine\tmesh\n")
        self.request = SettingsRequest(self.pipelines, "bin", False, ["chain"])

    def lines(self, **given):
        self.request.command_line = given
        return settings_for_make(self.request).split(LINE_END)

    def refusal(self, **given):
        try:
            self.lines(**given)
        except BreastError as error:
            return str(error)
        return ""

    def assert_lines(self, given, *lines):
        made = self.lines(**given)
        for line in lines:
            self.assertIn(line, made)

    def test_unknown_names_and_values_are_refused_with_a_suggestion(self):
        for given, said in (
                ({"SIDES": "left"}, "SIDES is not a setting; did you mean SIDE? (`make -f Makefile.pipeline help` lists all settings)"),
                ({"SIDE": "lefft"}, "SIDE: 'lefft' is none of left, right; did you mean left?"),
                ({"MATERIALS": "seed208"},
                 "MATERIALS: 'seed208' is neither a file nor one of invivo, seed2008; did you mean seed2008?"),
                ({"REDUCTION": "1.2.3"},
                 "REDUCTION: '1.2.3' is not a number; write digits and at most one decimal point, as 40 or 2.5"),
                ({"REDUCTION": "500"}, "REDUCTION: 500 must be from 1 to 95"),
                ({"ELEMENTS": "0"}, "ELEMENTS: 0 must be from 4 to 64"),
                ({"ELEMENTS": "6.5"}, "ELEMENTS: '6.5' is not a whole number"),
                ({"TUMOUR": "1,2"}, "TUMOUR 1,2: expected auto, none, a file, or x,y,z[:radius] in mm"),
                ({"TUMOUR": "1,2,3:90"}, "TUMOUR 1,2,3:90: radius 90 mm must be above 0 and at most 50"),
                ({"COST_POINTS": "fine coarse"}, "COST_POINTS: 'coarse' is none of fine")):
            self.assertEqual(self.refusal(**given), said)
        for given in ({"REDUCTION": "."}, {"WALL": "slid"}):
            self.assertNotEqual(self.refusal(**given), "", given)
        for given in ({"REDUCTION": "40.5"}, {"REDUCTION": "95"}, {"WALL": "slide:3"}, {"COST_POINTS": "fine"},
                      {"MATERIALS": str(self.pipelines / "materials/invivo.tsv")}, {"TUMOUR": str(self.pipelines / "settings.tsv")}):
            self.assertEqual(self.refusal(**given), "", given)

    def test_text_that_is_code_is_refused_for_every_kind(self):
        for code in ("$(shell x)", "`x`", "a;b", "a'b", "a#b", "a\\b", "a|b", "a\nb"):
            for name in ("MR", "MECHANICS", "FORWARD", "share"):
                self.assertIn("may not stand in it", self.refusal(**{name: code}), (name, code))
        for name in ("a=b", "a:b", "a%b", "a~b"):
            self.assertIn("the character " + name[1], self.refusal(MR=name))
            self.assertEqual(self.refusal(MECHANICS=name), "", "no harm in options")
        self.assertIn("blanks may not stand in 'a b'", self.refusal(MR="a b"))
        self.assertIn("write ./-x", self.refusal(MR="-x"))
        self.assertEqual(self.refusal(TUMOUR="-5,3,2:4"), "")
        self.assertNotEqual(self.refusal(TUMOUR="5:4=x"), "", "after a character that it may contain")
        self.request.environment = {"MR": "$(shell x)"}
        self.assertNotEqual(self.refusal(), "", "make reads the environment, too")
        self.request.environment = {"CHROMIUM": "a 'b'", "PATH": "$x"}
        self.assertEqual(self.refusal(), "")

    def test_the_model_follows_from_the_case(self):
        self.assert_lines({}, "RUN := runs/average", "MATERIALS := invivo", f"POPULATION_MATERIALS := {DEFAULT_MATERIAL_SET}",
                          "PRESSURE := 10", "MUSCLE := measured", "SURROUNDINGS := 16", "FORWARD := bin/forward")
        self.assert_lines({"PRESET": "paper"}, "MATERIALS := seed2008", "PRESSURE := ")
        self.assert_lines({"PAPER": "1"}, "RUN := runs/paper-as-printed", "AT_LEAST := 30", "MECHANICS = $(PRINTED_MECHANICS)")
        self.assert_lines({"MATERIALS": "seed2008"}, "MUSCLE := 0", "SURROUNDINGS := 0")
        self.assertFalse([line for line in self.lines(MECHANICS="--x") if line.startswith("MECHANICS")], "what is given stays")
        self.request.goals = ["tables"]
        self.assert_lines({}, "PRESET := paper")

    def test_a_scan_has_its_own_folder_and_no_tumour(self):
        self.assert_lines({"MR": "x/pat.001.nii.gz", "SIDE": "right"}, "CASE := pat.001-right")
        self.assert_lines({"MR": "1.2.840/"}, "CASE := 1.2.840-left")
        self.assert_lines({"MR": "x.nrrd"}, "TUMOUR := none", "no_tumour := yes", "TRUTH := ")
        self.assert_lines({"MR": "x.nrrd", "TUMOUR": "auto"}, "no_tumour := ")
        self.assert_lines({}, "no_tumour := ")
        self.assert_lines({"HEXMESH_OPTIONS": "--tumour none"}, "no_tumour := yes")
        self.assert_lines({"SIDE": "right"}, "CASE := average-right")
        # A phantom's result is not that of a scan whose name was lost.
        self.assertIn("MR: is empty", self.refusal(MR=""))
        for name in ("", "..", ".x", "a/b"):
            self.assertIn("CASE: ", self.refusal(CASE=name), name)
        self.assertIn("RUNS: is empty", self.refusal(RUNS=""))
        (self.folder / "scan.nrrd").write_text("abc")
        run = self.folder / "run"
        remember_scan(run, "left", str(self.folder / "scan.nrrd"))
        self.assertIn("another scan", self.refusal(RUN=str(run)))
        self.request.goals = ["cohort"]
        self.assertEqual(self.refusal(RUN=str(run)), "", "not about the case in RUN")

    def test_a_case_file_is_between_the_command_line_and_the_environment(self):
        file = self.folder / "a.case"
        file.write_text("REDUCTION = 40\nSIDE = right\n")
        self.request.environment = {"SIDE": "left", "CASE": "mine"}
        self.assert_lines({"CASE_FILE": str(file)}, "SIDE := right", "RUN := runs/mine")
        self.assertNotIn("REDUCTION := 40", self.lines(CASE_FILE=str(file), REDUCTION="30"))
        for text, said in (("SIDE = lefft\n", "did you mean left?"), ("MR = a b.nrrd\n", "blanks"),
                           ("FORWARD = /bin/sh\n", "is no setting of a case")):
            file.write_text(text)
            self.assertIn(said, self.refusal(CASE_FILE=str(file)))
        self.assertIn("CASE_FILE: is empty", self.refusal(CASE_FILE=""))

    def test_files_and_programs_that_are_not_there_are_refused_by_name(self):
        self.assertIn("CHEST_WALL: 'none.vtp' does not exist", self.refusal(CHEST_WALL="none.vtp"))
        self.assertIn("LANDMARKS: 'b.tsv' does not exist", self.refusal(LANDMARKS=f"{self.folder}/a.tsv,b.tsv"))
        self.assertEqual(self.refusal(CHEST_WALL="runs/made-later.vtp"), "")
        self.assertIn("FORWARD: '/no/such' is no program that can be run", self.refusal(FORWARD="/no/such"))
        self.assertEqual(self.refusal(FORWARD="/bin/sh -e"), "")

    def test_a_file_is_known_by_its_content(self):
        def content():
            return [line for line in self.lines(MATERIALS=str(self.folder / "a.tsv")) if line.startswith("content_MATERIALS")]
        before = content()
        self.assertRegex(before[0], "content_MATERIALS := [0-9a-f]{12}$")
        (self.folder / "a.tsv").touch()
        self.assertEqual(content(), before)
        (self.folder / "a.tsv").write_text("y")
        self.assertNotEqual(content(), before)

    def test_sets_and_parts_are_exchanged_for_the_case(self):
        self.assert_lines({"LANDMARKS": f"{self.folder}/a.tsv"}, "prior_set := invivo", "override MATERIALS := runs/average/identified.tsv")
        self.assertIn("SUPINE: phantom is", self.refusal(SUPINE="phantom", MR="x.nrrd"))
        self.assertEqual(self.refusal(SUPINE="phantom"), "")
        self.assert_lines({"LEAVE_OUT": "no-skin no-gland"}, "override HEXMESH_OPTIONS += --skin 0",
                          "override MATERIALS := runs/average/fat-only.tsv",
                          f"override whole_set := {self.pipelines}/materials/invivo.tsv")
        self.assertFalse([line for line in self.lines(LEAVE_OUT="no-skin") if "PRONE" in line.split(":=")[0].split()])
        self.assert_lines({"LEAVE_OUT": "no-gland", "SUPINE": f"{self.folder}/a.nrrd"}, "override whole_set := runs/average/identified.tsv")

    def test_a_target_is_refused_if_the_case_cannot_have_it(self):
        def refused(goal, **given):
            self.request.goals = ["chain", goal]
            return self.refusal(**given)
        self.assertEqual(refused("tables"), "")
        self.assertIn("tables: needs a tumour", refused("tables", MR="x.nrrd"))
        self.assertIn("truth: a scan has no truth", refused("truth", MR="x.nrrd"))
        self.assertEqual(refused("budget"), "", "PRESET is paper unless given")
        self.assertIn("give PRESET=paper", refused("budget", PRESET="average"))
        self.assertIn("with PAPER=1", refused("truth", PRESET="average", PAPER="1"))
        self.assertIn("give CLUSTER=slurm", refused("cohort-script"))
        self.assertEqual(refused("cohort-script", CLUSTER="slurm"), "")
        self.request.installed = True
        self.assertIn("needs the source tree", refused("budget"))


class Rows(unittest.TestCase):
    def test_become_assignments_and_a_template(self):
        text = rows_for_make(parse_table("a\tb\nx y\t-\n", "t.tsv"), "rule")
        self.assertEqual(text.split(LINE_END), ["cell_a := x y", "cell_b := ", "$(eval $(value rule))", ""])
        with self.assertRaises(BreastError):
            rows_for_make(parse_table("a\n$(shell x)\n", "t.tsv"), "rule")


if __name__ == "__main__":
    unittest.main()
