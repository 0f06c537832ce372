# SPDX-License-Identifier: MIT
# Strokes as polylines: a drawing's pen strokes, drawn with matplotlib in one colour for each kind.
# Usage: strokes.py [FOLDER [PIXELS]]     writes strokes.png into FOLDER; strokes are found on a page PIXELS high

# %% A staircase of boxes
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot
from matplotlib.collections import LineCollection

import estampe

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
height_px = int(sys.argv[2]) if len(sys.argv) > 2 else 480
folder.mkdir(parents=True, exist_ok=True)

corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (0.0, 1.0) for z in (-0.5, 0.5)])
faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
triangles = [[face[0], face[k], face[k + 1]] for face in faces for k in (1, 2)]

scene = estampe.Scene()
scene.add_material("plaster", base_color=(0.8, 0.8, 0.8))
box = scene.add_mesh("box", estampe.Part(corners, triangles))
for step in range(5):
    matrix = np.diag([1.0, 0.25 * (step + 1), 0.5, 1.0])
    matrix[2, 3] = -0.5 * step
    scene.add_node(f"step {step}", matrix, mesh=box)

# %% The strokes, in millimetres of the page
renderer = estampe.Renderer()
renderer.set_scene(scene)
drawing = renderer.strokes("azimuth=40 elevation=25", "pen-sketch", width=height_px * 4 // 3, height=height_px)
print(f"{len(drawing)} strokes on a page of {drawing.width_mm:.0f} x {drawing.height_mm:.0f} mm")

# %% One collection of lines for each kind, as wide as the pen
figure, axes = pyplot.subplots(figsize=(drawing.width_mm / 25.4, drawing.height_mm / 25.4))
kinds = sorted({stroke.kind for stroke in drawing})
for number, kind in enumerate(kinds):
    points = [stroke.points for stroke in drawing if stroke.kind == kind]
    widths_pt = [float(p[:, 2].mean()) / 25.4 * 72 for p in points]
    lines = LineCollection([p[:, :2] for p in points], linewidths=widths_pt, colors=f"C{number}", label=kind)
    axes.add_collection(lines)
axes.set_xlim(0, drawing.width_mm)
axes.set_ylim(drawing.height_mm, 0)  # y points down on the page
axes.set_aspect("equal")
for line in axes.legend(loc="upper left").get_lines():
    line.set_linewidth(2)
figure.savefig(folder / "strokes.png", dpi=100)
