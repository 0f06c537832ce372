# SPDX-License-Identifier: MIT
"""Draw 3D scenes as a hand would: pen, ink and paper.

    import estampe

    renderer = estampe.Renderer()
    renderer.set_scene(estampe.Scene.load("helmet.glb"))
    picture = renderer.render("auto", estampe.Style("pencil"), width=640, height=360)
    picture.save("helmet.png")

Coordinates are right-handed, y up, in metres; times are in seconds; lengths on the page are in millimetres.
"""

from collections import abc as _abc

from ._estampe import (
    Camera,
    Device,
    DeviceLost,
    Drawing,
    Error,
    Layers,
    Part,
    Renderer,
    Scene,
    Stroke,
    __version__,
    devices,
    load_image,
)
from ._page import Page
from ._picture import Buffers, Mask, Picture
from ._style import Style

__all__ = [
    "Buffers",
    "Camera",
    "Device",
    "DeviceLost",
    "Drawing",
    "Error",
    "Layers",
    "Mask",
    "Page",
    "Part",
    "Picture",
    "Renderer",
    "Scene",
    "Stroke",
    "Style",
    "__version__",
    "devices",
    "load_image",
]

# Messages and help name the package, where the classes are public, and not the extension.
for _class in (Buffers, Camera, Device, Drawing, Layers, Mask, Page, Part, Picture, Renderer, Scene, Stroke, Style):
    _class.__module__ = "estampe"

_abc.Mapping.register(Layers)
_abc.Mapping.register(Style)
_abc.Sequence.register(Drawing)
