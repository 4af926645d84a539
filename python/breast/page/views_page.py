# SPDX-License-Identifier: GPL-3.0-or-later
"""The page itself: which files of a run it is made of, and what of them it shows."""
from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..command.beside import ended, readable_scan, started
from ..errors import BreastError
from ..study.html import page
from ..study.kinds import Request, kind

if TYPE_CHECKING:
    from ..lookup import Lookup
    from ..mammogram import Mammogram
    from ..state import State
    from ..volume import Volume

_TEMPLATES = Path(__file__).with_name("templates")
_SCRIPTS = ("data", "lookup", "arc", "window", "view", "pins", "colours", "overlay", "marks", "slice", "body", "list", "readout",
            "gestures", "keys", "controls", "main")


@dataclass(frozen=True)
class Views:
    """Both views of a run: compressed shapes, images, and the lookups of each image in the other. scan: to be shown, or None."""

    states: tuple[State, State]
    images: tuple[Mammogram, Mammogram]
    lookups: tuple[Lookup, Lookup]
    scan: Volume | None


def read_views(run: Path, scan: Path | None) -> Views:
    """Raises BreastError where a file is missing or damaged, or where the lookup is not of these compressions."""
    from ..loading import load_scan
    from ..lookup import read_lookup
    from ..mammogram import read_mammogram
    from ..state_file import read_state

    cc, mlo = (read_state(run / f"{view}.vtkhdf") for view in ("cc", "mlo"))
    images = (read_mammogram(run / "cc.vti"), read_mammogram(run / "mlo.vti"))
    there, back = read_lookup(run / "lookup.h5"), read_lookup(run / "lookup.h5", back=True)
    for state, image, view, side in zip((cc, mlo), images, (there.from_view, there.to_view), (there.side, back.side)):
        if state.contact is None:
            raise BreastError("is no compression", state.file)
        if (state.contact.view, state.side, image.view, image.side) != (view, side, view, side):
            raise BreastError(f"is of {view} of the {side} breast, but {state.file.name} of {state.contact.view} of the {state.side} and "
                              f"{image.file.name} of {image.view} of the {image.side}", there.file)
    if not {*cc.history, *mlo.history} <= {*there.history}:
        raise BreastError("was made of other compressions than cc.vtkhdf and mlo.vtkhdf", there.file, "run match-lookup again")
    return Views((cc, mlo), images, (there, back), load_scan(scan) if scan else None)


def views_page(views: Views) -> str:
    """The page. Raises BreastError for one above LARGEST_PAGE."""
    from markupsafe import Markup

    from .packed import LARGEST_PAGE

    scripts = [Markup((_TEMPLATES / f"scripts/{name}.js").read_text(encoding="utf-8")) for name in _SCRIPTS]
    made = page("views", _TEMPLATES, data=_data(views), scripts=scripts)
    if len(made) > LARGEST_PAGE:
        raise BreastError(f"the page would have {len(made) // 1000000} MB, at most {LARGEST_PAGE // 1000000} allowed; use a larger "
                          "--pitch of match-lookup, or show no scan")
    return made


def _data(views: Views) -> dict[str, Any]:
    from .packed import box_of, packed_body, packed_image, packed_lookup, packed_scan

    body = views.states[0]
    middle = 0.5 * sum(box_of(body))
    return {"side": body.side, "band_without": ", ".join(views.lookups[0].band_without),
            "images": [packed_image(image, state) for image, state in zip(views.images, views.states)],
            "lookups": [packed_lookup(lookup, middle) for lookup in views.lookups],
            "body": packed_body(body), "scan": packed_scan(views.scan, body) if views.scan else None}


@kind("page", "RUN [SCAN] [SERIES]",
      "interactive page of a run's lookup.h5, cc and mlo (.vtkhdf, .vti): pointing at a view shows the curve in the other; with SCAN, also "
      "its slices about the breast. The page holds no file names and no header data of the scan, but it shows images of the breast: give "
      "it only to those who may see the scan")
def _page(request: Request) -> str:
    run, scan, series = request.path(0), request.word(1), request.word(2, "0")
    pairs = [("cc.vtkhdf", "mlo.vtkhdf"), ("cc.vtkhdf", "cc.vti"), ("mlo.vtkhdf", "mlo.vti")]
    named = {name: run / name for pair in pairs for name in pair} | ({"SCAN": Path(scan)} if scan else {})
    # The files' pairs are checked, in C++, while they are read here.
    check = started("pairs", ["tabulate", "--series", series, *(f"--check={name}={file}" for name, file in named.items())])
    with tempfile.TemporaryDirectory(prefix="breast-page-") as folder:
        try:
            views = read_views(run, readable_scan(Path(scan), int(series), Path(folder)) if scan else None)
        finally:
            ended("pairs", check)
    return views_page(views)
