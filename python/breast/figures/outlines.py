# SPDX-License-Identifier: GPL-3.0-or-later
"""The superimposed shapes of one breast: how far its tissue moves from the scan to other postures."""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..elements import boundary_faces
from ..section import quads_in_plane
from ..state import State
from .body import UP, face_facets, from_below, lateral_view, place_of
from .colours import SHAPES, WALL, Stroke
from .inputs import Inputs, need
from .layout import SMALL, Panel, Picture
from .muscle import back_words, front_of_muscle
from .silhouette import silhouette

_RING = 6  # pixels
_FEW = 8


@dataclass(frozen=True)
class Shape:
    """A nodal field (N, 3) of a state, with its name and its stroke."""

    state: State
    points: np.ndarray
    name: str
    stroke: Stroke


def posture_of(gravity: np.ndarray) -> str:
    size = np.linalg.norm(gravity)
    if size == 0:
        return "stress-free"
    if abs(gravity[1]) > 0.9 * size:
        return "supine" if gravity[1] > 0 else "prone"
    return "under gravity " + ", ".join(f"{g:.0f}" for g in gravity) + " mm/s2"


def shapes_of(states: list[State]) -> list[Shape]:
    """The shape in the scan, then those of the states."""
    shapes = [Shape(states[0], states[0].imaged, "as scanned", SHAPES[0])]
    for k, state in enumerate(states, 1):
        shapes.append(Shape(state, state.points, posture_of(state.gravity), SHAPES[k % len(SHAPES)]))
    return shapes


def _named(state: State) -> list[str]:
    """The landmarks whose motion is stated: of many, those that everybody looks for, since words would hide one another."""
    return [name for name in state.landmarks if len(state.landmarks) <= _FEW or name in ("nipple", "tumour")]


def _moved(shapes: list[Shape], k: int, name: str) -> float:
    return float(np.linalg.norm(place_of(shapes[k].state, name, shapes[k].points)
                                - place_of(shapes[0].state, name, shapes[0].points)))


def legend_of(shapes: list[Shape]) -> list[tuple[str, Stroke | None]]:
    """One entry a shape, with how far its landmarks moved from the scan."""
    entries = []
    for k, shape in enumerate(shapes):
        words = shape.name
        for name in _named(shape.state) if k else []:
            words += f", {name.replace('_', ' ')} moved {_moved(shapes, k, name):.0f} mm"
        entries.append((words, shape.stroke))
    return entries


def add_landmarks(panel: Panel, shapes: list[Shape], words: bool = True) -> None:
    """Rings at the landmarks in every shape, and arrows from the first to the last."""
    for name in shapes[0].state.landmarks:
        places = [panel.camera.flat(place_of(shape.state, name, shape.points)[None])[0] for shape in shapes]
        panel.arrow(places[0], places[-1])
        for place, shape in zip(places, shapes):
            panel.ring(place, _RING, shape.stroke.colour)
        if words and len(shapes) > 1 and name in _named(shapes[0].state):
            # Beyond the head of the arrow, where the words hide no mark.
            start, tip = panel.to_pixel(places[0]), panel.to_pixel(places[-1])
            rightwards = tip[0] >= start[0]
            panel.text(tip + [14 if rightwards else -14, 0],
                       f"{name.replace('_', ' ')} {_moved(shapes, len(shapes) - 1, name):.0f} mm", SMALL, align="left" if
                       rightwards else "right", boxed=True)


def section_of(shape: Shape, faces: np.ndarray, height: float) -> np.ndarray:
    """Segments (S, 2, 3) of faces in the transverse plane at a height, LPS mm."""
    facets = face_facets(shape.state, shape.points, faces)
    return quads_in_plane(facets.points[facets.quads], np.array([0, 0, height]), UP)


def add_sections(panel: Panel, shapes: list[Shape], height: float) -> None:
    """Transverse sections of the shapes, with the back of the body and, thin, where the model ends; fits the panel to them."""
    panel.camera = from_below()
    drawn = [(section_of(shape, shape.state.faces[name], height), Stroke(shape.stroke.colour, width, shape.stroke.dashes))
             for shape in shapes for name, width in (("skin", shape.stroke.width), ("pectoral", shape.stroke.width), ("cut", 1.1))]
    first = shapes[0]
    muscle = section_of(first, front_of_muscle(first.state), height)
    drawn.append((muscle, Stroke(WALL.colour, 1.1)))
    panel.fit(panel.camera.flat(np.concatenate([pieces.reshape(-1, 3) for pieces, _ in drawn])))
    for pieces, stroke in drawn:
        flat = [panel.camera.flat(line) for line in joined(pieces)]
        panel.lines(flat, stroke)
    wall = first.state.thorax.at_height(height) if first.state.thorax else np.zeros((0, 3))
    panel.lines([panel.camera.flat(wall)] if len(wall) else [], WALL)


def back_legend(state: State) -> list[tuple[str, Stroke | None]]:
    """What the lines at the back are: the wall of the scan and, with a layer of muscle, the surface behind it."""
    entries: list[tuple[str, Stroke | None]] = [(back_words(state), WALL)] if state.thorax else []
    if len(front_of_muscle(state)):
        entries.append(("chest wall of the scan: front of the muscle", Stroke(WALL.colour, 1.1)))
    return [*entries, ("thin: where the model ends", None)]


def joined(pieces: np.ndarray) -> list[np.ndarray]:
    """Segments (S, 2, d) joined at their common ends into lines (n, d), so that dashes run on across them."""
    if not len(pieces):
        return []
    _, ends = np.unique(np.rint(pieces.reshape(-1, pieces.shape[2]) * 1e4).astype(np.int64), axis=0, return_inverse=True)
    ends = ends.reshape(-1, 2)
    at: dict[int, list[int]] = {}
    for n, pair in enumerate(ends.tolist()):
        for end in pair:
            at.setdefault(end, []).append(n)
    left, lines = set(range(len(pieces))), []

    def walk(end: int) -> list[np.ndarray]:
        places = []
        while (n := next((n for n in at[end] if n in left), None)) is not None:
            left.remove(n)
            other = int(ends[n, 0] == end)
            places.append(pieces[n, other])
            end = int(ends[n, other])
        return places

    for n in range(len(pieces)):
        if n in left:
            left.remove(n)
            ahead, behind = walk(int(ends[n, 1])), walk(int(ends[n, 0]))
            lines.append(np.array([*behind[::-1], *pieces[n], *ahead]))
    return lines


def add_silhouettes(panel: Panel, shapes: list[Shape], words: bool = True) -> None:
    """The silhouettes of the shapes from the outer side, with their landmarks."""
    panel.camera = lateral_view(shapes[0].state.side)
    outlines = []
    for shape in shapes:
        facets = face_facets(shape.state, shape.points, boundary_faces(shape.state.hexahedra))
        outlines.append(silhouette(panel.camera.flat(facets.points), facets.quads))
    panel.fit(np.concatenate([line for lines in outlines for line in lines]))
    for lines, shape in zip(outlines, shapes):
        panel.lines(lines, shape.stroke)
    add_landmarks(panel, shapes, words)


def height_of_nipple(state: State, nodal: np.ndarray) -> float:
    return float(place_of(state, "nipple", nodal)[2]) if "nipple" in state.landmarks else 0.0


def draw(inputs: Inputs) -> Picture:
    need(inputs.states, "outlines", "a deformed .vtkhdf")
    shapes, picture = shapes_of(inputs.states), Picture(1600, 860)
    first = shapes[0].state
    panel = picture.panel(0, 0, 0.5, 1)
    panel.caption("(a) transverse section through the nipple as scanned, seen from below")
    panel.legend([*legend_of(shapes), *back_legend(first)])
    add_sections(panel, shapes, height_of_nipple(first, first.imaged))
    add_landmarks(panel, shapes)
    side = picture.panel(0.5, 0, 1, 1)
    side.caption("(b) silhouettes from the outer side; lengths are three-dimensional")
    add_silhouettes(side, shapes)
    for drawn in (panel, side):
        drawn.scale_bar()
        drawn.compass()
    return picture
