# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `breast`, and what all programs in Python have in common: options, help, reports, exit codes."""
