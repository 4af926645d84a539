# SPDX-License-Identifier: GPL-3.0-or-later
"""A private X display: the packaged VTK 9.1 draws only through X and aborts without a display."""
from __future__ import annotations

import os
import select
import shutil
import subprocess
import tempfile
from glob import glob
from types import TracebackType

from ..command.child import beginning
from ..errors import Failed

_START_SECONDS = 30
_PACKAGES = "install the Debian packages xvfb xauth libgl1-mesa-dri"


class PrivateDisplay:
    """Xvfb on a free display number for the length of a `with`, whatever DISPLAY was before.

    Pictures are then the same on a desktop, over ssh and in a container, and several programs can draw at the same time. The
    server ends with the block, and also when the process is killed. Raises Failed naming the Debian packages when Xvfb or the
    software OpenGL driver is missing, or with Xvfb's own words when it does not start within 30 s.
    """

    def __enter__(self) -> PrivateDisplay:
        _check_installed()
        reading, writing = os.pipe()
        with tempfile.TemporaryFile() as words:
            command = ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24", "-nolisten", "tcp", "-noreset"]
            self._server = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=words, stderr=words, pass_fds=[writing],
                                            preexec_fn=beginning())
            os.close(writing)
            number = _read_number(reading)
            os.close(reading)
            if not number:
                self.__exit__(None, None, None)
                words.seek(0)
                said = words.read().decode("utf-8", "replace").strip().rpartition("\n")[2] or "no message"
                raise Failed(f"Xvfb did not start ({said}); {_PACKAGES}")
        os.environ |= {"DISPLAY": f":{number}", "LIBGL_ALWAYS_SOFTWARE": "1"}
        os.environ.pop("XAUTHORITY", None)
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._server.terminate()
        self._server.wait()


def _check_installed() -> None:
    if shutil.which("Xvfb") is None:
        raise Failed(f"render needs the X server Xvfb, which is not installed: {_PACKAGES}")
    places = ("/usr/lib/*/dri", "/usr/lib/dri", "/usr/local/lib/*/dri", "/usr/local/lib/dri")
    if "LIBGL_DRIVERS_PATH" not in os.environ and not any(glob(f"{place}/swrast_dri.so") for place in places):
        raise Failed(f"render needs the software OpenGL driver: {_PACKAGES}")


def _read_number(descriptor: int) -> str:
    """The display number that Xvfb writes when it is ready; empty when it ended or did not answer in time."""
    text = b""
    while not text.endswith(b"\n"):
        ready, _, _ = select.select([descriptor], [], [], _START_SECONDS)
        part = os.read(descriptor, 16) if ready else b""
        if not part:
            return ""
        text += part
    return text.decode().strip()
