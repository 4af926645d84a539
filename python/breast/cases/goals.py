# SPDX-License-Identifier: GPL-3.0-or-later
"""What the targets of the pipeline need of a case (pipelines/goals.tsv)."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..errors import BreastError
from ..text_table import read_table


class Goals:
    """The targets given to make; those that the table in `pipelines` does not contain need nothing."""

    def __init__(self, pipelines: Path, names: Sequence[str]) -> None:
        needs = {row["goal"]: row["needs"].split() for row in read_table(pipelines / "goals.tsv").records()}
        self._goals = [(name, needs.get(name, [])) for name in names]

    def about_case(self) -> bool:
        """Whether a target is about the case in RUN."""
        return any("any" not in needs for _, needs in self._goals)

    def check(self, case: Mapping[str, str]) -> None:
        """Raises BreastError for the first target that a case cannot have, with the reason and what to do.

        Args:
            case: its settings, and installed, phantom, body_slides and no_tumour, not empty if they hold.
        """
        phantom, slides, preset = (case.get(name, "") for name in ("phantom", "body_slides", "PRESET"))
        demonstration = phantom and (preset, case.get("ELEMENTS")) == ("average", "10")
        for need, lacking, why in (
                ("source", case.get("installed"),
                 "needs the source tree of libbreast, which is not installed; run it in the source tree"),
                ("tumour", case.get("no_tumour"),
                 "needs a tumour to follow, and this case has none; name its place with TUMOUR=x,y,z (patient LPS, mm), a table or "
                 "labels, or give TUMOUR=auto for an artificial one"),
                ("truth", not phantom, "a scan has no truth to compare with; leave MR out and name a phantom with PRESET=NAME"),
                ("held", slides, f"holds the breast at its wall, but the phantom {preset} slides there; give PRESET=paper or leave PRESET out"),
                ("demo", not demonstration, "is about the demonstration; give PRESET=average ELEMENTS=10 and no scan"),
                ("slurm", case.get("CLUSTER") != "slurm",
                 "prints what would be submitted to Slurm, and CLUSTER is not slurm; give CLUSTER=slurm"),
                ("truth", case.get("PAPER") and slides,
                 f"with PAPER=1 the breast is held at its wall, but the phantom {preset} slides there; leave PAPER or PRESET out")):
            goal = next((name for name, needs in self._goals if need in needs), None) if lacking else None
            if goal is not None:
                raise BreastError(f"{goal}: {why}")
