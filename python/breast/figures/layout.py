# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of several panels: captions, scale bars, compasses, legends, marks. Lengths on the page are in pixels."""
from __future__ import annotations

import io
import textwrap
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Polygon
from matplotlib.patheffects import withStroke
from PIL import Image
from PIL.PngImagePlugin import PngInfo

from .colours import INK, TUMOUR, Colour, Stroke
from .scene import Camera, Scene

DPI = 100
LETTERS, SMALL = 15, 13
"""Heights of letters, pixels."""
_LINE, _EDGE = 21, 12
_FOOT = 62  # below the drawing, for scale bar and compass
RING = 12
"""Radius of the ring round the point that a figure is about, pixels."""
_LETTER_WIDTH = 0.56  # of their height, on average


def points(pixels: float) -> float:
    """matplotlib's unit of letters and lines."""
    return pixels * 72 / DPI


def mark() -> PngInfo:
    """What says of a PNG that it is a file of libbreast (output.written_by_us)."""
    made = PngInfo()
    made.add_text("Software", "libbreast")
    return made


def _from_arm(place: np.ndarray, arm: np.ndarray) -> float:
    """How far a place (2) is from the line from the origin to the end of an arm (2)."""
    along = float(np.clip(place @ arm / max(arm @ arm, 1e-12), 0, 1))
    return float(np.linalg.norm(place - along * arm))


class Picture:
    """A page of `width` x `height` pixels, which panels share."""

    def __init__(self, width: int, height: int) -> None:
        self.size = np.array([width, height], float)
        self.figure = Figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor="white")
        self._canvas = FigureCanvasAgg(self.figure)

    def panel(self, left: float, bottom: float, right: float, top: float) -> Panel:
        """A panel on a part of the page, in fractions from its lower left corner."""
        low, high = np.rint([left, bottom] * self.size), np.rint([right, top] * self.size)
        return Panel(self, low, high - low)

    def png(self) -> bytes:
        """The page as PNG, marked as a file of libbreast."""
        stream = io.BytesIO()
        Image.fromarray(self.pixels()).save(stream, "png", compress_level=7, pnginfo=mark())
        return stream.getvalue()

    def pixels(self) -> np.ndarray:
        """The page, RGB (height, width, 3), 0 to 255.

        Values are rounded to every third of 256: no difference is seen, and a noisy scan takes two thirds of the bytes.
        """
        self._canvas.draw()
        rounded = np.minimum((np.asarray(self._canvas.buffer_rgba())[..., :3].astype(np.uint16) + 1) // 3 * 3, 255)
        return rounded.astype(np.uint8)


def from_two_sides(scene: Scene, views: Sequence[tuple[Camera, str]]) -> Picture:
    """One scene seen by two cameras side by side, each with its caption."""
    picture = Picture(1600, 800)
    for k, (camera, words) in enumerate(views):
        panel = picture.panel(0.5 * k, 0, 0.5 * (k + 1), 1)
        panel.caption(f"({'ab'[k]}) {words}")
        panel.scene(scene, camera)
    return picture


class Panel:
    """A part of a page with its own scale. `low` (2) is its corner on the page, `size` (2) its extent, `top` the height below
    which there is room for a drawing, pixels.

    Words and marks are placed in pixels from its lower left corner, drawings in mm of the picture's plane once `fit` or `frame`
    has said where that plane lies.
    """

    def __init__(self, picture: Picture, low: np.ndarray, size: np.ndarray) -> None:
        self.low, self.size, self._page = low, size, picture.size
        self.axes = picture.figure.add_axes((*(low / picture.size), *(size / picture.size)))
        self.axes.set_axis_off()
        self.camera = Camera(np.array([0, 0, -1.0]), np.array([0, 1.0, 0]))
        self.top = float(size[1]) - _EDGE
        self._drawn: list[np.ndarray] = []
        self.frame(0.5 * size, 1.0)

    # ---- where the drawing is ---------------------------------------------------------------------------------------

    def frame(self, centre: np.ndarray, mm_per_pixel: float) -> None:
        """The middle of the panel shows `centre` (2), mm."""
        self.centre, self.mm_per_pixel = np.asarray(centre, float), mm_per_pixel
        half = 0.5 * self.size * mm_per_pixel
        self.axes.set_xlim(self.centre[0] - half[0], self.centre[0] + half[0])
        self.axes.set_ylim(self.centre[1] - half[1], self.centre[1] + half[1])

    def fit(self, flat: np.ndarray, mm_per_pixel: float | None = None, margin: float = 16, right: float = 0,
            mirrored: bool = False) -> None:
        """Shows all of the places (n, 2), mm, between what stands at the top and the foot.

        It leaves `right` pixels free beside them; `mirrored`: at the left.
        """
        low, high = flat.min(0), flat.max(0)
        room = np.array([self.size[0] - right, self.top - _FOOT]) - 2 * margin
        scale = mm_per_pixel or self.needed(flat, margin, right)
        middle = np.array([margin + (right if mirrored else 0), _FOOT + margin]) + 0.5 * room
        self.frame(0.5 * (low + high) + (0.5 * self.size - middle) * scale, scale)

    def needed(self, flat: np.ndarray, margin: float = 16, right: float = 0) -> float:
        """The mm in a pixel with which the places (n, 2) fit."""
        room = np.array([self.size[0] - right, self.top - _FOOT]) - 2 * margin
        return float((np.ptp(flat, axis=0) / room).max())

    def to_pixel(self, flat: np.ndarray) -> np.ndarray:
        """Pixels in the panel (..., 2) of places in the plane (..., 2), mm."""
        return 0.5 * self.size + (flat - self.centre) / self.mm_per_pixel

    # ---- drawings, in mm ----------------------------------------------------------------------------------------------

    def scene(self, scene: Scene, camera: Camera, mm_per_pixel: float | None = None, right: float = 0) -> None:
        """Shows a scene, with scale bar and compass. Panels of one scale ask `needed` first."""
        self.still(scene, camera, camera.flat(scene.shown()), mm_per_pixel, right)

    def still(self, scene: Scene, camera: Camera, flat: np.ndarray, mm_per_pixel: float | None = None, right: float = 0) -> None:
        """The same in the frame that the places `flat` (n, 2), mm, need: those of several scenes that follow one another."""
        self.camera = camera
        self.fit(flat, mm_per_pixel, right=right)
        width, height = (int(n) for n in self.size)
        image = scene.image(camera, self.centre, self.mm_per_pixel, width, height)
        self.image(image, self.centre - 0.5 * self.size * self.mm_per_pixel, self.mm_per_pixel, "nearest")
        self.scale_bar()
        self.compass()

    def image(self, pixels: np.ndarray, corner: np.ndarray, pixel: float, interpolation: str = "bilinear") -> None:
        """Rows from the top, grey from 0 to 1 or RGB; `corner` (2): of the lower left pixel, mm."""
        high = corner + pixel * np.array(pixels.shape[1::-1])
        limits = self.axes.get_xlim(), self.axes.get_ylim()
        self.axes.imshow(pixels, cmap="gray", vmin=0, vmax=1, extent=(corner[0], high[0], corner[1], high[1]), aspect="auto",
                         interpolation=interpolation)
        self.axes.set(xlim=limits[0], ylim=limits[1])

    def lines(self, pieces: Sequence[np.ndarray], stroke: Stroke, halo: bool = False) -> None:
        """Lines through places (n, 2), mm; with a dark halo on an image."""
        if not len(pieces):
            return
        self._drawn.extend(pieces)
        if halo:
            self._collect(pieces, Stroke(INK, stroke.width + 1.6), 0.4)
        self._collect(pieces, stroke)

    def _collect(self, pieces: Sequence[np.ndarray], stroke: Stroke, opacity: float = 1) -> None:
        dashes = (0, stroke.dashes) if stroke.dashes else "solid"
        made = LineCollection(list(pieces), colors=[stroke.colour], linewidths=points(stroke.width), alpha=opacity,
                              linestyles=[dashes], capstyle="butt", joinstyle="round")
        self.axes.add_collection(made, autolim=False)

    def ring(self, flat: np.ndarray, radius: float, colour: Colour = TUMOUR) -> None:
        """A ring with a dark rim, which hides nothing; its radius is in pixels."""
        for width, shade in ((4.6, INK), (2.6, colour)):
            self._add(Circle(self.to_pixel(flat), radius, fill=False, edgecolor=shade, linewidth=points(width)))

    def arrow(self, start: np.ndarray, tip: np.ndarray) -> None:
        a, b = self.to_pixel(start), self.to_pixel(tip)
        if np.linalg.norm(b - a) >= 8:  # shorter than its own head
            self._arrow(a, b, 10, 4.5, 2.2)

    # ---- words, in pixels ----------------------------------------------------------------------------------------------

    def text(self, at: Sequence[float], words: str, height: float = LETTERS, colour: Colour = INK, align: str = "left", *,
             boxed: bool = False, rotation: float = 0) -> None:
        """Words centred vertically at a place; light ones have a dark outline; `boxed` keeps a drawing from crossing them."""
        made = self.axes.text(*at, words, fontsize=points(height), color=colour, ha=align, va="center", transform=self._pixels(),
                              rotation=rotation, rotation_mode="anchor", clip_on=False)
        if sum(colour) > 2.4:
            made.set_path_effects([withStroke(linewidth=2, foreground=(0, 0, 0, 0.8))])
        if boxed:
            made.set_bbox({"facecolor": (1, 1, 1, 0.85), "edgecolor": "none", "pad": 1})

    def line(self, places: Sequence[Sequence[float]], stroke: Stroke) -> None:
        """A line through places in pixels."""
        x, y = np.transpose(places)
        dashes = (0, stroke.dashes) if stroke.dashes else "solid"
        self._add(Line2D(x, y, color=stroke.colour, linewidth=points(stroke.width), linestyle=dashes, solid_capstyle="butt"))

    def caption(self, words: str, colour: Colour = INK) -> None:
        """Words at the top, in as many lines as they need; what is drawn afterwards stays below them."""
        for line in textwrap.wrap(words, int((self.size[0] - 2 * _EDGE) / (_LETTER_WIDTH * (LETTERS + 1))), break_long_words=False,
                                  break_on_hyphens=False):
            self.text((_EDGE, self.top - 0.5 * _LINE), line, LETTERS + 1, colour)
            self.top -= _LINE

    def legend(self, entries: Iterable[tuple[str, Stroke | None]]) -> None:
        """A line of words behind its stroke for each entry, below the caption and above the drawing."""
        for words, stroke in entries:
            y = self.top - 0.5 * _LINE
            if stroke is not None:
                self.line([(_EDGE + 4, y), (_EDGE + 42, y)], stroke)
            self.text((_EDGE + 52, y), words, SMALL + 1)
            self.top -= _LINE

    def legend_row(self, entries: Iterable[tuple[str, Stroke | None]]) -> None:
        """The same for lines on an image, side by side in a panel of its own, in several rows if they need them."""
        x, y = float(_EDGE), self.top - 0.5 * _LINE
        for words, stroke in entries:
            width = _LETTER_WIDTH * (SMALL + 1) * len(words) + (46 if stroke else 0) + 26
            if x + width > self.size[0] and x > _EDGE:
                x, y = float(_EDGE), y - _LINE
            if stroke is not None:
                self.line([(x, y), (x + 38, y)], Stroke((0.2, 0.2, 0.2), 10))
                self.line([(x + 2, y), (x + 36, y)], Stroke(stroke.colour, stroke.width + 1.2, stroke.dashes))
            self.text((x + (46 if stroke else 0), y), words, SMALL + 1)
            x += width

    def scale_bar(self, colour: Colour = INK, either_side: bool = False) -> None:
        """At the bottom right: the largest round length up to a quarter of the panel. With `either_side` it is at the left where lines of
        the drawing would cross it at the right and do not cross it there."""
        length = max((n for n in (1, 2, 5, 10, 20, 50, 100, 200) if n <= 0.25 * self.size[0] * self.mm_per_pixel), default=1)
        long, y = length / self.mm_per_pixel, 20.0
        right = self.size[0] - 22
        if either_side and self._crossed(right - long, right, y) and not self._crossed(22, 22 + long, y):
            right = 22 + long
        left = right - long
        self.line([(left, y), (right, y)], Stroke(colour, 3))
        for x in (left, right):
            self.line([(x, y - 5), (x, y + 5)], Stroke(colour, 2))
        self.text((0.5 * (left + right), y + 16), f"{length} mm", LETTERS, colour, "center", boxed=sum(colour) < 1.5)

    def _crossed(self, left: float, right: float, y: float) -> bool:
        """Whether a line of the drawing comes into the place of a scale bar and its words."""
        low, high = np.array([left - 6, y - 8]), np.array([right + 6, y + 28])
        for piece in self._drawn:
            at = self.to_pixel(np.asarray(piece))
            steps = np.linspace(0, 1, 9)[:, None, None]
            dense = ((1 - steps) * at[:-1] + steps * at[1:]).reshape(-1, 2)
            if ((dense > low) & (dense < high)).all(1).any():
                return True
        return False

    def compass(self) -> None:
        """At the bottom left: the patient's left, anterior and superior directions, where they lie in the picture."""
        right, top, _ = self.camera.axes()
        arms = [(np.array([axis @ right, axis @ top]), letter)
                for axis, letter in ((np.array([1, 0, 0]), "L"), (np.array([0, -1, 0]), "A"), (np.array([0, 0, 1]), "S"))]
        arms.sort(key=lambda one: -np.linalg.norm(one[0]))
        origin = 22 - np.minimum(0, np.min([30 * arm for arm, _ in arms], axis=0))
        named: list[tuple[np.ndarray, np.ndarray, str]] = []  # arm, place of its letters, these
        for arm, letter in arms:
            if np.linalg.norm(arm) < 0.15:  # points at or away from the viewer
                continue
            at = 30 * arm + 11 * arm / np.linalg.norm(arm)
            over = next((n for n, (longer, other, _) in enumerate(named) if np.linalg.norm(other - at) < 14 or
                         _from_arm(at, 30 * longer) < 0.6 * LETTERS), None)
            if over is None:
                named.append((arm, at, letter))
            elif np.linalg.norm(arm - named[over][0]) < 0.5 * np.linalg.norm(named[over][0]):
                # Along an oblique beam two axes may coincide: their letters then stand side by side.
                named[over] = (*named[over][:2], named[over][2] + letter)
            else:  # its letter would lie on another arm
                continue
            self._arrow(origin, origin + 30 * arm, 6, 3.5, 2)
        for _, at, letters in named:
            self.text(origin + at, letters, LETTERS, align="center", boxed=True)

    def colour_bar(self, colours: Any, high: float, title: str) -> None:
        """A scale from 0 to `high` at the right, 62 pixels from the border."""
        left, bottom, tall = self.size[0] - 62, 90.0, self.top - 140
        axes = self.axes.figure.add_axes((*((self.low + [left, bottom]) / self._page), *(np.array([18, tall]) / self._page)))
        axes.imshow(np.linspace(0, 1, 256)[:, None], cmap=colours, origin="lower", aspect="auto", extent=(0, 1, 0, high))
        axes.set_xticks([])
        axes.yaxis.tick_right()
        axes.set_yticks(np.linspace(0, high, 5), [f"{v:.{1 if high < 10 else 0}f}" for v in np.linspace(0, high, 5)],
                        fontsize=points(SMALL))
        self.text((left + 18, bottom + tall + 18), title, SMALL + 1, align="right")

    def plot_axes(self, across: str, upwards: str = "", logarithmic: str = "") -> Any:
        """matplotlib's axes for a chart below the caption, with their titles; `logarithmic` has the letters of such axes: "xy"."""
        self.axes.set_axis_off()
        low = self.low + [74, 58]
        size = np.array([self.size[0] - 74 - 22, self.top - 58 - 14])
        axes = self.axes.figure.add_axes((*(low / self._page), *(size / self._page)))
        axes.tick_params(labelsize=points(SMALL))
        axes.grid(True, color="0.87", linewidth=0.7)
        axes.set_axisbelow(True)
        axes.set_xlabel(across, fontsize=points(SMALL + 1))
        axes.set_ylabel(upwards, fontsize=points(SMALL + 1))
        for letter in logarithmic:
            axes.set(**{f"{letter}scale": "log"})
            getattr(axes, f"{letter}axis").set_major_formatter(lambda value, _: f"{value:g}")
        return axes

    def _pixels(self) -> Any:
        """From pixels of the panel to those of the page."""
        from matplotlib.transforms import Affine2D
        return Affine2D().translate(*self.low)

    def _add(self, artist: Any) -> None:
        artist.set_transform(self._pixels())
        artist.set_clip_on(False)
        artist.set_zorder(5)
        self.axes.add_artist(artist)
        artist.set_clip_path(None)

    def _arrow(self, start: np.ndarray, tip: np.ndarray, length: float, half: float, width: float) -> None:
        along = (tip - start) / np.linalg.norm(tip - start)
        side = np.array([-along[1], along[0]])
        self.line([start, tip - 0.6 * length * along], Stroke(INK, width))
        self._add(Polygon([tip, tip - length * along + half * side, tip - length * along - half * side], color=INK))
