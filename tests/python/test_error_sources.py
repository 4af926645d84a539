# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tables of the validation pages say together."""
import dataclasses
import shutil
import unittest

import numpy as np
import small_run
from breast.errors import BreastError
from breast.lookup import read_lookup
from breast.study.table import read_table
from breast_validation.error_sources import error_sources, methods_cost
from breast_validation.lookup_cost import interpolated_error
from in_folder import InFolder

TABLES = small_run.source / "docs/tables"


class Gathered(InFolder):
    def test_the_tables_of_the_page_are_those_of_the_other_pages(self):
        """If this fails after a table was made again: make -f Makefile.pipeline errors-page."""
        for name, make in (("error-sources", error_sources), ("methods-cost", methods_cost)):
            self.assertEqual(make(TABLES).text(), (TABLES / f"{name}.tsv").read_text(encoding="utf-8"), name)

    def test_values_are_those_of_the_rows_that_are_named(self):
        rows = {(row["source"], row["shape"]): row for row in error_sources(TABLES)}
        friction = next(row for row in read_table(TABLES / "friction.tsv") if (row["view"], row["variant"]) == ("MLO", "friction-0.2"))
        row = rows["friction 0.2 instead of 0.3", "MLO"]
        self.assertEqual((float(row["mm"]), row["of"], row["table"]), (float(friction["tumour_mm"]), "tumour", "friction"))
        cost = [row for row in methods_cost(TABLES) if row["method"] == "stiffness identified, wrong law"]
        self.assertEqual([row["elements"] for row in cost], ["648", "1068", "1984", "4340"])
        self.assertEqual((cost[0]["cpu_s"], cost[0]["error_mm"]), ("5.22", "1.34"))  # (6+6+4.3+4.6)/4, (1.57+1.86+1.03+.91)/4

    def test_a_source_that_its_table_lacks_is_named(self):
        shutil.copytree(TABLES, self.folder / "tables")
        file = self.folder / "tables/truth.tsv"
        file.write_text(file.read_text().replace("true-tumour", "cyst"))
        with self.assertRaisesRegex(BreastError, "truth.tsv: has no value of .* for 'chain, wall held"):
            error_sources(self.folder / "tables")

    def test_what_a_lookup_loses_between_its_nodes(self):
        """Of curves that change linearly with the point nothing, of a square half the step squared at most; nodes are left out."""
        exact = read_lookup(small_run.folder() / "lookup.h5")
        nv, nu, samples = 9, 13, 5
        v, u, _ = np.meshgrid(np.arange(nv), np.arange(nu), np.arange(samples), indexing="ij")
        status = np.ones((nv, nu), int)

        def of(curve, pitch=1.0, step=1):
            return dataclasses.replace(exact, pitch_mm=pitch, status=status[::step, ::step], curve_mm=curve[::step, ::step])
        flat = np.stack([2.0 * u - v, 3.0 * v], -1)
        self.assertLess(interpolated_error(of(flat, 4.0, 4), of(flat)).max(), 1e-12)
        bent = np.stack([1.0 * u**2, 0.0 * v], -1)
        found = interpolated_error(of(bent, 2.0, 2), of(bent))
        self.assertEqual((found.max(), found.min()), (1.0, 0.0))
        self.assertEqual(len(found), 8 * 12 - 4 * 6)
        with self.assertRaisesRegex(BreastError, "has a pitch of 1.5 mm in CC, must be a multiple"):
            interpolated_error(of(flat, 1.5), of(flat))


if __name__ == "__main__":
    unittest.main()
