# SPDX-License-Identifier: GPL-3.0-or-later
"""The lines of a run in the terminal: whoever reads one knows of which stage it is, also where several stages run the same program."""
import re
import shlex
import unittest
from collections import defaultdict
from pathlib import Path

import small_run
from breast.cases.stage import label_of

EVERYTHING = ("PRESET=paper", "SUPINE=phantom", "MAMMOGRAMS=scan.nrrd,t1.nrrd", "all", "states", "slicer", "truth", "budget")


def stages_of(plan: str) -> list[tuple[Path, str]]:
    """The record and the label of every stage that a plan of make runs."""
    stages = []
    for line in re.findall(r"/cases stage (.*)", plan.replace("\\\n", " ")):
        words = shlex.split(line.replace("$((", "").replace("$(", ""))
        at = words.index("--")
        record, prints = Path(words[0]), words[words.index("--prints", 0, at) + 1] if "--prints" in words[:at] else ""
        stage = record.name.removeprefix(".").removesuffix(".settings")
        stages.append((record, label_of(stage, str(record.parent), words[at + 1:], Path(prints) if prints else None)))
    return stages


class Labels(unittest.TestCase):
    def test_of_the_chain_are_program_and_view(self):
        for stage, words, label in (("reference", "bin/backward a b", "backward"), ("cc", "bin/compress a b --view CC", "compress CC"),
                                    ("mlo-mammogram", "bin/project-mammogram a b", "project-mammogram MLO")):
            self.assertEqual(label_of(stage, "runs/a", words.split()), label)

    def test_beside_the_chain_say_which_stage(self):
        for stage, words, label in (("cut-fixed", "bin/backward a b", "backward (cut-fixed)"),
                                    ("supine-cut-fixed", "bin/forward a b", "forward (supine-cut-fixed)"),
                                    ("cc-states", "bin/compress a b --view CC", "compress CC (cc-states)"),
                                    ("cc-sensitivity", "bin/sensitivity a b", "sensitivity CC"), ("lookup", "bin/match-lookup a", "match-lookup")):
            self.assertEqual(label_of(stage, "runs/a", words.split()), label)
        self.assertEqual(label_of("cut", "runs/a", ["bin/probe"], Path("runs/a/cut.tsv")), "probe cut.tsv")
        self.assertEqual(label_of("cut-fixed", "runs/a/studies/s/softer", ["bin/backward"]), "s/softer: backward (cut-fixed)")

    def test_no_two_stages_of_a_run_share_one(self):
        clone = small_run.planning_folder("labels")
        planned = small_run.run_in(clone, ["make", "-n", "-f", "Makefile.pipeline", "MAKE=true", *EVERYTHING])
        self.assertEqual(planned.returncode, 0, planned.stderr)
        records = defaultdict(set)
        for record, label in stages_of(planned.stdout):
            records[label].add(record)
        self.assertGreater(len(records), 40)
        self.assertEqual({label: sorted(of) for label, of in records.items() if len(of) > 1}, {})


if __name__ == "__main__":
    unittest.main()
