# SPDX-License-Identifier: GPL-3.0-or-later
"""What the targets of the pipeline need of a case (pipelines/goals.tsv)."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ..errors import BreastError
from ..text_table import read_table


class CaseKind(NamedTuple):
    """What a case has, as far as a target may need it."""

    installed: bool = False    # an installation, without the source tree
    phantom: bool = False      # its true body is known
    has_tumour: bool = False   # there is a tumour to follow
    body_slides: bool = False  # the body of the phantom slides on the chest wall
    printed: bool = False      # the model as printed in the paper (PAPER=1)
    slurm: bool = False        # cohorts are submitted to Slurm (CLUSTER=slurm)


class Goals:
    """The targets given to make; those that the table in `pipelines` does not contain need nothing."""

    def __init__(self, pipelines: Path, names: Sequence[str]) -> None:
        needs = {row["goal"]: row["needs"].split() for row in read_table(pipelines / "goals.tsv").records()}
        self._goals = [(name, needs.get(name, [])) for name in names]

    def about_case(self) -> bool:
        """Whether a target is about the case in RUN."""
        return any("any" not in needs for _, needs in self._goals)

    def check(self, kind: CaseKind, preset: str) -> None:
        """Raises BreastError for the first target that a case of this kind cannot have, with the reason and what to do."""
        for need, lacking, why in (
                ("source", kind.installed,
                 "needs the source tree of libbreast, which is not installed; run it in the source tree"),
                ("tumour", not kind.has_tumour,
                 "needs a tumour to follow, and this case has none; name its place with TUMOUR=x,y,z (patient LPS, mm), a table or "
                 "labels, or give TUMOUR=auto for an artificial one"),
                ("truth", not kind.phantom,
                 "a scan has no truth to compare with; leave MR out and name a phantom with PRESET=NAME"),
                ("held", kind.body_slides, f"holds the breast at its wall, but the phantom {preset} slides there; give PRESET=paper or leave PRESET out"),
                ("slurm", not kind.slurm,
                 "prints what would be submitted to Slurm, and CLUSTER is not slurm; give CLUSTER=slurm"),
                ("truth", kind.printed and kind.body_slides,
                 f"with PAPER=1 the breast is held at its wall, but the phantom {preset} slides there; leave PAPER or PRESET out")):
            goal = next((name for name, needs in self._goals if need in needs), None) if lacking else None
            if goal is not None:
                raise BreastError(f"{goal}: {why}")
