# SPDX-License-Identifier: MIT
"""What several tests of the Python module use: one renderer on the processor, and small scenes of arrays."""

import functools
import os
import subprocess

import numpy as np

import estampe

PROGRAM = os.environ["ESTAMPE_PROGRAM"]
SQUARE_GLB = os.environ["ESTAMPE_SQUARE_GLB"]
SOURCE = os.environ["ESTAMPE_SOURCE"]

QUAD = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
QUAD_TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]], np.uint32)
FACING = "eye=0,0,5 target=0,0,0 ortho=1"
# Paint alone, without lines, strokes, and the texture of paper, so that colours can be compared.
PLAIN = {
    "contour.enabled": False, "hatch.enabled": False, "paper.color": "#ffffff", "paper.grain": 0, "paper.margin_mm": 0,
    "paper.border_mm": 0, "picture.ground": False, "light.shadows": False, "wash.strength": 1, "wash.detail": 1,
}


@functools.cache
def renderer() -> estampe.Renderer:
    """The renderer that tests share, as opening a device and compiling shaders takes most of their time."""
    return estampe.Renderer("cpu")


def plain_style() -> estampe.Style:
    """A style that paints flat colours, up to the edges of the page."""
    style = estampe.Style()
    style.update(PLAIN)
    return style


def scene_of_quad(light=None, uvs=None, **material) -> estampe.Scene:
    """A square of 2 m in the plane z = 0, which faces +z and fills the view FACING."""
    scene = estampe.Scene()
    image = material.pop("image", None)
    if image is not None:
        material["base_color_image"] = scene.add_image(image)
    number = scene.add_material("paint", **material)
    mesh = scene.add_mesh("quad", estampe.Part(QUAD, QUAD_TRIANGLES, material=number, uvs=uvs))
    scene.add_node("quad", mesh=mesh)
    if light is not None:
        scene.add_node("sun", light, light=scene.add_light("directional", intensity=1.0))
    return scene


def run_program(*words) -> str:
    """Run the program estampe, and return what it prints."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"estampe {words} ends with {done.returncode}: {done.stderr}")
    return done.stdout
