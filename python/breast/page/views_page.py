# SPDX-License-Identifier: GPL-3.0-or-later
"""The page itself: which files of a run it is made of, and what of them it shows."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..cases.compression import VIEWS, why_not_made
from ..errors import BreastError
from ..programs import ended, started
from ..study.files import exists
from ..study.html import data_uri, page
from ..study.kinds import Request, kind
from ..study.stage_report import StageReport
from ..study.summary import tumour_origin

if TYPE_CHECKING:
    from ..labels import Labels
    from ..lookup import Lookup
    from ..mammogram import Mammogram
    from ..state import State
    from ..volume import Volume
    from .facts import Fact
    from .lines import MatchedLine
    from .patient import PatientImage

_TEMPLATES = Path(__file__).with_name("templates")
_SCRIPTS = ("data", "lookup", "arc", "window", "view", "pins", "colours", "overlay", "marks", "slice", "body", "list", "readout",
            "gestures", "keys", "controls", "main")
_TUMOUR_WORDS = {"none": "", "given": "the tumour of the MR, in a mammogram moved as the model says",
                 "artificial": "an artificial tumour, put there by the program: not a finding"}

_ANIMATIONS = {"supine": "The breast while the patient turns from prone to supine, equilibrium by equilibrium",
               "cc": "The breast while the plates close in CC, equilibrium by equilibrium; the breast may slip back when a hand lets go of it",
               "mlo": "The breast while the plates close in MLO, equilibrium by equilibrium; the breast may slip back when a hand lets go of it"}
_LARGEST_ANIMATIONS = 3_000_000  # bytes
_NOT_COUNTED = {"tumour": "how stiff the tumour is", "sternum": "how firmly the breast is held at the sternum",
                "chest_wall": "where exactly the chest wall lies", "angle": "the true angle of the view",
                "detector": "the height of the plates"}


@dataclass(frozen=True)
class Views:
    """What the page is made of.

    Attributes:
        pairs: the views whose plates hold the breast, each with its image.
        lookups: of each image in the other; None unless there are both views.
        body: a shape of the mesh, for what is said of the imaged breast.
        labels: None where the run has none.
        scan: None if it is not given.
        shows_scan: whether voxels of the scan may be shown.
        origin: of the tumour: none, given or artificial.
        patients: the patient's own mammograms by view.
    """

    pairs: list[tuple[Mammogram, State]]
    lookups: tuple[Lookup, Lookup] | None
    body: State
    labels: Labels | None
    scan: Volume | None
    shows_scan: bool
    origin: str
    patients: dict[str, PatientImage] = field(default_factory=dict)


def read_views(run: Path, scan: Path | None, shows_scan: bool = True, series: int = 0) -> Views:
    """Raises BreastError where a file is missing or damaged, or where the lookup is not of these compressions."""
    from ..labels import read_labels
    from ..loading import load_scan
    from ..mammogram import read_mammogram
    from ..state_file import read_state
    from .patient import read_patient

    held = [view for view in VIEWS if not why_not_made([run / f"{view}.vtkhdf"])]
    pairs = [(read_mammogram(run / f"{view}.vti"), read_state(run / f"{view}.vtkhdf")) for view in held]
    for image, state in pairs:
        if state.contact is None:
            raise BreastError("is no compression", state.file)
        if (image.view, image.side) != (state.contact.view, state.side):
            raise BreastError(f"is of {image.view} of the {image.side} breast, but {state.file.name} of {state.contact.view} of the "
                              f"{state.side}", image.file)
    lookups = _read_lookups(run / "lookup.h5", [state for _, state in pairs]) if len(pairs) == 2 else None
    body = pairs[0][1] if pairs else read_state(run / "mesh.vtkhdf")
    labels = run / "labels.vtkhdf"
    origin = tumour_origin(StageReport.read(run / "mesh.json"))
    if origin == "none" and any("tumour" in name for name in body.landmarks):  # a mesh without a report
        origin = "artificial" if "artificial_tumour" in body.landmarks else "given"
    patients = {image.view: read_patient(run, image.view, image.side) for image, _ in pairs}
    return Views(pairs, lookups, body, read_labels(labels) if labels.exists() else None, load_scan(scan, series) if scan else None,
                 shows_scan, origin, {view: patient for view, patient in patients.items() if patient is not None})


def _read_lookups(file: Path, states: list[State]) -> tuple[Lookup, Lookup]:
    from ..lookup import read_lookup

    there, back = read_lookup(file), read_lookup(file, back=True)
    for state, views, side in zip(states, ((there.from_view, back.to_view), (there.to_view, back.from_view)), (there.side, back.side)):
        if {*views} != {state.contact.view if state.contact else ""} or side != state.side:
            raise BreastError(f"is of {views[0]} of the {side} breast, but {state.file.name} of another view or side", file)
    if not {*states[0].history, *states[1].history} <= {*there.history}:
        raise BreastError("was made of other compressions than cc.vtkhdf and mlo.vtkhdf", file, "run match-lookup again")
    return there, back


def views_page(run: Path, views: Views) -> str:
    """The page. Raises BreastError for one above LARGEST_PAGE."""
    from markupsafe import Markup

    from .drawing import BAR_MM
    from .packed import LARGEST_PAGE
    from .remarks import banners_of, remarks_of

    lines = _lines_of_tumour(views)
    pictures, patients = _pictures(views, lines), _pictures_of_patient(views, lines)
    widths = [picture.size[0] for picture in pictures]
    pair = max([1, sum(widths[:2]), *widths, sum(picture.size[0] for picture in patients)])  # mm, side by side on a telephone
    scripts = [Markup((_TEMPLATES / f"scripts/{name}.js").read_text(encoding="utf-8")) for name in _SCRIPTS]
    made = page("views", _TEMPLATES, title=_title(views), banners=banners_of(run), remarks=remarks_of(run),
                answer_title=_answer_title(views), answer=_answer(views, lines), pictures=pictures, patients=patients,
                bar_mm=BAR_MM, pair_mm=f"{pair:.1f}", tall_mm=f"{max([1, *(picture.size[1] for picture in (*pictures, *patients))]):.1f}",
                row_mm=f"{max(sum(widths), pair):.1f}", animations=_animations(run), tables=_tables(run, views), data=_data(views),
                scripts=scripts, tumour_words=_TUMOUR_WORDS[views.origin],
                tumour_kind="artificial" if views.origin == "artificial" else "tumour", behind=_behind(views),
                with_lines=any(picture.line for picture in pictures), with_band=any(picture.band for picture in pictures))
    if len(made) > LARGEST_PAGE:
        raise BreastError(f"the page would have {len(made) // 1000000} MB, at most {LARGEST_PAGE // 1000000} allowed; use a larger "
                          "--pitch of match-lookup, or show no scan")
    return made


def _tables(run: Path, views: Views) -> list[tuple[str, list[Fact]]]:
    """What is said in numbers: captions and rows."""
    from .facts import fact_of_views, facts_in_views, facts_of_breast, facts_of_patient, facts_of_tumour

    grid = views.scan.grid if views.scan is not None else None
    tumour = facts_of_tumour(views.body, views.labels, grid) if views.origin != "none" else []
    moved = facts_in_views(views.pairs) if views.origin != "none" else []
    name = "The tumour" if views.origin == "given" else "The artificial tumour"
    compressions = [StageReport.read(state.file.with_suffix(".json")) for _, state in views.pairs]
    return [(f"{name} in the MR (not compressed)", tumour), (f"{name} in the simulated views (moved by the plates)", moved),
            ("The breast", [*facts_of_breast(StageReport.read(run / "labels.json"), compressions), *fact_of_views(run)]),
            ("The patient's mammograms", facts_of_patient(views.patients))]


def _title(views: Views) -> str:
    names = " and ".join(image.view for image, _ in views.pairs)  # a view that is no compression is not promised
    shown = f" in {names}" if names else ""
    of = {"none": f"matching {names}" if len(views.pairs) == 2 else f"the model{shown}", "given": f"the tumour{shown}",
          "artificial": f"an artificial tumour{shown}"}
    return f"{views.body.side.capitalize()} breast: {of[views.origin]}"


def _lines_of_tumour(views: Views) -> list[MatchedLine | None]:
    """For each view, the line on which the tumour lies there, as seen in the other view alone."""
    from .lines import line_at

    if views.origin == "none" or len(views.pairs) < 2:
        return [None for _ in views.pairs]

    def line(image: Mammogram, here: State, there: State) -> MatchedLine | None:
        place = image.project(here.landmark_position("tumour")[None])[0]
        left, right, bottom, top = image.extent_mm()
        return line_at((here, there), place) if left <= place[0] <= right and bottom <= place[1] <= top else None
    return [line(image, here, there) for (image, here), (_, there) in (views.pairs, views.pairs[::-1])][::-1]


def _pictures(views: Views, lines: list[MatchedLine | None]) -> list[Any]:
    from .drawing import pair_size, slice_picture, view_picture

    size = pair_size(tuple(image for image, _ in views.pairs)) if views.pairs else (0.0, 0.0)
    pictures = [view_picture(image, state, size, line) for (image, state), line in zip(views.pairs, lines)]
    if views.scan is not None and views.shows_scan:
        pictures.append(slice_picture(views.scan, views.body))
    return pictures


def _pictures_of_patient(views: Views, lines: list[MatchedLine | None]) -> list[Any]:
    """Both images have errors of their own when a place of one is looked for in the other."""
    from .drawing import patient_picture

    more = sum(patient.deviation_mm**2 for patient in views.patients.values()) ** 0.5
    return [patient_picture(image, state, views.patients[image.view], line.with_more(more) if line else None)
            for (image, state), line in zip(views.pairs, lines) if image.view in views.patients]


def _behind(views: Views) -> list[str]:
    """How the images show what lies behind the model, if they do."""
    behind = [image.images["thickness"][image.images["through_back"] != 0] for image, _ in views.pairs]
    words = (("Even grey at the back of a mammogram: the model has ended, and nothing is known there.", any((mm <= 0).any() for mm in behind)),
             ("The model ends behind the breast: from there to the back of a mammogram, fat is drawn, or muscle where the model ends in muscle.",
              any((mm > 0).any() for mm in behind)))
    return [said for said, shown in words if shown]


def _animations(run: Path) -> list[tuple[str, str]]:
    """The animated pictures of `make states` that the run has: what each shows, and its data URI; at most 3 MB of them. What would be
    too much has no URI."""
    found, size = [], 0
    for name, words in _ANIMATIONS.items():
        file = run / f"figures/{name}-states.png"
        if exists(file):
            fits = size + file.stat().st_size <= _LARGEST_ANIMATIONS
            size += file.stat().st_size if fits else 0
            found.append((words, data_uri(file.read_bytes(), "png") if fits else ""))
    return found


def _answer_title(views: Views) -> str:
    return "Where to look" if views.origin != "none" else "What this page shows"


def _answer(views: Views, lines: list[MatchedLine | None]) -> list[str]:
    """The result in sentences."""
    if len(views.pairs) < 2:
        alone = f"With {views.pairs[0][0].view} alone" if views.pairs else "Without a simulated view"
        return [f"{alone}, no place can be followed from one view to the other."]
    names = [image.view for image, _ in views.pairs]
    if views.origin == "none":
        return [f"No tumour was given for this breast. On a screen, point at any place of {names[0]} or {names[1]} below to see on which "
                "line of the other view it lies."]
    the = "The tumour" if views.origin == "given" else "The artificial tumour"
    said = []
    for (here, there), line in zip((names, names[::-1]), lines[::-1]):
        if line is None:
            said.append(f"{the} does not lie in the {here} image but behind its back edge, or beside the breast: nothing is said about "
                        f"{there} from {here} alone.")
            continue
        sides = (f", about {line.to_either_side_mm:.0f} mm to either side of it (90 %)" if line.to_either_side_mm > 0 else
                 "; how far to either side of it is not known for this run")
        said.append(f"{the}, seen in {here} alone, lies in {there} somewhere on a line of {line.length_mm:.0f} mm{sides}. "
                    f"{line.remark()}".strip())
    if not any(lines):
        return said
    without = _not_counted(views)
    if without and any(line and line.to_either_side_mm > 0 for line in lines):
        said.append(f"Not counted in the 90 %: {without}.")
    return [*said, "The ring in each view is the tumour of the MR, moved as the model says. A single mammogram does not show depth: a place in "
            "one view is therefore a line in the other."]


def _not_counted(views: Views) -> str:
    names = views.lookups[0].band_without if views.lookups else []
    return ", ".join(_NOT_COUNTED.get(name, name.replace("_", " ")) for name in names)


def _data(views: Views) -> dict[str, Any] | None:
    """What the scripts read; None unless there are both views."""
    from .packed import box_of, packed_body, packed_image, packed_lookup, packed_scan

    if views.lookups is None:
        return None
    middle = 0.5 * sum(box_of(views.body))
    return {"side": views.body.side, "band_without": _not_counted(views),
            "images": [packed_image(image, state) for image, state in views.pairs],
            "lookups": [packed_lookup(lookup, middle) for lookup in views.lookups],
            "body": packed_body(views.body),
            "scan": packed_scan(views.scan, views.body) if views.scan is not None and views.shows_scan else None}


@kind("page", "RUN [SCAN] [SERIES] [no]",
      "the page of a run for those who read mammograms: where the tumour, or any place of one view, lies in the other, from its lookup.h5, "
      "cc and mlo (.vtkhdf, .vti), and from reports, labels and mesh if they are there. With SCAN the page states the number of the MR "
      "slice and shows slices about the breast; 'no' leaves the slices out. The page holds no file names and no header data of the scan, "
      "but it shows images of the breast: give it only to those who may see the scan")
def _page(request: Request) -> str:
    run, scan, series, shown = request.path(0), request.word(1), request.word(2, "0"), request.word(3, "yes")
    if not series.isdecimal() or shown not in ("yes", "no"):
        raise BreastError(f"page: '{series} {shown}' is not the number of a series and yes or no")
    pairs = [("cc.vtkhdf", "mlo.vtkhdf"), ("cc.vtkhdf", "cc.vti"), ("mlo.vtkhdf", "mlo.vti")]
    named = {name: run / name for pair in pairs for name in pair if (run / name).exists()} | ({"SCAN": Path(scan)} if scan else {})
    # The files' pairs are checked, in C++, while they are read here.
    check = started("pairs", ["tabulate", "--series", series, *(f"--check={name}={file}" for name, file in named.items())])
    try:
        views = read_views(run, Path(scan) if scan else None, shown == "yes", int(series))
    finally:
        ended("pairs", check)
    return views_page(run, views)
