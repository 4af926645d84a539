# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a case belongs to one make at a time, unless another has the same settings.

RUN/.running/PID states with which settings that process makes the case: digests, because a run may be sent to somebody. A process that
has ended, or whose number another process has now, claims nothing.
"""
from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Collection, Mapping
from pathlib import Path

from ..errors import BreastError
from ..output import write_text


def _parent_and_start(pid: int) -> tuple[int, int]:
    """The parent of a process and when it started, in clock ticks since boot. Raises OSError if there is no such process."""
    with open(f"/proc/{pid}/stat", "rb") as file:
        fields = file.read().rpartition(b")")[2].split()
    return int(fields[1]), int(fields[19])


def _ancestors(pid: int) -> set[int]:
    found = set()
    while pid > 1 and pid not in found:
        found.add(pid)
        pid = _parent_and_start(pid)[0]
    return found


def _others(folder: Path, pid: int) -> list[tuple[int, dict]]:
    """The claims of other processes that live; those of processes that have ended are removed."""
    found = []
    for file in folder.iterdir():
        if not file.name.isdigit() or int(file.name) == pid:
            continue
        try:
            claim = json.loads(file.read_text(encoding="utf-8"))
            if _parent_and_start(int(file.name))[1] == claim["started"]:
                found.append((int(file.name), claim))
                continue
        except (OSError, ValueError, KeyError):
            pass
        file.unlink(missing_ok=True)
    return found


def claim_run(run: Path, pid: int, settings: Mapping[str, str], following: Collection[str] = ()) -> None:
    """Claims the folder RUN for the make `pid` and its children.

    Raises BreastError, naming the settings that differ, if another process makes the case with other settings; the names in `following`,
    whose values follow from others, only if no other differs. Of two that begin at once, the one that started first goes on.
    """
    digests = {name: hashlib.sha256(os.fsencode(value)).hexdigest()[:12] for name, value in settings.items()}
    started = _parent_and_start(pid)[1]
    folder = run / ".running"
    folder.mkdir(parents=True, exist_ok=True)
    write_text(folder / str(pid), json.dumps({"started": started, "settings": digests}))
    family = _ancestors(pid)
    for other, claim in _others(folder, pid):
        if other in family or (claim["started"], other) > (started, pid):
            continue
        differ = sorted(name for name in digests if claim["settings"].get(name) != digests[name])
        if differ:
            (folder / str(pid)).unlink(missing_ok=True)
            differ = [name for name in differ if name not in following] or differ
            shown = ", ".join(f"{name}={settings[name]}" for name in differ)
            raise BreastError(f"{run} is being made by process {other}, and there {' '.join(differ)} "
                              f"{'is' if len(differ) == 1 else 'are'} not {shown}; wait until it has ended, or give another folder with "
                              "CASE=NAME")
