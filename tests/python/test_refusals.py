# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged and foreign files: one clear line that names the file and what is wrong."""
import unittest
from pathlib import Path

import h5py
import numpy as np

import breast
import small_run


def set_value(path, value, index=0):
    def change(file: h5py.File) -> None:
        array = file[path][...]
        array[index] = value
        file[path][...] = array
    return change


def removed(path):
    def change(file: h5py.File) -> None:
        del file[path]
    return change


def attribute(path, name, value):
    def change(file: h5py.File) -> None:
        file[path].attrs[name] = value
    return change


def soft_link(file: h5py.File) -> None:
    file["VTKHDF/PointData/second"] = h5py.SoftLink("/VTKHDF/Points")


def external(file: h5py.File) -> None:
    del file["VTKHDF/CellData/det_F"]
    file["VTKHDF/CellData"].create_dataset("det_F", (4,), "f8", external=[("other.bin", 0, 32)])


MESH_DAMAGE = {
    "nan": (set_value("VTKHDF/Points", np.nan, (3, 1)), r"Points\[3,1\] is nan, must be finite"),
    "far": (set_value("VTKHDF/PointData/imaged", 2e6, (5, 2)), r"imaged\[5"),
    "schema": (attribute("breast", "schema", b"mesh/2"), r"states no schema"),
    "units": (attribute("breast", "units", b"SI"), r"units is 'SI', must be 'mm-g-s'"),
    "tissue": (set_value("VTKHDF/CellData/tissue", 7), r"tissue\[0\] is 7"),
    "missing": (removed("VTKHDF/PointData/imaged"), r"imaged is missing"),
    "landmark": (set_value("breast/landmarks/local", 1.5, (0, 0)), r"local\[0\]"),
    "soft link": (soft_link, r"is a link"),
    "external": (external, r"another file, which is not read"),
}


class Meshes(unittest.TestCase):
    def refused(self, file: Path, pattern: str) -> None:
        with self.assertRaisesRegex(breast.BreastError, pattern) as caught:
            breast.load(file)
        self.assertTrue(str(caught.exception).startswith(str(file)), str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))
        self.assertEqual(Path(caught.exception.file), file)

    def test_what_the_programs_refuse(self) -> None:
        for name, (change, pattern) in MESH_DAMAGE.items():
            with self.subTest(name):
                file = small_run.scratch("mesh") / "supine.vtkhdf"
                file.write_bytes((small_run.folder() / "supine.vtkhdf").read_bytes())
                with h5py.File(file, "r+") as h5:
                    change(h5)
                self.refused(file, pattern)

    def test_an_edited_file_is_read(self) -> None:
        file = small_run.scratch("edited") / "mesh.vtkhdf"
        file.write_bytes((small_run.folder() / "mesh.vtkhdf").read_bytes())
        with h5py.File(file, "r+") as h5:
            h5["VTKHDF/CellData/tissue"][...] = 1
        self.assertTrue((breast.load(file).tissue == 1).all())

    def test_an_edited_lookup_is_refused(self) -> None:
        """No program reads it, so that nothing could check it again."""
        file = small_run.scratch("lookup") / "lookup.h5"
        file.write_bytes((small_run.folder() / "lookup.h5").read_bytes())
        with h5py.File(file, "r+") as h5:
            h5["breast/lookup/depth_mm"][...] = 1
        self.refused(file, "was changed after match-lookup wrote it; make it with match-lookup")

    def test_bytes_that_changed_are_refused_by_the_seal(self) -> None:
        content = (small_run.folder() / "mesh.vtkhdf").read_bytes()
        file = small_run.scratch("seal") / "mesh.vtkhdf"
        for at in np.random.default_rng(7).integers(2000, len(content) - 80, 20):
            file.write_bytes(content[:at] + bytes([content[at] ^ 16]) + content[at + 1 :])
            self.refused(file, "damaged: its content disagrees")
        file.write_bytes(content[:5000])
        self.refused(file, "truncated")
        file.write_bytes(b"no mesh at all")
        self.refused(file, "is not an HDF5 file")

    def test_another_schema_is_named(self) -> None:
        from breast.state_file import read_state
        with self.assertRaisesRegex(breast.BreastError, "has schema 'labels/1', must be 'mesh/1'; make it with hexmesh"):
            read_state(small_run.folder() / "labels.vtkhdf")
        with self.assertRaisesRegex(breast.BreastError, "'labels' is no state; its states are mesh, reference"):
            breast.load(small_run.folder()).state("labels")
        with self.assertRaisesRegex(breast.BreastError, "has no upright.vtkhdf; it has: cc, geometry"):
            breast.load(small_run.folder()).transport([[0, 0, 0]], "imaged", "upright")


class OtherFiles(unittest.TestCase):
    def refused(self, name: str, content: bytes, pattern: str) -> None:
        file = small_run.scratch("other") / name
        file.write_bytes(content)
        with self.assertRaisesRegex(breast.BreastError, pattern):
            breast.load(file)

    def test_nothing_there(self) -> None:
        with self.assertRaisesRegex(breast.BreastError, "give a run folder"):
            breast.load(small_run.scratch("empty") / "none")
        with self.assertRaisesRegex(breast.BreastError, "holds no .vtkhdf file"):
            breast.load(small_run.scratch("empty"))

    def test_tables(self) -> None:
        self.refused("t.tsv", b"a\tb\n1\t2\t3\n", "line 2 has 3 columns")
        self.refused("t.tsv", b"a\n1\nnan\n", "line 3, a: 'nan' is not finite")
        self.refused("t.tsv", b"", "no header line")
        self.refused("t.tsv", b"a\ta\n", "two columns of one name")

    def test_reports(self) -> None:
        self.refused("r.json", b'{"a": NaN}', "NaN")
        self.refused("r.json", b'{"a": 1e999}', "1e999")
        self.refused("r.json", b'{"a": 1', "no JSON")
        self.refused("r.json", b"[1]", "outermost")

    def test_mammograms_and_curves(self) -> None:
        for name in ("cc.vti", "curve.vtp"):
            content = (small_run.folder() / name).read_bytes()
            at = content.index(b"binary", len(content) // 2) if name == "cc.vti" else len(content) // 2
            self.refused(name, content[: at + 120] + b"A" + content[at + 121 :], "damaged")
            self.refused(name, content[: len(content) // 2], "truncated|damaged")
        from breast.curves import read_curves
        with self.assertRaisesRegex(breast.BreastError, "must be 'curves/1'"):
            read_curves(small_run.folder() / "points.vtp")
        self.refused("x.vti", b'<!DOCTYPE a [<!ENTITY b "c">]><VTKFile/>', "not of type ImageData")

    def test_scans(self) -> None:
        nrrd = (small_run.folder() / "small-scan.nrrd").read_bytes()
        self.refused("s.nrrd", nrrd.replace(b"space: left-posterior-superior\n", b""), "left and right are unknown")
        self.refused("s.nrrd", nrrd.replace(b"left-posterior-superior", b"scanner-xyz"), "space 'scanner-xyz'")
        self.refused("s.nrrd", nrrd[:-1000], "cut off|damaged")
        self.refused("s.nrrd", nrrd.replace(b"sizes: 128", b"sizes: 127"), "more than the header announces")
        self.refused("s.nrrd", nrrd.replace(b"sizes: 128 128 15", b"sizes: 128 128"), "one 3-D volume")
        self.refused("s.nrrd", nrrd.replace(b"space origin: ", b"space source: "), "states no space origin")
        self.refused("s.nrrd", nrrd.replace(b"space origin: ", b'space units: "in" "in" "in"\nspace origin: '), "'in'")
        folder = small_run.scratch("nifti")
        small_run.tool(f"segment {small_run.folder()}/small-scan.nrrd l.nii --side left", folder)
        small_run.tool(f"segment {small_run.folder()}/small-scan.nrrd l.mha --side left", folder)
        nifti = bytearray((folder / "l.nii").read_bytes())
        blank = nifti[:252] + bytes(4) + nifti[256:]
        self.refused("s.nii", bytes(blank), "no orientation")
        self.refused("s.nii", bytes(nifti[:-500]), "truncated")
        self.refused("s.nii", bytes(nifti) + b"\0", "but the header announces")
        self.refused("s.nii", bytes(nifti[:80]) + np.float32(0).tobytes() + bytes(nifti[84:]), "voxel size|contradict")
        self.refused("s.nii", b"\1" * 400, "not the NIfTI header")
        meta = (folder / "l.mha").read_bytes()
        lines = [line for line in meta.split(b"\n", 20) if not line.startswith(b"TransformMatrix")]
        self.refused("s.mha", b"\n".join(lines), "TransformMatrix")
        self.refused("s.mha", meta + b"\0", "more than the header announces|but the header announces")
        self.refused("s.mha", meta.replace(b"Offset =", b"Remark =", 1), "no Offset")
        self.refused("scan.img", b"", "unknown ending")


if __name__ == "__main__":
    unittest.main()
