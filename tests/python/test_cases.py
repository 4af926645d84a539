# SPDX-License-Identifier: GPL-3.0-or-later
"""What the pipeline reads before it runs a case: case files, the record of the scan to which a folder belongs, cohorts, studies, and
scripts for Slurm; and what it does with a case that fails."""
import os
import random
import re
import subprocess
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import small_run
from breast.cases.attempt import attempt
from breast.cases.case_file import parse_case_file, read_case_file, setting_in
from breast.cases.case_run import is_done, reason_of, run_case
from breast.cases.cohort import CohortEntry, cohort_entries
from breast.cases.ladder import climb
from breast.cases.make_text import code_in, has_control
from breast.cases.scan_identity import mixed_up, remember_scan
from breast.cases.slurm import SlurmRequest, slurm_plan
from breast.cases.study_rules import StudyRules, chain_rules
from breast.cases.variants import Studies, StudyBase
from breast.errors import BreastError
from in_folder import CODE, InFolder, reason

KEYS = ("MR", "SIDE", "PRESET", "HEXMESH_OPTIONS", "ELEMENTS")


class CaseFiles(unittest.TestCase):
    def refusal(self, text):
        return reason(parse_case_file, text, "a.case", KEYS)

    def test_are_keys_and_values_with_comments(self):
        text = "# a patient\r\nMR = a/b.nrrd\nSIDE=right\t# from her\n\n  HEXMESH_OPTIONS =  --elements 8 --order 1  \n"
        self.assertEqual(parse_case_file(text, "a.case", KEYS),
                         {"MR": "a/b.nrrd", "SIDE": "right", "HEXMESH_OPTIONS": "--elements 8 --order 1"})
        self.assertEqual(setting_in(text, "SIDE"), "right")
        self.assertEqual(setting_in(text, "PRESET"), "")

    def test_are_refused_by_line_and_key(self):
        self.assertEqual(self.refusal("\nMRI = x"), "case file a.case, line 2: MRI is no setting of a case; did you mean MR?")
        for line in ("include other", "export X = 1", "SIDE := left", "SIDE ?= left", "= x"):
            self.assertIn("line 1: this line is not KEY = VALUE", self.refusal(line), line)
        self.assertIn("line 2: MR is given for the second time", self.refusal("MR = x\nMR = y"))
        for code in (*CODE, "#x"):
            self.assertIn("MR contains the character", self.refusal("MR = " + code), code)
        self.assertIn("control character", self.refusal("MR = a\x1eb"))
        self.assertIn("larger than 64 kB", self.refusal("#" * 70000))
        self.assertIn("can be read", reason(read_case_file, "/nowhere.case", KEYS))

    def test_nothing_that_make_reads_as_code_passes(self):
        """Random changes of a case file are refused by name, or give values without code that read the same again."""
        seed = "# a patient\nMR = scan.nrrd\nSIDE=right\t# hers\nHEXMESH_OPTIONS = --elements 8 --skin 1.5\n"
        some = random.Random(1)
        for _ in range(3000):
            text = list(seed)
            for _ in range(some.randint(1, 6)):
                at = some.randrange(len(text))
                text[at:at + some.randint(0, 2)] = some.choice(("$(x)", "`", ";", "\n", "=", "#", "\t", "\x1e", "\0", "é", "\udcff", "MR", ""))
            changed = "".join(text)
            try:
                found = parse_case_file(changed, "a.case", KEYS)
            except BreastError as error:
                self.assertTrue(str(error).startswith("case file a.case"))
                continue
            for key, value in found.items():
                self.assertFalse(code_in(value) or has_control(value), changed)
                self.assertEqual(setting_in(changed, key), value)


class ScanIdentity(InFolder):
    def test_knows_another_scan_and_side_whatever_its_name_and_times(self):
        for patient in "AB":
            (self.folder / patient).mkdir()
            (self.folder / patient / "1").write_text("slice-" + patient)
        run, a, b = self.folder / "run", str(self.folder / "A"), str(self.folder / "B")
        self.assertEqual(mixed_up(run, "left", a), "", "nothing is remembered yet")
        remember_scan(run, "left", a)
        self.assertEqual(mixed_up(run, "left", a), "")
        os.utime(self.folder / "A/1", (1, 1))
        self.assertEqual(mixed_up(run, "left", a), "", "touched, and still the same")
        self.assertIn("another scan", mixed_up(run, "left", b))
        self.assertIn("holds the left breast", mixed_up(run, "right", a))
        self.assertNotEqual(mixed_up(run, "left", "phantom:small"), "")
        self.assertEqual(mixed_up(run, "left", str(self.folder / "C")), "", "make says that it is not there")
        self.assertNotIn(str(self.folder), (run / ".scan").read_text())

    def test_one_of_two_runs_that_begin_at_once_has_the_folder(self):
        run = self.folder / "run"
        for name in "AB":
            (self.folder / name).write_text(name)
        remember_scan(run, "left", str(self.folder / "A"))
        self.assertIn("another scan", reason(remember_scan, run, "left", str(self.folder / "B")))
        remember_scan(run, "left", str(self.folder / "A"))
        self.assertEqual(os.listdir(run), [".scan"], "nothing else is left")

    def test_of_what_is_no_file_is_refused(self):
        self.assertIn("neither a file nor a folder", reason(remember_scan, self.folder / "run", "left", "/dev/zero"))

    def test_remembers_content_as_sha256sum_does(self):
        (self.folder / "scan.nrrd").write_text("abc")
        remember_scan(self.folder / "run", "left", str(self.folder / "scan.nrrd"))
        # printf abc | sha256sum | sha256sum
        self.assertIn("content\t3037103b5833a3a6a132fee525b05d963dd32445ffa08e9e2e7fd5342a04f332\n",
                      (self.folder / "run/.scan").read_text())


class Cohorts(InFolder):
    def test_are_found_checked_and_named_once(self):
        def refusal():
            return reason(cohort_entries, str(self.folder), KEYS)
        self.assertIn("holds no case", refusal())
        (self.folder / "a").mkdir()
        (self.folder / "a/case.txt").write_text("MR = x.nrrd\n")
        (self.folder / "b.case").write_text("PRESET = small\n")
        self.assertEqual([(one.name, one.kind) for one in cohort_entries(str(self.folder), KEYS)], [("a", "scan"), ("b", "phantom")])
        (self.folder / "a.case").write_text("MR = y.nrrd\n")
        self.assertIn("two case files are called a", refusal())
        (self.folder / "a.case").rename(self.folder / "c d.case")
        self.assertIn("c?d.case: a name with such characters is refused", refusal())
        (self.folder / "c d.case").rename(self.folder / "c.case")
        (self.folder / "c.case").write_text("SIDE = left\n")
        (self.folder / "d.case").write_text("MRI = left\n")
        self.assertIn("c.case: names neither MR nor PRESET", refusal())
        self.assertIn("did you mean MR?", refusal(), "all problems at once")


class CaseRuns(InFolder):
    def test_say_why_without_folders(self):
        for log, said in (
                ("make: *** No rule to make target '/secret/x.nrrd', needed by 'runs/n/labels.vtkhdf'.  Stop.\n",
                 "'x.nrrd', which a setting names, does not exist"),
                ("make[1]: Entering\nforward: no body in runs/n/supine.vtkhdf\nforward: give up\nmake: *** [x] Error 3\n",
                 "forward: give up"),
                ("forward: no body in runs/n/supine.vtkhdf\n", "forward: no body in n/supine.vtkhdf"),
                ("make[2]: *** pipelines/x.mk:3: *** SIDE: 'a' is none.  Stop.\n", "pipelines/x.mk:3: *** SIDE: 'a' is none"),
                ("", "")):
            self.assertEqual(reason_of(log, "runs"), said)

    def test_keep_what_became_of_the_case(self):
        status, log = self.folder / "n.status", self.folder / "n.log"
        scan, phantom = CohortEntry("n", "n.case", "scan"), CohortEntry("n", "n.case", "phantom")
        self.assertTrue(run_case(self.folder, scan, ["sh", "-c", "echo forward: no body; exit 3", "summary"]))
        self.assertEqual(status.read_text(), "failed\tforward: no body\n")
        self.assertFalse(is_done(status))
        self.assertTrue(run_case(self.folder, phantom, ["echo", "made", "summary"]))
        self.assertEqual(log.read_text(), "made phantom-scan\nmade summary\n", "its phantom's scan first")
        self.assertTrue(is_done(status))
        self.assertFalse(run_case(self.folder, scan, ["sh", "-c", "kill -TERM $$"]))
        self.assertIn("stopped by a signal", status.read_text())


class Attempts(InFolder):
    def test_keep_the_reason_of_a_solve_that_ends_early(self):
        report = self.folder / "supine.json"

        def solve(script, inputs=()):
            return reason(attempt, report, inputs, ["sh", "-c", script])
        (self.folder / "supine.vtkhdf").write_text("of an earlier attempt")
        self.assertEqual(solve(f"echo '{{\"reason\": \"folded\"}}' > {report}; exit 3"), "")
        self.assertIn("folded", report.read_text())
        self.assertFalse((self.folder / "supine.vtkhdf").exists())
        self.assertIn("exit code 3", solve("exit 3"), "not even a report")
        self.assertIn("exit code 2", solve(f"echo x > {report}; exit 2"))
        self.assertEqual(solve("true"), "")
        self.assertIn('"ok"', report.read_text(), "of somebody else's program")
        (self.folder / "reference.json").write_text("no body")
        self.assertEqual(solve("exit 1", [self.folder / "reference.vtkhdf"]), "")
        self.assertEqual(report.read_text(), "no body", "what needed it has the same reason")


class Ladders(InFolder):
    def test_end_at_the_first_rung_that_is_good_enough(self):
        def judge(folder, point, coarser, wanted):
            """The first point has no solution, the last meets the bound."""
            self.assertEqual((folder, wanted), (self.folder / "studies/cost", 0.5))
            return None if point.endswith("-4") else [point, coarser, "-", "-", "1", "yes" if point.endswith("-8") else "no"]

        def up(*points):
            with mock.patch("breast.study.cost.accuracy_row", judge):
                return climb(self.folder, 0.5, points, ["true"])
        self.assertEqual(up("q1p0-dome-4", "q2p1-dome-6", "q1p0-dome-8", "q1p0-dome-10"),
                         "point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n"
                         "q2p1-dome-6\t\t\t\t1\tno\nq1p0-dome-8\tq2p1-dome-6\t\t\t1\tyes\n")
        self.assertEqual((self.folder / "accuracy.mk").read_text(), "ELEMENTS := 8\nELEMENT := q1p0\n")
        self.assertIn("not met", up("q2p1-dome-6"))
        self.assertEqual((self.folder / "accuracy.mk").read_text(), "ELEMENTS := 6\nELEMENT := q2p1\n")
        self.assertIn("no mesh of the ladder", reason(up, "q1p0-dome-4"))


CHAIN = """
# ---- the chain -----
$(RUN)/labels.vtkhdf $(RUN)/points.vtp &: $(MR_FILES) $(SEGMENT) $(call changed,labels)
	@record
	$(call stage,labels) $(SEGMENT) $(MR) $(RUN)/labels.vtkhdf --points $(RUN)/points.vtp $(labels_options) $(common_alone)
$(RUN)/mesh.vtkhdf: $(RUN)/labels.vtkhdf $(HEXMESH) $(MADE_TUMOUR) $(call changed,mesh)
	$(call stage,mesh) $(HEXMESH) $< $@ $(mesh_options) $(common_alone)

# Two files.
$(RUN)/reference.vtkhdf: $(RUN)/mesh.vtkhdf $(RUN)/labels.vtkhdf $(BACKWARD) $(MADE_MATERIALS) $(call changed,reference)
	$(call stage,reference) $(BACKWARD) $(wordlist 1,2,$^) $@ $(reference_options) $(common)
$(RUN)/supine.vtkhdf: $(RUN)/reference.vtkhdf $(FORWARD) $(MADE_MATERIALS) $(call changed,supine)
	$(call stage,supine) $(FORWARD) $< $@ --posture supine $(supine_options) $(common)
# ---- the end of the chain -----
other: rule
	$(call stage,other) nothing
"""


def studies():
    return Studies(StudyBase("run", list(chain_rules(CHAIN)), "supine",
                             {"hexmesh": "--elements 16", "mechanics": "--materials seed --element q1p0", "materials": "seed",
                              "content": "1"}, {"RUN": "run", "tumour": "{tumour}"}))


def rules_of(made, tumour=True):
    variables = {"hexmesh": "HEXMESH_OPTIONS", "mechanics": "MECHANICS", "materials": "MATERIALS", "content": "content_MATERIALS"}
    return StudyRules(made, chain_rules(CHAIN), variables, "run", tumour, "tabulate place").text()


def expanded(table, tumour=True):
    made = studies()
    made.add("own", table, "own.tsv")
    return rules_of(made, tumour)


class Remembered(InFolder):
    def test_a_stage_may_have_settings_or_none(self):
        """In a rule of make as in all makefiles; without settings the times of its files alone decide."""
        (self.folder / "Makefile").write_text(
            f"BIN := {small_run.programs}\nRUN := .\nquoted = '$1'\nwith_settings := a b\ninclude {small_run.source}/pipelines/remember.mk\n"
            "all:\n\t$(call stage,with) touch one\n\t$(call stage,without) touch $@\n")
        subprocess.run(["make", "all"], cwd=self.folder, check=True, capture_output=True)
        self.assertEqual((self.folder / ".with.settings").read_text().strip(), "a b")
        self.assertTrue((self.folder / "one").exists() and (self.folder / "all").exists())


class Variants(unittest.TestCase):
    def test_have_the_rules_of_the_chain_in_their_folders(self):
        text = expanded("# why\nvariant\tfrom\tstarts_at\tends_at\thexmesh\tmechanics\tmaterials\tif\n"
                        "soft\t-\treference\tsupine\t-\t+--scale fat=50\t{RUN}/own.tsv\t-\n"
                        "fine\tsoft\tmesh\treference supine\t--tumour {tumour}:0.1\t-\t-\tsoft\n")
        for line in ("own_variants := soft fine", "V := $(RUN)/studies/own/soft",
                     "$V/%: private override MECHANICS := --materials run/own.tsv --element q1p0 --scale fat=50",
                     "$V/%: private override MATERIALS := run/own.tsv",
                     "$V/reference.json: $(RUN)/mesh.vtkhdf $(RUN)/labels.vtkhdf $(BACKWARD) $(RUN)/own.tsv $$(call changed_in,$$(@D),reference)",
                     "\t$(call attempt,reference,$(RUN)/mesh.vtkhdf $(RUN)/labels.vtkhdf) $(BACKWARD) $(RUN)/mesh.vtkhdf $(RUN)/labels.vtkhdf "
                     "$(@D)/reference.vtkhdf $(reference_options) $(common)",
                     "# fine: from own/soft, at mesh",
                     "$V/%: private override HEXMESH_OPTIONS = --tumour $$(tabulate place run/mesh.json tumour):0.1",
                     "$V/mesh.json: $(RUN)/labels.vtkhdf $(HEXMESH) $(MADE_TUMOUR) $(RUN)/mesh.vtkhdf $(RUN)/studies/own/soft/supine.json "
                     "$$(call changed_in,$$(@D),mesh)",
                     "$(RUN)/studies/own.tsv: $(RUN)/studies/own/soft/supine.json $(RUN)/studies/own/fine/reference.json "
                     "$(RUN)/studies/own/fine/supine.json $(BIN)/tabulate"):
            self.assertIn(line + "\n", text)
        self.assertNotIn("HEXMESH_OPTIONS := --elements 16", text, "what the case has is not said again")
        self.assertIn("$(error own/fine: this variant needs a tumour", expanded(
            "variant\tstarts_at\thexmesh\nfine\tmesh\t--tumour {tumour}\n", False))

    def test_say_which_options_a_cell_without_plus_leaves_out(self):
        text = expanded("variant\tfrom\tstarts_at\thexmesh\tmechanics\n"
                        "soft\t-\treference\t-\t--scale fat=50\n"
                        "kept\t-\treference\t-\t+--scale fat=50\n"
                        "both\tkept\tmesh\t--tumour none\t--materials other --element=q2p1\n"
                        "all\t-\tmesh\t--elements 20\t--element q2p1 --materials other\n")
        end = " (a + at the beginning of the cell keeps it)"
        self.assertIn(f"own_drops = $(info own/soft leaves out of the case mechanics: --materials seed --element q1p0{end}) "
                      f"$(info own/both leaves out of studies/own/kept hexmesh: --elements 16; mechanics: --scale fat=50{end})\n", text)

    def test_replace_options_of_the_same_name(self):
        text = expanded("variant\tfrom\tstarts_at\thexmesh\tmechanics\n"
                        "fine\t-\tmesh\t+--elements 20\t+--element q2p1 --scale fat=50\n"
                        "soft\tfine\treference\t-\t+--scale skin=10 --scale fat=25\n")
        for line in ("HEXMESH_OPTIONS := --elements 20", "MECHANICS := --materials seed --element q2p1 --scale fat=50",
                     "MECHANICS := --materials seed --element q2p1 --scale skin=10 --scale fat=25"):
            self.assertIn(line + "\n", text)

    def test_come_from_rows_of_other_studies(self):
        made = studies()
        made.add("scaled", "variant\tstarts_at\tmechanics\nx\treference\t+--a\n", "scaled.tsv")
        made.add("again", "variant\tfrom\tstarts_at\tmechanics\ny\tscaled/x\tsupine\t+--b\nz\t-\tsupine\t+--c\n", "again.tsv", "scaled/x")
        text = rules_of(made)
        for row, options in (("y", "--a --b"), ("z", "--a --c")):
            self.assertIn(f"V := $(RUN)/studies/again/{row}\n$V/%: private override MECHANICS := --materials seed --element q1p0 {options}\n"
                          "$V/supine.json: $(RUN)/studies/scaled/x/reference.json $(FORWARD)", text)

    def test_a_material_set_is_known_by_its_content(self):
        with tempfile.TemporaryDirectory() as folder:
            own = Path(folder) / "own.tsv"
            own.write_text("a")
            table = f"variant\tstarts_at\tmaterials\nx\treference\t{own}\n"
            first = expanded(table)
            own.write_text("b")
            self.assertIn("private override content_MATERIALS := ", first)
            self.assertNotEqual(expanded(table), first)
            made = Studies(StudyBase(folder, list(chain_rules(CHAIN)), "supine", {"mechanics": "", "materials": "seed", "content": "1"}))
            made.add("own", table, "own.tsv")
            self.assertEqual(made.variants[f"{folder}/studies/own/x"].options["content"], "", "of a file that a rule makes")

    def test_are_refused_by_column_stage_and_row(self):
        for table, said in (
                ("variant\tstarts_at\tmechanic\nx\tmesh\t-\n",
                 "'mechanic' is none of variant, starts_at, ends_at, from, given, if, hexmesh, mechanics, materials, content; did you mean "
                 "mechanics?"),
                ("variant\tstarts_at\nx\t-\n",
                 "x does not say in the column starts_at at which stage it begins; write one of labels, mesh, reference, supine"),
                ("variant\tfrom\tstarts_at\nx\ty\tmesh\n",
                 "x comes from 'y', and no row above has this name; write the row from which it comes above it"),
                ("variant\tif\tstarts_at\nx\ty{RUN}\tmesh\n",
                 "x depends on 'y{RUN}', and no row above has this name; write that row above it"),
                ("variant\tstarts_at\tfrom\nx\tmesh\n",
                 "x has 2 cells and not 3; separate cells by one tab, and write - for an empty one"),
                ("variant\tstarts_at\nx\tmesh cc\n", "'mesh cc' is none of labels, mesh, reference, supine"),
                ("variant\tstarts_at\tmechanics\nx\tmesh\ta\vSHELL := b\r\n", "x holds a control character")):
            self.assertEqual(reason(expanded, table), "own.tsv: " + said)
        self.assertIn("did you mean reference?", reason(expanded, "variant\tstarts_at\nx\trefference\n"))
        for name in ("x", "a/b", "a b", "-"):
            self.assertIn("is no name of a row of its own", reason(expanded, f"variant\tstarts_at\nx\tmesh\n{name}\tmesh\n"), name)
        for code in ("$(shell x)", "`x`", "; x", "{MR}", "{shell}"):
            self.assertIn("may not stand in a study, because make or a shell would read it as code; write the cell without it ({NAME} is "
                          "one of RUN, tumour)", reason(expanded, f"variant\tstarts_at\tmechanics\nx\tmesh\t{code}\n"), code)

    def test_nothing_that_make_reads_as_code_passes(self):
        seed = ("# why\nvariant\tfrom\tstarts_at\tends_at\tmechanics\tif\nsoft\t-\treference\tsupine\t+--scale fat=50\t-\n"
                "fine\tsoft\tmesh\t-\t{RUN}/own.tsv\tsoft\n# rows 2\n")
        some = random.Random(2)
        for _ in range(3000):
            text = list(seed)
            for _ in range(some.randint(1, 6)):
                at = some.randrange(len(text))
                text[at:at + some.randint(0, 2)] = some.choice(("$(x)", "`", "{RUN}", "\n", "\t", "+", "#", "\r", "\x1e", "é", "-", "mesh"))
            try:
                text = expanded("".join(text))
            except BreastError as error:
                self.assertTrue(str(error).startswith("own.tsv"), error)
                continue
            for value in re.findall("private override .* :?= (.*)", text):
                self.assertFalse(code_in(value) or has_control(value), value)
            self.assertFalse(has_control(re.sub("[\n\t]", "", text)))


class Slurm(InFolder):
    def test_scripts_ask_for_what_the_largest_case_needs(self):
        case, listed, cost = self.folder / "a.case", self.folder / ".cases", self.folder / "assumed.tsv"
        cost.write_text("element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\n")
        case.write_text("MR = x.nrrd\n  ELEMENTS = 32\n")
        listed.write_text(f"a\t{case}\tscan\n")
        request = SlurmRequest(self.folder, Path("patients"), "/opt/it's/cases", ["make"], cost)
        plan = slurm_plan(request)
        for text in ("# sbatch --array=0-0 ", "\n#SBATCH --time=165\n", "ELEMENTS=32", "'/opt/it'\\''s/cases' task "):
            self.assertIn(text, plan)
        self.assertNotIn("--partition", plan)
        # As large as a case file may be: blanks, and more elements than hexmesh makes.
        case.write_text(" " * 60000 + "\nELEMENT=q2p1\n  ELEMENTS = " + "9" * 400 + "\n")
        cost.write_text("element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\nq2p1\t64\t600\t380\n")
        self.assertIn("\n#SBATCH --time=35\n", slurm_plan(request))
        case.write_text("ELEMENTS = 1e9\n")
        self.assertIn("q1p0, ELEMENTS=64: ", slurm_plan(request))
        request.partition, request.time = "long", "2:00:00"
        plan = slurm_plan(request)
        for text in ("\n#SBATCH --partition=long\n", "\n#SBATCH --time=2:00:00\n", "; time as asked"):
            self.assertIn(text, plan)
        listed.write_text("a\tb\n")
        self.assertIn("is no case", reason(slurm_plan, request))

    def test_the_cost_of_a_cohort_counts_when_three_cases_are_done(self):
        case = self.folder / "a.case"
        case.write_text("MR = x.nrrd\n")
        (self.folder / ".cases").write_text(f"a\t{case}\tscan\n")
        (self.folder / "cost.tsv").write_text("case\telements\twall_seconds\tcpu_seconds\tpeak_mb\n"
                                              "a\t4000\t9\t600\t400\nb\t4000\t9\t60\t800\nc\t4000\t9\t60\t40\n\r\n")
        (self.folder / "assumed.tsv").write_text("element\telements\tcpu_seconds\tpeak_mb\nq1p0\t16\t200\t380\n")
        plan = slurm_plan(SlurmRequest(self.folder, Path("patients"), "cases", ["make"], self.folder / "assumed.tsv"))
        for text in ("#SBATCH --time=35\n", "#SBATCH --mem=1456M\n", "the most expensive of 3 cases in cost.tsv: 600 seconds, 800 MB"):
            self.assertIn(text, plan)


if __name__ == "__main__":
    unittest.main()
