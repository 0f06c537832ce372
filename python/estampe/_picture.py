# SPDX-License-Identifier: MIT
"""Pictures as numpy arrays that notebooks show and that save themselves."""

import os
import tempfile
from typing import NamedTuple

import numpy as np

from . import _estampe


class Picture(np.ndarray):
    """A picture: a numpy array of the shape (h, w, 4), rows from top to bottom.

    A uint8 picture is sRGB-encoded with straight alpha, a float32 picture is linear with premultiplied alpha. `paper`
    is the linear colour that a transparent float32 picture leaves out, or None. Notebooks show the picture.

    Parts and copies of a picture are pictures. Results of arithmetic, of reductions such as mean(), and of astype() are
    plain arrays and numbers, as nothing says whether they are encoded: a change in place keeps the picture, and
    array.view(estampe.Picture) makes one.
    """

    paper = None

    def __array_finalize__(self, source):
        self.paper = getattr(source, "paper", None)

    def __array_wrap__(self, array, context=None, return_scalar=False):
        if array is self:  # a change in place
            return self
        return array[()] if array.ndim == 0 else np.asarray(array)

    def astype(self, *how, **more):
        """Return a plain array of another type; see numpy.ndarray.astype()."""
        return self.array.astype(*how, **more)

    def __reduce__(self):
        function, arguments, state = super().__reduce__()
        return function, arguments, (state, self.paper)

    def __setstate__(self, state):
        pixels, self.paper = state
        super().__setstate__(pixels)

    @property
    def array(self) -> np.ndarray:
        """The same pixels as a plain numpy array, which shares their memory."""
        return self.view(np.ndarray)

    def save(self, path, quality=None) -> None:
        """Write the picture; the ending of `path` chooses the format.

        uint8: .png, .jpg, .jpeg (quality 1 to 100, 92 if left out; no alpha) or .webp (quality 0 to 100, lossless if
        left out). float32: .exr (half floats) or .png (16 bits). Raises Error if the file cannot be written, ValueError
        for another ending and for a quality of other formats, and TypeError for an array of other numbers. The file
        appears when it is complete.
        """
        ending = os.path.splitext(os.fspath(path))[1].lower()
        if isinstance(ending, bytes):
            ending = ending.decode(errors="replace")
        is_linear = self.dtype == np.float32
        if not is_linear and self.dtype != np.uint8:
            raise TypeError(f"pixels: an array of {self.dtype} is no picture; convert it to uint8 or float32")
        if quality is not None and (is_linear or ending not in (".jpg", ".jpeg", ".webp")):
            raise ValueError(f"quality: is only valid for .jpg, .jpeg and .webp, not for {ending!r}")
        if is_linear and ending in (".exr", ".png"):
            _estampe._save_linear(self, path, self.paper, ending == ".exr")
        elif not is_linear and ending == ".png":
            _estampe._save_png(self, path)
        elif not is_linear and ending in (".jpg", ".jpeg"):
            _estampe._save_jpeg(self, path, 92 if quality is None else quality)
        elif not is_linear and ending == ".webp":
            _estampe._save_webp(self, path, quality)
        else:
            allowed = ".exr or .png" if is_linear else ".png, .jpg, .jpeg or .webp"
            raise ValueError(f"path: a picture of {self.dtype} is not written as {ending!r}, but as {allowed}")

    def _repr_png_(self):
        """Return the picture as the bytes of a PNG file, for notebooks; None if the array is no picture any more."""
        if self.ndim != 3 or self.shape[2] != 4 or self.size == 0 or self.dtype not in (np.uint8, np.float32):
            return None
        with tempfile.TemporaryDirectory(prefix="estampe-") as folder:
            path = os.path.join(folder, "picture.png")
            self.save(path)
            with open(path, "rb") as file:
                return file.read()


def svg_text_of(drawing):
    """Return the text of the SVG file of a Drawing."""
    with tempfile.TemporaryDirectory(prefix="estampe-") as folder:
        path = os.path.join(folder, "drawing.svg")
        drawing.save(path)
        with open(path, encoding="utf-8") as file:
            return file.read()


class Mask(NamedTuple):
    """Coverage of one object or effect in a picture, see Layers.masks."""

    name: str
    is_object: bool
    x: int
    y: int
    cover: np.ndarray


Mask.name.__doc__ = "Name of the node, or of the effect, such as \"shadow\"."
Mask.is_object.__doc__ = "Whether the mask shows a node of the scene, and not an effect."
Mask.x.__doc__ = "Left edge of the covered rectangle, in pixels."
Mask.y.__doc__ = "Upper edge of the covered rectangle, in pixels from the top."
Mask.cover.__doc__ = "(height, width) float32: coverage of each pixel of the rectangle, 0 to 1."


class Buffers(NamedTuple):
    """What each pixel of a picture shows of the scene, see Renderer.buffers()."""

    depth_m: np.ndarray
    normals: np.ndarray
    objects: np.ndarray
    materials: np.ndarray


Buffers.depth_m.__doc__ = "(h, w) float32: distance from the eye along the axis of view in metres; inf without a surface."
Buffers.normals.__doc__ = "(h, w, 3) float32: unit normals in world space, towards the eye; 0 without a surface."
Buffers.objects.__doc__ = "(h, w) int32: numbers of nodes; -1 without a surface, on terrain and on added ground."
Buffers.materials.__doc__ = "(h, w) int32: numbers of materials; -1 where objects is -1."
