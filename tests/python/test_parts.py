# SPDX-License-Identifier: GPL-3.0-or-later
"""States that hold a part of the mesh: compress leaves out the tissue around the breast, and points still find each other."""
import shutil
import unittest

import h5py
import numpy as np

import breast
import small_run

ELEMENT_NUMBER, NODE_NUMBER = "VTKHDF/CellData/element_number", "VTKHDF/PointData/node_number"


class Parts(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.run_ = breast.load(small_run.demo())

    def around(self) -> np.ndarray:
        return np.flatnonzero(self.run_.mesh.tissue == breast.TISSUES.index("other"))

    def test_compressions_are_parts_of_the_mesh(self) -> None:
        mesh, cc = self.run_.mesh, self.run_.cc
        self.assertTrue(cc.part and self.run_.mlo.part)
        self.assertFalse(mesh.part or self.run_.supine.part)
        np.testing.assert_array_equal(cc.element_numbers, np.setdiff1d(mesh.element_numbers, self.around()))
        np.testing.assert_array_equal(cc.imaged, mesh.imaged[cc.node_numbers])

    def test_points_of_the_scan_reach_every_state_and_come_back(self) -> None:
        mesh = self.run_.mesh
        own = np.setdiff1d(mesh.element_numbers, self.around())
        points = mesh.element_map("imaged").positions(own, np.tile([0.3, -0.2, 0.6], (len(own), 1)))
        for state in ("reference", "supine", "cc", "mlo"):
            there = self.run_.transport(points, "imaged", state)
            self.assertTrue(there.inside.all(), state)
            back = self.run_.transport(there.points, state, "imaged")
            self.assertLess(np.linalg.norm(back.points - points, axis=1).max(), 1e-8, state)
        across = self.run_.transport(self.run_.transport(points, "imaged", "cc").points, "cc", "mlo")
        np.testing.assert_allclose(across.points, self.run_.transport(points, "imaged", "mlo").points, atol=1e-8)

    def test_the_tissue_around_has_no_place_in_a_compression(self) -> None:
        centres = self.run_.mesh.centres("imaged")[self.around()]
        moved = self.run_.transport(centres, "imaged", "cc")
        self.assertFalse(moved.inside.any())
        self.assertTrue(np.isnan(moved.points).all() and moved.located.inside.all())
        np.testing.assert_array_equal(moved.distance, 0)
        self.assertTrue(self.run_.transport(centres, "imaged", "supine").inside.all())

    def test_nodes_that_a_state_lacks_are_not_numbers(self) -> None:
        moved = self.run_.displacement("imaged", "cc")
        self.assertEqual(moved.shape, self.run_.mesh.points.shape)
        known = np.isfinite(moved).all(1)
        np.testing.assert_array_equal(np.flatnonzero(known), self.run_.cc.node_numbers)
        np.testing.assert_array_equal(moved[known], self.run_.cc.points - self.run_.cc.imaged)

    def test_landmarks_are_where_the_reports_say(self) -> None:
        for state in ("supine", "cc", "mlo"):
            for name, told in self.run_.reports[state]["landmarks"].items():
                self.assertLess(np.abs(self.run_.landmark_position(name, state) - told["position"]).max(), 1e-9)

    def changed(self, name: str, change) -> breast.Run:
        folder = small_run.scratch(name)
        for file in ("mesh.vtkhdf", "cc.vtkhdf"):
            shutil.copy(small_run.demo() / file, folder)
        with h5py.File(folder / "cc.vtkhdf", "r+") as h5:
            change(h5)
        return breast.load(folder)

    def test_numbers_of_another_mesh_are_refused(self) -> None:
        def shift(h5: h5py.File) -> None:
            h5[ELEMENT_NUMBER][-1] += 1
        with self.assertRaisesRegex(breast.BreastError, "cc.vtkhdf: has another mesh"):
            self.changed("shifted", shift).shape("cc")

    def test_numbers_come_together_and_ascend(self) -> None:
        for path in (ELEMENT_NUMBER, NODE_NUMBER):
            with self.assertRaisesRegex(breast.BreastError, f"/{path} is missing"):
                self.changed("missing", lambda h5: h5.pop(path)).shape("cc")

            def repeat(h5: h5py.File) -> None:
                h5[path][3] = h5[path][2]
            with self.assertRaisesRegex(breast.BreastError, rf"/{path}\[3\]"):
                self.changed("repeated", repeat).shape("cc")


if __name__ == "__main__":
    unittest.main()
