#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""fields.py BIN [whole] [FILE...]: no dataset or attribute is used without a check.

In every kind of file of a small run of the pipeline's defaults, each dataset, attribute and array of VTK XML is deleted, emptied,
shortened and given another type in turn, one at a time, and the file is given to the tools that read it. The answer must be that
of the whole file, where the field is not needed, or exit code 2 with one line that names the field. Anything else is a finding, and
ends the program with code 1. The package python/breast must load the file or raise a BreastError.

By default a damage that the first tool of a file refuses is not tried on the others, which use the same reader, and only deleted
and emptied fields are tried (two minutes); `whole` tries all damages on all tools (hours). FILE restricts the run to these files.
Exit code 77 says that python3-h5py is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from typing import Callable, Iterator

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "python"), str(ROOT / "tests/python")]
try:
    import h5py
    import numpy as np
except ImportError:
    print("skipped: python3-h5py is not installed (apt-get install python3-h5py)")
    sys.exit(77)
import breast  # noqa: E402
import small_run  # noqa: E402

COMPRESS = "compress reference.vtkhdf out.vtkhdf --view CC --reduction 5 --at-least 1"
CURVE = "cc2mlo cc.vtkhdf mlo.vtkhdf out.vtp --landmark tumour"
BAND = "cc2mlo cc-slopes.vtkhdf mlo-slopes.vtkhdf out.vtp --landmark tumour --band"
LOOKUP = "match-lookup cc.vtkhdf mlo.vtkhdf out.h5 --pitch 40 --both-ways"
PAGE = "tabulate page ."
FIGURE = "render cc.vti mlo.vti curve.vtp --figure mammogram -o out.png"
# The tools that read a file, the quickest first.
TOOLS = {
    "labels.vtkhdf": ["evaluate labels.vtkhdf labels.vtkhdf", "fit-hermite labels.vtkhdf out.vtkhdf",
                      "hexmesh geometry.vtkhdf labels.vtkhdf out.vtkhdf --elements 6",
                      "project-mammogram cc.vtkhdf out.vti --labels labels.vtkhdf --pixel 2", "export-slicer . out --no-fields"],
    "geometry.vtkhdf": ["hexmesh geometry.vtkhdf labels.vtkhdf out.vtkhdf --elements 6"],
    "mesh.vtkhdf": ["probe mesh.vtkhdf", "backward mesh.vtkhdf out.vtkhdf", "render mesh.vtkhdf --figure mesh -o out.png",
                    "export-slicer . out --no-fields"],
    "reference.vtkhdf": ["probe reference.vtkhdf", "forward reference.vtkhdf out.vtkhdf",
                         "sensitivity reference.vtkhdf supine.vtkhdf out.vtkhdf", COMPRESS],
    "supine.vtkhdf": ["probe supine.vtkhdf", "sensitivity reference.vtkhdf supine.vtkhdf out.vtkhdf"],
    "cc.vtkhdf": ["probe cc.vtkhdf", CURVE, "project-mammogram cc.vtkhdf out.vti --pixel 2", LOOKUP,
                  "sensitivity reference.vtkhdf cc.vtkhdf out.vtkhdf", "render cc.vtkhdf mlo.vtkhdf --figure pressure -o out.png"],
    "mlo.vtkhdf": ["probe mlo.vtkhdf", CURVE, LOOKUP],
    "nodes.vtkhdf": ["probe nodes.vtkhdf", "sensitivity reference.vtkhdf nodes.vtkhdf out.vtkhdf"],
    "cc-slopes.vtkhdf": [BAND, "difference cc-slopes.vtkhdf cc.vtkhdf cc.vtkhdf out.vtkhdf"],
    "cc.vti": [FIGURE, PAGE],
    "curve.vtp": [FIGURE, "export-slicer . out --no-fields"],
}
Damage = Callable[[h5py.Group, str], None]


# ---- damage of HDF5 --------------------------------------------------------------------------------------------------

def stored(group: h5py.Group, path: str) -> tuple[h5py.Group | h5py.AttributeManager, str, np.ndarray]:
    """Where a field is stored, under which name, and its values."""
    if "@" in path:
        place, name = path.split("@")
        attributes = group[place].attrs
        return attributes, name, np.asarray(attributes[name])
    return group, path, group[path][()]


def replaced(group: h5py.Group, path: str, change: Callable[[np.ndarray], np.ndarray | None]) -> None:
    place, name, values = stored(group, path)
    other = change(values)
    if other is None:
        raise KeyError("there is no such damage of this field")
    del place[name]
    if isinstance(place, h5py.AttributeManager):
        place.create(name, other)
    else:
        place.create_dataset(name, data=other)


def deleted(group: h5py.Group, path: str) -> None:
    place, name, _ = stored(group, path)
    del place[name]


def emptied(group: h5py.Group, path: str) -> None:
    replaced(group, path, lambda v: None if v.size == 0 else np.empty((0, *v.shape[1:]), v.dtype))


def shortened(group: h5py.Group, path: str) -> None:
    replaced(group, path, lambda v: v[:-1] if v.ndim and len(v) > 1 else None)


def retyped(group: h5py.Group, path: str) -> None:
    """Numbers become texts, texts numbers."""
    replaced(group, path, lambda v: np.zeros(v.shape) if v.dtype.kind in "SO" else np.full(v.shape, b"no number"))


def without_value(group: h5py.Group, path: str) -> None:
    """What h5py.Empty writes: HDF5 reads nothing and reports no error."""
    place, name, values = stored(group, path)
    if not isinstance(place, h5py.AttributeManager):
        raise KeyError("datasets without storage are another damage")
    del place[name]
    place.create(name, h5py.Empty(values.dtype if values.dtype.kind != "O" else "S1"))


def fields_of(file: pathlib.Path) -> list[str]:
    found: list[str] = []
    with h5py.File(file) as h5:
        def visit(name: str, member: h5py.Group | h5py.Dataset) -> None:
            if isinstance(member, h5py.Dataset):
                found.append("/" + name)
            found.extend(f"/{name}@{attribute}" for attribute in member.attrs)
        h5.visititems(visit)
    return found


# ---- damage of VTK XML -----------------------------------------------------------------------------------------------

ARRAY = r'<(?:Data)?Array[^>]*Name="%s"[^>]*?(?:/>|>.*?</(?:Data)?Array>)'


def arrays_of(file: pathlib.Path) -> list[str]:
    return list(dict.fromkeys(re.findall(r'<(?:Data)?Array[^>]*Name="([^"]+)"', file.read_text())))


def without_array(file: pathlib.Path, name: str) -> None:
    text = re.sub(r"<!-- sha256.*?-->\n?", "", file.read_text(), flags=re.S)
    file.write_text(re.sub(ARRAY % re.escape(name), "", text, flags=re.S))


# ---- what is said ----------------------------------------------------------------------------------------------------

def table_of(text: str) -> list[list[str]]:
    """Lines of words between tabs, without the columns that say how long something took."""
    rows = [line.split("\t") for line in text.split("\n")]
    kept = [i for i, name in enumerate(rows[0]) if not name.endswith("seconds")]
    return [[row[i] for i in kept if i < len(row)] for row in rows]


def content(file: pathlib.Path) -> object:
    """What a file says, without its history and the time it took."""
    if file.suffix in (".vtkhdf", ".h5"):
        with h5py.File(file) as h5:
            paths = [p for p in fields_of(file) if not re.search(r"/history/|seconds$|@(tool|version)$|content_sha256", p)]
            return {p: (stored(h5, p)[2].shape, stored(h5, p)[2].tobytes()) for p in paths if stored(h5, p)[2].dtype.kind != "O"}
    if file.suffix == ".tsv":
        return table_of(file.read_text())
    text = file.read_bytes()
    return re.sub(rb"<FieldData>.*?</FieldData>|<!--.*?-->|[0-9a-f]{64}", b"", text, flags=re.S)


def same(said: object, whole: object, path: str) -> bool:
    """Whether an answer is that of the whole file; a copy of the file may lack what the file lacks."""
    (printed, files), (wholly_printed, whole_files) = said, whole

    def copied(files: list[tuple[str, object]]) -> list[tuple[str, object]]:
        return [(name, {k: v for k, v in held.items() if k != path} if isinstance(held, dict) else held) for name, held in files]

    return printed == wholly_printed and copied(files) == copied(whole_files)


class Sweep:
    def __init__(self, run: pathlib.Path, whole: bool) -> None:
        self.run, self.whole = run, whole
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="breast-fields-"))
        self.findings: list[str] = []
        self.tried = self.refused = 0
        self.known: dict[str, object] = {}

    def folder(self) -> pathlib.Path:
        """Links to all files of the run."""
        folder = self.work / "here"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for file in self.run.iterdir():
            if file.is_file():
                (folder / file.name).symlink_to(file)
        return folder

    def answer(self, line: str, folder: pathlib.Path) -> tuple[int, str, object]:
        """Exit code, stderr, and what was printed and written."""
        name, *arguments = line.split()
        before = set(folder.rglob("*"))
        done = subprocess.run([small_run.programs / name, *arguments, "--quiet", "--threads", "1"], cwd=folder,
                              capture_output=True, text=True, errors="replace")
        made = sorted(p for p in set(folder.rglob("*")) - before if p.is_file())
        said = (table_of(done.stdout), [(p.relative_to(folder).as_posix(), content(p)) for p in made])
        for path in made:
            path.unlink()
        return done.returncode, done.stderr, said

    def of_whole(self, line: str) -> object:
        if line not in self.known:
            code, err, said = self.answer(line, self.folder())
            if code != 0:
                raise SystemExit(f"{line}: exit {code} with whole files: {err}")
            self.known[line] = said
        return self.known[line]

    def judge(self, line: str, folder: pathlib.Path, what: str, path: str) -> bool:
        """Whether the tool refused the file; any other ending but the answer of the whole file is a finding."""
        code, err, said = self.answer(line, folder)
        self.tried += 1
        field = re.split(r"[/@]", path)[-1]
        lines = err.strip().split("\n")
        # Of columns of different lengths any may be named.
        group = path[: -len(field)].rstrip("@")
        named = re.search(r"\b" + re.escape(field) + r"\b", err) or (group and group in err)
        if code == 2 and len(lines) == 1 and named:
            self.refused += 1
            return True
        if code == 0 and same(said, self.of_whole(line), path):
            return False
        why = f"exit {code}" if code != 0 else "another answer"
        if code == 2:
            why = f"{len(lines)} lines" if len(lines) > 1 else "the line does not name it"
        self.findings.append(f"{what}, {line}: {why}: {err.strip()[:300]}")
        return code == 2

    def load(self, file: pathlib.Path, what: str) -> None:
        try:
            breast.load(file)
        except breast.BreastError as error:
            if "\n" in str(error):
                self.findings.append(f"{what}, Python: several lines: {error}")
        except Exception as error:  # any other is what is looked for
            self.findings.append(f"{what}, Python: {type(error).__name__}: {error}")

    def damaged(self, name: str, folder: pathlib.Path) -> Iterator[tuple[str, str]]:
        """Makes every damage of a file in turn; what was done, and to which field."""
        file, good = folder / name, self.run / name
        if file.suffix != ".vtkhdf":
            for array in arrays_of(good):
                file.unlink()
                shutil.copy(good, file)
                without_array(file, array)
                yield f"{name}: {array} deleted", array
            return
        ways: list[Damage] = [deleted, emptied, without_value]
        ways += [shortened, retyped] if self.whole else []
        for path in fields_of(good):
            for way in ways:
                file.unlink()
                shutil.copy(good, file)
                try:
                    with h5py.File(file, "r+") as h5:
                        way(h5, path)
                except KeyError:
                    continue
                yield f"{name}: {path} {way.__name__}", path

    def sweep(self, name: str) -> None:
        folder = self.folder()
        lines = [line for line in TOOLS[name] if (small_run.programs / line.split()[0]).exists()]
        for line in lines:
            self.of_whole(line)
        folder = self.folder()
        for what, path in self.damaged(name, folder):
            self.load(folder / name, what)
            for line in lines:
                if self.judge(line, folder, what, path) and not self.whole:
                    break


def main() -> int:
    words = sys.argv[2:]
    whole = "whole" in words
    names = [word for word in words if word != "whole"] or list(TOOLS)
    small_run.programs = pathlib.Path(sys.argv[1]).resolve()
    sweep = Sweep(small_run.swept(), whole)
    for name in names:
        before = sweep.tried, len(sweep.findings)
        sweep.sweep(name)
        print(f"{name}: {sweep.tried - before[0]} runs, {len(sweep.findings) - before[1]} findings", flush=True)
    for finding in sweep.findings:
        print(finding)
    shutil.rmtree(sweep.work)
    small_run.remove()
    return 1 if sweep.findings else 0


if __name__ == "__main__":
    sys.exit(main() if len(sys.argv) > 1 else __doc__)
