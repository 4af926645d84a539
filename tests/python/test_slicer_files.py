# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of 3D Slicer's formats: fields of vectors, segmentations, markups, and meshes in VTK XML."""
import importlib.util
import json
import unittest

import numpy as np

import breast
import small_run

HEADER = """NRRD0005
type: {type}
dimension: {dimension}
space: {space}
sizes: {sizes}
space directions: {directions}
kinds: {kinds}
endian: little
encoding: raw
space origin: {origin}
"""


def nrrd(name: str, array: np.ndarray, notes: str = "", **fields: object) -> breast.Volume:
    """What is loaded from a file of this array, its first axis the fastest."""
    types = {"float32": "float", "uint8": "uchar"}
    fields = {"type": types[str(array.dtype)], "dimension": array.ndim, "sizes": " ".join(map(str, array.shape)),
              "space": "left-posterior-superior", "origin": "(10,20,30)",
              "directions": "(2,0,0) (0,2,0) (0,0,3)", "kinds": "domain domain domain"} | fields
    file = small_run.scratch("slicer") / name
    file.write_bytes(HEADER.format(**fields).encode() + notes.encode() + b"\n" + array.tobytes(order="F"))
    return breast.load(file)


class Units(unittest.TestCase):
    def test_lengths_are_millimetres_whatever_the_file_is_in(self) -> None:
        labels = np.zeros((4, 3, 2), np.uint8)
        volume = nrrd("m.nrrd", labels, 'space units: "m" "m" "m"\n', origin="(0.01,0.02,0.03)",
                      directions="(0.002,0,0) (0,0.002,0) (0,0,0.003)")
        np.testing.assert_allclose(volume.grid.to_patient([[0, 0, 0], [1, 1, 1]]), [[10, 20, 30], [12, 22, 33]])
        with self.assertRaisesRegex(breast.BreastError, "one unit for all axes"):
            nrrd("m.nrrd", labels, 'space units: "m" "mm" "m"\n')


class Fields(unittest.TestCase):
    def test_a_linear_field_moves_points_exactly(self) -> None:
        i, j, k = np.meshgrid(range(6), range(5), range(4), indexing="ij")
        vectors = np.stack([0.5 * i - j, 2.0 + 0 * i, 0.25 * k], 0).astype(np.float32)
        field = nrrd("field.nrrd", vectors, "takes_points_of:=scan\nto:=supine\n", kinds="vector domain domain domain",
                     directions="none (2,0,0) (0,2,0) (0,0,3)")
        self.assertIsInstance(field, breast.Field)
        self.assertEqual((field.notes["takes_points_of"], field.notes["to"]), ("scan", "supine"))
        index = np.array([[0, 0, 0], [2.5, 1.25, 3], [5, 4, 0.5]])
        points = np.array([10, 20, 30]) + index * [2, 2, 3]
        moves = np.stack([0.5 * index[:, 0] - index[:, 1], [2.0] * 3, 0.25 * index[:, 2]], -1)
        np.testing.assert_allclose(field.move(points), points + moves, atol=1e-6)
        self.assertTrue(np.isnan(field.move([[0, 0, 0]])).all())

    def test_what_is_ambiguous_is_refused(self) -> None:
        vectors = np.zeros((3, 2, 2, 2), np.float32)
        more = {"directions": "none (2,0,0) (0,2,0) (0,0,3)"}
        with self.assertRaisesRegex(breast.BreastError, "space left-posterior-superior"):
            nrrd("f.nrrd", vectors, kinds="vector domain domain domain", space="right-anterior-superior", **more)
        with self.assertRaisesRegex(breast.BreastError, "overlap"):
            nrrd("f.seg.nrrd", vectors.astype(np.uint8), kinds="list domain domain domain", **more)


class Segmentations(unittest.TestCase):
    def test_names_values_and_place(self) -> None:
        labels = np.zeros((4, 3, 2), np.uint8)
        labels[1, 2, 0], labels[3, 0, 1] = 7, 3
        notes = ("Segment0_ID:=a\nSegment0_Name:=Brustwand ä\nSegment0_LabelValue:=7\nSegment0_Color:=1 0.5 0\n"
                 "Segment1_ID:=Segment_2\nSegment1_LabelValue:=3\n")
        for space, sign in (("left-posterior-superior", 1), ("right-anterior-superior", -1)):
            seg = nrrd("s.seg.nrrd", labels, notes, space=space)
            self.assertIsInstance(seg, breast.Segmentation)
            self.assertEqual(seg.values, {"Brustwand ä": 7, "Segment_2": 3})
            np.testing.assert_array_equal(seg.colours["Brustwand ä"], [1, 0.5, 0])
            np.testing.assert_array_equal(np.argwhere(seg.mask("Brustwand ä")), [[0, 2, 1]])
            np.testing.assert_allclose(seg.grid.to_patient([[1, 2, 0]])[0], [sign * 12, sign * 24, 30])
            with self.assertRaisesRegex(breast.BreastError, "it has: Brustwand ä, Segment_2"):
                seg.mask("wall")

    def test_of_several_segments_each_states_its_value(self) -> None:
        with self.assertRaisesRegex(breast.BreastError, "Segment1_LabelValue is missing"):
            nrrd("s.seg.nrrd", np.ones((4, 3, 2), np.uint8), "Segment0_ID:=a\nSegment0_LabelValue:=1\nSegment1_ID:=b\n")


class Fiducials(unittest.TestCase):
    def load(self, header: str, row: str = "n0,1,2,3,0,0,0,1,1,1,0,\"a, b\",,\n") -> breast.Markup:
        file = small_run.scratch("markups") / "F.fcsv"
        file.write_text(f"# Markups fiducial file version = 4.11\n{header}"
                        f"# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n{row}")
        return breast.load(file)["F"]

    def test_places_are_lps_whatever_the_file_is_in(self) -> None:
        for system, place in (("LPS", [1, 2, 3]), ("1", [1, 2, 3]), ("RAS", [-1, -2, 3]), ("0", [-1, -2, 3])):
            np.testing.assert_array_equal(self.load(f"# CoordinateSystem = {system}\n").point("a, b"), place)

    def test_what_is_no_place_is_refused(self) -> None:
        for header, row, word in (("", "n0,1,2,3,0,0,0,1,1,1,0,a,,\n", "CoordinateSystem"),
                                  ("# CoordinateSystem = 2\n", "n0,1,2,3,0,0,0,1,1,1,0,a,,\n", "CoordinateSystem"),
                                  ("# CoordinateSystem = LPS\n", "n0,1,two,3,0,0,0,1,1,1,0,a,,\n", "line 4"),
                                  ("# CoordinateSystem = LPS\n", "", "no points")):
            with self.assertRaisesRegex(breast.BreastError, word):
                self.load(header, row)


class Markups(unittest.TestCase):
    def load(self, **changes: object) -> dict[str, breast.Markup]:
        points = [{"label": "nipple", "position": [1, 2, 3]},
                  {"label": "unset", "position": [0, 0, 0], "positionStatus": "undefined"}]
        markup = {"type": "Fiducial", "name": "F", "coordinateSystem": "LPS", "controlPoints": points} | changes
        file = small_run.scratch("markups") / "F.mrk.json"
        file.write_text(json.dumps({"markups": [markup]}))
        return breast.load(file)

    def test_places_are_lps_whatever_the_file_is_in(self) -> None:
        np.testing.assert_array_equal(self.load()["F"].point("nipple"), [1, 2, 3])
        np.testing.assert_array_equal(self.load(coordinateSystem="RAS")["F"].points, [[-1, -2, 3]])

    def test_what_is_no_place_is_refused(self) -> None:
        for changes, word in (({"coordinateSystem": "IJK"}, "IJK"), ({"coordinateUnits": "cm"}, "cm"),
                              ({"controlPoints": [{"position": [1, 2]}]}, "no list of markups"),
                              ({"controlPoints": [{"position": [1, 2, 1e9]}]}, "no place")):
            with self.assertRaisesRegex(breast.BreastError, word):
                self.load(**changes)


class XmlMeshes(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("vtkmodules"), "python3-vtk9 is not installed")
    def test_surfaces_and_tetrahedra_are_those_of_vtk(self) -> None:
        from vtkmodules.util.numpy_support import vtk_to_numpy
        from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader
        folder = small_run.scratch("xml")
        run = small_run.folder()
        small_run.tool(f"hexmesh {run}/geometry.vtkhdf {run}/labels.vtkhdf m.vtkhdf --elements 6 --surface s.vtp "
                       "--tetrahedra t.vtu", folder)
        for name, reader in (("s.vtp", vtkXMLPolyDataReader()), ("t.vtu", vtkXMLUnstructuredGridReader())):
            reader.SetFileName(str(folder / name))
            reader.Update()
            theirs, ours = reader.GetOutput(), breast.load(folder / name)
            np.testing.assert_array_equal(vtk_to_numpy(theirs.GetPoints().GetData()), ours.points)
            self.assertEqual(theirs.GetNumberOfCells(), len(ours.types))
            next_of = {kind: iter(cells) for kind, cells in ours.cells.items()}
            for c in range(theirs.GetNumberOfCells()):
                self.assertEqual(theirs.GetCellType(c), ours.types[c])
                cell = theirs.GetCell(c)
                ids = [cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())]
                self.assertEqual(ids, list(next(next_of[int(ours.types[c])])))
            for data, arrays in ((theirs.GetPointData(), ours.point_arrays), (theirs.GetCellData(), ours.cell_arrays)):
                self.assertEqual({data.GetArrayName(i) for i in range(data.GetNumberOfArrays())}, set(arrays))
                for key, values in arrays.items():
                    np.testing.assert_array_equal(vtk_to_numpy(data.GetArray(key)), values)


if __name__ == "__main__":
    unittest.main()
