#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""named-files.py BIN: every file of a run that a program or its page names is made by a rule or by a program.

Named are the file names in what reads runs (python/breast/study, python/breast/cases), the folders that they append to
a run, and the paths runs/CASE/... in the examples of all tools and on the pages. Made is what the makefile says it would make
or pass to a program (its rules, and the plans of its goals on the demonstration and on the paper's model), and what a program writes
under a fixed name. BIN holds the programs, of which `cases` plans.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
ENDINGS = "json|tsv|png|vtkhdf|vtp|vti|h5|html|mk|txt"
PLANS = [("PRESET=average", "demo page slicer report"), ("PRESET=paper", "all leaveout cost wall-sensitivity band")]
RULES = ["pipelines/*.mk", "pipelines/*.tsv", "Makefile.pipeline", "tests/*.mk", "tests/truth/*.mk", "tests/bench/*.mk", "tests/bench/*.sh"]
READERS = ["python/breast/study/**/*.py", "python/breast/cases/*.py"]
EXAMPLES = ["tools/*.cpp", "python/breast/command/*.py", "docs/**/*.md", "README.md"]


def texts(patterns: list[str]) -> dict[str, str]:
    files = sorted({file for pattern in patterns for file in ROOT.glob(pattern)})
    return {file.relative_to(ROOT).as_posix(): file.read_text(encoding="utf-8") for file in files}


def plan(programs: str, runs: str, preset: str, goals: str) -> str:
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
    environment["INSTALLED"] = str(pathlib.Path(programs).resolve())
    done = subprocess.run(["make", "-f", "Makefile.pipeline", "-n", "-k", f"RUNS={runs}", preset, *goals.split()], cwd=ROOT,
                          env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"make -n {preset} {goals}: exit {done.returncode}: {done.stderr[-1000:]}")
    return done.stdout


def names_in(text: str) -> set[str]:
    """File names, and the folders above them."""
    names: set[str] = set()
    for path in re.findall(r"[\w./%+-]+", text):
        names.update(part for part in path.split("/") if part)
    return names


def named() -> list[tuple[str, str]]:
    """What is named, and where: the last part of every path."""
    found = []
    for file, text in texts(READERS).items():
        found += [(name, file) for name in re.findall(rf'"([a-z][\w/-]*\.(?:{ENDINGS}))"', text)]
    for file, text in texts(EXAMPLES).items():
        found += [(name, file) for name in re.findall(r"\bruns/[a-z][\w-]*/([\w./-]*\w)", text)]
    return found


def folders_named() -> list[tuple[str, str]]:
    """Folders, or files without their ending, that a program appends to a run."""
    return [(name, file) for file, text in texts(READERS).items() for name in re.findall(r'\brun / "([\w/-]+)"', text)]


def main(programs: str) -> int:
    with tempfile.TemporaryDirectory() as work:
        rules = "".join(texts(RULES).values())
        plans = "".join(plan(programs, f"{work}/runs", preset, goals) for preset, goals in PLANS)
        made = names_in(rules) | names_in(plans)
        below = set(re.findall(r"\$\(RUN\)/([\w./-]+)", rules)) | set(re.findall(rf"{work}/runs/\w+/([\w./-]+)", plans))
    written = r'write\w*\([^;]*?"([\w/-]+\.\w+)"'
    for text in texts(["libbreast/**/*.cpp", "tools/*.cpp"]).values():
        made |= {name.split("/")[-1] for name in re.findall(written, text)}
    for text in texts(["python/breast/**/*.py"]).values():
        made |= set(re.findall(r'write_text\([^\n]*?"([\w-]+\.\w+)"', text))
    # render draws the pictures of a run in one call.
    pictures = (ROOT / "python/breast/figures/of_run.py").read_text(encoding="utf-8")
    made |= {f"{name}.png" for name in re.findall(r'RunPicture\("([\w-]+)"', pictures)}
    made |= {file.name for file in (ROOT / "pipelines").rglob("*")}
    # cc2mlo writes NAME-summary.tsv beside its table NAME.tsv.
    made |= {f"{name[:-4]}-summary.tsv" for name in made if name.endswith(".tsv")}
    missing = {(name, file) for name, file in named() if name.split("/")[-1] not in made and not (ROOT / name).exists()}
    missing |= {(name, file) for name, file in folders_named() if not any(path.startswith(name) for path in below)}
    for name, file in sorted(missing):
        print(f"{file} names {name}, which no rule and no program makes")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]) if len(sys.argv) == 2 else __doc__)
