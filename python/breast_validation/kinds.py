# SPDX-License-Identifier: GPL-3.0-or-later
"""All kinds of `tabulate` of this package."""
from . import truth, documents, draws, error_sources, expected, lookup_cost, plates, same_scan, solves  # noqa: F401
