# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules by which make solves the rows of studies: those of the chain (Makefile.pipeline), each in the folder of its row.

A rule of the chain is the home of a stage: what it reads, its program and its arguments. In the folder of a row it is the same rule with
three differences. It reads the files of earlier stages where the row takes them from. Its target is the report, STAGE.json, because a
solve that ends early is a result, whose report states the reason (`cases attempt`). And its options are those of the row.
"""
from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from ..errors import Failed
from .variants import Studies, Variant

_BEGIN, _END = "# ---- the chain ", "# ---- the end of the chain "
_RULE = re.compile(r"^(\S.*?) ?&?: (.*)\n((?:\t.*\n)+)", re.MULTILINE)
_STAGED = re.compile(r"\t\$\(call (?:stage|pressed|of_pressed),([a-z-]+)\) (.*)")
_FILE = re.compile(r"\$\(RUN\)/([\w-]+)\.(\w+)")


@dataclass
class ChainRule:
    """A rule of the chain.

    stage: its name; file: the first file that it writes; reads: the files of earlier stages, in order; needs: its other prerequisites;
    command: its program with arguments, as make reads them.
    """

    stage: str
    file: str
    reads: list[str]
    needs: list[str]
    command: str


def chain_rules(makefile: str) -> dict[str, ChainRule]:
    """The rules of the stages in the text of Makefile.pipeline, in order. Raises Failed if a rule has another form."""
    text = makefile.partition(_BEGIN)[2].partition(_END)[0]
    rules = {}
    for targets, needs, recipe in _RULE.findall(text):
        staged = _STAGED.search(recipe)
        if staged is None:
            raise Failed(f"Makefile.pipeline: the rule of {targets} runs no stage")
        words = re.findall(r"\$\([^()]*(?:\([^()]*\)[^()]*)*\)\S*|\S+", needs)
        reads = [word.removeprefix("$(RUN)/") for word in words if _FILE.fullmatch(word)]
        other = [word for word in words if not _FILE.fullmatch(word) and not word.startswith("$(call changed,")]
        rules[staged[1]] = ChainRule(staged[1], targets.split()[0].removeprefix("$(RUN)/"), reads, other, staged[2])
    return rules


class StudyRules:
    """The rules of all rows of studies.

    Args:
        variables: of make, that have the options of each column. run: folder of the case. tumour: whether the case has one to follow.
            place: shell command that prints the place of the tumour in a mesh, given its report.
    """

    def __init__(self, studies: Studies, rules: dict[str, ChainRule], variables: dict[str, str], run: str, tumour: bool, place: str) -> None:
        self._studies, self._rules, self._run, self._tumour, self._place = studies, rules, run, tumour, place
        self._variables = variables
        self._maker = {rule.file: rule.stage for rule in rules.values()}

    def text(self) -> str:
        """The rules as a makefile: for each study the names of its rows in STUDY_variants, and its table."""
        parts = ["# The rows of studies, made of their tables (pipelines/studies/*.tsv) and of the rules of the chain.\n"]
        for study in self._studies.names:
            rows = [one for one in self._studies.variants.values() if one.study == study]
            parts.append(f"\n# ---- {study}\n{study}_variants := {' '.join(one.name for one in rows)}\n")
            parts += [part for one in rows for part in self._variant(one)]
            ends = " ".join(f"$(RUN)/studies/{study}/{one.name}/{stage}.json" for one in rows for stage in one.ends_at)
            table = f"$(RUN)/studies/{study}"
            says = [f"$(info {study}/{one.name} {_says(one, self._run)})" for one in rows if one.drops]
            parts.append(f"{study}_drops = {' '.join(says)}".rstrip() + "\n")
            parts.append(f"{table}.tsv: {ends} $(BIN)/tabulate\n"
                         f"\t$(call table,$(tabulate) study {table} $(landmarks) $({study}_variants))\n")
        return "".join(parts)

    def _home(self, one: Variant, stage: str) -> str:
        """The folder in which a row finds the files of a stage: its own, or that of the row from which it starts."""
        folder = one.folder
        while folder != self._run:
            at = self._studies.variants[folder]
            if stage in at.stages or stage in at.given:
                break
            folder = at.origin
        return folder

    def _target(self, one: Variant, stage: str) -> str:
        """The target that makes a stage for a row."""
        home = self._home(one, stage)
        return f"{home}/{self._rules[stage].file}" if home == self._run else f"{home}/{stage}.json"

    def _variant(self, one: Variant) -> Iterator[str]:
        at = one.origin.removeprefix(self._run + "/studies/") if one.origin != self._run else "the case"
        yield f"# {one.name}: from {at}, at {one.stages[0]}\n"
        yield f"V := $(RUN){one.folder.removeprefix(self._run)}\n"
        for column, value in one.options.items():
            if value != self._studies.case[column]:
                equals = "=" if "{tumour}" in value else ":="  # its place is asked for when the stage runs
                yield f"$V/%: private override {self._variables[column]} {equals} {self._placed(one, value)}\n"
        for stage in one.stages:
            if stage not in one.given:
                yield self._rule(one, self._rules[stage])

    def _placed(self, one: Variant, options: str) -> str:
        """Options with the place of the tumour in the mesh from which the row starts."""
        if "{tumour}" not in options or not self._tumour:
            return options
        mesh = f"{self._mesh_of(one).rpartition('/')[0]}/mesh.json"
        return options.replace("{tumour}", f"$$({self._place} {mesh} tumour)")

    def _mesh_of(self, one: Variant) -> str:
        start = self._studies.variants.get(one.origin)
        return self._target(start, "mesh") if start else f"{self._run}/mesh.vtkhdf"

    def _rule(self, one: Variant, rule: ChainRule) -> str:
        needs = " ".join(self._needs(one, rule)).replace(one.folder + "/", "$V/")
        waits = " ".join(self._file(one, rule, name) for name in rule.reads) + (f" {one.only_if}/supine.vtkhdf" if one.only_if else "")
        command = f"$(call attempt,{rule.stage},{waits}) {self._command(one, rule)}".replace(one.folder + "/", "$(@D)/")
        return f"$V/{rule.stage}.json: {needs} $$(call changed_in,$$(@D),{rule.stage})\n\t{command}\n".replace(self._run + "/", "$(RUN)/")

    def _file(self, one: Variant, rule: ChainRule, name: str) -> str:
        """Where a row finds a file that the rule of the chain names: in its own folder what the rule itself makes."""
        stage = self._maker.get(name)
        return f"{one.folder if stage in (None, rule.stage) else self._home(one, stage)}/{name}"

    def _follows_tumour(self, one: Variant, rule: ChainRule) -> bool:
        """Whether the stage places the tumour where it is in the mesh from which the row starts."""
        return rule.stage == "mesh" and "{tumour}" in one.options.get("hexmesh", "")

    def _needs(self, one: Variant, rule: ChainRule) -> list[str]:
        """The prerequisites of a row's stage, but for the record of its options."""
        needs = [self._target(one, self._maker[name]) for name in rule.reads]
        materials = one.options["materials"]
        made = [materials] if materials.startswith(self._run + "/") else []  # by a rule
        for need in rule.needs:
            needs += made if need == "$(MADE_MATERIALS)" else [need]
        if one.options.get("plates") and rule.stage in ("cc", "mlo"):
            needs.append("$(TRUTH_TABLE)")
        if self._follows_tumour(one, rule):
            needs.append(self._mesh_of(one))
        if one.only_if:
            needs.append(one.only_if + "/supine.json")
        return needs

    def _command(self, one: Variant, rule: ChainRule) -> str:
        """The program of the chain with the files of the row instead of those of the case."""
        if self._follows_tumour(one, rule) and not self._tumour:
            return (f"$(error {one.study}/{one.name}: this variant needs a tumour to follow$(comma) and the case has none; name its "
                    "place with TUMOUR=x$(comma)y$(comma)z (mm))")
        reads = [self._file(one, rule, name) for name in rule.reads]
        words = {"$(wordlist 1,2,$^)": " ".join(reads[:2]), "$(word 2,$^)": reads[1] if reads[1:] else "", "$<": reads[0] if reads else "",
                 "$@": f"{one.folder}/{rule.file}", "$(contours) ": "", "$(common_alone)": "$(common)"}
        command = rule.command
        for word, text in words.items():
            command = command.replace(word, text)
        return _FILE.sub(lambda found: self._file(one, rule, f"{found[1]}.{found[2]}"), command)


def _says(one: Variant, run: str) -> str:
    origin = one.origin.removeprefix(run + "/") if one.origin != run else "the case"
    return f"leaves out of {origin} {one.drops} (a + at the beginning of the cell keeps it)"
