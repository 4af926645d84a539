# SPDX-License-Identifier: GPL-3.0-or-later
"""How far tissue moves and how much nearer it comes to the ribs, by its depth: model and living women."""
from __future__ import annotations

import numpy as np

from .inputs import Inputs, need
from .layout import SMALL, Picture, points

_DEPTHS = (("0_20", "0-20"), ("20_40", "20-40"), ("above_40", "above 40"))


def draw(inputs: Inputs) -> Picture:
    need(inputs.tables, "motion", "a table of population")
    table, picture = inputs.tables[0], Picture(1000, 480)
    rows = {name: n for n, name in enumerate(table.texts("quantity"))}
    one = not (np.nan_to_num(table.numbers("sd")) > 0).any()
    model = "this breast" if one else "model, mean and SD over breasts"
    for k, (start, words, title, limits) in enumerate((
            ("moved", "moved from prone to supine (mm)", "(a) motion of tissue", (0, 140)),
            ("change", "change of the distance from the ribs (mm)", "(b) change of its distance from the ribs", (-55, 5)))):
        panel = picture.panel(0.5 * k, 0, 0.5 * (k + 1), 1)
        panel.caption(title)
        axes = panel.plot_axes("distance from the ribs in the scan (mm)", words)
        for mean, sd, shift, marker, colour, label in (("women_mean", "women_sd", -0.08, "s", "0.45", "women, mean and SD"),
                                                       ("mean", "sd", 0.08, "o", "#D55E00", model)):
            found = [(n, rows[f"{start}_{key}_mm"]) for n, (key, _) in enumerate(_DEPTHS) if f"{start}_{key}_mm" in rows]
            at, which = (np.array(part) for part in zip(*found)) if found else (np.zeros(0), np.zeros(0, int))
            means, deviations = np.array(table.numbers(mean))[which], np.nan_to_num(table.numbers(sd))[which]
            axes.errorbar(at + shift, means, deviations, fmt=marker, capsize=4, color=colour, label=label, linewidth=points(2.5))
        axes.set_xlim(-0.5, 2.5)
        axes.set_ylim(*limits)
        axes.set_xticks(range(3), [words for _, words in _DEPTHS])
        if k == 0:
            axes.legend(loc="upper left", fontsize=points(SMALL), frameon=False)
    return picture
