# SPDX-License-Identifier: MIT
# A turntable: eight frames of one film, stacked in one array and saved side by side.
# Usage: turntable.py [FOLDER [PIXELS]]     writes turntable.png, of frames PIXELS high, into FOLDER

# %% A knot of arrays
import sys
from pathlib import Path

import numpy as np

import estampe

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
side_px = int(sys.argv[2]) if len(sys.argv) > 2 else 240
folder.mkdir(parents=True, exist_ok=True)

around, across = 160, 16
t = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
centre = np.stack([np.sin(t) + 2 * np.sin(2 * t), -np.sin(3 * t), np.cos(t) - 2 * np.cos(2 * t)], axis=1) / 3
along = np.roll(centre, -1, axis=0) - np.roll(centre, 1, axis=0)
along /= np.linalg.norm(along, axis=1, keepdims=True)
out = np.cross(along, [0.0, 1.0, 0.0])
out /= np.linalg.norm(out, axis=1, keepdims=True)
up = np.cross(out, along)
s = np.linspace(0.0, 2.0 * np.pi, across, endpoint=False)[:, None, None]
tube = centre + 0.16 * (np.cos(s) * out + np.sin(s) * up)  # (across, around, 3)

i, j = np.meshgrid(np.arange(across), np.arange(around), indexing="ij")
a, b = (i * around + j).ravel(), (i * around + (j + 1) % around).ravel()
c, d = ((i + 1) % across * around + j).ravel(), ((i + 1) % across * around + (j + 1) % around).ravel()
triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([c, b, d], axis=1)])

# %% The scene
scene = estampe.Scene()
scene.add_material("copper", base_color=(0.8, 0.35, 0.15))
knot = scene.add_mesh("knot", estampe.Part(tube.reshape(-1, 3), triangles, crease_deg=180))
scene.add_node("knot", mesh=knot)

# %% Eight frames: each follows the one before, so that its lines continue
renderer = estampe.Renderer()
renderer.set_scene(scene)
style = estampe.Style("comic")
frames = np.stack([
    renderer.render(f"azimuth={angle_deg} elevation=35 distance=4.5 fov=30", style, width=side_px, height=side_px,
                    follows=number > 0)
    for number, angle_deg in enumerate(np.arange(8) * 45.0)
])  # (8, h, w, 4) uint8

# %% Side by side, in two rows
sheet = np.concatenate([np.concatenate(list(row), axis=1) for row in (frames[:4], frames[4:])])
sheet.view(estampe.Picture).save(folder / "turntable.png")
