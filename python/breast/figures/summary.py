# SPDX-License-Identifier: GPL-3.0-or-later
"""The whole chain on one page: scan, postures, both compressions, both mammograms."""
from __future__ import annotations

from ..state import State
from .body import add_body, add_image_border, add_plates, anterior_view, compression_words, lateral_view, plate_view, \
    tumour_words, two_plates
from .colours import BAD
from .compression import show
from .inputs import Inputs, need
from .layout import Panel, Picture
from .mammogram import add_mammograms
from .matching import add_columns
from .outlines import add_silhouettes, legend_of, shapes_of
from .scene import Camera, Scene
from .slices import AXIAL, SAGITTAL, Slices

_SPLIT, _LEGEND, _SCAN_RIGHT = 0.5, 0.03, 0.63


def _sorted(inputs: Inputs) -> dict[str, State]:
    """The shapes by what their files say of themselves, in whatever order they were given."""
    chain = {}
    for state in inputs.states:
        if state.contact is not None:
            chain["cc" if state.contact.view == "CC" else "mlo"] = state
        elif state.reference is None:
            chain["imaged"] = state
        else:
            chain["supine" if state.gravity.any() else "reference"] = state
    return chain


def _add_tissues(picture: Picture, state: State) -> None:
    """Without a scan: the tissues of the imaged body from two sides."""
    tumour, scene = tumour_words(state), Scene()
    add_body(scene, state, state.points, skin_opacity=0.3, gland_opacity=0.85)
    words = "(a) as imaged: fibroglandular (violet)" + (f", {tumour}" if tumour else ""), "(b) from the front"
    for k, view in enumerate((lateral_view(state.side), anterior_view())):
        panel = picture.panel(0.5 * _SCAN_RIGHT * k, _SPLIT, 0.5 * _SCAN_RIGHT * (k + 1), 1)
        panel.caption(words[k])
        panel.scene(scene, view)


def _pressed(picture: Picture, inputs: Inputs, state: State, left: float, letter: str) -> tuple[Panel, Scene, Camera, str]:
    panel, scene = picture.panel(left, 0, left + 0.25, _SPLIT), Scene()
    add_columns(scene, state, inputs.curves)
    add_body(scene, state, state.points, skin_opacity=0.3, gland_opacity=0.85)
    add_plates(scene, state, state.points, two_plates(state), 0.4)
    add_image_border(scene, state)
    return panel, scene, plate_view(state), f"{letter} {compression_words(state)}; orange: image border"


def _add_images(picture: Picture, chain: dict[str, State], inputs: Inputs) -> None:
    """The mammograms; in the place of one that there is not, because its plates do not grip the breast, words that say so."""
    images = {image.view == "CC": image for image in inputs.mammograms[:2]}
    panels = {cc: (picture.panel(left, 0, left + 0.25, _SPLIT), letter) for cc, left, letter in ((True, 0.5, "f"), (False, 0.75, "g"))}
    for cc, (panel, letter) in panels.items():
        if cc not in images:
            state = chain["cc" if cc else "mlo"]
            panel.caption(f"({letter}) {state.contact.view}: no mammogram, because this is no compression "
                          f"({state.solve.status.replace('_', ' ') if state.solve else 'not solved'})", BAD)
    there = [cc for cc in panels if cc in images]
    if there:
        add_mammograms([panels[cc][0] for cc in there], [images[cc] for cc in there], inputs.curves,
                       "".join(panels[cc][1] for cc in there))


def draw(inputs: Inputs) -> Picture:
    chain = _sorted(inputs)
    need(len(chain) == 5, "summary", "five meshes")
    picture = Picture(1500, 1080)
    if inputs.scan is not None and inputs.labels is not None:
        imaged = Inputs(states=[chain["imaged"]], scan=inputs.scan, labels=inputs.labels)
        Slices(imaged).draw_row(picture, (AXIAL, SAGITTAL), "ab", _SPLIT, _SCAN_RIGHT, _LEGEND)
    else:
        _add_tissues(picture, chain["imaged"])
    panel, shapes = picture.panel(_SCAN_RIGHT, _SPLIT + _LEGEND, 1, 1), shapes_of([chain["reference"], chain["supine"]])
    panel.caption("(c) silhouettes from the outer side")
    panel.legend(legend_of(shapes))
    add_silhouettes(panel, shapes, words=False)
    panel.scale_bar()
    panel.compass()
    show([_pressed(picture, inputs, chain["cc"], 0, "(d)"), _pressed(picture, inputs, chain["mlo"], 0.25, "(e)")])
    _add_images(picture, chain, inputs)
    return picture
