# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the validation pages and of the checks in tests/, and the upkeep of those pages: kinds of `tabulate` in the source tree alone.

An installation has none of this. A module a subject, as in breast.study, whose tables and numbers it uses.
"""
from . import truth, documents, draws, error_sources, same_scan, solves  # noqa: F401
