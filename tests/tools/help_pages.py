#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""help_pages.py FOLDER PROGRAM...: writes FOLDER/tools/NAME.md and FOLDER/man/NAME.1, what `PROGRAM --help-all` says as Markdown and as
a manual page; of the command `breast`, whose help lists its commands, the page of its own arguments and options."""
from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from breast.command.commands import SUMMARY  # noqa: E402
from breast.command.declaration import Declaration, help_text  # noqa: E402
from breast.command.request import pipeline_command  # noqa: E402


@dataclass
class Help:
    """The parts of a help text: sections by title, each with its entries as pairs of what stands in the margin and below it."""

    name: str
    summary: str
    synopsis: str
    paragraphs: list[str]
    sections: dict[str, list[tuple[str, str]]]


def parse_help(text: str) -> Help:
    """The text of --help-all, in which blank lines separate paragraphs and sections; the entries of a section are indented by two
    columns, and what explains an entry by more."""
    first, usage, *blocks = text.rstrip("\n").split("\n\n")
    name, _, summary = first.partition(" - ")
    found = Help(name, summary, usage.removeprefix("Usage: "), [], {})
    for block in blocks:
        title, *lines = block.split("\n")
        if not lines or not lines[0].startswith("  "):
            found.paragraphs.append(" ".join([title, *lines]))
            continue
        entries: list[list[str]] = []
        for line in lines:
            if line.startswith("   "):
                entries[-1].append(line.strip())
            else:
                entries.append([line[2:]])
        title = title.removesuffix(":")
        if title == "Exit codes":
            found.sections[title] = [(code, meaning) for (line,) in entries for code, _, meaning in [line.partition("  ")]]
        elif title == "Citation":
            found.sections[title] = [(" ".join(lines), "") for lines in entries]
        else:
            found.sections[title] = [(head, " ".join(rest)) for head, *rest in entries]
    return found


def markdown(tool: Help) -> str:
    def cell(text: str) -> str:  # a vertical bar would end a cell of a table, an angle bracket would start a tag
        return text.replace("|", "\\|").replace("<", "&lt;")

    out = [f"# {tool.name}\n\n{cell(tool.summary)}\n\n```\n{tool.synopsis}\n```\n"]
    out += [f"\n{cell(paragraph)}\n" for paragraph in tool.paragraphs]
    for title, entries in tool.sections.items():
        if title == "Examples":
            out.append("\n## Examples\n" + "".join(f"\n{cell(said)}\n\n```\n{command}\n```\n" for command, said in entries))
        elif title == "Exit codes":
            out.append("\n## Exit codes\n\n| code | meaning |\n|---|---|\n" + "".join(f"| {c} | {said} |\n" for c, said in entries))
        elif title == "Citation":
            out.append("\n## References\n\n" + "".join(f"- {cell(citation)}\n" for citation, _ in entries))
        else:
            rows = (f"| `{usage.replace('|', chr(92) + '|')}` | {cell(said)} |\n" for usage, said in entries)
            out.append(f"\n## {title}\n\n| | |\n|---|---|\n" + "".join(rows))
    return "".join(out)


def manual(tool: Help, version: str) -> str:
    def roff(text: str) -> str:  # a leading dot or quote would be a request, a bare minus a hyphen
        text = text.replace("\\", "\\e").replace("-", "\\-")
        return "\\&" + text if text[:1] in (".", "'") else text

    out = [f'.TH {tool.name.upper()} 1 "" "libbreast {version}" libbreast\n.SH NAME\n{roff(tool.name)} \\- {roff(tool.summary)}\n'
           f".SH SYNOPSIS\n.B {roff(tool.synopsis)}\n"]
    if tool.paragraphs:
        out.append(".SH DESCRIPTION\n" + ".PP\n".join(roff(paragraph) + "\n" for paragraph in tool.paragraphs))
    for title, entries in tool.sections.items():
        if title == "Citation":
            out.append(".SH REFERENCES\n" + ".PP\n".join(roff(citation) + "\n" for citation, _ in entries))
            continue
        heading = {"Exit codes": "EXIT STATUS"}.get(title, title.upper())
        out.append(f'.SH "{heading}"\n' if " " in heading else f".SH {heading}\n")
        out += [f".TP\n.B {roff(usage)}\n{roff(said)}\n" for usage, said in entries]
    return "".join(out)


def breast_help() -> str:
    """The arguments and options of `breast` itself: those of all its commands."""
    d = Declaration("breast", SUMMARY)
    d.paragraphs += [
        "`breast TOOL` runs a tool of libbreast with its arguments, as in `breast segment scan.nrrd labels.vtkhdf --side left`. Each tool "
        "has a manual page, breast-TOOL. `breast list` lists them, `breast help TOOL` prints the help of one.",
        "`breast run SCAN [SETTING=value]...` runs the whole chain on a scan, `breast demo` on a simulated breast, "
        "`breast cohort DIR` on every case file of a folder. They work from any folder; results are written to ./runs or to the folder "
        "given by --runs."]
    d.word("COMMAND", "run, demo, page, cohort, list, help, or the name of a tool")
    d.words("ARGUMENT", "arguments of the command")
    for option in pipeline_command("run").options + pipeline_command("cohort").options:
        if d.option(option.label) is None:
            d.options.append(option)
    d.flag("--help", "the commands and tools")
    d.flag("--version", "name and version")
    d.examples += [("breast demo", "the whole chain on a simulated breast; results in ./runs/average"),
                   ("breast run scan.nrrd", "the whole chain on a scan; results in ./runs/scan-left and ./runs/scan-right"),
                   ("breast help compress", "the help of a tool"),
                   ("breast help TUMOUR", "what a setting does")]
    return help_text(d, everything=True)


def said_by(program: str, option: str) -> str:
    return subprocess.run([program, option], stdout=subprocess.PIPE, text=True, check=True).stdout


def main() -> None:
    folder, *programs = sys.argv[1:]
    for program in programs:
        name = Path(program).name
        page = parse_help(breast_help() if name == "breast" else said_by(program, "--help-all"))
        version = said_by(program, "--version").split()[-1]
        Path(folder, "tools", name + ".md").write_text(markdown(page))
        Path(folder, "man", name + ".1").write_text(manual(page, version))


if __name__ == "__main__":
    main()
