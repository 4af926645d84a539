# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables, verdicts and pages of finished runs: the program `tabulate`.

A module a subject; each declares with @kind the tables that it makes. Cells are text, as they are printed. No module here imports
numpy, h5py or jinja2 before it needs them.
"""
