# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a run for those who read mammograms: where a place in one view lies in the other, as one HTML file."""
