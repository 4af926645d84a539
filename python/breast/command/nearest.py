# SPDX-License-Identifier: GPL-3.0-or-later
"""The name that was probably meant."""
from __future__ import annotations

from collections.abc import Iterable


def _distance(a: bytes, b: bytes) -> int:
    """Levenshtein's edit distance."""
    row = list(range(len(b) + 1))
    for i, x in enumerate(a):
        diagonal, row[0] = row[0], i + 1
        for j, y in enumerate(b):
            diagonal, row[j + 1] = row[j + 1], min(row[j + 1] + 1, row[j] + 1, diagonal + (x != y))
    return row[-1]


def nearest(given: str, candidates: Iterable[str]) -> str:
    """The candidate with the smallest edit distance if that is small enough for a slip, otherwise ""."""
    word = given.encode(errors="surrogateescape")
    best, least = "", max(2, len(word) // 3) + 1
    for candidate in candidates:
        # An abbreviation is a slip too: "--post" for "--posture".
        short = len(word) >= 4 and candidate.startswith(given)
        distance = 1 if short else _distance(word, candidate.encode(errors="surrogateescape"))
        if distance < least:
            best, least = candidate, distance
    return best


def suggestion(word: str, candidates: Iterable[str]) -> str:
    """"; did you mean X?", or "" if no candidate is near; upper and lower case are not told apart."""
    raised = {candidate.upper(): candidate for candidate in reversed(list(candidates))}
    near = nearest(word.upper(), reversed(raised))
    return f"; did you mean {raised[near]}?" if near else ""
