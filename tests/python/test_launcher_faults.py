# SPDX-License-Identifier: GPL-3.0-or-later
"""The programs in Python on files that are gone, cut, or something else, and on full disks: a result, or one line that says what is wrong."""
import contextlib
import importlib
import os
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import traceback
import unittest
from pathlib import Path

import small_run
from in_folder import StandingInFolder

# What is called, and the module of the program's main(); RUN is a run, OTHER another one.
CALLS = (("breast.study.tabulate", "tabulate summary RUN"),
         ("breast.study.tabulate", "tabulate page RUN RUN/small-scan.nrrd 0"),
         ("breast.study.compare", "compare RUN OTHER"))
DAMAGE = {"gone": lambda data: None, "cut": lambda data: data[:len(data) // 2], "other": lambda data: b"\0\xff{]<other" * 20}
PIPELINES = small_run.source / "pipelines"


def in_a_child(work):
    """(exit code, stdout, stderr, files opened) of a function that returns an exit code."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err, tempfile.TemporaryFile() as opened:
        child = os.fork()
        if child == 0:
            os.dup2(out.fileno(), 1)
            os.dup2(err.fileno(), 2)
            sys.addaudithook(lambda event, given: os.write(opened.fileno(), os.fsencode(given[0]) + b"\n")
                             if event == "open" and isinstance(given[0], (str, bytes, os.PathLike)) else None)
            try:
                code = work()
            except SystemExit as end:
                code = end.code or 0
            except BaseException:
                traceback.print_exc()
                code = 99
            with contextlib.suppress(OSError):
                sys.stdout.flush()
            os._exit(code)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = [(file.seek(0), file.read())[1] for file in (out, err, opened)]
        return code, texts[0], texts[1].decode(), set(filter(None, os.fsdecode(texts[2]).split("\n")))


class Faults(StandingInFolder):
    def setUp(self):
        super().setUp()
        for name in ("RUN", "OTHER"):
            shutil.copytree(small_run.folder(), name)

    def call(self, module, line):
        main = importlib.import_module(module).main
        name, *words = line.split()
        if name == "tabulate":
            words += ["--pipelines", str(PIPELINES)]

        def work():
            sys.argv = [str(small_run.programs / name), *words, "--quiet"]
            return main()
        return in_a_child(work)

    def test_inputs(self):
        for module, line in CALLS:
            code, out, said, opened = self.call(module, line)
            self.assertEqual((code, said), (0, ""), line)
            files = sorted(file for file in map(Path, opened) if file.is_file() and (self.folder / file).is_relative_to(self.folder / "RUN"))
            self.assertGreater(len(files), 4, line)
            for file in files:
                content = file.read_bytes()
                for damage, made in DAMAGE.items():
                    file.unlink()
                    data = made(content)
                    if data is not None:
                        file.write_bytes(data)
                    with self.subTest(call=line, file=str(file), damage=damage):
                        code, out, said, _ = self.call(module, line)
                        self.assertIn(code, (0, 1, 2), said)
                        self.assertEqual((said.count("\n"), out), (1, b"") if code else (0, out), said)
                    file.write_bytes(content)

    def test_full_disks(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64))

        def full(line, *words):
            name, *more = line.split()
            ended = subprocess.run([small_run.programs / name, *more, *words, "--quiet"], capture_output=True, text=True,
                                   preexec_fn=small_files)
            self.assertEqual((ended.returncode, ended.stderr.count("\n")), (1, 1), ended.stderr)
            return ended.stderr
        self.assertIn("difference", full("compare RUN OTHER --out difference"))
        self.assertFalse(Path("difference").exists(), "nothing is left of what could not be written")
        Path("a.case").write_text("MR = RUN/small-scan.nrrd\nSIDE = left\nSEGMENT_OPTIONS = --quiet\n")
        self.assertIn("made/", full("cases case-file", PIPELINES, "a.case", "made"))
        self.assertEqual(list(Path("made").iterdir()), [])
        ended = subprocess.run([small_run.programs / "cases", "stage", "RUN/.mesh.settings", "settings", "--quiet", "--", "/bin/echo", "x" * 100],
                               capture_output=True, text=True, preexec_fn=small_files)
        self.assertEqual((ended.returncode, ended.stderr), (1, "cases: RUN/log.txt: could not be written: File too large\n"))
        self.assertFalse(Path("RUN/.mesh.settings").exists(), "the stage is run again")


if __name__ == "__main__":
    unittest.main()
