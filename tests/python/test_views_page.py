# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of both views: what its scripts read is what the files of the run say."""
import base64
import dataclasses
import json
import re
import shutil
import unittest

import numpy as np

import breast
import small_run
from breast.errors import BreastError

try:
    import jinja2  # noqa: F401
    from breast.page import packed
    from breast.page.views_page import read_views, views_page
    without_jinja = ""
except ImportError:
    without_jinja = "python3-jinja2 is not installed"


def data_of(page: str) -> dict:
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1])


def unpacked(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), kind)


@unittest.skipIf(without_jinja, without_jinja)
class PackedData(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_folder = small_run.folder()
        cls.views = read_views(cls.run_folder, None)
        cls.page = views_page(cls.views)

    def test_holds_the_curves_of_both_directions(self):
        low, high = packed.box_of(self.views.states[0])
        for lookup, held in zip(self.views.lookups, data_of(self.page)["lookups"]):
            tissue = lookup.status != 0
            self.assertGreater(np.count_nonzero(tissue), 50)
            self.assertEqual((held["nv"], held["nu"], held["pitch"]), (*lookup.status.shape, lookup.pitch_mm))
            np.testing.assert_array_equal(unpacked(held["status"], "u1"), lookup.status.ravel())
            for name, kind, values in (("depth", "<u2", lookup.depth_mm), ("curve", "<i2", lookup.curve_mm),
                                       ("imaged", "<i2", lookup.imaged_mm - 0.5 * (low + high))):
                np.testing.assert_allclose(0.01 * unpacked(held[name], kind), values[tissue].ravel(), atol=0.0051)

    def test_holds_the_images_as_they_are_hung(self):
        for image, state, held in zip(self.views.images, self.views.states, data_of(self.page)["images"]):
            grey = unpacked(held["grey"], "<u2").reshape(held["height"], held["width"])
            self.assertEqual(grey.shape, image.images["path"].shape)
            self.assertGreater(grey.max(), 60000)
            expected = image.project(state.landmark_position("nipple")[None])[0]
            np.testing.assert_allclose(held["landmarks"][0]["at"], expected)

    def test_shows_of_the_scan_only_the_breast(self):
        scan = breast.load(self.run_folder / "small-scan.nrrd")
        held = packed.packed_scan(scan, self.views.states[0])
        low, high = packed.box_of(self.views.states[0])
        np.testing.assert_allclose(held["origin"], low - 15)
        self.assertTrue(((np.array(held["size"]) - 1) * held["spacing"] <= high - low + 30).all())
        grey = unpacked(held["grey"], "u1").reshape(held["size"][::-1])
        place = np.array(held["origin"]) + np.array([40, 30, 20]) * held["spacing"]
        near = scan.sample(place[None])[0]
        darker, brighter = (np.count_nonzero(scan.sample(self.places(held)[::50]) < near + d) for d in (-1, 1))
        self.assertLessEqual(darker, np.count_nonzero(grey.ravel()[::50] <= grey[20, 30, 40]))
        self.assertLessEqual(np.count_nonzero(grey.ravel()[::50] < grey[20, 30, 40]), brighter)
        elsewhere = dataclasses.replace(scan, grid=dataclasses.replace(scan.grid, origin=scan.grid.origin + 1000))
        with self.assertRaisesRegex(BreastError, "covers 0 % of the bounding box"):
            packed.packed_scan(elsewhere, self.views.states[0])

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
            made = views_page(dataclasses.replace(self.views, lookups=(lookup, self.views.lookups[1])))
            self.assertFalse("<" in hostile and hostile in made, hostile)
            self.assertEqual(made.count("</script>"), self.page.count("</script>"))
            self.assertEqual(data_of(made)["band_without"], hostile)

    def test_refuses_files_of_other_views(self):
        for name, other, said in (("cc.vti", "mlo.vti", "is of CC of the left breast, but"), ("cc.vtkhdf", "mesh.vtkhdf", "is no compression"),
                                  ("lookup.h5", "lookup.h5", "was made of other compressions")):
            run = small_run.scratch("page")
            for file in ("cc.vtkhdf", "mlo.vtkhdf", "cc.vti", "mlo.vti", "lookup.h5"):
                shutil.copy(self.run_folder / file, run)
            shutil.copy(self.run_folder / other, run / name)
            if name == other:
                small_run.tool(f"compress {self.run_folder}/reference.vtkhdf {run}/cc.vtkhdf --view CC --reduction 20 --at-least 15", run)
            with self.assertRaisesRegex(BreastError, said):
                read_views(run, None)


if __name__ == "__main__":
    unittest.main()
