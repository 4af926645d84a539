# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against run time: the table of tabulate cost."""
from __future__ import annotations

import numpy as np

from .inputs import Inputs, need
from .layout import SMALL, Picture, points

_SERIES = (("q1p0", "dome", False, "Q1/P0 dome", "#0072B2", "o", "-"), ("q2p1", "dome", False, "Q2/P1 dome", "#D55E00", "s", "--"),
           ("q1p0", "cuboid", False, "Q1/P0 cuboid", "#009E73", "^", "-."),
           ("q1p0", "dome", True, "Q1/P0 dome, direct solver", "#333333", "D", ":"))


def draw(inputs: Inputs) -> Picture:
    need(inputs.tables, "cost", "a table of tabulate cost")
    table, picture = inputs.tables[0], Picture(900, 640)
    seconds, error = np.array(table.numbers("cpu_s")), np.array(table.numbers("supine_error_mm"))
    element, template, solver = (np.array(table.texts(name)) for name in ("element", "template", "solver"))
    panel = picture.panel(0, 0, 1, 1)
    panel.caption("Error against run time: distance to the finest solution")
    axes = panel.plot_axes("CPU time of backward and forward (s)", "error of tumour or nipple, supine (mm)", "xy")
    for of_element, of_template, direct, words, colour, marker, style in _SERIES:
        which = (element == of_element) & (template == of_template) & ((solver == "direct") == direct)
        which &= np.isfinite(seconds) & np.isfinite(error) & (error > 0)
        if which.any():
            axes.plot(seconds[which], error[which], style, marker=marker, color=colour, label=words, linewidth=points(2.2))
    axes.grid(True, which="minor", color="0.93", linewidth=0.5)
    if axes.lines:
        axes.legend(fontsize=points(SMALL), framealpha=0.9)
    return picture
