# SPDX-License-Identifier: GPL-3.0-or-later
"""render as a user runs it: every figure, with and without DISPLAY, several at a time, nothing left behind."""
import json
import os
import resource
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

import breast
import h5py
import numpy as np
import small_run
from breast.output import written_by_us

try:
    import vtkmodules  # noqa: F401
    from matplotlib.image import imread
    from PIL import Image
    from breast.figures.colours import COLUMN
    from breast.figures.of_run import PICTURES
    from breast.figures.matching import moved_columns
except ImportError as error:
    raise unittest.SkipTest(f"figures need python3-matplotlib and python3-vtk9 ({error})") from None

CHAIN = "mesh.vtkhdf reference.vtkhdf supine.vtkhdf cc.vtkhdf mlo.vtkhdf cc.vti mlo.vti"


def render(line, folder, **more):
    """Exit code and stderr of "render LINE"."""
    done = subprocess.run([small_run.programs / "render", *line.split()], cwd=folder, capture_output=True, text=True, **more)
    return done.returncode, done.stderr


def pixels(file, left, right, wanted):
    """Pixels between two fractions of the width that satisfy `wanted` (r, g, b), each 0 to 1."""
    image = imread(file)[..., :3]
    part = image[:, int(left * image.shape[1]) : int(right * image.shape[1])]
    return int(np.count_nonzero(wanted(*np.moveaxis(part, -1, 0))))


def is_tumour(r, g, b):
    return (r > 0.59) & (g > 0.65 * r) & (b < 0.45 * r)


def is_curve(r, g, b):
    return (g > 0.59) & (r < 0.5 * g) & (b < 0.7 * g)


class Render(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = small_run.scratch("render")
        for file in small_run.folder().iterdir():
            os.symlink(file, cls.folder / file.name)

    def drawn(self, line, folder=None, **more):
        self.assertEqual(render(line, folder or self.folder, **more), (0, ""), line)

    def refused(self, line, *words, code=2, **more):
        found, said = render(line, self.folder, **more)
        self.assertEqual((found, said.count("\n")), (code, 1), said)
        for word in words:
            self.assertIn(word, said)

    # ---- pictures ----------------------------------------------------------------------------------------------------

    def test_one_call_draws_all_of_a_run(self):
        small_run.tool("cc2mlo cc.vtkhdf mlo.vtkhdf curves.vtp --grid 2", self.folder)
        self.drawn(f"{CHAIN} geometry.vtkhdf points.vtp curve.vtp curves.vtp --scan small-scan.nrrd --labels labels.vtkhdf "
                   "--all figures --report all.json")
        made = {file.name for file in (self.folder / "figures").iterdir()}
        self.assertEqual(made, {f"{picture.name}.png" for picture in PICTURES})
        for name in made:
            image = imread(self.folder / "figures" / name)
            self.assertGreater(np.count_nonzero(image[..., :3].min(-1) < 0.9), 10000, f"{name} is all but empty")
            self.assertTrue(written_by_us(self.folder / "figures" / name))
        self.assertEqual(set(json.loads((self.folder / "all.json").read_text())["figure"]), {p.name for p in PICTURES})
        # What the captions promise: the tumour is seen through skin and gland, in both views of the tissues and in the columns.
        for name, parts in (("tissues", 2), ("cc-matching", 2), ("mlo-matching", 2), ("slices", 3)):
            for k in range(parts):
                self.assertGreater(pixels(self.folder / f"figures/{name}.png", k / parts, (k + 1) / parts, is_tumour), 100, (name, k))
        # The circumference of 12 pixels' radius by 2.6: a ring hides nothing, and a filled mark would have 450.
        ring = pixels(self.folder / "figures/cc-mammogram.png", 0, 1, is_tumour)
        self.assertTrue(90 < ring < 300, ring)

    def test_figures_of_a_few_files(self):
        self.drawn(f"{CHAIN} --figure summary -o summary.png")  # a case without tumour and scan
        self.drawn("mlo.vtkhdf curve.vtp --figure matching -o matching.png")
        self.drawn("supine.vtkhdf points.vtp --figure postures -o postures.png")
        self.drawn("cc.vti mlo.vti --figure mammogram -o mammograms.png")
        self.assertEqual(pixels(self.folder / "mammograms.png", 0, 1, is_curve), 0)
        nv, nu = breast.load(self.folder / "cc.vti").images["path"].shape  # of 1 mm
        small_run.tool(f"cc2mlo cc.vtkhdf mlo.vtkhdf middle.vtp --point {nu // 2},{nv // 2}", self.folder)
        self.drawn("cc.vti mlo.vti middle.vtp --figure mammogram -o mammograms.png")
        self.assertEqual(pixels(self.folder / "mammograms.png", 0, 0.5, is_curve), 0)
        self.assertGreater(pixels(self.folder / "mammograms.png", 0.5, 1, is_curve), 150)
        (self.folder / "budget.tsv").write_text("replaced\tstress_free_mean_mm\tsupine_mean_mm\tcurve_mean_mm\n"
                                                "chain\t3\t4\t2\nbackward\t0\t2\t\n\r\n")
        self.drawn("budget.tsv --figure budget -o budget.png")
        self.refused("budget.tsv --figure cost -o no.png", "budget.tsv: has no column", "it has: replaced")

    def test_states_follow_one_another_in_a_picture_that_moves(self):
        small_run.tool("forward reference.vtkhdf turn.vtkhdf --states 3", self.folder)
        small_run.tool("compress reference.vtkhdf closing.vtkhdf --view CC --reduction 30 --at-least 20 --states 2", self.folder)
        for name, count in (("turn", 3), ("closing", 2)):
            files = sorted(f"{name}-states/{file.name}" for file in (self.folder / f"{name}-states").glob("state_*.vtkhdf"))
            self.drawn(f"{' '.join(files)} curve.vtp --figure states -o {name}.png")
            self.assertTrue(written_by_us(self.folder / f"{name}.png"))
            self.assertLess((self.folder / f"{name}.png").stat().st_size, 3e6 * count / 13)
            with Image.open(self.folder / f"{name}.png") as picture:
                self.assertEqual((picture.n_frames, picture.info["loop"]), (count, 0))
                frames = []
                for k in range(count):
                    picture.seek(k)
                    frames.append(np.asarray(picture.convert("RGB")) / 255)
            for a, b in zip(frames, frames[1:]):
                self.assertGreater(np.count_nonzero(np.abs(a - b).max(-1) > 0.1), 3000, "the body moves")
            for frame in frames:
                self.assertGreater(np.count_nonzero(is_tumour(*np.moveaxis(frame, -1, 0))), 100, "the tumour is seen")
                self.assertGreater(np.count_nonzero(np.abs(frame - COLUMN).max(-1) < 0.02), 60, "so is the tissue above its pixel")
        curves = breast.load(self.folder / "curve.vtp")
        last, (column,) = breast.load(self.folder / "closing.vtkhdf"), curves["column in CC"]
        (moved,) = moved_columns(last, curves)
        self.assertEqual(len(moved), len(column.points))
        self.assertLess(np.abs(moved - column.points).max(), 0.02)
        self.refused("supine.vtkhdf --figure states -o no.png", "figure states needs the .vtkhdf of a folder NAME-states")

    def test_without_a_tumour_nothing_is_yellow(self):
        small_run.tool("hexmesh geometry.vtkhdf labels.vtkhdf none.vtkhdf --elements 6 --tumour none", self.folder)
        self.drawn("none.vtkhdf --figure tissues -o none.png")
        self.assertEqual(pixels(self.folder / "none.png", 0, 1, is_tumour), 0)

    def test_a_dicom_series_is_the_same_scan(self):
        small_run.tool("phantom phantom.nrrd --preset small --coarse 8 --dicom series", self.folder)
        (self.folder / "any.tsv").write_text("a\n1\n\r\n")  # without a mesh the labels are shown alone
        small_run.tool("segment phantom.nrrd phantom.vtkhdf --side left", self.folder)
        for scan in ("phantom.nrrd", "series"):
            self.drawn(f"any.tsv --scan {scan} --labels phantom.vtkhdf --figure slices -o {scan[:6]}.png")
        self.assertEqual((self.folder / "phanto.png").read_bytes(), (self.folder / "series.png").read_bytes())

    # ---- displays ----------------------------------------------------------------------------------------------------

    def test_display_and_others_at_work_make_no_difference(self):
        folders = [small_run.scratch(f"beside-{n}") for n in range(2)]
        line = [small_run.programs / "render", small_run.folder() / "mesh.vtkhdf", "-o", "mesh.png"]
        there = os.environ | {"DISPLAY": ":987"}  # nobody there
        without = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        children = [subprocess.Popen(line, cwd=folder, env=env) for folder, env in zip(folders, (there, without))]
        self.assertEqual([child.wait() for child in children], [0, 0])
        self.assertEqual((folders[0] / "mesh.png").read_bytes(), (folders[1] / "mesh.png").read_bytes())

    def test_a_killed_render_leaves_no_server_and_no_picture(self):
        line = [small_run.programs / "render", *"cc.vtkhdf mlo.vtkhdf --figure compression -o killed.png".split()]
        child = subprocess.Popen(line, cwd=self.folder)
        servers = self.waited(lambda: self.servers_of(child.pid))
        self.assertEqual(len(servers), 1)
        child.send_signal(signal.SIGKILL)
        child.wait()
        self.assertTrue(self.waited(lambda: not any(self.lives(server) for server in servers)))
        self.assertFalse((self.folder / "killed.png").exists())

    @staticmethod
    def waited(what):
        end = time.monotonic() + 20
        while not (found := what()) and time.monotonic() < end:
            time.sleep(0.02)
        return found

    @staticmethod
    def stat(process):
        try:
            name, _, rest = Path(f"/proc/{process}/stat").read_text().partition("(")[2].rpartition(")")
            return name, *rest.split()[:2]
        except OSError:
            return "", "X", "0"

    def servers_of(self, parent):
        processes = [int(p.name) for p in Path("/proc").iterdir() if p.name.isdigit()]
        return [p for p in processes if self.stat(p)[0] == "Xvfb" and self.stat(p)[2] == str(parent)]

    def lives(self, process):
        return self.stat(process)[1] not in ("X", "Z")  # a zombie waits for its reaper only

    def test_a_missing_server_is_said_with_the_packages(self):
        self.refused("mesh.vtkhdf -o no.png", "xvfb xauth libgl1-mesa-dri", code=1, env=os.environ | {"PATH": "/nowhere"})

    # ---- refusals ----------------------------------------------------------------------------------------------------

    def test_what_is_missing_is_named(self):
        self.refused("mesh.vtkhdf --figure slices -o no.png", "--scan")
        self.refused("mesh.vtkhdf --figure slices --scan small-scan.nrrd -o no.png", "must be given together")
        self.refused("mesh.vtkhdf curve.vtp --figure matching -o no.png", "figure matching needs a compressed .vtkhdf")
        self.refused("mesh.vtkhdf --figure compression -o no.png", "figure compression needs a compressed .vtkhdf")
        self.refused("mesh.vtkhdf --figure heatmap -o no.png", "'heatmap' is none of")
        self.refused("mesh.vtkhdf", "--output OUT.png is missing")
        self.refused("mesh.vtkhdf --all figs -o no.png", "either --output OUT.png or --all FOLDER")
        self.refused("mesh.vtkhdf --all figs --only presure", "did you mean pressure?")
        self.refused("mesh.vtkhdf --all figs --only pressure", "pressure needs cc.vtkhdf, mlo.vtkhdf too")
        self.refused("labels.json -o no.png", "render reads .vtkhdf, .vti, .vtp and .tsv files")
        self.assertFalse((self.folder / "no.png").exists() or (self.folder / "figs").exists())

    def test_a_picture_is_of_one_breast_except_for_outlines(self):
        shutil.copy(small_run.folder() / "mlo.vtkhdf", self.folder / "other.vtkhdf")
        with h5py.File(self.folder / "other.vtkhdf", "r+") as file:
            side = file["breast"].attrs["side"]
            del file["breast"].attrs["side"]
            file["breast"].attrs.create("side", b"right" if side in (b"left", "left") else b"left")
            for entry in ("input_sha256",):
                digests = file[f"breast/history/{entry}"][()]
                file[f"breast/history/{entry}"][...] = [b"0" * 64 for _ in digests]
        self.refused("cc.vtkhdf other.vtkhdf --figure compression -o no.png", "give files that belong together")
        self.assertFalse((self.folder / "no.png").exists())
        self.drawn("cc.vtkhdf other.vtkhdf --figure outlines -o both.png")

    def test_files_of_others_stay_and_full_disks_are_said(self):
        (self.folder / "mine.png").write_text("mine")
        self.refused("cc.vtkhdf --figure force-thickness -o mine.png", "does not look like a result of libbreast")
        self.assertEqual((self.folder / "mine.png").read_text(), "mine")

        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))
        self.refused("cc.vtkhdf --figure force-thickness -o full.png", "full.png", code=1, preexec_fn=small_files)
        self.assertEqual([f.name for f in self.folder.iterdir() if "full.png" in f.name], [])
        self.drawn("cc.vtkhdf --figure force-thickness -o whole.png")  # no module is kept of which a part was written

    def test_damaged_files_are_named(self):
        content = (small_run.folder() / "cc.vti").read_bytes()
        (self.folder / "damaged.vti").write_bytes(content[: len(content) // 2])
        self.refused("damaged.vti curve.vtp --figure mammogram -o no.png", "damaged.vti")
        (self.folder / "damaged.vtkhdf").write_bytes((small_run.folder() / "cc.vtkhdf").read_bytes()[:5000])
        self.refused("damaged.vtkhdf --figure pressure -o no.png", "damaged.vtkhdf")


if __name__ == "__main__":
    breast.load(small_run.folder())
    unittest.main()
