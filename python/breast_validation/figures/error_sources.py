# SPDX-License-Identifier: GPL-3.0-or-later
"""What moves a predicted place by how many mm, least first: the table of tabulate error-sources."""
from __future__ import annotations

import numpy as np

from breast.figures.inputs import Inputs, need
from breast.figures.layout import SMALL, Picture, points

_MEASURED = {"phantom's truth": ("#0072B2", ""), "finer solution": ("#56B4E9", "///"), "other assumption": ("#E69F00", "..."),
             "same breast again": ("#999999", "xxx")}

_LEAST_MM = 1e-3
"""Where the axis begins; what is less has no bar, only its number."""


def draw(inputs: Inputs) -> Picture:
    need(inputs.tables, "error-sources", "a table of tabulate error-sources")
    table = inputs.tables[0]
    mm, measured = np.array(table.numbers("mm")), table.texts("measured")
    words = [f"{source}, {shape}" for source, shape in zip(table.texts("source"), table.texts("shape"))]
    order = np.argsort(mm, kind="stable")
    picture = Picture(1200, 120 + 30 * len(order))
    panel = picture.panel(0, 0, 1, 1)
    panel.caption("What moves a predicted place, and by how much; the colour says against what this was measured")
    axes = panel.plot_axes("mm (logarithmic)", logarithmic="x")
    low, _, width, height = axes.get_position().bounds
    axes.set_position((0.34, axes.get_position().y0, low + width - 0.34, height))
    for name, (colour, hatch) in _MEASURED.items():
        rows = [k for k, n in enumerate(order) if measured[n] == name]
        axes.barh(rows, mm[order[rows]], 0.72, color=colour, hatch=hatch, edgecolor="white", label=f"from: {name}")
    for k, n in enumerate(order):
        axes.text(1.15 * max(mm[n], _LEAST_MM), k, f"{mm[n]:.2g}", va="center", fontsize=points(SMALL))
    axes.set_xlim(_LEAST_MM, mm.max() * 3)
    axes.set_yticks(range(len(order)), [words[n] for n in order], fontsize=points(SMALL))
    axes.legend(loc="lower right", fontsize=points(SMALL), framealpha=0.95)
    return picture
