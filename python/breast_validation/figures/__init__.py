# SPDX-License-Identifier: GPL-3.0-or-later
"""Charts of the tables of this package: a module each, as in breast.figures."""
SUMMARIES = {
    "budget": "what is left of the errors when one stage is replaced by the truth (from the .tsv of tabulate budget; in the source tree)",
    "error-sources": "what moves a predicted place by how many mm (from the .tsv of tabulate error-sources; in the source tree)",
    "methods-cost": "error against CPU time over all methods (from the .tsv of tabulate methods-cost; in the source tree)",
}
