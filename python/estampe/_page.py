# SPDX-License-Identifier: MIT
"""Pages of paper: sizes in millimetres that become pixels by a resolution."""

import re
from typing import NamedTuple

_SIZES_MM = {
    "a0": (841.0, 1189.0),
    "a1": (594.0, 841.0),
    "a2": (420.0, 594.0),
    "a3": (297.0, 420.0),
    "a4": (210.0, 297.0),
    "a5": (148.0, 210.0),
    "a6": (105.0, 148.0),
    "letter": (215.9, 279.4),
    "legal": (215.9, 355.6),
    "tabloid": (279.4, 431.8),
}
_INCH_MM = 25.4


class _Size(NamedTuple):
    width: int
    height: int
    width_mm: float
    height_mm: float
    dpi: float


class Page(_Size):
    """Size of a printed page: pixels, millimetres, and pixels per inch.

    Page("A4", dpi=150) has a named size: A0 to A6, letter, legal or tabloid. Page("210x297mm") has any size of 10 to
    5000 mm per side. landscape turns the page so that its longer side is horizontal. Lengths of a style that are in
    millimetres refer to this page where a drawing method takes it. A wrong name or number raises ValueError.
    """

    __slots__ = ()

    def __new__(cls, name: str = "A4", dpi: float = 300.0, landscape: bool = False) -> "Page":
        width_mm, height_mm = _size_of(name)
        if landscape and width_mm < height_mm:
            width_mm, height_mm = height_mm, width_mm
        if not 1.0 <= dpi <= 10000.0:
            raise ValueError(f"dpi: {dpi} is not 1 to 10000")
        width, height = (max(1, int(length / _INCH_MM * dpi + 0.5)) for length in (width_mm, height_mm))
        if max(width, height) > 65535:
            raise ValueError(f"dpi: {name} has {width} x {height} pixels at {dpi} dpi; a side may have 65535")
        return super().__new__(cls, width, height, width_mm, height_mm, float(dpi))

    def __reduce__(self):
        return type(self)._make, (tuple(self),)


def _size_of(name: str) -> "tuple[float, float]":
    if not isinstance(name, str):
        raise TypeError("name: is not a text")
    if name.lower() in _SIZES_MM:
        return _SIZES_MM[name.lower()]
    typed = re.fullmatch(r"([0-9]+(?:\.[0-9]+)?)x([0-9]+(?:\.[0-9]+)?)mm", name.lower())
    if typed is None:
        raise ValueError(f"name: {name!r} is not a page; write A0 to A6, letter, legal, tabloid, or 210x297mm")
    size = float(typed[1]), float(typed[2])
    if min(size) < 10.0 or max(size) > 5000.0:
        raise ValueError(f"name: {name} is out of range; each side may have 10 to 5000 mm")
    return size
