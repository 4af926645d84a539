# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read is what the files hold: against the programs' own digests, against VTK where it is installed, and against tables."""
import importlib.util
import json
import sys
import unittest
from unittest import mock

import numpy as np

import breast
import small_run

HAS_VTK = importlib.util.find_spec("vtkmodules") is not None
HAS_PANDAS = importlib.util.find_spec("pandas") is not None


class States(unittest.TestCase):
    def setUp(self) -> None:
        self.run_ = breast.load(small_run.folder())

    def test_the_chain_is_there_in_its_order(self) -> None:
        self.assertEqual(self.run_.states, ("mesh", "reference", "supine", "cc", "mlo"))
        self.assertEqual([c.tool for c in self.run_.cc.history],
                         ["segment", "fit-hermite", "hexmesh", "backward", "compress"])
        self.assertEqual(self.run_.cc.side, "left")
        np.testing.assert_array_equal(self.run_.supine.gravity, [0, 9810, 0])

    def test_displacements_are_those_of_the_file(self) -> None:
        import h5py
        for name in ("supine", "cc"):
            with h5py.File(small_run.folder() / f"{name}.vtkhdf") as file:
                stored = file["VTKHDF/PointData"]
                state = self.run_.state(name)
                np.testing.assert_array_equal(state.displacement_from_scan, stored["displacement_from_scan"][:])
                np.testing.assert_array_equal(state.displacement_from_stress_free,
                                              stored["displacement_from_stress_free"][:])
                np.testing.assert_array_equal(self.run_.displacement("imaged", name), state.displacement_from_scan)
                np.testing.assert_array_equal(self.run_.displacement("reference", name),
                                              state.displacement_from_stress_free)

    def test_records_agree_with_the_report(self) -> None:
        cc, report = self.run_.cc, self.run_.reports["cc"]
        self.assertEqual(cc.contact.view, "CC")
        self.assertAlmostEqual(cc.contact.thickness_mm, report["thickness_mm"], places=9)
        self.assertAlmostEqual(cc.contact.reduction_percent, report["reduction_percent"], places=9)
        self.assertAlmostEqual(cc.contact.path["thickness_mm"][-1], cc.contact.thickness_mm, places=9)
        self.assertAlmostEqual(cc.contact.path["force_N"][-1], cc.contact.plates["paddle"].force_N, places=6)
        self.assertEqual(cc.solve.status, report["status"])
        self.assertEqual((cc.model.name, cc.model.element), (report["materials"]["name"], report["element"]))
        self.assertEqual((cc.model.wall, cc.model.cut), (report["wall"], report["cut"]))
        self.assertTrue(cc.model.materials.startswith("tissue\tlaw"))
        self.assertIsNone(self.run_.mesh.model)
        self.assertEqual(set(cc.solve.iterations), {"step", "iteration", "residual", "min_det_F", "max_det_F",
                                                    "step_length", "seconds"})
        self.assertIn("contact_pressure", cc.point_arrays)

    def test_volumes_are_those_of_the_report(self) -> None:
        told = self.run_.reports["supine"]["volumes_ml"]
        supine = self.run_.supine
        for shape in ("imaged", "reference", "points"):
            volumes = supine.volumes(shape) / 1000
            for tissue in ("fat", "fibroglandular"):
                ml = volumes[supine.tissue == breast.TISSUES.index(tissue)].sum()
                self.assertAlmostEqual(ml, told[tissue], delta=1e-6 * told[tissue])

    def test_arrays_refuse_changes(self) -> None:
        for array in (self.run_.cc.points, self.run_.cc.tissue, self.run_.cc.cell_arrays["det_F"]):
            with self.assertRaises(ValueError):
                array[0] = 0

    def test_a_section_lies_in_its_plane_and_on_the_nodes_box(self) -> None:
        supine = self.run_.supine
        middle = 0.5 * (supine.points.min(0) + supine.points.max(0))
        outline = supine.section("points", middle, [0, 0, 2])
        self.assertEqual(set(outline), {"skin", "pectoral", "cut"})
        segments = np.concatenate(list(outline.values()))
        self.assertGreater(len(segments), 20)
        np.testing.assert_allclose(segments[:, :, 2], middle[2], atol=1e-9)
        # The outline is closed: every end is shared by exactly two segments.
        ends = np.round(segments.reshape(-1, 3), 6)
        self.assertTrue((np.unique(ends, axis=0, return_counts=True)[1] % 2 == 0).all())

    def test_another_mesh_does_not_correspond(self) -> None:
        folder = small_run.scratch("mixed")
        for name, file in (("mesh", small_run.folder() / "mesh.vtkhdf"), ("supine", small_run.quadratic() / "supine.vtkhdf")):
            (folder / f"{name}.vtkhdf").write_bytes(file.read_bytes())
        with self.assertRaisesRegex(breast.BreastError, "another mesh"):
            breast.load(folder).displacement("imaged", "supine")


class Volumes(unittest.TestCase):
    def test_the_scan_is_the_one_segment_read(self) -> None:
        """The history's digest was made by a program from its own reading of grid and voxels."""
        run = breast.load(small_run.folder())
        self.assertEqual(run.scan.content_sha256(), run.labels.history[0].inputs[0].sha256)

    def test_another_scan_is_refused(self) -> None:
        content = bytearray((small_run.folder() / "small-scan.nrrd").read_bytes())
        other = content.replace(b"space origin: (-208.28,", b"space origin: (-209.28,")
        self.assertNotEqual(other, content)
        file = small_run.scratch("scan") / "small-scan.nrrd"
        file.write_bytes(other)
        with self.assertRaisesRegex(breast.BreastError, "not the scan"):
            breast.load(small_run.folder()).scan_from(file)

    def test_nifti_and_meta_image_hold_the_same_labels(self) -> None:
        folder, labels = small_run.scratch("formats"), breast.load(small_run.folder()).labels
        for ending in (".nrrd", ".nii.gz", ".nii", ".mha"):
            small_run.tool(f"segment {small_run.folder()}/small-scan.nrrd labels{ending} --side left", folder)
            volume = breast.load(folder / f"labels{ending}")
            np.testing.assert_array_equal(volume.voxels, labels.tissue)
            self.assertEqual(volume.grid.size, labels.grid.size)
            np.testing.assert_allclose(volume.grid.to_patient([[0, 0, 0], [3, 5, 7]]),
                                       labels.grid.to_patient([[0, 0, 0], [3, 5, 7]]), atol=1e-3)

    def test_index_and_place_invert_each_other(self) -> None:
        turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
        grid = breast.Grid((7, 6, 5), np.array([0.8, 1.1, 2.5]), np.array([10.0, -20, 30]), turn)
        index = np.array([[0, 0, 0], [1, 0, 0], [2.5, 3.25, -1]])
        np.testing.assert_allclose(grid.to_index(grid.to_patient(index)), index, atol=1e-12)
        np.testing.assert_allclose(grid.to_patient(index)[1] - grid.to_patient(index)[0], 0.8 * turn[:, 0], atol=1e-12)

    def test_interpolation_is_exact_for_a_trilinear_field(self) -> None:
        grid = breast.Grid((7, 6, 5), np.array([0.8, 1.1, 2.5]), np.array([10.0, -20, 30]), np.eye(3))
        k, j, i = np.meshgrid(range(5), range(6), range(7), indexing="ij")
        field = 2 + i - 3.0 * j * k + 0.5 * i * j
        at = np.random.default_rng(5).uniform(0, 1, (50, 3)) * [6, 5, 4]
        expected = 2 + at[:, 0] - 3 * at[:, 1] * at[:, 2] + 0.5 * at[:, 0] * at[:, 1]
        np.testing.assert_allclose(grid.sample(field, grid.to_patient(at), -1), expected, atol=1e-10)
        self.assertEqual(grid.sample(field, grid.to_patient([[-0.6, 0, 0]]), -1)[0], -1)

    def test_label_volumes_are_those_of_the_report(self) -> None:
        run = breast.load(small_run.folder())
        for tissue, ml in run.reports["labels"]["volumes_ml"].items():
            self.assertAlmostEqual(run.labels.volume_ml(tissue), ml, delta=1e-9 + 1e-9 * ml)
        np.testing.assert_array_equal(
            run.labels.grid.nearest(run.labels.tissue, run.labels.centres("fibroglandular"), 0), 2)


class Views(unittest.TestCase):
    """Curves, mammograms, lookup and table are made by three programs and agree about the tumour's place."""

    def test_the_tumour_is_where_cc2mlo_says(self) -> None:
        run = breast.load(small_run.folder())
        row = breast.read_table(run.folder / "curve.tsv", pandas=False)[0]
        for view, columns in (("cc", ("cc_u_mm", "cc_v_mm")), ("mlo", ("model_u_mm", "model_v_mm"))):
            uv = run.mammograms[view].project([run.landmark_position("tumour", view)])[0]
            self.assertLess(np.abs(uv - [row[c] for c in columns]).max(), 1e-4)
        self.assertLess(np.abs(run.curves["point in CC"][0].uv_mm[0] - [row["cc_u_mm"], row["cc_v_mm"]]).max(), 1e-4)

    def test_the_column_is_carried_by_the_element_map(self) -> None:
        """cc2mlo maps the column of CC to the MLO view by its own locator."""
        run = breast.load(small_run.folder())
        column, there = run.curves["column in CC"][0].points, run.curves["column in MLO"][0].points
        moved = run.transport(column, "cc", "mlo", within=1e-6)
        self.assertTrue(moved.inside.all())
        self.assertLess(np.linalg.norm(moved.points - there, axis=1).max(), 1e-6)
        imaged = run.transport(column, "cc", "imaged", within=1e-6).points
        self.assertLess(np.linalg.norm(imaged - run.curves["column in imaged"][0].points, axis=1).max(), 1e-6)

    def test_the_lookup_is_read(self) -> None:
        lookup = breast.load(small_run.folder()).lookup
        self.assertEqual((lookup.from_view, lookup.to_view, lookup.pitch_mm), ("CC", "MLO", 5.0))
        self.assertTrue((lookup.status == 1).any())
        j, i = np.argwhere(lookup.status == 1)[0]
        self.assertEqual(lookup.node(5.0 * i + 1, 5.0 * j - 1), (j, i))
        # Imaged columns lie in the imaged body.
        run = breast.load(small_run.folder())
        self.assertTrue(run.transport(lookup.imaged_mm[j, i], "imaged", "cc", within=1e-3).inside.all())

    def test_geometry_is_read(self) -> None:
        geometry = breast.load(small_run.folder()).geometry
        import h5py
        with h5py.File(geometry.file) as file:
            st = file["breast/hermite"].attrs["nipple_st"]
        self.assertLess(np.linalg.norm(geometry.skin.points(st[None])[0] - geometry.nipple), 1e-6)
        self.assertEqual(len(geometry.rim_border), len(geometry.rim_skin))
        self.assertEqual(set(geometry.rim_border), {0, 1, 2, 3})
        skin = geometry.points[np.unique(geometry.quads[geometry.part == 0])]
        self.assertLess(np.abs(skin - geometry.nipple).max(1).min(), 20)


class Tables(unittest.TestCase):
    def test_without_pandas(self) -> None:
        with mock.patch.dict(sys.modules, {"pandas": None}):
            table = breast.read_table(small_run.folder() / "curve.tsv")
            self.assertIsInstance(table, np.ndarray)
            with self.assertRaisesRegex(breast.BreastError, "python3-pandas"):
                breast.read_table(small_run.folder() / "curve.tsv", pandas=True)
        self.assertIn(table["status"][0], ("matched", "behind_image"))
        self.assertEqual(table["query"].dtype, np.int64)
        self.assertTrue(np.isnan(table["band_95_area_mm2"][0]))

    @unittest.skipUnless(HAS_PANDAS, "python3-pandas is not installed")
    def test_with_pandas(self) -> None:
        frame = breast.load(small_run.folder()).tables["displacements"]
        self.assertEqual(type(frame).__name__, "DataFrame")
        plain = breast.read_table(small_run.folder() / "displacements.tsv", pandas=False)
        np.testing.assert_array_equal(frame["nipple_x_mm"], plain["nipple_x_mm"])

    def test_reports_are_dicts(self) -> None:
        run = breast.load(small_run.folder())
        self.assertEqual(run.reports["cc"], json.loads((small_run.folder() / "cc.json").read_text()))
        self.assertIn("cc-mammogram", run.reports)
        with self.assertRaisesRegex(breast.BreastError, "it has: cc, cc-mammogram"):
            run.reports["xx"]


class Vtk(unittest.TestCase):
    def test_without_vtk_the_package_is_named(self) -> None:
        with mock.patch.dict(sys.modules, {"vtkmodules.util.numpy_support": None}):
            with self.assertRaisesRegex(breast.BreastError, "python3-vtk9"):
                breast.load(small_run.folder()).mesh.vtk()

    @unittest.skipUnless(HAS_VTK, "python3-vtk9 is not installed")
    def test_the_grid_is_that_of_vtks_own_reader(self) -> None:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOHDF import vtkHDFReader
        for folder in (small_run.folder(), small_run.quadratic()):
            reader = vtkHDFReader()
            reader.SetFileName(str(folder / "supine.vtkhdf"))
            reader.Update()
            theirs, ours = reader.GetOutput(), breast.load(folder / "supine.vtkhdf").vtk()
            self.assertEqual(theirs.GetNumberOfCells(), ours.GetNumberOfCells())
            for c in range(0, ours.GetNumberOfCells(), 17):
                self.assertEqual(theirs.GetCellType(c), ours.GetCellType(c))
                ids = [[cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
                       for cell in (theirs.GetCell(c), ours.GetCell(c))]
                self.assertEqual(*ids)
            for arrays in (lambda g: g.GetPointData(), lambda g: g.GetCellData()):
                names = {arrays(theirs).GetArrayName(i) for i in range(arrays(theirs).GetNumberOfArrays())}
                self.assertEqual(names, {arrays(ours).GetArrayName(i) for i in range(arrays(ours).GetNumberOfArrays())})
                for name in names:
                    np.testing.assert_array_equal(vtk_to_numpy(arrays(theirs).GetArray(name)),
                                                  vtk_to_numpy(arrays(ours).GetArray(name)))

    @unittest.skipUnless(HAS_VTK, "python3-vtk9 is not installed")
    def test_points_are_inside_where_vtk_finds_a_cell(self) -> None:
        from vtkmodules.vtkCommonCore import reference
        state = breast.load(small_run.folder() / "supine.vtkhdf")
        grid = state.vtk()
        random = np.random.default_rng(6)
        points = random.uniform(state.points.min(0), state.points.max(0), (2000, 3))
        moved = state.transport(points, "points", "imaged")
        place, weights = [0.0] * 3, [0.0] * 8
        for point, inside, element in zip(points, moved.inside, moved.located.element):
            cell = grid.FindCell(point, None, -1, 1e-12, reference(0), place, weights)
            self.assertEqual(cell >= 0, inside, point)
            if inside:
                self.assertEqual(cell, element)


if __name__ == "__main__":
    unittest.main()
