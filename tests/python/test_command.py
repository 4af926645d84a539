# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `breast`: names for make and their links, what was asked for, and programs that cannot write."""
import contextlib
import io
import os
import subprocess
import tempfile
import unittest
import unittest.mock
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import small_run
from breast.command import scan_run
from breast.command.assumed import Series, series_of, side_of, tumour_beside, tumour_position
from breast.command.commands import unknown_command
from breast.command.make_name import name_for_make, plain_for_make, plain_name
from breast.command.request import parse_request
from breast.errors import BreastError
from in_folder import StandingInFolder

LINKS = Path("runs/.names")


def touch(name):
    Path(name).parent.mkdir(parents=True, exist_ok=True)
    Path(name).write_text("scan")


class MakeNames(StandingInFolder):
    """In a folder of their own, as a caller is."""

    def test_plain_names(self):
        for name in ("scan.nrrd", "/data/a-b_c.1/scan@2,3+4", "été.nrrd", "乳房/画像.nii.gz"):
            self.assertTrue(plain_for_make(name), name)
        for name in (*(f"a{c}b" for c in " '\"()=:%$`;|&<>*?[]{}#\\!^~\n\t"), "-a", "", os.fsdecode(b"\xe9t\xe9"), os.fsdecode(b"\xc0\xaf")):
            self.assertFalse(plain_for_make(name), name)

    def test_every_name_has_a_plain_one(self):
        for name, plain in (("my scan (1).nrrd", "my_scan__1_.nrrd"), ("été 2.nrrd", "été_2.nrrd"), (os.fsdecode(b"\xe9.nrrd"), "_.nrrd"),
                            ("-x", "_x")):
            self.assertEqual(plain_name(name), plain)

    def test_plain_files_are_named_as_given(self):
        touch("scan.nrrd")
        touch("sub/scan.nrrd")
        for name in ("scan.nrrd", "sub/scan.nrrd"):
            self.assertEqual(name_for_make(name, LINKS), name)
        self.assertEqual(name_for_make("sub/", LINKS), "sub")
        self.assertFalse(Path("runs").exists())
        with self.assertRaises(BreastError):
            name_for_make("missing.nrrd", LINKS)

    def test_links_lead_to_the_file(self):
        strange = "my scan [a]'s.nrrd"
        touch(strange)
        name = name_for_make(strange, LINKS)
        self.assertTrue(plain_for_make(name), name)
        self.assertEqual(Path(name).name, "my_scan__a__s.nrrd")
        self.assertTrue(os.path.samefile(name, strange))
        self.assertEqual(name_for_make("./" + strange, LINKS), name, "the same for the same file")
        touch("other/" + strange)
        self.assertNotEqual(name_for_make("other/" + strange, LINKS), name, "another for another")

    def test_detached_headers_keep_their_data_beside_them(self):
        touch("my scans/scan.nhdr")
        touch("my scans/scan.raw")
        name = name_for_make("my scans/scan.nhdr", LINKS)
        self.assertTrue(plain_for_make(name), name)
        self.assertTrue((Path(name).parent / "scan.raw").exists())
        touch("my scan.mhd")
        with self.assertRaises(BreastError):
            name_for_make("my scan.mhd", LINKS)

    def test_folders_of_slices(self):
        touch("series 1/IM (1).dcm")
        touch("series 1/IM_2.dcm")
        name = name_for_make("series 1", LINKS)
        self.assertEqual(Path(name).name, "series_1")
        self.assertEqual(len([file for file in Path(name).iterdir() if plain_for_make(str(file)) and file.is_file()]), 2)
        os.remove("series 1/IM_2.dcm")
        name_for_make("series 1", LINKS)
        self.assertEqual(len(os.listdir(name)), 1, "a slice that went is gone")
        touch("plain/IM_1.dcm")
        self.assertEqual(name_for_make("plain", LINKS), "plain")


class Requests(unittest.TestCase):
    def test_options_and_settings(self):
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            touch("A=b.nrrd")
            r = parse_request("run", ["A=b.nrrd", "--side", "right", "TUMOUR=-60,-40,12", "--runs", "/data", "REDUCTION=40", "--jobs", "2"])
        self.assertEqual((r.scan, r.side, r.runs, r.jobs, r.target), ("A=b.nrrd", "right", "/data", 2, "summary page"))
        self.assertEqual(r.settings, {"REDUCTION": "40", "TUMOUR": "-60,-40,12"})
        self.assertEqual(parse_request("demo", ["PRESET=paper"]).settings, {"PRESET": "paper"})
        self.assertEqual(parse_request("cohort", ["patients"]).target, "cohort")

    def test_a_page_is_of_a_scan_or_of_the_demonstration(self):
        r = parse_request("page", ["scan", "--side", "left", "REDUCTION=40"])
        self.assertEqual((r.scan, r.side, r.target, r.settings), ("scan", "left", "page", {"REDUCTION": "40"}))
        r = parse_request("page", ["PRESET=slim"])
        self.assertEqual((r.scan, r.target, r.settings), ("", "page", {"PRESET": "slim"}))
        self.assertEqual(parse_request("page", ["scan"]).side, "")

    def test_of_a_cluster(self):
        r = parse_request("cohort", ["patients", "--slurm", "--partition", "long", "--time", "2:00:00", "--cores", "2", "--memory", "900",
                                     "--account", "a", "--resume"])
        self.assertTrue(r.slurm)
        self.assertEqual(r.settings, {"CLUSTER": "slurm", "CLUSTER_ACCOUNT": "a", "CLUSTER_CORES": "2", "CLUSTER_MEMORY": "900",
                                      "CLUSTER_PARTITION": "long", "CLUSTER_TIME": "2:00:00", "RESUME": "1"})
        self.assertEqual(parse_request("cohort", ["patients", "--local"]).settings, {})

    def test_what_is_wrong_is_said(self):
        for words, said in (
                ("run scan CASE=a", "--side left|right is missing: CASE is of one breast"),
                ("run scan --target ''", "not the name of a target"),
                ("run --side left", "SCAN is missing"),
                ("run scan --side lefft", "did you mean 'left'"),
                ("run scan --sid left", "did you mean '--side'"),
                ("run scan more --side left", "'more' is one argument too many"),
                ("run scan --side left SIDE=right", "contradict"),
                ("run scan --side left PRESET=a PRESET=b", "PRESET is given twice"),
                ("run scan --side left RUNS=x", "--runs DIR"),
                ("run scan --side left MR=x", "MR is not a setting here"),
                ("run scan --side left --target a/b", "not the name of a target"),
                ("run scan --side left --jobs 0", "--jobs 0"),
                ("demo scan.nrrd", "one argument too many"),
                ("demo MR=scan.nrrd", "breast run SCAN"),
                ("cohort patients --slurm --local", "contradict"),
                ("cohort patients --time 5", "give --slurm"),
                ("cohort patients --slurm --jobs 2", "give --cores"),
                ("cohort patients --slurm --time 5 CLUSTER_TIME=6", "both given"),
                ("run scan --side left --slurm", "--slurm"),
                ("cohort", "DIR is missing")):
            command, *rest = words.split()
            with self.assertRaisesRegex(BreastError, said.replace("|", r"\|")) as refused:
                parse_request(command, rest)
            self.assertEqual(refused.exception.exit_code, 2)

    def test_nearest_commands(self):
        here = SimpleNamespace(tools={"forward": "", "backward": "", "segment": ""})
        self.assertEqual(unknown_command(here, "segmnt"), "'segmnt' is no command, tool or setting; did you mean 'segment'?")
        self.assertIn("'demo'", unknown_command(here, "dem"))
        self.assertIn("`breast help` lists them", unknown_command(here, "xyzzy"))

    def test_it_is_said_whose_stages_follow(self):
        """The stages of both sides have the same names."""
        asked = (["make"], "runs/x", "")
        for words, expected in (("scan", "left segments right segments left makes right makes"), ("scan --side left", "makes")):
            said = []
            with unittest.mock.patch.multiple(scan_run, asked_of_make=lambda *_: asked, make_run=lambda *_: said.append("makes") or 0,
                                              run_child=lambda *_: said.append("segments") or 0, show_results=lambda *_: None,
                                              print=lambda words, **_: said.append(words.split()[-2]), create=True), \
                    unittest.mock.patch.object(scan_run.sys, "stdout", io.StringIO()):
                self.assertEqual(scan_run.run_scan(SimpleNamespace(), parse_request("run", [*words.split(), "TUMOUR=none"])), 0)
            self.assertEqual(" ".join(said), expected)


class Assumed(StandingInFolder):
    """What is found beside a scan."""

    def test_the_page_of_what_failed_is_named_if_it_is_of_this_run(self):
        """Plates that do not hold the breast end with a page that says so; a segmentation that fails leaves that of an earlier run."""
        self.assertEqual(scan_run._page_of_failure("."), "")
        for name, time in (("labels.json", 10), ("page.html", 20)):
            touch(name)
            os.utime(name, (time, time))
        self.assertEqual(scan_run._page_of_failure("."), "", "a page without a banner does not say why")
        Path("cc.json").write_text('{"tool": "compress", "view": "CC", "status": "not_gripped", "reason": "not_gripped"}')
        os.utime("cc.json", (10, 10))
        self.assertEqual(scan_run._page_of_failure("."), "; page.html says why")
        os.utime("labels.json", (30, 30))
        self.assertEqual(scan_run._page_of_failure("."), "")

    def test_the_tumour_is_found_by_the_name_of_the_scan(self):
        for name in ("a.nrrd", "a-tumour-x.nrrd", "ab-tumour.nrrd", "tumour.nrrd", "a.nrrd-tumour.nrrd"):
            touch(name)
        self.assertEqual(tumour_beside("a.nrrd"), {})
        touch("a-tumour.mrk.json")
        touch("a-tumor-left.nii.gz")
        for scan in ("a.nrrd", "./a.nrrd"):
            self.assertEqual({side: os.path.normpath(file) for side, file in tumour_beside(scan).items()},
                             {"": "a-tumour.mrk.json", "left": "a-tumor-left.nii.gz"})
        touch("a-tumour.tsv")
        with self.assertRaisesRegex(BreastError, "both name the tumour"):
            tumour_beside("a.nrrd")
        os.makedirs("export.1/S1")
        touch("export.1-tumour.seg.nrrd")
        self.assertEqual(tumour_beside("export.1/"), {"": "export.1-tumour.seg.nrrd"})

    def test_the_tumour_belongs_to_the_nearer_nipple(self):
        nipples = {"left": np.array([90.0, -60, 0]), "right": np.array([-90.0, -60, 0])}
        Path("points.tsv").write_text("x_mm\ty_mm\tz_mm\n-50\t-20\t3\n")
        Path("points.fcsv").write_text("# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n"
                                       "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                                       "1,50,20,3,0,0,0,1,1,1,0,tumour,,\n")
        for given, side in (("40,-20,0:5", "left"), ("points.tsv", "right"), ("points.fcsv", "right")):
            self.assertEqual(side_of(tumour_position(given), nipples), side, given)
        with self.assertRaisesRegex(BreastError, "neither"):
            tumour_position("40,-20")

    def test_a_folder_that_is_refused_shows_both_sides(self):
        os.makedirs("export")
        touch("export/notes.txt")
        tools = SimpleNamespace(tool=lambda name: str(small_run.programs / name))
        self.assertEqual(series_of(tools, "export"), Series(("left", "right")))


class Programs(unittest.TestCase):
    def test_say_so_in_one_line_when_they_cannot_write(self):
        for words in (["breast", "list"], ["breast", "--version"], ["cases", "--help"]):
            with open("/dev/full", "wb") as full:
                ended = subprocess.run([small_run.programs / words[0], *words[1:]], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual((ended.returncode, ended.stderr), (1, f"{words[0]}: stdout cannot be written\n"), words)

    def test_hostile_names_are_names_and_nothing_else(self):
        hostile = "a b'c\"$(touch executed)`touch executed`;é(=)<script>&\u2028"
        with tempfile.TemporaryDirectory() as folder:
            scan = Path(folder) / f"{hostile}.nrrd"
            scan.write_text("scan")
            report = Path(folder) / f"{hostile}.json"
            ended = subprocess.run([small_run.programs / "cases", "record", str(Path(folder) / hostile), "left", str(scan), "--report",
                                    str(report)], capture_output=True, text=True, cwd=folder)
            self.assertEqual((ended.returncode, ended.stdout, ended.stderr), (0, "", ""))
            self.assertEqual(sorted(os.listdir(folder)), sorted([scan.name, report.name, hostile]))
            self.assertNotIn(folder, report.read_text())


if __name__ == "__main__":
    unittest.main()
