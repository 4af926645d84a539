# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of both views: what its scripts read is what the files of the run say."""
import base64
import dataclasses
import html
import json
import re
import shutil
import unittest
import unittest.mock
import zlib
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

import breast
import small_run
from breast.elements import FACE_CORNERS
from breast.errors import BreastError
from breast.state import TISSUES, Landmark

try:
    import jinja2  # noqa: F401
    from breast.page import drawing, facts, packed
    from breast.page.lines import SIDES_90, MatchedLine, line_at
    from breast.page.patient import read_patient
    from breast.page.remarks import banners_of, remarks_of
    from breast.page.views_page import read_views, views_page
    from breast.state_file import read_state
    without_jinja = ""
except ImportError:
    without_jinja = "python3-jinja2 is not installed"


def data_of(page: str) -> dict:
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1])


def unpacked(held: dict, kind: str) -> np.ndarray:
    """As data.js unpacks them: numbers that were stored as differences add up, and so come round where they are too large."""
    numbers, step = np.frombuffer(zlib.decompress(base64.b64decode(held["packed"])), held["kind"]), held["step"]
    assert np.dtype(kind).str[1:] == held["kind"]
    return np.cumsum(numbers.reshape(-1, step), axis=0, dtype=numbers.dtype).ravel() if step else numbers


def words_of(page: str) -> str:
    """What a reader sees, without the scripts' part."""
    seen = re.sub(r"<(script|style)\b.*?</\1>|<[^>]*>", " ", page.partition('<section id="pointing"')[0], flags=re.S)
    return re.sub(r"\s+", " ", seen.replace("&#39;", "'"))


class Elements(HTMLParser):
    """The elements of a page with their attributes, in order."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.all: list[tuple[str, dict[str, str]]] = []
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.all.append((tag, {name: value or "" for name, value in attrs}))

    def named(self, tag: str) -> list[dict[str, str]]:
        return [given for name, given in self.all if name == tag]


def number_of(page: str, key: str) -> list[float]:
    """The numbers of the row of the page's tables with that key."""
    row = re.search(rf'data-key="{key}">(.*?)</td>', page)[1]
    return [float(n) for n in re.findall(r"\d+\.?\d*", html.unescape(row))]


@unittest.skipIf(without_jinja, without_jinja)
class PackedData(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = small_run.folder()
        cls.views = read_views(cls.run_folder, cls.run_folder / "small-scan.nrrd")
        cls.page = views_page(cls.run_folder, cls.views)

    def test_holds_the_curves_of_both_directions(self):
        low, high = packed.box_of(self.views.body)
        for lookup, held in zip(self.views.lookups, data_of(self.page)["lookups"]):
            tissue = lookup.status != 0
            self.assertGreater(np.count_nonzero(tissue), 50)
            self.assertEqual((held["nv"], held["nu"], held["pitch"]), (*lookup.status.shape, lookup.pitch_mm))
            np.testing.assert_array_equal(unpacked(held["status"], "u1"), lookup.status.ravel())
            for name, kind, values in (("depth", "<u2", lookup.depth_mm), ("curve", "<i2", lookup.curve_mm),
                                       ("imaged", "<i2", lookup.imaged_mm - 0.5 * (low + high))):
                np.testing.assert_allclose(0.01 * unpacked(held[name], kind), values[tissue].ravel(), atol=0.0051)

    def test_holds_the_images_as_they_are_hung(self):
        for (image, state), held in zip(self.views.pairs, data_of(self.page)["images"]):
            grey = unpacked(held["grey"], "<u2").reshape(held["height"], held["width"])
            self.assertEqual(grey.shape, image.images["path"].shape)
            self.assertGreater(grey.max(), 60000)
            expected = image.project(state.landmark_position("nipple")[None])[0]
            np.testing.assert_allclose(held["landmarks"][0]["at"], expected)

    def test_shows_of_the_scan_only_the_breast(self):
        scan = breast.load(self.run_folder / "small-scan.nrrd")
        held = packed.packed_scan(scan, self.views.body)
        low, high = packed.box_of(self.views.body)
        np.testing.assert_allclose(held["origin"][:2], low[:2] - 15)
        slices = scan.grid.to_index(self.places(held))[:, 2]
        np.testing.assert_allclose(slices, np.rint(slices), atol=1e-6, err_msg="its planes are the scan's slices")
        row, place = np.array(held["slices"]["row"]), np.array([80.0, -20, 12])
        self.assertAlmostEqual(row[:3] @ place + row[3], scan.grid.to_index(place)[2])
        self.assertEqual((held["slices"]["plane"], held["slices"]["count"]), ("axial", scan.grid.size[2]))
        self.assertTrue(((np.array(held["size"]) - 1) * held["spacing"] <= high - low + 30).all())
        grey = unpacked(held["grey"], "u1").reshape(held["size"][::-1])
        place = np.array(held["origin"]) + np.array([40, 30, 6]) * held["spacing"]
        near = scan.sample(place[None])[0]
        darker, brighter = (np.count_nonzero(scan.sample(self.places(held)[::50]) < near + d) for d in (-1, 1))
        self.assertLessEqual(darker, np.count_nonzero(grey.ravel()[::50] <= grey[6, 30, 40]))
        self.assertLessEqual(np.count_nonzero(grey.ravel()[::50] < grey[6, 30, 40]), brighter)
        elsewhere = dataclasses.replace(scan, grid=dataclasses.replace(scan.grid, origin=scan.grid.origin + 1000))
        with self.assertRaisesRegex(BreastError, "covers 0 % of the bounding box"):
            packed.packed_scan(elsewhere, self.views.body)

    @staticmethod
    def places(held: dict) -> np.ndarray:
        k, j, i = np.indices(held["size"][::-1]).reshape(3, -1)
        return np.array(held["origin"]) + np.stack([i, j, k], -1) * held["spacing"]

    def test_is_one_file_that_asks_for_nothing(self):
        for outside in ("http:", "https:", "src=", "fetch(", "XMLHttpRequest", str(self.run_folder)):
            self.assertFalse(outside in self.page, outside)
        for there in ("Content-Security-Policy", "Research only, not a medical device"):
            self.assertTrue(there in self.page, there)

    def test_lets_no_name_become_code(self):
        for hostile in ('</script><script>alert("1")</script>', "<!--<script>", "]]>", "\u2028", "{{ 7 * 7 }}", "'&\\"):
            lookup = dataclasses.replace(self.views.lookups[0], band_without=[hostile])
            made = views_page(self.run_folder, dataclasses.replace(self.views, lookups=(lookup, self.views.lookups[1])))
            self.assertFalse("<" in hostile and hostile in made, hostile)
            self.assertEqual(made.count("</script>"), self.page.count("</script>"))
            self.assertEqual(data_of(made)["band_without"], hostile)

    def test_refuses_files_of_other_views(self):
        for name, other, said in (("cc.vti", "mlo.vti", "is of MLO of the left breast, but cc.vtkhdf of CC"),
                                  ("cc.vtkhdf", "mesh.vtkhdf", "is no compression"),
                                  ("lookup.h5", "lookup.h5", "was made of other compressions")):
            run = small_run.scratch("page")
            for file in ("cc.vtkhdf", "mlo.vtkhdf", "cc.vti", "mlo.vti", "lookup.h5"):
                shutil.copy(self.run_folder / file, run)
            shutil.copy(self.run_folder / other, run / name)
            if name == other:
                small_run.tool(f"compress {self.run_folder}/reference.vtkhdf {run}/cc.vtkhdf --view CC --reduction 20 --at-least 15", run)
            with self.assertRaisesRegex(BreastError, said):
                read_views(run, None)


@unittest.skipIf(without_jinja, without_jinja)
class WhatIsSaid(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = small_run.folder()
        cls.views = read_views(cls.run_folder, cls.run_folder / "small-scan.nrrd")
        cls.page = views_page(cls.run_folder, cls.views)
        cls.report = {name: json.loads((cls.run_folder / f"{name}.json").read_text()) for name in ("mesh", "labels", "cc", "mlo")}

    def test_every_number_of_the_tables_is_recomputed_from_the_files(self):
        marks, labels = self.report["mesh"]["landmarks"], breast.load(self.run_folder / "labels.vtkhdf")
        tumour, nipple = (np.array(marks[name]["imaged"]) for name in ("artificial_tumour", "nipple"))
        scan = breast.load(self.run_folder / "small-scan.nrrd").grid
        slices = [1 + round((tumour[2] - scan.origin[2]) / scan.spacing[2]), scan.size[2]]
        muscle = labels.grid.to_patient(np.argwhere(labels.tissue == TISSUES.index("muscle"))[:, ::-1])
        faces, shape = self.views.body.faces["skin"], np.linspace(0, 1, 41)
        corners = self.views.body.imaged[self.views.body.hexahedra[faces[:, 0, None], FACE_CORNERS[faces[:, 1]]]]
        weights = np.stack(np.meshgrid(shape, shape), -1).reshape(-1, 2)
        weights = np.stack([(1 - weights).prod(1), weights[:, 0] * (1 - weights[:, 1]), weights.prod(1), (1 - weights[:, 0]) * weights[:, 1]])
        skin = np.einsum("cp,fcx->fpx", weights, corners).reshape(-1, 3)

        def nearest(points, place):
            return float(np.linalg.norm(points - place, axis=1).min())
        hour = round(np.degrees(np.arctan2(tumour[0] - nipple[0], tumour[2] - nipple[2])) / 30) % 12
        cc, mlo = self.report["cc"], self.report["mlo"]
        expected = {"clock": [hour or 12], "nipple_mm": [np.linalg.norm(tumour - nipple)], "skin_mm": [nearest(skin, tumour)],
                    "third": [nearest(muscle, tumour), nearest(muscle, nipple)], "position": abs(tumour), "slice": [*slices, 1],
                    "volume_ml": [self.report["labels"]["breast_ml"]],
                    "density": [self.report["labels"]["density_percent"], 4.5, 7.5, 15.5],
                    "plates_CC": [cc["thickness_mm"], cc["force_N"]],
                    "plates_MLO": [mlo["thickness_mm"], mlo["force_N"], mlo["angle_deg"]],
                    "nipple_lines": [report["coverage"]["nipple_in_front_mm"] for report in (cc, mlo)]}
        for image, state in self.views.pairs:
            (u, v), (u_nipple, v_nipple) = (image.project(state.landmark_position(name)[None])[0] for name in ("tumour", "nipple"))
            expected[f"in_{image.view}"] = [u_nipple - u, abs(v - v_nipple)]
        self.assertEqual(set(re.findall(r'data-key="(\w+)"', self.page)), {*expected}, "no row without its check")
        for key, values in expected.items():
            np.testing.assert_allclose(number_of(self.page, key), values, atol=0.051 if key == "density" else 0.501, err_msg=key)
        self.assertIn(f"MR {slices[0]} of {slices[1]}", words_of(self.page))
        self.assertIn(facts.density_class(self.report["labels"]["density_percent"]), words_of(self.page))

    def moved_tumour(self):
        """The views with the tumour in the middle of an element that both images show, and its place in CC."""
        ((image, cc), (_, mlo)), lookup = self.views.pairs, self.views.lookups[0]

        def far_apart(uv):
            node = lookup.node(*uv)
            return min(uv) > 0 and lookup.status[node] == 1 and np.linalg.norm(np.ptp(lookup.curve_mm[node], axis=0)) > 30
        element = next(e for e, point in enumerate(cc.centres()) if cc.element_numbers[e] == mlo.element_numbers[e] and
                       far_apart(image.project(point[None])[0]))

        def moved(state):
            landmark = Landmark("tumour", state.centres("imaged")[element], element, np.zeros(3), 0)
            return dataclasses.replace(state, landmarks={"nipple": state.landmarks["nipple"], "tumour": landmark})
        pairs = [(image, moved(state)) for image, state in self.views.pairs]
        return (dataclasses.replace(self.views, pairs=pairs, body=pairs[0][1], origin="given"),
                image.project(pairs[0][1].landmark_position("tumour")[None])[0])

    def test_lines_and_bands_are_those_of_the_matcher_both_ways(self):
        views, _ = self.moved_tumour()
        self.assertIn("how far to either side of it is not known for this run", words_of(views_page(self.run_folder, views)), "no band")
        run = small_run.scratch("line")
        shutil.copytree(self.run_folder, run, dirs_exist_ok=True)
        for view in ("cc", "mlo"):
            small_run.tool(f"sensitivity reference.vtkhdf {view}.vtkhdf {view}-sensitivity.vtkhdf", run)
        views = dataclasses.replace(views, pairs=[(image, dataclasses.replace(state, file=run / state.file.name)) for image, state in views.pairs])
        words = words_of(views_page(run, views))
        for k, (here, there) in enumerate((("cc", "mlo"), ("mlo", "cc"))):
            u, v = views.pairs[k][0].project(views.pairs[k][1].landmark_position("tumour")[None])[0]
            small_run.tool(f"cc2mlo {here}-sensitivity.vtkhdf {there}-sensitivity.vtkhdf c.vtp --point {u},{v} --band --table c.tsv "
                           "--curve-table b.tsv", run)
            length = breast.read_table(run / "c.tsv", pandas=False)[0]["curve_mm"]
            u, v, sigma = (np.array([float(row[name]) for row in breast.read_table(run / "b.tsv", pandas=False)])
                           for name in (f"{there}_u_mm", f"{there}_v_mm", "deviation_mm"))
            half, pieces = 1.644854 * 0.5 * (sigma[1:] + sigma[:-1]), np.hypot(np.diff(u), np.diff(v))
            said = re.search(rf"seen in {here.upper()} alone, lies in {there.upper()} somewhere on a line of (\d+) mm, about (\d+) mm", words)
            self.assertEqual(int(said[1]), round(float(length)))
            self.assertLessEqual(pieces[half > float(said[2]) + 0.51].sum(), 0.1 * pieces.sum())
            self.assertGreater(pieces[half > float(said[2]) - 0.51].sum(), 0.1 * pieces.sum())
        small_run.tool("compress reference.vtkhdf cc.vtkhdf --view CC --reduction 20 --at-least 15", run)
        other = [(views.pairs[0][0], read_state(run / "cc.vtkhdf")), views.pairs[1]]
        with self.assertRaisesRegex(BreastError, "cc-sensitivity.vtkhdf.*another compression than cc.vtkhdf"):
            line_at((other[0][1], other[1][1]), np.array([30.0, 40]))

    def test_a_tumour_outside_the_images_is_said_and_not_drawn(self):
        self.assertIn("does not lie in the CC image but behind its back edge", words_of(self.page))
        views = self.page.partition('id="picture-CC"')[2].partition('id="picture-MR"')[0]
        self.assertFalse('<circle class="artificial" cx' in views)

    def test_a_band_is_said_as_half_its_width(self):
        def wide(*place):
            line = line_at(*place)
            return dataclasses.replace(line, deviation=np.full(len(line.points), 9.1))
        with unittest.mock.patch("breast.page.lines.line_at", wide):
            page = views_page(self.run_folder, self.moved_tumour()[0])
        self.assertIn("about 15 mm to either side of it (90 %)", words_of(page))
        self.assertEqual(page.count('<path class="band" d="M'), 3, "in both pictures and in the legend")

    def test_a_band_goes_round_its_corners_and_ends_at_the_skin(self):
        image = self.views.pairs[0][0]
        body = image.images["thickness"] > 0
        row = body.shape[0] // 2
        edge = image.pixel_mm * np.flatnonzero(body[row])[-1]
        points = np.array([[edge - 20, image.pixel_mm * row], [edge, image.pixel_mm * row], [edge - 15, image.pixel_mm * row - 15]])
        line = MatchedLine(points, np.full(3, 5 / SIDES_90), np.zeros(3), "matched", 41)
        np.testing.assert_allclose(line.inside_band(points[1] + np.array([[3, 4], [0, 6], [0, 0]])), [0, -1, 5], atol=1e-9)
        np.testing.assert_allclose(line.inside_band(0.5 * (points[0] + points[1]) + [[0, 4], [0, 5.5]]), [1, -0.5], atol=0.02)
        hook = "The hook in the line is probably tissue near the skin, which a plate has dragged along."
        for end, said in ((points[2], hook), (points[1] + 15, "")):
            way = np.vstack([np.linspace(points[0], points[1], 21), np.linspace(points[1], end, 22)[1:]])
            self.assertEqual(MatchedLine(way, np.zeros(42), np.zeros(42), "matched", 41).remark(), said)
        for ring in drawing._band(line, image):
            np.testing.assert_array_equal(ring[0], ring[-1], "closed")
            u, v = np.rint(ring / image.pixel_mm).astype(int).T
            near = [body[max(0, j - 2):j + 3, max(0, i - 2):i + 3].any() for i, j in zip(u, v)]
            self.assertTrue(all(near), "no place of it lies beside the breast")

    def test_words_for_places(self):
        for offset, clock in (((0, 0, 20), "12 o'clock"), ((20, 5, 0), "3 o'clock"), ((-20, 5, 0), "9 o'clock"), ((0, 9, -20), "6 o'clock"),
                              ((11, 43, 14), "1 o'clock"), ((3, 40, 4), "behind the nipple"), ((-5, 0, 30), "12 o'clock")):
            self.assertEqual(facts.clock_position(np.array(offset, float)), clock)
        for offset, side, words in (((20, 5, 9), "left", "upper outer quadrant"), ((20, 5, -9), "right", "lower inner quadrant"),
                                    ((-20, 5, -1), "left", "between the inner quadrants"),
                                    ((-20, 5, 1), "right", "between the outer quadrants"),
                                    ((4, 0, 20), "left", "between the upper quadrants"), ((-4, 0, -20), "left", "between the lower quadrants")):
            self.assertEqual(facts.quadrant(np.array(offset, float), side), words)
        self.assertEqual([facts.depth_third(at, 90) for at in (5, 45, 80, 95)], ["posterior", "middle", "anterior", "anterior"])
        self.assertEqual(facts.patient_position(np.array([-93.6, 31.4, -13.2])), "R 94, P 31, I 13 mm")
        self.assertEqual([facts.density_class(p)[0] for p in (2, 4.5, 7.6, 15.4, 15.5, 60)], ["a", "b", "c", "c", "d", "d"])
        sagittal = breast.load(self.run_folder / "small-scan.nrrd").grid
        sagittal = dataclasses.replace(sagittal, direction=np.array([[0.0, 0, -1], [1, 0, 0], [0, -1, 0]]), origin=np.array([100.0, 0, 0]))
        number, count, plane = facts.slice_of(sagittal, np.array([100 - 3 * sagittal.spacing[2], 0.0, 0]))
        self.assertEqual((number, count, plane, facts.first_slice(sagittal)), (4, sagittal.size[2], "sagittal", "leftmost"))

    def test_what_lies_behind_the_model_is_said_as_it_is_drawn(self):
        image, state = self.views.pairs[0]
        for behind, said, unsaid in ((0, "the model has ended, and nothing is known", "fat is drawn, or muscle"),
                                     (40, "fat is drawn, or muscle", "nothing is known"), (None, "One scale", "The model ends")):
            images = {name: values.copy() for name, values in image.images.items()}
            images["through_back"][:] = 0
            images["through_back"][:, 0] = behind is not None
            images["thickness"][:, 0] = behind or 0
            views = dataclasses.replace(self.views, pairs=[(dataclasses.replace(image, images=images), state)], lookups=None)
            words = words_of(views_page(self.run_folder, views))
            self.assertIn(said, words)
            self.assertNotIn(unsaid, words)

    def test_an_artificial_tumour_is_no_finding(self):
        self.assertIn("It is not a finding of this patient", words_of(self.page))
        self.assertTrue("an artificial tumour" in self.page and 'class="artificial"' in self.page, "dashed, in the legend")
        for given in ("first row of tumour.tsv", "94,-31,13", "centroid of the label"):
            run = small_run.scratch("given")
            (run / "mesh.json").write_text(json.dumps({"tumour": given}))
            for file in ("cc.vtkhdf", "mlo.vtkhdf", "cc.vti", "mlo.vti", "lookup.h5"):
                shutil.copy(self.run_folder / file, run)
            views = read_views(run, None)
            self.assertEqual(views.origin, "given")
            said = words_of(views_page(run, views))
            self.assertIn("The tumour does not lie in the CC image", said)
            self.assertNotIn("artificial", said)

    def test_without_a_tumour_it_is_of_the_breast(self):
        def without(state):
            return dataclasses.replace(state, landmarks={"nipple": state.landmarks["nipple"]})
        views = dataclasses.replace(self.views, origin="none", pairs=[(image, without(state)) for image, state in self.views.pairs],
                                    body=without(self.views.body))
        page = views_page(self.run_folder, views)
        self.assertIn("No tumour was given for this breast. On a screen, point at any place", words_of(page))
        self.assertNotIn('data-key="clock"', page)
        self.assertIn('data-key="density"', page)

    def test_a_view_that_is_not_gripped_has_a_banner_and_no_picture(self):
        run = small_run.scratch("loose")
        for file in ("cc.vtkhdf", "cc.vti", "mlo.vtkhdf", "mesh.vtkhdf", "labels.json", "mesh.json", "cc.json"):
            shutil.copy(self.run_folder / file, run)
        early = {"status": "stopped_early", "reduction_percent": 12}
        for said, fields in (("the simulated plates do not hold the breast", {"status": "not_gripped"}),
                             ("stopped early, when the breast was 12 % thinner, which is not enough", early),
                             ("the simulated compression failed", {"status": "not_converged"})):
            (run / "mlo.json").write_text(json.dumps({"view": "MLO", "accepted": False, "explanation": "it <slips>", **fields}))
            views = read_views(run, None)
            page = views_page(run, views)
            self.assertIn(said, words_of(page))
            self.assertIn("There is no MLO image", words_of(page))
            self.assertIn("tumour in CC</title>", page)  # the title promises no view that is missing
            self.assertEqual(page.count("it &lt;slips&gt;"), 2, "in the banner, for want of words, and among what the programs say")
            self.assertTrue('id="picture-CC"' in page and 'id="picture-MLO"' not in page and 'id="data"' not in page)
        why = ("the plates do not grip the breast: the rounded edge carries 59 % of the paddle's force (less than 40 % are allowed). Try a "
               "another --image-edge")
        (run / "mlo.json").write_text(json.dumps({"view": "MLO", "accepted": False, "status": "not_gripped", "explanation": why,
                                                  "warnings": ["skin lies 2 mm deep in the chest wall"]}))
        page = views_page(run, read_views(run, None))
        banner = page.partition('class="banner"')[2].partition("</div>")[0]
        self.assertIn("press mainly with their edge", banner)
        self.assertNotIn("--image-edge", banner, "a reader has no options")
        self.assertNotIn("reaches into the chest wall", words_of(page), "of a shape that is not shown")
        self.assertIn("mlo: skin lies 2", page)
        shutil.copy(run / "mlo.json", run / "cc.json")
        self.assertEqual(read_views(run, None).pairs, [])
        self.assertEqual(len(banners_of(run)), 2)
        self.assertNotIn("<figure", views_page(run, read_views(run, None)))

    def test_what_buckles_lying_down_did_not_slip_between_plates(self):
        run = small_run.scratch("buckles")
        (run / "supine.json").write_text(json.dumps({"warnings": ["the tangent was indefinite in 2 iterations: the breast may buckle"]}))
        (run / "cc.json").write_text(json.dumps({"warnings": ["the tangent was indefinite in 3 iterations, first at thickness 50 mm: the "
                                                              "breast slips or buckles there"]}))
        self.assertEqual([(remark.words.split()[:4], remark.said[0].split(":")[0]) for remark in remarks_of(run)],
                         [("The breast may buckle".split(), "supine"), ("The breast slipped while".split(), "cc")])

    def test_a_warning_is_said_of_the_shape_that_it_is_of(self):
        run = small_run.scratch("wrinkles")
        for stage in ("supine", "cc", "mlo"):
            (run / f"{stage}.json").write_text(json.dumps({"warnings": ["the skin is compressed enough to wrinkle over two elements or more "
                                                                        "on 3 % of its area"]}))
        words = {remark.words.partition(" wrinkles ")[2].partition(";")[0]: len(remark.said) for remark in remarks_of(run)}
        self.assertEqual(words, {"in the supine shape": 1, "between the plates": 2})
        (run / "cc.json").unlink(), (run / "mlo.json").unlink()
        self.assertNotIn("plates", " ".join(remark.words for remark in remarks_of(run)), "nothing was wrong between them")

    def test_warnings_are_said_in_a_readers_words_worst_first(self):
        run = small_run.scratch("warned")
        for stage, warnings in (("labels", ["quality of wall 0.4 is low", "quality of tissue 0.3 is low"]),
                                ("cc", ["paddle force 12 N is below the clinical range of 50-180 N", "a <b>new</b> warning"]),
                                ("mesh", ["the tumour is artificial: it was not found in the scan"])):
            (run / f"{stage}.json").write_text(json.dumps({"warnings": warnings}))
        remarks = remarks_of(run)
        self.assertEqual([remark.weight for remark in remarks], [1, 2, 2, 2])
        self.assertIn("not a finding", remarks[0].words)
        self.assertEqual(remarks[1].said, ["labels: quality of wall 0.4 is low", "labels: quality of tissue 0.3 is low"])
        self.assertEqual(remarks[-1].words, "a <b>new</b> warning", "a warning without a row is shown as it is")

    def test_views_that_show_more_and_less_of_the_breast_are_said_to(self):
        run = small_run.scratch("unequal")
        for view, mm in (("cc", 58), ("mlo", 84)):
            (run / f"{view}.json").write_text(json.dumps({"coverage": {"nipple_in_front_mm": mm}}))
        self.assertIn("CC shows 58 mm and MLO 84 mm", remarks_of(run)[0].words)
        self.assertEqual([fact.value for fact in facts.fact_of_views(run)], ["CC 58 mm, MLO 84 mm"])
        (run / "mlo.json").write_text(json.dumps({"coverage": {"nipple_in_front_mm": 67}}))
        self.assertEqual(remarks_of(run), [])
        (run / "mlo.json").write_text(json.dumps({"accepted": False, "coverage": {"nipple_in_front_mm": 84}}))
        self.assertEqual((remarks_of(run), facts.fact_of_views(run)), ([], []), "there is no such view")

    def test_the_patients_own_mammograms_are_registered_and_drawn_on(self):
        """The images of the simulation itself as the patient's: what is drawn in them lies where it does in the simulated views."""
        run = small_run.scratch("patient")
        for view in ("cc", "mlo"):
            small_run.tool(f"project-mammogram {self.run_folder}/{view}.vtkhdf x.vti --labels {self.run_folder}/labels.vtkhdf --pixel 0.5 "
                           f"--dicom {view}.dcm", run)
            for file in (f"{view}.vtkhdf", f"{view}.vti", f"{view}.json"):
                shutil.copy(self.run_folder / file, run)
        for file in ("lookup.h5", "mesh.json"):
            shutil.copy(self.run_folder / file, run)
        small_run.tool("cc2mlo cc.vtkhdf mlo.vtkhdf patient.vtp --grid 1 --cc-image cc.dcm --mlo-image mlo.dcm --cc-hung patient-cc.png "
                       "--mlo-hung patient-mlo.png --report patient.json", run)
        views = read_views(run, None)
        self.assertEqual(set(views.patients), {"CC", "MLO"})
        for (image, state) in views.pairs:
            patient = views.patients[image.view]
            nipple = image.project(state.landmark_position("nipple")[None])
            np.testing.assert_allclose(patient.put(nipple)[0], nipple[0] + 0.5 * image.pixel_mm, atol=1.5)
            self.assertLess(patient.residual_mm, 1.5)
        moved = self.moved_tumour()[0]
        page = views_page(run, dataclasses.replace(views, pairs=moved.pairs, body=moved.body, origin="given"))
        self.assertIn("In the patient's own mammograms", words_of(page))
        for view in ("CC", "MLO"):
            drawn = page.partition(f'id="picture-patient-{view}"')[2].partition("</figure>")[0]
            self.assertTrue(all(mark in drawn for mark in ('class="outline"', 'class="line"', 'class="tumour"', 'data-mm="20"')))
            self.assertEqual(number_of(page, f"fit_{view}"), [round(views.patients[view].residual_mm, 1)])
        self.assertLess(len(re.findall(r"In the patient's own", words_of(self.page))), 1, "a run without them says nothing of them")

    def test_animated_pictures_of_a_run_are_shown_up_to_3_mb(self):
        run = small_run.scratch("animated")
        for file in ("cc.vtkhdf", "mlo.vtkhdf", "cc.vti", "mlo.vti", "lookup.h5"):
            shutil.copy(self.run_folder / file, run)
        (run / "figures").mkdir()
        for name, size in (("supine", 1_000_000), ("cc", 2_500_000), ("mlo", 1_000_000)):
            (run / f"figures/{name}-states.png").write_bytes(b"p" * size)
        page = views_page(run, read_views(run, None))
        self.assertEqual(page.count('src="data:image/png;base64,cHBw'), 2)
        self.assertEqual(re.findall(r"plates close in (\w+)[^<:]*: too large for this page", page), ["CC"], "what is left out is said")
        self.assertNotIn("animations", self.page.partition('<section id="pointing"')[0].partition("</style>")[2])

    def test_a_right_breast_is_hung_the_other_way(self):
        (run := small_run.scratch("right")).joinpath("patient-cc.png").write_bytes(b"png")
        key = {"scale": 1, "rotation_deg": 90, "shift_mm": [5, 6], "deviation_mm": 1, "residual_mm": 2,
               "hung": {"pixel_mm": 0.2, "corner_mm": [100, 200]}}
        (run / "patient.json").write_text(json.dumps({"aligned": {"CC": key}}))
        np.testing.assert_allclose(read_patient(run, "CC", "right").put([[10, 20]]), [[100 - (5 - 20), 200 - (6 + 10)]])
        key["hung"]["corner_mm"] = [-1, -2]
        (run / "patient.json").write_text(json.dumps({"aligned": {"CC": key}}))
        np.testing.assert_allclose(read_patient(run, "CC", "left").put([[10, 20]]), [[5 - 20 + 1, 6 + 10 + 2]])
        self.assertIsNone(read_patient(run, "MLO", "left"))
        del key["hung"]
        (run / "patient.json").write_text(json.dumps({"aligned": {"CC": key}}))
        with self.assertRaisesRegex(BreastError, "does not say where the CC image lies"):
            read_patient(run, "CC", "left")

    def test_can_be_heard_and_reached_without_a_mouse(self):
        """The rules of WCAG 2.1 that can be judged without a browser; tests/page/check_page.py judges the rest in one."""
        views, _ = self.moved_tumour()
        seen = Elements(views_page(self.run_folder, views))
        self.assertEqual(seen.named("html")[0]["lang"], "en")
        for svg in seen.named("svg"):
            self.assertTrue(len(svg.get("aria-label", "")) > 20 if svg.get("role") == "img" else svg["aria-hidden"] == "true", svg)
        levels = [int(name[1]) for name, _ in seen.all if name in ("h1", "h2", "h3")]
        self.assertTrue(levels[0] == 1 and levels.count(1) == 1 and all(b - a <= 1 for a, b in zip(levels, levels[1:])), levels)
        self.assertEqual({th.get("scope") for th in seen.named("th")}, {"row"})
        labelled = {label["for"] for label in seen.named("label") if "for" in label}
        inside = self.page.count('<label><input type="checkbox"')
        self.assertEqual(len(seen.named("input")), len(labelled) + inside, "every input has a label")
        for canvas in seen.named("canvas"):
            self.assertEqual(canvas["tabindex"], "0")
        self.assertFalse([name for name, given in seen.all if int(given.get("tabindex", 0)) > 0], "nothing jumps the order")
        ids = [given["id"] for _, given in seen.all if "id" in given]
        self.assertEqual(len(ids), len(set(ids)))
        for _, given in seen.all:
            for name in (given.get("aria-labelledby", "") + " " + given.get("aria-describedby", "")).split():
                self.assertIn(name, ids)

    def test_all_pictures_have_one_scale_and_bars_of_20_mm(self):
        views, _ = self.moved_tumour()
        page = views_page(self.run_folder, views)
        figures = re.findall(r'<figure class="picture".*?</figure>', page, flags=re.S)
        self.assertEqual(len(figures), 3)
        for figure in figures:
            width = float(re.search(r"--w: ([\d.]+)", figure)[1])
            self.assertAlmostEqual(width, float(re.search(r'viewBox="0 0 ([\d.]+)', figure)[1]), delta=0.06)
            self.assertTrue(re.search(r'class="bar" data-mm="20" d="M[-\d.]+ [\d.]+v2h20v-2"', figure), "its length in mm is what it says")
        for image, _ in views.pairs:
            figure = next(figure for figure in figures if f'id="picture-{image.view}"' in figure)
            width, height = (float(n) for n in re.search(r'<image [^>]*width="([\d.]+)" height="([\d.]+)"', figure).groups())
            rows, columns = image.images["path"].shape
            np.testing.assert_allclose((width, height), image.pixel_mm * np.array([columns, rows]), atol=0.01)

    def test_words_at_the_top_of_a_picture_lie_in_it_whatever_their_size(self):
        """Letters are larger on a telephone and where a wide row is printed: only a place in units of their height stays inside."""
        figures = re.findall(r'<figure class="picture".*?</figure>', views_page(self.run_folder, self.moved_tumour()[0]), flags=re.S)
        self.assertTrue(figures)
        for figure in figures:
            for attributes in re.findall(r'<text class="(?:upper|name)[^>]*>', figure):
                self.assertGreaterEqual(float(re.search(r'dy="([\d.]+)em"', attributes)[1]), 0.75, "the height of a capital letter")

    def test_every_advice_has_words_and_they_are_plain(self):
        """A kind of warning that has advice in the report has words on the page."""
        advice = (small_run.source / "pipelines/advice.tsv").read_text().splitlines()
        rows = [line.split("\t")[0] for line in advice if line[:1] not in ("#", "")]
        words = (Path(facts.__file__).parent / "words.tsv").read_text()
        missing = [row for row in rows if f"\n{row}\t" not in words and row != "is (below|above) the range of"]
        self.assertEqual(missing, [])


if __name__ == "__main__":
    unittest.main()
