# SPDX-License-Identifier: GPL-3.0-or-later
"""Cases: their settings and files, cohorts of them, jobs of a cluster, and the variants of a study."""
