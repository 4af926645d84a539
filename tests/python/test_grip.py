# SPDX-License-Identifier: GPL-3.0-or-later
"""The grip of plates by the shape alone: blocks between plates whose force is known."""
import unittest
from types import SimpleNamespace

import numpy as np

from breast.records import Plate
from breast.study.grip import ONSET_MM, gap, grip

STIFFNESS = 1e6  # Pa/mm
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float)
TOP_AND_BOTTOM = np.array([[0, 4], [0, 5]])
HEIGHT = 30.0


def plate(name: str, level: float, down: float) -> Plate:
    """A plate perpendicular to z whose edge runs along y and begins where x is 0; anterior is +x."""
    return Plate(name, np.array([0, 0, down]), np.array([1.0, 0, 0]), np.array([0, 0, level]), 3.0, 0, 0, 0, 0, 0)


def block(behind: float, depth: float, rise: float = 0.0) -> SimpleNamespace:
    """A block of 50 x 40 x 30 mm from `behind` mm behind the edge on, which lies `depth` mm deep in both plates where x is 0, and `rise`
    mm per mm less deep in the paddle farther forwards."""
    points = CORNERS * [50, 40, HEIGHT] - [behind, 0, 0]
    points[4:, 2] += depth - rise * points[4:, 0]
    points[:4, 2] -= depth
    plates = {"paddle": plate("paddle", HEIGHT, -1.0), "detector": plate("detector", 0.0, 1.0)}
    return SimpleNamespace(contact=SimpleNamespace(surface_stiffness=STIFFNESS, plates=plates), points=points, imaged=points,
                           hexahedra=np.arange(8)[None], faces={"skin": TOP_AND_BOTTOM, "cut": np.empty((0, 2), int)})


class Grip(unittest.TestCase):
    def test_a_block_in_front_of_the_edge_carries_the_pressure_of_its_depth(self):
        depth = 0.05
        found = grip(block(-10, depth))
        pressure = STIFFNESS * (depth - ONSET_MM / 2)
        for force in found.force_N:
            self.assertAlmostEqual(force, pressure * 50 * 40 / 1e6, delta=0.01 * force)
        self.assertEqual(found.edge_percent, (0, 0))
        self.assertAlmostEqual(found.contact_percent, 100, delta=5)
        self.assertTrue(found.grips())

    def test_what_lies_far_behind_the_edge_carries_nothing(self):
        found = grip(block(25, 0.05))
        self.assertLess(found.edge_percent[0], 5)
        self.assertAlmostEqual(found.force_N[0], STIFFNESS * 0.04 * 25 * 40 / 1e6, delta=0.05 * found.force_N[0])

    def test_a_block_that_recedes_from_the_paddle_lies_on_its_edge(self):
        found = grip(block(25, 0.05, rise=0.2))
        self.assertGreater(found.edge_percent[0], 60)
        self.assertFalse(found.grips())

    def test_plates_that_touch_little_do_not_grip(self):
        found = grip(block(-10, 0.05, rise=0.05))
        self.assertLess(found.contact_percent, 40)
        self.assertFalse(found.grips())

    def test_the_edge_is_round_and_the_wall_behind_it_upright(self):
        at = np.array([[5, 0, HEIGHT], [-3, 0, HEIGHT + 3], [-5, 0, HEIGHT + 9], [0, 0, HEIGHT - 2.0]])
        np.testing.assert_allclose(gap(at, plate("paddle", HEIGHT, -1.0)), [0, 0, 2, 2], atol=1e-9)

    def test_other_states_are_not_judged(self):
        exact = block(0, 0.05)
        exact.contact.surface_stiffness = 0.0
        self.assertIsNone(grip(exact))
        self.assertIsNone(grip(SimpleNamespace(contact=None)))


if __name__ == "__main__":
    unittest.main()
