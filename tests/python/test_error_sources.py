# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tables of the validation pages say together."""
import shutil
import unittest

import small_run
from breast.errors import BreastError
from breast_validation.error_sources import error_sources, methods_cost
from in_folder import InFolder

TABLES = small_run.source / "docs/tables"


class Gathered(InFolder):
    def test_the_tables_of_the_page_are_those_of_the_other_pages(self):
        """If this fails after a table was made again: make -f Makefile.pipeline errors-page."""
        for name, make in (("error-sources", error_sources), ("methods-cost", methods_cost)):
            self.assertEqual(make(TABLES).text(), (TABLES / f"{name}.tsv").read_text(encoding="utf-8"), name)

    def test_values_are_those_of_the_rows_that_are_named(self):
        rows = {(row["source"], row["shape"]): row for row in error_sources(TABLES)}
        row = rows["friction 0.1 instead of 0.15", "MLO"]
        self.assertEqual((row["mm"], row["of"], row["table"]), ("4.65", "tumour", "compression-friction"))
        cost = [row for row in methods_cost(TABLES) if row["method"] == "stiffness identified, wrong law"]
        self.assertEqual([row["elements"] for row in cost], ["648", "1068", "1984", "4340"])
        self.assertEqual((cost[0]["cpu_s"], cost[0]["error_mm"]), ("5.22", "1.34"))  # (6+6+4.3+4.6)/4, (1.57+1.86+1.03+.91)/4

    def test_a_source_that_its_table_lacks_is_named(self):
        shutil.copytree(TABLES, self.folder / "tables")
        file = self.folder / "tables/truth.tsv"
        file.write_text(file.read_text().replace("true-tumour", "cyst"))
        with self.assertRaisesRegex(BreastError, "truth.tsv: has no value of .* for 'chain, wall held"):
            error_sources(self.folder / "tables")


if __name__ == "__main__":
    unittest.main()
