# SPDX-License-Identifier: GPL-3.0-or-later
"""The force of both plates against the thickness, on the way to the compressed shape."""
from __future__ import annotations

import numpy as np

from ..state import State
from .body import two_plates
from .inputs import Inputs, need
from .layout import SMALL, Panel, Picture, points
from .pressure import round_up

CLINICAL_N = (50, 180)
_LEAST_N = 0.1
_COLOURS, _MARKERS = ("#0072B2", "#D55E00", "#009E73"), "osD"


def _add_paths(panel: Panel, states: list[State], low: float, high: float, logarithmic: bool) -> None:
    axes = panel.plot_axes("thickness between the flat parts of the plates (mm)", "force (N)", "y" * logarithmic)
    for k, state in enumerate(states):
        contact, plates = state.contact, two_plates(state)
        words = f"{contact.view}, reduction {contact.reduction_percent:.0f} %, "
        for plate, name, style, fill in ((plates[0], "force_N", "-", "full"), (plates[1], "detector_N", "--", "none")):
            force = np.where(contact.path[name] < low, np.nan, contact.path[name])
            axes.plot(contact.path["thickness_mm"], force, style, color=_COLOURS[k % 3], marker=_MARKERS[k % 3],
                      markersize=points(8), fillstyle=fill, linewidth=points(2.4),
                      label=f"{words}{plate.name} {plate.force_N:.0f} N")
    axes.axhspan(*CLINICAL_N, color="#dff0df", zorder=0, label=f"{CLINICAL_N[0]} to {CLINICAL_N[1]} N, the clinical range")
    thickness = np.concatenate([s.contact.path["thickness_mm"] for s in states])
    axes.set_xlim(10 * np.ceil(thickness.max() / 10), 10 * np.floor(thickness.min() / 10))
    axes.set_ylim(low, high)


def draw(inputs: Inputs) -> Picture:
    states = [s for s in inputs.compressed() if len(s.contact.path["thickness_mm"]) and len(s.contact.plates) == 2]
    need(states, "force-thickness", "a compressed .vtkhdf with its path")
    strongest = max(float(np.max([s.contact.path[name].max() for name in ("force_N", "detector_N")])) for s in states)
    high = max(strongest, CLINICAL_N[1]) * 1.15
    picture = Picture(1600, 760)
    row = picture.panel(0, 0, 1, 0.1)
    for k, (words, low, top, logarithmic) in enumerate((
            ("(a) force of each plate; marks: solved positions of the plates", 0, high, False),
            ("(b) the same, logarithmic", _LEAST_N, round_up(high), True))):
        panel = picture.panel(0.5 * k, 0.1, 0.5 * (k + 1), 1)
        panel.caption(words)
        _add_paths(panel, states, low, top, logarithmic)
    handles, labels = picture.figure.axes[-1].get_legend_handles_labels()
    row.axes.legend(handles, labels, ncols=3, loc="center", frameon=False, fontsize=points(SMALL + 1), handlelength=4)
    return picture
