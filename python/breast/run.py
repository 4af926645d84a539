# SPDX-License-Identifier: GPL-3.0-or-later
"""A run folder: every file of one case, read when it is first asked for."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .curves import Line, read_curves
from .element_map import ElementMap
from .errors import BreastError
from .geometry import Geometry
from .hdf5 import file_schema
from .labels import Labels
from .loading import load, load_scan
from .lookup import Lookup
from .mammogram import read_mammogram
from .reports import read_report
from .state import State
from .tables import read_table
from .transport import Transported, transported
from .volume import Volume

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


_CHAIN = ("mesh", "reference", "supine", "cc", "mlo")


class Files(Mapping[str, Any]):
    """The files of one ending in a folder and below it, by path without the ending ('cc', 'tables/table3'), read when first
    asked for."""

    def __init__(self, folder: Path, ending: str, read: Callable[[Path], Any]) -> None:
        self._folder, self._ending, self._read = folder, ending, read
        self._known: dict[str, Any] = {}

    def __getitem__(self, name: str) -> Any:
        if name not in self._known:
            if name not in list(self):
                raise BreastError(f"has no {name}{self._ending}", self._folder, f"it has: {', '.join(self) or 'none'}")
            self._known[name] = self._read(self._folder / (name + self._ending))
        return self._known[name]

    def __iter__(self) -> Iterator[str]:
        found = (p.relative_to(self._folder).as_posix() for p in self._folder.rglob("*" + self._ending) if p.is_file())
        return iter(sorted(name[: -len(self._ending)] for name in found if not Path(name).name.startswith(".")))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def get(self, name: str, default: Any = None) -> Any:
        return self[name] if name in self else default

    def __contains__(self, name: object) -> bool:
        return name in list(self)

    def __repr__(self) -> str:
        return f"<{self._ending} files: {', '.join(self) or 'none'}>"


class Run:
    """A run folder as the pipeline leaves it (runs/CASE).

    Attributes:
        folder: its path.
        reports: dicts by file name without .json: run.reports["cc"]["force_N"].
        tables: tables by file name without .tsv: run.tables["displacements"].
        mammograms: Mammogram by file name without .vti: run.mammograms["cc"].
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        self.reports = Files(self.folder, ".json", read_report)
        self.tables = Files(self.folder, ".tsv", read_table)
        self.mammograms = Files(self.folder, ".vti", read_mammogram)
        self._files = Files(self.folder, ".vtkhdf", load)
        self._maps: dict[str, ElementMap] = {}
        if not len(self._files):
            raise BreastError("holds no .vtkhdf file", folder, "give the folder of a run, runs/CASE")

    def __repr__(self) -> str:
        return f"<Run {self.folder}: {', '.join(self._files)}>"

    # ---- files ------------------------------------------------------------------------------------------------------

    @cached_property
    def states(self) -> tuple[str, ...]:
        """Names of all states (files of schema mesh/1), in the order of the chain."""
        names = [name for name in self._files if file_schema(self.folder / (name + ".vtkhdf")) == "mesh/1"]
        return tuple(sorted(names, key=lambda name: (_CHAIN.index(name) if name in _CHAIN else len(_CHAIN), name)))

    def state(self, name: str) -> State:
        """The state in NAME.vtkhdf."""
        found = self._files[name]
        if not isinstance(found, State):
            raise BreastError(f"'{name}' is no state", self.folder, f"its states are {', '.join(self.states)}")
        return found

    @property
    def mesh(self) -> State:
        """The body in the scan, before any mechanics."""
        return self.state("mesh")

    @property
    def reference(self) -> State:
        """The stress-free state."""
        return self.state("reference")

    @property
    def supine(self) -> State:
        return self.state("supine")

    @property
    def cc(self) -> State:
        """Compressed cranio-caudally."""
        return self.state("cc")

    @property
    def mlo(self) -> State:
        """Compressed medio-laterally obliquely."""
        return self.state("mlo")

    @property
    def labels(self) -> Labels:
        return self._files["labels"]

    @property
    def geometry(self) -> Geometry:
        return self._files["geometry"]

    @cached_property
    def curves(self) -> dict[str, list[Line]]:
        """Lines and markers of curve.vtp by name."""
        return read_curves(self.folder / "curve.vtp")

    @cached_property
    def lookup(self) -> Lookup:
        """lookup.h5, where the run has one."""
        return load(self.folder / "lookup.h5")

    @cached_property
    def scan(self) -> Volume:
        """The scan, found by its name in or beside the run folder, or in the current folder; see scan_from for others.

        Raises BreastError when it is not there, or another scan lies there under its name.
        """
        name = self._scan_record().name
        places = [self.folder, self.folder.parent, self.folder.parent / "phantom", Path()]
        found = next((place / name for place in places if (place / name).is_file()), None)
        if found is None:
            raise BreastError(f"its scan {name} is not beside it", self.folder, "give its path: run.scan_from(PATH)")
        return self.scan_from(found)

    def scan_from(self, path: str | os.PathLike[str]) -> Volume:
        """The run's scan from a path. Raises BreastError for any other scan: grid and voxels must be those of the history."""
        volume = load_scan(path)
        if volume.content_sha256() != self._scan_record().sha256:
            raise BreastError(f"is not the scan of {self.folder}: its grid or voxels differ", path)
        return volume

    def _scan_record(self) -> Any:
        first = next((c for c in self.labels.history if c.inputs), None)
        if first is None:
            raise BreastError("its history names no scan", self.labels.file)
        return first.inputs[0]

    # ---- shapes -----------------------------------------------------------------------------------------------------

    def shape(self, name: str) -> np.ndarray:
        """Positions (N, 3), LPS mm, of the nodes of the whole mesh in 'imaged' (the shape in the scan) or a state.

        NaN at nodes that the state lacks: files of compress do not contain the tissue around the breast.
        """
        if name == "imaged":
            return self._base.imaged
        state = self.state(name)
        if state is self._base:
            return state.points
        positions = np.full_like(self._base.points, np.nan)
        positions[self._nodes_of(state)] = state.points
        return positions

    def displacement(self, source: str, target: str) -> np.ndarray:
        """Where each node is in `target` minus where it is in `source`, (N, 3) mm; names as for shape()."""
        return self.shape(target) - self.shape(source)

    def transport(self, points: ArrayLike, source: str, target: str, within: float = 0.0) -> Transported:
        """Points carried with the tissue from one shape to another through the element map.

        Args:
            points: (n, 3) LPS mm in `source`.
            source, target: 'imaged' or the name of a state: 'reference', 'supine', 'cc', 'mlo', ...
            within: points at most so many mm outside are moved to the nearest point of `source` first.

        Returns:
            Transported: `points` (NaN where not inside), `inside` (n), and `distance` (n) mm outside the source shape.
        """
        state = self._state_of(source)
        boundary = np.concatenate(list(state.faces.values()))
        boundary = np.column_stack([state.element_numbers[boundary[:, 0]], boundary[:, 1]])
        return transported(self.element_map(source), self.element_map(target), boundary, points, within)

    def element_map(self, name: str) -> ElementMap:
        """The element map of a shape, by the numbers of the elements in the mesh, made once; names as for shape()."""
        if name not in self._maps:
            state = self._state_of(name)
            nodal = state.imaged if name == "imaged" else state.points
            self._maps[name] = ElementMap(state.hexahedra, nodal, state.element_numbers)
        return self._maps[name]

    def landmark_position(self, name: str, shape: str) -> np.ndarray:
        """Where a landmark is in a shape, (3) LPS mm; shapes as for shape(). Raises BreastError where the shape lacks it."""
        landmark = self._base.landmark(name)
        number = self._base.element_numbers[landmark.element]
        place = self.element_map(shape).positions(np.array([number]), landmark.local[None])[0]
        if np.isnan(place).any():
            raise BreastError(f"has no element {number} of the mesh, in which the landmark '{name}' is",
                              self._state_of(shape).file, "it contains a part of the mesh only")
        return place

    @cached_property
    def _base(self) -> State:
        """The first state of the whole mesh, or else the first."""
        names = [name for name in _CHAIN if name in self._files] or self.states
        if not names:
            raise BreastError("has no state (a mesh file)", self.folder, "make one with hexmesh")
        return next((s for s in map(self.state, names) if not s.part), None) or self.state(names[0])

    def _state_of(self, shape: str) -> State:
        """The state that a shape belongs to, once it is known to be of the same mesh as all others."""
        if shape == "imaged":
            return self._base
        state = self.state(shape)
        self._nodes_of(state)
        return state

    def _nodes_of(self, state: State) -> np.ndarray:
        """Rows of the nodes of a state in the mesh; elements and imaged shape must be the same."""
        base = self._base
        node, element = (np.minimum(np.searchsorted(all_numbers, numbers), len(all_numbers) - 1) for all_numbers, numbers in (
            (base.node_numbers, state.node_numbers), (base.element_numbers, state.element_numbers)))
        same = (np.array_equal(base.node_numbers[node], state.node_numbers)
                and np.array_equal(base.element_numbers[element], state.element_numbers)
                and np.array_equal(base.hexahedra[element], node[state.hexahedra])
                and np.array_equal(base.imaged[node], state.imaged))
        if not same:
            raise BreastError(f"has another mesh than {base.file.name}: no node or element corresponds", state.file,
                              "make both from one mesh")
        return node
