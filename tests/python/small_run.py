# SPDX-License-Identifier: GPL-3.0-or-later
"""Small runs made by the programs once for all tests: the kept scan through the whole chain, and the pipeline's demonstration."""
import functools
import os
import pathlib
import shutil
import subprocess
import tempfile
from collections.abc import Iterable

programs: pathlib.Path = pathlib.Path("build/release/bin")  # run_tests.py says which
source = pathlib.Path(__file__).resolve().parent.parent.parent

_STAGES = """\
segment small-scan.nrrd labels.vtkhdf --side left --points points.vtp --report labels.json
fit-hermite labels.vtkhdf geometry.vtkhdf --report geometry.json
hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --elements 6 --report mesh.json
backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --report reference.json
forward reference.vtkhdf supine.vtkhdf --report supine.json
compress reference.vtkhdf cc.vtkhdf --view CC --reduction 30 --at-least 20 --report cc.json
compress reference.vtkhdf mlo.vtkhdf --view MLO --reduction 30 --at-least 20 --report mlo.json
project-mammogram cc.vtkhdf cc.vti --labels labels.vtkhdf --png cc.png --pixel 1 --report cc-mammogram.json
project-mammogram mlo.vtkhdf mlo.vti --labels labels.vtkhdf --png mlo.png --pixel 1 --report mlo-mammogram.json
cc2mlo cc.vtkhdf mlo.vtkhdf curve.vtp --landmark tumour --table curve.tsv --report curve.json
match-lookup cc.vtkhdf mlo.vtkhdf lookup.h5 --pitch 5 --both-ways"""


def tool(line: str, folder: pathlib.Path) -> str:
    """stdout of "program arguments", run in the folder."""
    name, *arguments = line.split()
    done = subprocess.run([programs / name, *arguments, "--quiet"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{line}: exit {done.returncode}: {done.stderr}")
    return done.stdout


@functools.lru_cache(maxsize=None)
def _work() -> pathlib.Path:
    return pathlib.Path(tempfile.mkdtemp(prefix="breast-python-"))


@functools.lru_cache(maxsize=None)
def folder() -> pathlib.Path:
    """The run's folder; nothing in it may be changed."""
    run = _work() / "runs" / "average"
    run.mkdir(parents=True)
    shutil.copy(source / "testdata" / "small-scan.nrrd", run)
    for line in _STAGES.splitlines():
        tool(line, run)
    table = tool("probe mesh.vtkhdf reference.vtkhdf supine.vtkhdf cc.vtkhdf mlo.vtkhdf", run)
    (run / "displacements.tsv").write_text(table)
    return run


_COARSE = ("PRESET=average", "PHANTOM_OPTIONS=--coarse 2", "ELEMENTS=6")


@functools.lru_cache(maxsize=None)
def demo() -> pathlib.Path:
    """The folder of the demonstration, with the pipeline's defaults but coarser; nothing in it may be changed.

    BREAST_RUN in the environment names a finished one instead.
    """
    if os.environ.get("BREAST_RUN"):
        return pathlib.Path(os.environ["BREAST_RUN"]).resolve()
    runs = _work() / "demo"
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
    environment["INSTALLED"] = str(programs)
    done = subprocess.run(["make", "-f", "Makefile.pipeline", f"RUNS={runs}", *_COARSE, "chain"], cwd=source, env=environment,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"the demonstration: exit {done.returncode}: {done.stderr[-2000:]}")
    return runs / "average"


@functools.lru_cache(maxsize=None)
def swept() -> pathlib.Path:
    """The files of the demonstration with a compression between nodes and the derivatives of two compressions."""
    run = _work() / "swept"
    run.mkdir()
    for file in demo().iterdir():
        if file.is_file():
            shutil.copy(file, run)
    tool("match-lookup cc.vtkhdf mlo.vtkhdf lookup.h5 --pitch 40 --both-ways", run)
    tool("compress reference.vtkhdf nodes.vtkhdf --view CC --reduction 5 --at-least 1 --standoff 10", run)
    for view in ("cc", "mlo"):
        tool(f"sensitivity reference.vtkhdf {view}.vtkhdf {view}-slopes.vtkhdf --parameters main", run)
    return run


@functools.lru_cache(maxsize=None)
def quadratic() -> pathlib.Path:
    """A folder with a mesh of 27-node elements of the same body, stress-free and supine."""
    run = _work() / "quadratic"
    run.mkdir()
    first = folder()
    tool(f"hexmesh {first}/geometry.vtkhdf {first}/labels.vtkhdf mesh.vtkhdf --elements 5 --order 2", run)
    tool("backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --element q2p1", run)
    tool("forward reference.vtkhdf supine.vtkhdf", run)
    return run


def scratch(name: str) -> pathlib.Path:
    """An empty folder of one test."""
    made = _work() / "scratch" / name
    shutil.rmtree(made, ignore_errors=True)
    made.mkdir(parents=True)
    return made


def link_to(folder: pathlib.Path, files: Iterable[pathlib.Path]) -> None:
    """A link in the folder to each of the files."""
    for file in files:
        (folder / file.name).symlink_to(file)


def planning_folder(name: str) -> pathlib.Path:
    """A folder like a clone of the project whose programs are built, with scans, case files and studies beside it: make plans there."""
    clone, scan = scratch(name), source / "testdata/small-scan.nrrd"
    linked = ("Makefile.pipeline", "CMakeLists.txt", "CMakePresets.json", "libbreast", "tools", "python", "cmake", "docs", "tests")
    link_to(clone, (source / one for one in linked))
    (clone / "pipelines").mkdir()  # without installed.mk, which names the programs of another build
    link_to(clone / "pipelines", (file for file in (source / "pipelines").iterdir() if file.name != "installed.mk"))
    (clone / "build/release").mkdir(parents=True)
    (clone / "build/release/bin").symlink_to(programs)
    for one in ("scan.nrrd", "t1tse.nrrd", "phantomA_mr_t1.nrrd", "corrected.seg.nrrd", "fat.nrrd", "t1.nrrd"):
        (clone / one).symlink_to(scan)
    (clone / "patients").mkdir()
    (clone / "patients/anna.case").write_text("MR = scan.nrrd\nSIDE = left\n", encoding="utf-8")
    for one in ("mine.tsv", "softer.tsv"):
        (clone / one).write_text("variant\tstarts_at\tmechanics\nsofter\treference\t+--scale fat=50\n", encoding="utf-8")
    return clone


def run_in(place: pathlib.Path, words: list[str]) -> subprocess.CompletedProcess[str]:
    """Runs a command; `breast` takes the programs of this build, and builds none."""
    environment = {name: value for name, value in os.environ.items() if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL", "INSTALLED")}
    environment["PATH"] = f"{programs}:{environment['PATH']}"
    if words[0] == "breast":
        environment["INSTALLED"] = str(programs)
    return subprocess.run(words, cwd=place, env=environment, capture_output=True, text=True)


def remove() -> None:
    """Removes everything; KEEP=1 in the environment leaves it and says where."""
    if not _work.cache_info().currsize:
        return
    if os.environ.get("KEEP"):
        print(f"kept: {_work()}")
    else:
        shutil.rmtree(_work())
