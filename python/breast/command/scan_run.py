# SPDX-License-Identifier: GPL-3.0-or-later
"""`breast run SCAN`: the pipeline on the breasts that a scan shows, with what is not given found or assumed, and said."""
from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..errors import BreastError
from ..reports import read_report
from .assumed import SIDES, TUMOUR_ENDINGS, own_name, series_of, side_of, tumour_beside, tumour_position
from .child import run_child
from .installation import Installation
from .make_name import folder_for_make, name_for_make
from .pipeline import asked_of_make, make_run, show_results
from .request import PipelineRequest

# segment's own words when the field of view ends before the other breast.
_NOT_IN_VIEW = "the only breast in the field of view is the"


class _OneSide:
    """The request for one side, and what make answers to it."""

    def __init__(self, installation: Installation, request: PipelineRequest) -> None:
        self.installation, self.request = installation, request
        self.make, self.run, self.plan = asked_of_make(installation, request)

    def with_tumour(self, tumour: str) -> _OneSide:
        return _OneSide(self.installation, replace(self.request, settings={**self.request.settings, "TUMOUR": tumour}))

    def announced(self) -> _OneSide:
        """Says whose stages follow, since those of both sides have the same names."""
        print(f"breast run: the {self.request.side} breast", flush=True)
        return self

    def made(self, targets: Sequence[str]) -> int:
        return make_run([*self.make, f"-j{self.request.jobs}", *targets], self.run)

    def segmented(self) -> dict:
        """The report of the segmentation; empty if there is none."""
        file = os.path.join(self.run, "labels.json")
        return read_report(file) if os.path.exists(file) else {}


def _requests(installation: Installation, r: PipelineRequest, assumed: list[str]) -> dict[str, PipelineRequest]:
    """The request for each side, with the settings that a DICOM folder suggests; adds what was assumed."""
    given = r.side or r.settings.get("SIDE", "")
    sides = (given,) if given else SIDES
    chosen = any(name in r.settings for name in ("SEGMENT_OPTIONS", "SERIES", "FAT", "ALSO", "CASE_FILE"))
    series = series_of(installation, r.scan) if os.path.isdir(r.scan) and not chosen else None
    if series and not given:
        if not series.sides:
            raise BreastError(f"'{r.scan}': no series shows a breast; `breast scan '{r.scan}' --list` says what is there")
        sides = series.sides
    if not given and sides == SIDES:
        assumed.append("both breasts, as far as the scan shows them (one: --side left or --side right)")
    elif not given:
        assumed.append(f"the {sides[0]} breast, the only one that the series show (--side NAME)")
    requests = {}
    for side in sides:
        settings = dict(r.settings)
        if series and side in series.taken:
            assumed.append(f"{side}: {series.taken[side]} (another: SERIES=N, as numbered by `breast scan '{r.scan}' --list`)")
        if series and side in series.fat:
            folder = name_for_make(r.scan, os.path.join(folder_for_make(r.runs), ".names"))
            settings.update(FAT=folder, SEGMENT_OPTIONS=f"--fat-series {series.fat[side]}")
            assumed.append(f"{side}: series {series.fat[side]} is the fat image of that water image (another: FAT=FILE)")
        requests[side] = replace(r, side=side, settings=settings)
    return requests


def _tumours(r: PipelineRequest, assumed: list[str]) -> dict[str, str]:
    """The tumour by side, "" for one whose side is not known; empty if none was found or asked for."""
    if "CASE_FILE" in r.settings and "TUMOUR" not in r.settings:
        return {}
    if "TUMOUR" in r.settings:
        return {"": r.settings["TUMOUR"]}
    found = tumour_beside(r.scan)
    for side, file in found.items():
        assumed.append(f"{side + ': ' if side else ''}the tumour is that of {file} (none: TUMOUR=none)")
    if not found:
        assumed.append(f"no tumour, as there is no {own_name(r.scan)}-tumour{{{','.join(TUMOUR_ENDINGS)}}} beside the scan (give TUMOUR=x,y,z, a "
                       "file, or auto)")
    return found


def _in_view(sides: dict[str, _OneSide]) -> tuple[dict[str, _OneSide], dict[str, int]]:
    """Segments both sides. Returns those that can be modelled, and the exit codes of those that failed; a side that the scan does not
    show is neither, unless it is the only one."""
    shown, failed, absent = {}, {}, {}
    for name, side in sides.items():
        code = run_child([*side.announced().make, f"{side.run}/labels.vtkhdf"])
        reason = str(side.segmented().get("reason", ""))
        if code == 0:
            shown[name] = side
        elif code < 128 and _NOT_IN_VIEW in reason:
            absent[name] = code
            print(f"breast run: the scan does not show the {name} breast, which is left out", flush=True)
        else:
            failed[name] = code
        if code >= 128:
            break
    return shown, failed if shown else {**absent, **failed}


def _assigned(sides: dict[str, _OneSide], tumours: dict[str, str]) -> dict[str, _OneSide]:
    """The sides with their tumours."""
    done = {name: side.with_tumour(tumours[name]) if name in tumours else side for name, side in sides.items()}
    place = tumours.get("", "")
    if place in ("", "auto", "none"):
        return {name: side.with_tumour(place) for name, side in done.items()} if place else done
    left = {name: side for name, side in done.items() if name not in tumours}
    if len(sides) > 1:  # the other breast has none
        nipples = {name: np.array(side.segmented()["landmarks"]["nipple"]["imaged"]) for name, side in sides.items()}
        owner = side_of(tumour_position(place), nipples)
        print(f"breast run: the tumour {place} belongs to the {owner} breast, whose nipple is nearer", flush=True)
        left = {name: side for name, side in left.items() if name == owner}
        done = {name: side.with_tumour("none") if name not in tumours and name not in left else side for name, side in done.items()}
    return {**done, **{name: side.with_tumour(place) for name, side in left.items()}}


def _page_of_failure(run: str) -> str:
    """Where the page says why, if plates do not hold the breast and it was made after the last stage: that of an earlier run says nothing
    of this one."""
    from ..page.remarks import banners_of

    page, reports = Path(run) / "page.html", [*Path(run).glob("*.json")]
    if not page.exists() or any(report.stat().st_mtime > page.stat().st_mtime for report in reports):
        return ""
    if not banners_of(Path(run)):
        return ""
    return f"; {page} says why"


def run_scan(installation: Installation, r: PipelineRequest) -> int:
    """Runs the request on each breast in view. Returns 0 if every one of them was modelled, otherwise the exit code of the first that
    failed; raises BreastError for what is refused before anything runs."""
    assumed: list[str] = []
    requests = _requests(installation, r, assumed)
    tumours = _tumours(r, assumed)
    quiet = {name: replace(one, settings={k: v for k, v in one.settings.items() if k != "TUMOUR"} if len(requests) > 1 else one.settings)
             for name, one in requests.items()}
    sides = {name: _OneSide(installation, one) for name, one in quiet.items()}
    all_sides, targets = sides, r.target.split()
    # Only what make accepts is announced: a refusal is one line. A plan may be given to a shell.
    mark = "#" if r.plan else "breast run:"
    sys.stdout.write("".join(f"{mark} assumed: {one}\n" for one in assumed))
    if r.plan:
        if len(sides) == 1:
            sides = _assigned(sides, tumours)
        sys.stdout.write("".join(side.plan for side in sides.values()))
        return 0
    sys.stdout.flush()
    failed: dict[str, int] = {}
    if len(sides) > 1:
        sides, failed = _in_view(sides)
    if any(code >= 128 for code in failed.values()):
        return max(failed.values())
    done: dict[str, _OneSide] = {}
    for name, side in _assigned(sides, tumours).items():
        code = (side.announced() if len(requests) > 1 else side).made(targets)
        if code >= 128:
            return code
        if code:
            failed[name] = code
        else:
            done[name] = side
    for name, side in done.items():  # after the messages of all sides, so that the pages are the last lines
        contrast = side.segmented().get("contrast", "")
        if contrast:
            print(f"breast run: {name}: contrast {contrast}, found on the scan (another: SEGMENT_OPTIONS='--contrast NAME')")
        show_results(targets, side.run)
    for name in failed:
        print(f"breast run: the {name} breast was not modelled to the end{_page_of_failure(all_sides[name].run)}", file=sys.stderr)
    return next(iter(failed.values()), 0)
