#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""run_tests.py PROGRAM_FOLDER [TEST]...: the tests of python/breast on results of these programs; exit 77 where h5py is missing."""
import pathlib
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
try:
    import h5py  # noqa: F401
except ImportError:
    print("skipped: python3-h5py is not installed (apt-get install python3-h5py)")
    sys.exit(77)
if len(sys.argv) < 2:
    sys.exit(__doc__)
sys.path[:0] = [str(HERE), str(HERE.parent.parent / "python")]
import small_run  # noqa: E402

small_run.programs = pathlib.Path(sys.argv[1]).resolve()
sys.argv[0] = str(small_run.programs / "tabulate")  # what programs are beside
loader = unittest.TestLoader()
suite = loader.loadTestsFromNames(sys.argv[2:]) if sys.argv[2:] else loader.discover(str(HERE))
passed = unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful()
small_run.remove()
sys.exit(0 if passed else 1)
