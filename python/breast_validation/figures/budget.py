# SPDX-License-Identifier: GPL-3.0-or-later
"""What is left of the chain's errors when one stage is replaced by the truth; dashed: the chain as it is."""
from __future__ import annotations

import numpy as np

from breast.figures.inputs import Inputs, need
from breast.figures.layout import SMALL, Picture, points

_STAGES = {"chain": "nothing\n(the chain)", "segmentation": "labels", "body": "labels, surfaces\nand mesh",
           "tissue": "tissue\non the mesh", "cut": "support of\nthe cut", "discretisation": "(finer mesh,\nnot truth)",
           "backward": "stress-free\nshape", "compression": "compressed\nshapes"}
_ERRORS = (("stress_free_mean_mm", "stress-free", "#0072B2", ""), ("supine_mean_mm", "supine", "#E69F00", "//"),
           ("curve_mean_mm", "MLO place to curve", "#009E73", ".."))


def draw(inputs: Inputs) -> Picture:
    need(inputs.tables, "budget", "a table of tabulate budget")
    table, picture = inputs.tables[0], Picture(1200, 620)
    replaced = table.texts("replaced")
    panel = picture.panel(0, 0, 1, 1)
    panel.caption("Error budget: what is left when one stage is replaced by the truth; dashed: the chain as it is; "
                  "\N{EN DASH}: the table says why there is no value")
    axes = panel.plot_axes("replaced by the truth", "mean error at the true places (mm)")
    at = np.arange(len(replaced))
    for k, (column, words, colour, hatch) in enumerate(_ERRORS):
        values, left = np.array(table.numbers(column)), at + 0.27 * (k - 1)
        axes.bar(left, np.nan_to_num(values), 0.25, color=colour, hatch=hatch, edgecolor="white", label=words)
        if "chain" in replaced and np.isfinite(values[replaced.index("chain")]):
            axes.axhline(values[replaced.index("chain")], color=colour, linestyle="--", linewidth=points(1.5), zorder=0.9)
        for x, value in zip(left, values):
            axes.text(x, np.nan_to_num(value), f"{value:.2f}" if np.isfinite(value) else "\N{EN DASH}", ha="center", va="bottom",
                      fontsize=points(SMALL - 1), bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.5, "alpha": 0.8})
    axes.set_xticks(at, [_STAGES.get(name, name) for name in replaced], fontsize=points(SMALL))
    axes.set_ylim(0, 1.15 * max([1e-3, *(np.nan_to_num(table.numbers(column)).max() for column, *_ in _ERRORS)]))
    axes.legend(ncols=3, loc="upper right", fontsize=points(SMALL), framealpha=0.9)
    return picture
