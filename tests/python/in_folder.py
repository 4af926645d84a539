# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests share that work on files: a folder of their own, why something is refused, and texts that make or a shell reads as code."""
import contextlib
import tempfile
import unittest
from pathlib import Path

from breast.errors import BreastError

CODE = ("$(shell x)", "`x`", "a;b", "a'b", "a#b", "a\\b", "a|b")


def reason(work, *arguments):
    """The message with which a call is refused; "" if it is not."""
    try:
        work(*arguments)
    except BreastError as error:
        return str(error)
    return ""


class InFolder(unittest.TestCase):
    def setUp(self) -> None:
        work = tempfile.TemporaryDirectory()
        self.addCleanup(work.cleanup)
        self.folder = Path(work.name)


class StandingInFolder(InFolder):
    """With that folder as the current one, so that what else lies where the tests are started has no part in them."""

    def setUp(self) -> None:
        super().setUp()
        self.enterContext(contextlib.chdir(self.folder))
