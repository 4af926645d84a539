# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against CPU time over all methods: the table of tabulate methods-cost."""
from __future__ import annotations

import numpy as np

from breast.figures.inputs import Inputs, need
from breast.figures.layout import SMALL, Picture, points

_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#333333", "#E69F00", "#CC79A7", "#56B4E9")
_MARKERS, _STYLES = "osD^vP*", ("-", "--", "-.", ":")


def draw(inputs: Inputs) -> Picture:
    need(inputs.tables, "methods-cost", "a table of tabulate methods-cost")
    table = inputs.tables[0]
    method, seconds, error = np.array(table.texts("method")), np.array(table.numbers("cpu_s")), np.array(table.numbers("error_mm"))
    measured = table.texts("measured")
    picture = Picture(1100, 760)
    panel = picture.panel(0, 0, 1, 1)
    panel.caption("Error against CPU time, one mark per mesh or per pitch of a lookup; in brackets: what the error is measured against")
    axes = panel.plot_axes("CPU time (s)", "error (mm)", "xy")
    for k, name in enumerate(dict.fromkeys(method)):
        rows = np.flatnonzero(method == name)
        rows = rows[np.argsort(seconds[rows], kind="stable")]
        axes.plot(seconds[rows], error[rows], _STYLES[k % 4], marker=_MARKERS[k % 7], color=_COLOURS[k % 7], linewidth=points(2.2),
                  label=f"{name} ({measured[rows[0]]})")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=2, fontsize=points(SMALL), frameon=False)
    box = axes.get_position()
    axes.set_position((box.x0, box.y0 + 0.13, box.width, box.height - 0.13))
    return picture
