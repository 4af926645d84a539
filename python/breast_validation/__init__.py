# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the validation pages and of the checks in tests/, and the upkeep of those pages: kinds of `tabulate` and
figures of `render` in the source tree alone.

An installation has none of this. A module a subject, as in breast.study and breast.figures, which it uses.
"""
