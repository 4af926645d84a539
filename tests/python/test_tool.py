# SPDX-License-Identifier: GPL-3.0-or-later
"""What all programs in Python have in common: options, refusals, reports, exit codes."""
import contextlib
import io
import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

from breast.command.declaration import help_completion, help_text
from breast.command.nearest import nearest, suggestion
from breast.command.tool import Tool
from breast.errors import BreastError, Failed, NotConverged
from breast.output import write_text, written_by_us
from in_folder import StandingInFolder

ROOT = Path(__file__).resolve().parents[2]
PYTHON = ROOT / "python"
sys.path.insert(0, str(ROOT / "tests/tools"))
from help_pages import manual, markdown, parse_help  # noqa: E402


def example():
    tool = Tool("example", "shows options")
    tool.describe("Does | nothing.")
    tool.word("IN.tsv", "table", "input")
    tool.integer("-f,--factor", "factor", 2, 1, 95)
    tool.choice("--element", ("q1p0", "q2p1"), "element", "q1p0")
    tool.integer("--cores", "cores", 1, 1, 8)
    tool.text("--with", "NAME", "more")
    tool.text("--gravity", "X,Y,Z", "direction", "0,0,0.5")
    tool.flag("--all", "everything")
    tool.output_file("-o,--output", "OUT.tsv", "result")
    tool.example("example in.tsv", "runs it")
    return tool


class Programs(StandingInFolder):
    def setUp(self):
        super().setUp()
        Path("in.tsv").write_text("a\tb\n")

    def run_tool(self, *words, body=lambda run: None):
        """(exit code, stderr) of the example in this process."""
        tool = example()
        reading, writing = os.pipe()
        kept = os.dup(2)
        os.dup2(writing, 2)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                code = tool.main(body, words)
        finally:
            os.dup2(kept, 2)
            os.close(writing)
        with os.fdopen(reading, encoding="utf-8") as pipe:
            return code, pipe.read(), tool.args

    def test_values(self):
        code, said, args = self.run_tool("in.tsv", "-f", "3", "--element=q2p1", "--with=b", "--gravity", "-1,0,2", "--all")
        self.assertEqual((code, said), (0, ""))
        self.assertEqual((getattr(args, "in"), args.factor, args.element, args.cores),
                         ("in.tsv", 3, "q2p1", 1))
        self.assertEqual((args.gravity, getattr(args, "with"), args.all), ("-1,0,2", "b", True))

    def test_refusals_are_one_line(self):
        for words, said in [
                (["in.tsv", "--facto", "3"], "unknown option '--facto'; did you mean '--factor'?"),
                (["in.tsv", "--xyzzy"], "unknown option '--xyzzy'; see example --help-all"),
                (["in.tsv", "--factor", "96"], "--factor 96: must be 1 to 95"),
                (["in.tsv", "--factor", "nan"], "--factor: 'nan' is not a finite number"),
                (["in.tsv", "--cores", "1.5"], "--cores: '1.5' is not a whole number"),
                (["in.tsv", "--element", "q1"], "--element: 'q1' is none of q1p0, q2p1; did you mean 'q1p0'?"),
                (["in.tsv", "--factor", "2", "--factor", "3"], "--factor is given 2 times; give it once"),
                (["in.tsv", "--output"], "--output needs a value; usage: example IN.tsv [options]"),
                (["in.tsv", "more"], "'more' is one argument too many; usage: example IN.tsv [options]"),
                ([], "IN.tsv is missing; usage: example IN.tsv [options]"),
                (["none.tsv"], "IN.tsv: none.tsv does not exist"),
                (["x/mesh.vtkhdf"], "IN.tsv: x/mesh.vtkhdf does not exist; `hexmesh` makes it"),
                (["in.tsv", "-o", "in.tsv"], "--output: in.tsv is also the input IN.tsv; give another output"),
                (["in.tsv", "-o", "out.txt"], "--output: out.txt: the name must end with .tsv, which states its format"),
                (["in.tsv", "-o", "no/out.tsv"], "--output: folder no does not exist; make it first")]:
            self.assertEqual(self.run_tool(*words)[:2], (2, f"example: {said}\n"), words)

    def test_foreign_files_are_not_replaced(self):
        Path("mine.tsv").write_text("x\n")
        code, said, _ = self.run_tool("in.tsv", "-o", "mine.tsv")
        self.assertEqual(code, 2)
        self.assertIn("does not look like a result of libbreast", said)
        write_text("ours.tsv", "a\n1\n\r\n")
        self.assertTrue(written_by_us("ours.tsv"))
        self.assertEqual(self.run_tool("in.tsv", "-o", "ours.tsv")[0], 0)

    def test_ends(self):
        def ends(error):
            def body(run):
                raise error
            return self.run_tool("in.tsv", "--report", "r.json", body=body)[:2]
        for error, code, status in ((Failed("disk"), 1, "failed"), (NotConverged("folds"), 3, "not_converged"),
                                    (BreastError("bad\nbytes\x1b"), 2, "bad_input"), (MemoryError(), 1, "failed")):
            self.assertEqual(ends(error)[0], code)
            self.assertEqual(json.loads(Path("r.json").read_text())["status"], status)
        self.assertEqual(ends(BreastError("bad\nbytes\x1b"))[1], "example: bad bytes?\n")

    def test_reports(self):
        code, _, _ = self.run_tool("./in.tsv", "--threads", "2", "--element", "q2p1", "--report", "r.json")
        report = json.loads(Path("r.json").read_text())
        self.assertEqual((code, report["tool"], report["inputs"], report["status"]), (0, "example", ["in.tsv"], "ok"))
        self.assertEqual(report["command"], "example in.tsv --element q2p1")
        self.assertEqual(self.run_tool("in.tsv", "--no-such", "--report", "in.tsv")[0], 2)
        self.assertEqual(Path("in.tsv").read_text(), "a\tb\n")

    def test_pages(self):
        tool = example()
        self.assertIn("  -f, --factor N\n      factor (1 to 95; default: 2)\n", help_text(tool))
        self.assertIn("  --gravity X,Y,Z\n      direction (default: 0,0,0.5)\n", help_text(tool))
        page = parse_help(help_text(tool, everything=True))
        self.assertIn("| `--element q1p0\\|q2p1` | element (default: q1p0) |", markdown(page))
        self.assertIn("\nDoes \\| nothing.\n", markdown(page))
        self.assertIn(".B \\-o, \\-\\-output OUT.tsv\nresult\n", manual(page, "1"))
        self.assertIn("--element\tvalue\tq1p0 q2p1\n", help_completion(tool))
        self.assertIn("--output\tfile\t\n", help_completion(tool))

    def test_short_help_has_the_options_and_full_help_everything(self):
        tool = example()
        tool.describe("More about nothing.")
        tool.cite("Nobody 2026")
        small = help_text(tool)
        self.assertIn("\nOptions:\n  -f, --factor N\n", small)
        self.assertNotIn("More about nothing.", small)
        self.assertTrue(small.endswith("\n\nexample --help-all also explains the common options and the exit codes\n"), small)
        whole = help_text(tool, everything=True)
        page = parse_help(whole)
        man, cells = manual(page, "1").replace("\\-", "-"), markdown(page).replace("\\|", "|")
        for option in tool.options + tool.common:
            usage = option.usage()
            for page, line in ((whole, f"\n  {usage}\n"), (man, f"\n.B {usage}\n"), (cells, f"| `{usage}` |")):
                self.assertEqual(page.count(line), 1, line)
        for page in (whole, man, cells):
            for part in ("More about nothing.", "Nobody 2026"):
                self.assertIn(part, page)


class Names(unittest.TestCase):
    def test_slips(self):
        self.assertEqual(nearest("segmnt", ["forward", "segment"]), "segment")
        self.assertEqual(nearest("--post", ["--posture", "--pose"]), "--posture")
        self.assertEqual(nearest("xyzzy", ["forward", "segment"]), "")
        self.assertEqual(suggestion("sides", ["MR", "SIDE"]), "; did you mean SIDE?")


class StartUp(unittest.TestCase):
    def test_nothing_large_is_imported_that_is_not_used(self):
        heavy = "numpy", "h5py", "pandas", "matplotlib", "vtkmodules", "jinja2"
        script = f"import sys, breast.command.tool; print(*[m for m in {heavy} if m in sys.modules])"
        said = subprocess.run([sys.executable, "-B", "-c", script], env={"PYTHONPATH": str(PYTHON)}, capture_output=True, text=True)
        self.assertEqual((said.stdout.strip(), said.stderr), ("", ""))


if __name__ == "__main__":
    unittest.main()
