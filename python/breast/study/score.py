# SPDX-License-Identifier: GPL-3.0-or-later
"""score: what a run predicted against what was seen in the patient, for one run or for the runs of a study."""
from __future__ import annotations

import math
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ..command.tool import Run, Tool
from ..errors import BreastError
from ..output import write_text
from ..programs import printed_by
from .seen import by_case, of_side, pairs_in, postures_in, read_seen
from .stage_report import StageReport
from .table import NO_VALUE, Table, fixed, number_of, parse_table, read_table

CURVE = "CC to MLO"
_FILES = {"stress_free": "reference", "supine": "supine", "cc": "cc", "mlo": "mlo", "ml": "ml"}
_BANDS = ((50, 0.674490), (90, 1.644854), (95, 1.959964))
"""Per cent of a normal distribution within so many standard deviations."""


@dataclass(frozen=True)
class Score:
    """The error of one point. where: the posture, or CURVE; moved_mm: how far the point moved from the scan; deviations: the error in
    standard deviations of the band, with its sign."""

    case: str
    landmark: str
    where: str
    error_mm: float
    moved_mm: float | None = None
    deviations: float | None = None

    def band(self) -> str:
        """The narrowest band that holds the point, as "90 %", "outside", or NO_VALUE without a band."""
        if self.deviations is None:
            return NO_VALUE
        return next((f"{percent} %" for percent, width in _BANDS if abs(self.deviations) <= width), "outside")


class _Case:
    """A run folder with the points of its breast; `work` is a folder for temporary files."""

    def __init__(self, run: Path, seen: Table, work: Path) -> None:
        self.run, self.work = run, work
        self.side = StageReport.read(run / "labels.json").text("side") or StageReport.read(run / "mesh.json").text("side")
        if not self.side:
            raise BreastError("neither labels.json nor mesh.json states the side of the breast", run)
        self.seen = of_side(seen, self.side)
        if not self.seen.rows:
            raise BreastError(f"has no point of the {self.side} breast", seen.name)

    def scores(self) -> list[Score]:
        postures, pairs = postures_in(self.seen), pairs_in(self.seen)
        if not postures and not pairs:
            raise BreastError("has neither positions in a second posture (supine_x_mm ...) nor places in both mammograms (cc_u_mm ... "
                              "or cc_x_px ...)", self.seen.name)
        made = [posture for posture in postures if self._state(_FILES[posture])]
        if postures and not made:
            raise BreastError(f"has none of {', '.join(_FILES[p] + '.vtkhdf' for p in postures)}", self.run)
        scores = self._of_postures(made) if made else []
        if pairs:
            scores += self._of_pairs(pairs.split())
        elif {"cc", "mlo"} <= set(made):
            scores += self._of_true_curves()
        return scores

    def has_band(self) -> bool:
        return bool(self._state("cc-sensitivity") and self._state("mlo-sensitivity"))

    def _state(self, name: str) -> str:
        file = self.run / f"{name}.vtkhdf"
        return str(file) if file.exists() else ""

    def _truth(self) -> str:
        """The points as probe and cc2mlo read true positions; a table of libbreast's own is given to them as it is."""
        if "scan_sha256" in self.seen.columns and Path(self.seen.name).exists():
            return self.seen.name
        file = self.work / "landmarks.tsv"
        write_text(file, self.seen.text() + "\r\n")
        return str(file)

    def _of_postures(self, postures: list[str]) -> list[Score]:
        files = [self._state("mesh"), *(self._state(_FILES[posture]) for posture in postures)]
        table = parse_table(printed_by("probe", [*filter(None, files), "--truth", self._truth()]), "probe --truth")
        scores = []
        for row in table:
            if row["landmark"] in ("mean", "largest"):
                continue
            for posture in postures:
                error = number_of(row.get(f"{posture}_error_mm", NO_VALUE))
                if error is not None:
                    scores.append(Score(self.run.name, row["landmark"], posture, error, number_of(row[f"{posture}_true_mm"])))
        return scores

    def _matched(self, words: Sequence[str]) -> Table:
        views = [self._state(f"{view}-sensitivity") if self.has_band() else self._state(view) for view in ("cc", "mlo")]
        if not all(views):
            raise BreastError("has no cc.vtkhdf and mlo.vtkhdf", self.run)
        table = self.work / "curve.tsv"
        printed_by("cc2mlo", [*views, str(self.work / "curve.vtp"), *words, "--table", str(table), *(["--band"] if self.has_band() else [])])
        return read_table(table)

    def _of_curve(self, table: Table, whose: str, landmark: str = "") -> list[Score]:
        scores = []
        for row in table:
            error = number_of(row[f"{whose}_to_curve_mm"])
            if error is not None:
                scores.append(Score(self.run.name, landmark or row["landmark"], CURVE, error, None,
                                    number_of(row[f"{whose}_over_deviation"])))
        return scores

    def _of_true_curves(self) -> list[Score]:
        return self._of_curve(self._matched(["--truth", self._truth()]), "true")

    def _of_pairs(self, axes: list[str]) -> list[Score]:
        scores: list[Score] = []
        for number, row in enumerate(self.seen):
            place = [self.seen.number(number, f"{view}_{axis}") for view in ("cc", "mlo") for axis in axes]
            images = []
            for view in ("cc", "mlo") if "x_px" in axes else ():
                images += [f"--{view}-image", str(Path(self.seen.name).parent / row[f"{view}_image"])]
            table = self._matched(["--pair", ",".join(f"{value:.9g}" for value in place), *images])
            found = self._of_curve(table, "marked", row["landmark"])
            if not found:
                raise BreastError(f"'{row['landmark']}': the CC place {place[0]:g},{place[1]:g} is beside the breast of the model",
                                  self.seen.name, "u and v are mm from the origin of the simulated mammogram, x and y pixels of the image")
            scores += found
        return scores


def table_of(scores: Sequence[Score]) -> Table:
    """One row a point and posture."""
    return Table(["case", "landmark", "where", "error_mm", "moved_mm", "error_over_deviation", "band"],
                 [[s.case, s.landmark, s.where, fixed(s.error_mm, 3), fixed(s.moved_mm, 3), fixed(s.deviations, 3), s.band()]
                  for s in scores])


def _quantile(ordered: Sequence[float], share: float) -> float:
    return ordered[max(math.ceil(share * len(ordered)), 1) - 1]


def summary_of(scores: Sequence[Score]) -> Table:
    """One row a posture: number of points and cases; mean, quantiles and largest error, mm; mean true motion, mm; per cent of the points
    inside each band."""
    bands = [f"in_{percent}_percent" for percent, _ in _BANDS]
    table = Table(["where", "points", "cases", "mean_mm", "median_mm", "p90_mm", "p95_mm", "largest_mm", "moved_mm", *bands])
    for where in dict.fromkeys(s.where for s in scores):
        own = [s for s in scores if s.where == where]
        errors, moved = sorted(s.error_mm for s in own), [s.moved_mm for s in own if s.moved_mm is not None]
        judged = [abs(s.deviations) for s in own if s.deviations is not None]
        shares = [fixed(100 * sum(d <= width for d in judged) / len(judged), 1) if judged else NO_VALUE for _, width in _BANDS]
        quantiles = [fixed(_quantile(errors, share), 3) for share in (0.5, 0.9, 0.95)]
        table.rows.append([where, str(len(own)), str(len({s.case for s in own})), fixed(math.fsum(errors) / len(errors), 3), *quantiles,
                           fixed(errors[-1], 3), fixed(math.fsum(moved) / len(moved) if moved else None, 3), *shares])
    return table


def _is_run(folder: Path) -> bool:
    return (folder / "mesh.vtkhdf").exists()


def _cases(folder: Path, points: Path) -> dict[Path, Table]:
    """The points of each run. Raises BreastError for a folder that is no run and holds none."""
    if _is_run(folder):
        if points.is_dir():
            raise BreastError(f"is a folder, and {folder} is one run", points, "give the file of its points")
        return {folder: read_seen(points)}
    runs = [one for one in sorted(folder.iterdir()) if _is_run(one)]
    if not runs:
        raise BreastError("is no run and holds none: no mesh.vtkhdf", folder)
    seen = by_case(points, [run.name for run in runs])
    return {run: seen[run.name] for run in runs if run.name in seen}


def _score(run: Run) -> None:
    args, scores, failures = run.args, [], {}
    cases = _cases(Path(args.run), Path(args.points))
    for folder, seen in cases.items():
        with tempfile.TemporaryDirectory() as work:
            try:
                case = _Case(folder, seen, Path(work))
                own = case.scores()
                scores += own
                if any(score.where == CURVE for score in own) and not case.has_band():
                    run.remark(f"{folder.name}: no band, as there are no cc-sensitivity.vtkhdf and mlo-sensitivity.vtkhdf (--target page "
                               "makes them)")
            except BreastError as error:
                if len(cases) == 1:
                    raise
                failures[folder.name] = str(error)
    for name, reason in failures.items():
        run.remark(f"{name} is not scored: {reason}")
    if not scores:
        raise BreastError(f"none of {len(cases)} runs is scored; the first: {next(iter(failures.values()), 'no points')}", args.run)
    table, summary = table_of(scores), summary_of(scores)
    run.report["cases"], run.report["not_scored"] = len(cases), failures
    run.report["score"] = {row["where"]: {name: number_of(row[name]) for name in summary.columns[1:]} for row in summary}
    for file, one in ((args.table, table), (args.summary, summary)):
        if file:
            write_text(file, one.text() + "\r\n")
    run.print(summary.text() if args.table else table.text() + "\n" + summary.text())


def declaration() -> Tool:
    tool = Tool("score", "errors of a run's predictions at points seen in the patient")
    tool.describe(
        "Compares finished runs with what was seen in the patient and was not given to them. RUN is the folder of a run, or a folder of "
        "runs. For each point the table gives the error in mm and, where the run has derivatives (cc-sensitivity.vtkhdf, "
        "mlo-sensitivity.vtkhdf), the narrowest of the 50 %, 90 % and 95 % bands that holds it. The summary gives, for each posture, mean, "
        "median, 90th and 95th percentile (nearest rank) and largest error, and the share of the points inside each band.")
    tool.describe(
        "Points in a second posture: a table with columns prone_x_mm prone_y_mm prone_z_mm and supine_x_mm ..., or cc_x_mm ... mlo_z_mm, and "
        "optionally landmark and side; a phantom's landmarks.tsv is one. Marks of 3D Slicer are paired by their labels (prone-3 with "
        "supine-3). Positions are LPS mm in the frame of the scan, with the rib cages registered: the error is the distance between the "
        "point as predicted and as seen.")
    tool.describe(
        "Lesions in the mammograms: a table with columns cc_u_mm cc_v_mm mlo_u_mm mlo_v_mm in the simulated images, or cc_x_px cc_y_px "
        "mlo_x_px mlo_y_px in the patient's own, whose files are named in cc_image and mlo_image (beside the table). The error is the "
        "distance of the place in MLO from the curve predicted for the place in CC (cc2mlo).")
    tool.describe(
        "For a folder of runs, POINTS is a folder with one file a run, named as the run (CASE.tsv, CASE.mrk.json or CASE.fcsv), or one "
        "table with the column case. A run that cannot be scored is named with the reason, and left out of the summary.")
    tool.word("RUN", "folder of a run, or of several")
    tool.word("POINTS", "what was seen: .tsv, .mrk.json, .fcsv, or a folder of such files")
    tool.output_file("--table", "OUT.tsv", "one row per point and posture; stdout then has the summary alone")
    tool.output_file("--summary", "OUT.tsv", "the summary as a table of its own")
    tool.check(lambda: _check_exist(tool.args.run, tool.args.points))
    tool.example("score runs/average runs/phantom/average-truth/landmarks.tsv", "the chain against a phantom's truth")
    tool.example("score runs/cohort-patients lesions.tsv --table scores.tsv", "a study: the lesions of all patients, seen in CC and MLO")
    return tool


def _check_exist(run: str, points: str) -> None:
    if not Path(run).is_dir():
        raise BreastError(f"RUN: {run} is not a folder")
    if not Path(points).exists():
        raise BreastError(f"POINTS: {points} does not exist")


def main() -> int:
    return declaration().main(_score)
