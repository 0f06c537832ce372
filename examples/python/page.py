# SPDX-License-Identifier: MIT
# A page drawn from arrays: a landscape of heights and a tower, hatched in ink and saved as PNG.
# Usage: page.py [FOLDER [PIXELS]]     writes page.png, PIXELS high, into FOLDER

# %% A model of arrays
import sys
from pathlib import Path

import numpy as np

import estampe

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
height_px = int(sys.argv[2]) if len(sys.argv) > 2 else 480
folder.mkdir(parents=True, exist_ok=True)


def grid(points):
    """Triangles of a (rows, columns, 3) grid of points: counter-clockwise where columns turn left into rows."""
    rows, columns = points.shape[:2]
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    return np.concatenate([np.stack([corner, corner + columns, corner + 1], axis=1),
                           np.stack([corner + 1, corner + columns, corner + columns + 1], axis=1)])


side = np.linspace(-3.0, 3.0, 61)
x, z = np.meshgrid(side, side)
ground = np.stack([x, 0.5 * np.exp(-((x - 1) ** 2) - z**2) + 0.06 * np.sin(3 * x) * np.cos(2 * z), z], axis=-1)

turn = np.linspace(0.0, 2.0 * np.pi, 49)
profile = np.array([[0.0, 2.2], [0.5, 1.6], [0.36, 1.6], [0.36, 0.0]])  # radius and height, from the top of the roof
tower = np.stack([profile[:, :1] * np.sin(turn), np.repeat(profile[:, 1:], len(turn), axis=1),
                  profile[:, :1] * np.cos(turn)], axis=-1)

# %% The scene: materials, a mesh for each object, and nodes that place them
scene = estampe.Scene()
grass = scene.add_material("grass", base_color=(0.25, 0.4, 0.12))
stone = scene.add_material("stone", base_color=(0.7, 0.35, 0.2))

hill = scene.add_mesh("hill", estampe.Part(ground.reshape(-1, 3), grid(ground), material=grass, crease_deg=180))
keep = scene.add_mesh("tower", estampe.Part(tower.reshape(-1, 3), grid(tower), material=stone))
scene.add_node("hill", mesh=hill)
place = np.eye(4)
place[:3, 3] = 1.0, 0.35, 0.0
scene.add_node("tower", place, mesh=keep)

# A sun from the upper left: a light shines along -z of its node, so the node is turned about y, then about x.
down, left = np.radians(-40.0), np.radians(-50.0)
about_x = np.array([[1, 0, 0], [0, np.cos(down), -np.sin(down)], [0, np.sin(down), np.cos(down)]])
about_y = np.array([[np.cos(left), 0, np.sin(left)], [0, 1, 0], [-np.sin(left), 0, np.cos(left)]])
turned = np.eye(4)
turned[:3, :3] = about_y @ about_x
scene.add_node("sun", turned, light=scene.add_light("directional", intensity=3.0))

# %% The drawing
style = estampe.Style()
style["paper.height_mm"] = 120
renderer = estampe.Renderer()
renderer.set_scene(scene)
picture = renderer.render("eye=-3,2.6,6 target=0.4,0.7,0 fov=32", style, width=height_px * 4 // 3, height=height_px)
picture.save(folder / "page.png")

# %% In a notebook the picture shows itself
picture
