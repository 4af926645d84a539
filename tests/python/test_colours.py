# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours that are told apart in the figures, as people without one kind of cones see them, and in grey print."""
import itertools
import unittest

import numpy as np

try:
    from breast.figures import colours, cost
    from breast_validation.figures import budget, error_sources, methods_cost
    from matplotlib.colors import to_rgb
except ImportError as error:
    raise unittest.SkipTest(f"figures need python3-matplotlib ({error})") from None

SEEN = {"all cones": np.eye(3),
        "no L cones": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
        "no M cones": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
        "no S cones": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]])}
"""Of linear RGB: Machado, Oliveira and Fernandes 2009, IEEE Trans Vis Comput Graph 15(6), severity 1."""
APART, IN_GREY = 12, 10
"""Least distance in CIE L*a*b* (a difference of 2.3 is just noticed), and least difference of L*."""
_XYZ = np.array([[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]])


def lab(colour, seen="all cones"):
    """CIE L*a*b* (3) of an sRGB colour, D65, as it is seen."""
    value = np.array(to_rgb(colour))
    linear = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    xyz = _XYZ @ np.clip(SEEN[seen] @ linear, 0, 1) / (0.95047, 1, 1.08883)
    root = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * root[1] - 16, 500 * (root[0] - root[1]), 200 * (root[1] - root[2])])


class Colours(unittest.TestCase):
    def check_apart(self, pairs):
        """pairs of (colour, what else tells it apart in grey), with the name of each."""
        for (name, (a, form)), (other, (b, other_form)) in pairs:
            for seen in SEEN:
                self.assertGreater(np.linalg.norm(lab(a, seen) - lab(b, seen)), APART, f"{name} and {other}, {seen}")
            if form == other_form:
                self.assertGreater(abs(lab(a)[0] - lab(b)[0]), IN_GREY, f"{name} and {other} in grey")

    def check_palette(self, entries):
        self.check_apart(itertools.combinations([(str(n), entry) for n, entry in enumerate(entries)], 2))

    def test_a_known_colour(self):
        np.testing.assert_allclose(lab((1, 0, 0)), [53.24, 80.09, 67.20], atol=0.05)
        self.assertLess(np.linalg.norm(lab("#00ff00", "no M cones") - lab("#ffdd00", "no M cones")), 40, "they become alike")

    def test_lines_of_one_picture(self):
        for strokes in (colours.SHAPES, (colours.SKIN_LINE, colours.WALL_LINE, colours.GLAND_LINE, colours.MODEL_LINE)):
            self.check_palette([(stroke.colour, stroke.dashes or stroke.width) for stroke in strokes])

    def test_surfaces_that_touch(self):
        surface = {name: (getattr(colours, name), "") for name in ("SKIN", "MUSCLE", "GLAND", "TUMOUR", "COLUMN", "PLATE")}
        touching = (("SKIN", "MUSCLE"), ("SKIN", "GLAND"), ("SKIN", "PLATE"), ("GLAND", "TUMOUR"), ("GLAND", "MUSCLE"), ("TUMOUR", "COLUMN"))
        self.check_apart([((a, surface[a]), (b, surface[b])) for a, b in touching])

    def test_charts(self):
        self.check_palette([(colour, (marker, style)) for *_, colour, marker, style in cost._SERIES])
        self.check_palette([(colour, marker) for colour, marker in zip(methods_cost._COLOURS, methods_cost._MARKERS)])
        self.check_palette(list(error_sources._MEASURED.values()))
        self.check_palette([(colour, hatch) for _, _, colour, hatch in budget._ERRORS])

    def test_pressure_is_darker_where_it_is_higher(self):
        for seen in SEEN:
            light = [lab(colours.HEAT(x)[:3], seen)[0] for x in np.linspace(0, 1, 33)]
            self.assertTrue((np.diff(light) < 0).all(), seen)


if __name__ == "__main__":
    unittest.main()
