# SPDX-License-Identifier: GPL-3.0-or-later
"""Points through the element map: exact on affine maps, there and back, landmarks, distorted elements, points outside."""
import unittest

import numpy as np

import breast
import small_run
from breast.element_map import ElementMap
from breast.elements import LATTICE, boundary_faces, element_volumes, evaluate
from breast.transport import transported

MATRIX = np.array([[1.2, 0.3, -0.1], [0.05, 0.8, 0.2], [-0.25, 0.1, 1.1]])
SHIFT = np.array([31.0, -7.0, 12.0])

CURVED = [
    [-1.04, -0.87, -0.85], [0.81, -0.84, -0.76], [1.29, 0.79, -1.33], [-1.08, 1.21, -0.77], [-1.03, -1.17, 0.9],
    [1.03, -1.02, 0.84], [0.91, 1.13, 1.07], [-1.18, 1.04, 0.76], [-0.26, -0.96, -0.87], [1.14, 0.07, -1.18],
    [0.3, 0.96, -0.89], [-0.95, 0.0, -1.13], [0.02, -1.19, 0.67], [1.11, 0.16, 0.69], [-0.29, 1.13, 1.16],
    [-0.88, -0.22, 1.09], [-0.9, -1.01, -0.02], [1.32, -0.69, -0.02], [0.89, 0.75, 0.25], [-0.99, 1.03, -0.12],
    [-1.05, -0.13, -0.1], [1.28, 0.24, -0.17], [-0.01, -0.78, 0.31], [-0.27, 0.79, -0.12], [-0.26, 0.29, -1.32],
    [-0.04, -0.04, 1.02], [0.04, -0.12, -0.17]]
"""Nodes of a strongly curved 27-node element whose Jacobian is positive throughout."""


def interior(shape_map: ElementMap, count: int, seed: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Random points inside random elements: places, element, local."""
    random = np.random.default_rng(seed)
    element = random.integers(0, len(shape_map._nodes), count)
    local = random.uniform(-1, 1, (count, 3))
    return shape_map.positions(element, local), element, local


def block(cells: int, order: int) -> tuple[np.ndarray, np.ndarray]:
    """A cube of side `cells` (mm) of cells³ elements: hexahedra and nodes."""
    side = order * cells + 1
    nodes = np.stack(np.meshgrid(*[np.arange(side) / order] * 3, indexing="ij"), -1).reshape(-1, 3)
    lattice = (LATTICE[:8] + 1) // 2 if order == 1 else LATTICE + 1
    hexahedra = []
    for corner in np.ndindex(cells, cells, cells):
        i, j, k = (order * np.array(corner) + lattice).T
        hexahedra.append((i * side + j) * side + k)
    return np.array(hexahedra), nodes


class AffineMaps(unittest.TestCase):
    def check(self, state: breast.State) -> None:
        source = state.element_map("imaged")
        target = ElementMap(state.hexahedra, state.imaged @ MATRIX.T + SHIFT)
        points = interior(source, 5000, 1)[0]
        moved = transported(source, target, state._boundary(), points)
        self.assertTrue(moved.inside.all())
        self.assertLess(np.abs(moved.points - (points @ MATRIX.T + SHIFT)).max(), 1e-10)
        np.testing.assert_array_equal(moved.distance, 0)

    def test_linear_elements_reproduce_it(self) -> None:
        self.check(breast.load(small_run.folder() / "mesh.vtkhdf"))

    def test_quadratic_elements_reproduce_it(self) -> None:
        state = breast.load(small_run.quadratic() / "mesh.vtkhdf")
        self.assertEqual(state.hexahedra.shape[1], 27)
        self.check(state)


class ThereAndBack(unittest.TestCase):
    def check(self, folder, pairs) -> None:
        run = breast.load(folder)
        for a, b in pairs:
            with self.subTest(a=a, b=b):
                points, element, local = interior(run.element_map(a), 3000, 2)
                there = run.transport(points, a, b)
                back = run.transport(there.points, b, a)
                self.assertTrue(there.inside.all() and back.inside.all())
                self.assertLess(np.linalg.norm(back.points - points, axis=1).max(), 1e-8)
                # The point is the material point it was made from, not merely one that comes back.
                exact = run.element_map(b).positions(element, local)
                self.assertLess(np.linalg.norm(there.points - exact, axis=1).max(), 1e-8)

    def test_linear(self) -> None:
        self.check(small_run.folder(), [("imaged", "supine"), ("reference", "cc"), ("cc", "mlo"), ("mlo", "imaged")])

    def test_quadratic(self) -> None:
        self.check(small_run.quadratic(), [("imaged", "supine")])

    def test_nodes_move_as_the_nodal_displacement(self) -> None:
        run = breast.load(small_run.folder())
        moved = run.transport(run.shape("imaged"), "imaged", "supine")
        self.assertTrue(moved.inside.all())
        self.assertLess(np.abs(moved.points - run.shape("imaged") - run.displacement("imaged", "supine")).max(), 1e-9)


class Outside(unittest.TestCase):
    def setUp(self) -> None:
        hexahedra, nodes = block(3, 1)
        self.boundary = boundary_faces(hexahedra)
        self.source, self.target = ElementMap(hexahedra, nodes), ElementMap(hexahedra, nodes + SHIFT)

    def test_it_is_nan_with_its_distance(self) -> None:
        points = np.array([[1.5, 1.5, 1.5], [4.0, 1.1, 2.9], [-1.0, -2.0, 1.0], [5.0, 5.0, 5.0], [1.0, 1.0, 3.25]])
        moved = transported(self.source, self.target, self.boundary, points)
        np.testing.assert_array_equal(moved.inside, [True, False, False, False, False])
        self.assertTrue(np.isnan(moved.points[1:]).all())
        np.testing.assert_allclose(moved.points[0], points[0] + SHIFT, atol=1e-12)
        np.testing.assert_allclose(moved.distance, [0, 1, 5**0.5, 12**0.5, 0.25], atol=1e-9)

    def test_within_moves_it_to_the_surface(self) -> None:
        points = np.array([[4.0, 1.0, 1.0], [3.2, 1.0, 1.0]])
        moved = transported(self.source, self.target, self.boundary, points, within=0.5)
        np.testing.assert_array_equal(moved.inside, [False, True])
        np.testing.assert_allclose(moved.points[1], np.array([3, 1, 1]) + SHIFT, atol=1e-9)
        np.testing.assert_allclose(moved.distance, [1, 0.2], atol=1e-9)
        np.testing.assert_allclose(moved.moved, [0, 0.2], atol=1e-9)

    def test_in_front_of_the_breast(self) -> None:
        run = breast.load(small_run.folder())
        nipple = run.landmark_position("nipple", "imaged")
        moved = run.transport([nipple + [0, -20, 0]], "imaged", "supine")
        self.assertFalse(moved.inside[0])
        self.assertTrue(np.isnan(moved.points).all())
        # Not farther than the skin behind it, and no nearer than the nearest node less an element's half width.
        nearest = np.linalg.norm(run.shape("imaged") - (nipple + [0, -20, 0]), axis=1).min()
        self.assertLessEqual(moved.distance[0], min(20, nearest) + 1e-9)
        self.assertGreater(moved.distance[0], nearest - 10)

    def test_bad_points_are_refused(self) -> None:
        run = breast.load(small_run.folder())
        for points, word in (([[1, 2]], "shape"), ([[1, np.nan, 3]], "finite"), ([1, 2, 3], "shape")):
            with self.assertRaisesRegex(breast.BreastError, word):
                run.transport(points, "imaged", "supine")
        with self.assertRaisesRegex(breast.BreastError, "within"):
            run.transport([[1, 2, 3]], "imaged", "supine", within=-1)


class Distances(unittest.TestCase):
    """Against the smallest distance to a dense sampling of the same faces."""

    def check(self, state: breast.State, steps: int) -> None:
        t = np.linspace(-1, 1, steps)
        samples = []
        for element, face in state.faces["pectoral"]:
            local = np.empty((steps * steps, 3))
            axis = face // 2
            local[:, axis] = 2 * (face % 2) - 1
            local[:, [a for a in range(3) if a != axis]] = np.stack(np.meshgrid(t, t), -1).reshape(-1, 2)
            samples.append(state.element_map("imaged").positions(np.full(len(local), element), local))
        samples = np.concatenate(samples)
        points = state.centres("imaged")[::7]
        found = state.distance_to("pectoral", points)
        for point, distance in zip(points, found):
            sampled = np.linalg.norm(samples - point, axis=1).min()
            self.assertLessEqual(distance, sampled + 1e-9)
            self.assertLess(sampled - distance, 0.05)

    def test_linear(self) -> None:
        self.check(breast.load(small_run.folder() / "mesh.vtkhdf"), 41)

    def test_quadratic(self) -> None:
        self.check(breast.load(small_run.quadratic() / "mesh.vtkhdf"), 61)


class DistortedElements(unittest.TestCase):
    def check(self, order: int, amount: float, seed: int) -> None:
        """Nodes of a block moved at random, by a part of the element's width; elements whose Jacobian stays positive."""
        hexahedra, nodes = block(6, order)
        random = np.random.default_rng(seed)
        moved = nodes + random.uniform(-amount, amount, nodes.shape)
        corners = np.concatenate([LATTICE[:8], 0.5 * LATTICE[:8], LATTICE[8:]])
        det = np.min([np.linalg.det(evaluate(order, moved[hexahedra], np.tile(c, (len(hexahedra), 1)))[1])
                      for c in corners], axis=0)
        shape = ElementMap(hexahedra, moved)
        usable = np.flatnonzero(det > 1e-3 * np.median(det))
        element = np.repeat(usable, 60)
        local = random.uniform(-1, 1, (len(element), 3))
        points = shape.positions(element, local)
        found = shape.locate(points)
        self.assertTrue(found.inside.all())
        self.assertLess(np.abs(shape.positions(found.element, found.local) - points).max(), 1e-9)
        if len(usable) == len(hexahedra):  # no overlap: the answer is unique
            same = found.element == element
            self.assertLess(np.abs(found.local[same] - local[same]).max(), 1e-7)
            self.assertGreater(same.mean(), 0.999)

    def test_moderately(self) -> None:
        self.check(1, 0.2, 3)

    def test_strongly(self) -> None:
        for seed in range(2):
            self.check(1, 0.45, seed)

    def test_quadratic(self) -> None:
        self.check(2, 0.08, 5)

    def test_a_curved_element_in_which_one_start_is_not_enough(self) -> None:
        """Its Jacobian is positive throughout; from the nearest corner alone Newton's method misses this point."""
        nodes = np.array(CURVED)
        shape = ElementMap(np.arange(27)[None], nodes)
        local = np.array([[0.01, -0.93, 0.98]])
        found = shape.locate(shape.positions(np.zeros(1, int), local))
        self.assertTrue(found.inside[0])
        np.testing.assert_allclose(found.local, local, atol=1e-9)

    def test_volumes(self) -> None:
        hexahedra, nodes = block(3, 1)
        volumes = element_volumes(1, (nodes @ MATRIX.T)[hexahedra])
        np.testing.assert_allclose(volumes, np.linalg.det(MATRIX), rtol=1e-13)
        hexahedra, nodes = block(2, 2)
        # x -> x + x²/10: exact volume of [a, b] x 1 x 1 is b - a + (b² - a²)/10.
        curved = nodes + np.stack([nodes[:, 0] ** 2 / 10, 0 * nodes[:, 0], 0 * nodes[:, 0]], -1)
        self.assertAlmostEqual(element_volumes(2, curved[hexahedra]).sum(), 4 * (2 + 0.4), places=12)


class Landmarks(unittest.TestCase):
    def test_they_are_where_every_file_says(self) -> None:
        run = breast.load(small_run.folder())
        for name in run.mesh.landmarks:
            imaged = run.landmark_position(name, "imaged")
            for state in run.states:
                landmark = run.state(state).landmarks[name]
                own = run.state(state).landmark_position(name)
                moved = run.transport([imaged], "imaged", state, within=1e-6)
                self.assertLess(np.linalg.norm(moved.points[0] - own), 1e-6)
                np.testing.assert_array_equal(landmark.local, run.mesh.landmarks[name].local)

    def test_they_are_where_probe_says(self) -> None:
        """probe is a program of its own reader and its own element map; it prints 4 decimals."""
        run = breast.load(small_run.folder())
        rows = breast.read_table(run.folder / "displacements.tsv", pandas=False)
        self.assertEqual([row["file"] for row in rows], [f"{s}.vtkhdf" for s in run.states])
        for row in rows:
            state = run.state(str(row["file"]).removesuffix(".vtkhdf"))
            for name in state.landmarks:
                place = state.landmark_position(name)
                printed = [row[f"{name}_{axis}_mm"] for axis in "xyz"]
                self.assertLess(np.abs(place - printed).max(), 5.1e-5)
                length = np.linalg.norm(place - state.landmark_position(name, "imaged"))
                self.assertLess(abs(length - row[f"{name}_mm"]), 5.1e-5)

    def test_they_are_where_the_reports_say(self) -> None:
        run = breast.load(small_run.folder())
        for state in ("reference", "supine", "cc", "mlo"):
            for name, told in run.reports[state]["landmarks"].items():
                self.assertLess(np.abs(run.landmark_position(name, state) - told["position"]).max(), 1e-9)


if __name__ == "__main__":
    unittest.main()
