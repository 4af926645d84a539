# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of a run: what is refused before make expands anything, and what a case cannot have."""
import os
import unittest

from breast.cases.scan_identity import remember_scan
from breast.cases.settings import case_file_for_make, check_case, check_given
from in_folder import CODE, StandingInFolder, reason

SETTINGS = """# what they are
setting kind of choices may_hold
MR path case - -
MATERIALS path case set -
LANDMARKS path case - -
CHEST_WALL path case - -
FAT path case - -
SUPINE path case - -
MAMMOGRAMS path case - -
SIDE name case left|right -
CASE name case - -
PRESET name case average|paper -
WALL name case held|slide:% :
PAPER name case 1 -
REDUCTION name case number|1|95 -
TUMOUR name case auto|none|place :
ELEMENTS name case integer|4|64 -
MECHANICS text case - -
FORWARD program command - -
CLUSTER name command local|slurm -
CHROMIUM words command - -
CASE_FILE name command - -
COST_POINTS words command rows:cost -
RUNS name command - -
RUN name command - -
"""
HOSTILE = (*CODE, "a\nb")


class Settings(StandingInFolder):
    def setUp(self):
        super().setUp()
        self.pipelines = self.folder / "pipelines"
        for name in ("materials", "studies"):
            (self.pipelines / name).mkdir(parents=True)
        (self.pipelines / "settings.tsv").write_text(SETTINGS.replace(" ", "\t").replace("|", " "))
        (self.pipelines / "goals.tsv").write_text("goal\tneeds\ntables\tpaper tumour\ntruth\ttruth\nbudget\tpaper truth held source\n"
                                                  "cohort\tany\ncohort-script\tslurm any\nerrors-tables\tdemo source\n")
        for name in ("invivo", "seed2008"):
            (self.pipelines / f"materials/{name}.tsv").write_text("tissue\tc\nfat\t1\n")
        for name in ("a.tsv", "a.nrrd"):
            (self.folder / name).write_text("x")
        (self.pipelines / "studies/cost.tsv").write_text("variant\tstarts_at\nfine\tmesh\n")

    def refused_text(self, environment=None, **given):
        return reason(check_given, self.pipelines, given, environment or {})

    def refusal(self, maker=0, **values):
        """What is said of the phantom `average` with other values."""
        usual = {"RUNS": "runs", "RUN": "runs/average", "CASE": "average", "PRESET": "average", "SIDE": "left", "phantom": "yes",
                 "body_slides": "yes", "goals": "chain", "given": " ".join(values)}
        if "MR" in values:
            usual["phantom"] = ""
        return reason(check_case, self.pipelines, maker, usual | values)

    def test_unknown_names_are_refused_with_a_suggestion(self):
        self.assertEqual(self.refused_text(SIDES="left"),
                         "SIDES is not a setting; did you mean SIDE? (`make -f Makefile.pipeline help` lists all settings)")
        self.assertEqual(self.refused_text({"SIDES": "left"}), "", "other programs have their own in the environment")

    def test_text_that_is_code_is_refused_for_every_kind(self):
        for code in HOSTILE:
            for name in ("MR", "MECHANICS", "FORWARD", "share"):
                self.assertIn("may not stand in it", self.refused_text(**{name: code}), (name, code))
        for name in ("a=b", "a:b", "a%b", "a~b"):
            self.assertIn("the character " + name[1], self.refused_text(MR=name))
            self.assertEqual(self.refused_text(MECHANICS=name), "", "no harm in options")
        self.assertIn("blanks may not stand in 'a b'", self.refused_text(MR="a b"))
        self.assertIn("write ./-x", self.refused_text(MR="-x"))
        self.assertEqual(self.refused_text(TUMOUR="-5,3,2:4"), "")
        self.assertNotEqual(self.refused_text(TUMOUR="5:4=x"), "", "after a character that it may contain")
        self.assertNotEqual(self.refused_text({"MR": "$(shell x)"}), "", "make reads the environment, too")
        self.assertEqual(self.refused_text({"MR": "$(shell x)"}, MR="x"), "", "which the command line overrides")
        self.assertEqual(self.refused_text({"CHROMIUM": "a 'b'", "PATH": "$x"}), "")

    def test_what_a_script_lost_is_not_another_case(self):
        for name in ("MR", "CASE", "CASE_FILE", "RUNS"):
            self.assertIn(name + ": is empty; ", self.refused_text(**{name: ""}))
        self.assertIn("RUNS: is empty", self.refused_text({"RUNS": ""}))
        self.assertEqual(self.refused_text({"MR": ""}, SIDE=""), "")
        self.assertIn("CASE: is empty", self.refusal(CASE=""))

    def test_values_are_refused_with_what_is_accepted(self):
        for given, said in (
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
                      {"MATERIALS": str(self.pipelines / "materials/invivo.tsv")}, {"TUMOUR": str(self.pipelines / "settings.tsv")},
                      {"MATERIALS": "runs/average/identified.tsv"}):
            self.assertEqual(self.refusal(**given), "", given)

    def test_a_folder_is_that_of_one_scan_and_of_one_process(self):
        for name in ("..", ".x", "a/b"):
            self.assertIn("CASE: ", self.refusal(CASE=name), name)
        (self.folder / "scan.nrrd").write_text("abc")
        run = self.folder / "run"
        remember_scan(run, "left", str(self.folder / "scan.nrrd"))
        self.assertIn("another scan", self.refusal(RUN=str(run)))
        self.assertEqual(self.refusal(RUN=str(run), goals="cohort"), "", "not about the case in RUN")
        self.assertEqual(self.refusal(RUN=str(run), MR=str(self.folder / "scan.nrrd")), "")
        self.assertEqual(self.refusal(os.getpid(), RUN=str(self.folder / "mine")), "")
        self.assertTrue((self.folder / f"mine/.running/{os.getpid()}").exists())

    def test_a_case_file_is_a_makefile_of_checked_values(self):
        file = self.folder / "a.case"
        file.write_text("REDUCTION = 40\nSIDE = right  # of the patient\nMECHANICS = --a 1\n")
        made = case_file_for_make(self.pipelines, str(file), self.folder / "made")
        self.assertEqual(made.read_text().splitlines()[1:], ["REDUCTION := 40", "SIDE := right", "MECHANICS := --a 1"])
        self.assertEqual(made, case_file_for_make(self.pipelines, str(file), self.folder / "made"))
        for text, said in (("MR = a b.nrrd\n", "blanks"), ("MR =\n", "MR: is empty"), ("MR = a=b\n", "the character ="),
                           ("FORWARD = /bin/sh\n", "is no setting of a case")):
            file.write_text(text)
            self.assertIn(said, reason(case_file_for_make, self.pipelines, str(file), self.folder / "made"))

    def test_files_and_programs_that_are_not_there_are_refused_by_name(self):
        self.assertIn("CHEST_WALL: 'none.vtp' does not exist", self.refusal(CHEST_WALL="none.vtp"))
        self.assertIn("FAT: 'none.nrrd' does not exist", self.refusal(FAT="none.nrrd"))
        self.assertIn("LANDMARKS: 'b.tsv' does not exist", self.refusal(LANDMARKS=f"{self.folder}/a.tsv,b.tsv"))
        self.assertIn("MAMMOGRAMS: 'b.dcm' does not exist", self.refusal(MAMMOGRAMS=f"{self.folder}/a.tsv,b.dcm"))
        self.assertIn(f"MAMMOGRAMS: '{self.folder}/a.tsv' is not CC.dcm,MLO.dcm", self.refusal(MAMMOGRAMS=f"{self.folder}/a.tsv"))
        self.assertEqual(self.refusal(CHEST_WALL="runs/made-later.vtp"), "")
        self.assertIn("FORWARD: '/no/such' is no program that can be run", self.refusal(FORWARD="/no/such"))
        self.assertEqual(self.refusal(FORWARD="/no/such", given=""), "", "that of a tree that is not built yet")
        self.assertEqual(self.refusal(FORWARD="/bin/sh -e"), "")
        self.assertIn("SUPINE: phantom is", self.refusal(SUPINE="phantom", MR="x.nrrd"))
        self.assertEqual(self.refusal(SUPINE="phantom"), "")

    def test_a_target_is_refused_if_the_case_cannot_have_it(self):
        def refused(goal, **given):
            return self.refusal(goals="chain " + goal, **given)
        self.assertEqual(refused("tables"), "")
        self.assertIn("tables: needs a tumour", refused("tables", no_tumour="yes"))
        self.assertIn("truth: a scan has no truth", refused("truth", MR="x.nrrd"))
        self.assertEqual(refused("budget", PRESET="paper", body_slides=""), "")
        self.assertIn("give PRESET=paper", refused("budget"))
        self.assertIn("with PAPER=1", refused("truth", PAPER="1"))
        self.assertIn("give CLUSTER=slurm", refused("cohort-script"))
        self.assertEqual(refused("cohort-script", CLUSTER="slurm"), "")
        for other in ({}, {"ELEMENTS": "16"}, {"ELEMENTS": "10", "PRESET": "paper"}, {"ELEMENTS": "10", "MR": "x.nrrd"}):
            self.assertIn("errors-tables: is about the demonstration", refused("errors-tables", **other))
        self.assertEqual(refused("errors-tables", ELEMENTS="10"), "")
        self.assertIn("needs the source tree", refused("budget", installed="yes"))


if __name__ == "__main__":
    unittest.main()
