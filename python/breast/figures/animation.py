# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures that follow one another: an animated PNG, which browsers show without a script."""
from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from PIL import Image

from .colours import Colour
from .layout import Picture, mark

_COLOURS = 192
_STEP, _FIRST, _LAST = 220, 900, 1800
"""How long a picture is shown, and the first and the last of a round, ms."""


@dataclass
class Animation:
    """Pictures of one size, in their order. lines: colours of what is thin, which stay as they are."""

    pictures: Iterable[Picture]
    lines: Sequence[Colour] = ()

    def png(self) -> bytes:
        """An endless round of the pictures, all in the colours of the last and the first, marked as a file of libbreast."""
        frames = [Image.fromarray(picture.pixels()) for picture in self.pictures]
        both = Image.new("RGB", (frames[0].width, 2 * frames[0].height))
        both.paste(frames[0], (0, 0))
        both.paste(frames[-1], (0, frames[0].height))
        palette = both.quantize(_COLOURS, Image.Quantize.MEDIANCUT)
        palette.putpalette([*palette.getpalette()[:3 * _COLOURS], *(round(255 * part) for colour in self.lines for part in colour)])
        small = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
        shown = [_FIRST, *[_STEP] * (len(small) - 2), _LAST][:len(small)]
        stream = io.BytesIO()
        small[0].save(stream, "png", save_all=True, append_images=small[1:], duration=shown, loop=0, compress_level=9, pnginfo=mark())
        return stream.getvalue()
