# SPDX-License-Identifier: MIT
"""The examples run at a small size and draw what they promise, and the code of the tutorial runs as it stands."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import estampe
from helpers import SOURCE, SQUARE_GLB


def colors_of(picture):
    """Means over the middle of a picture: red, green, blue from 0 to 255."""
    height, width = picture.shape[:2]
    return picture[height // 4: -height // 4, width // 4: -width // 4, :3].astype(float).mean(axis=(0, 1))


class Examples(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def picture_of(self, name, pixels):
        script = os.path.join(SOURCE, "examples", "python", name + ".py")
        done = subprocess.run([sys.executable, "-B", script, os.path.join(self.folder, "made"), str(pixels)],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return estampe.load_image(os.path.join(self.folder, "made", name + ".png")).array

    def test_page(self):
        picture = self.picture_of("page", 120)
        self.assertEqual(picture.shape, (120, 160, 4))
        below, middle = picture[85:105, 20:80, :3].mean(axis=(0, 1)), picture[35:55, 87:100, :3].mean(axis=(0, 1))
        self.assertGreater(below[1], below[0] + 10, "the hill at the bottom is green")
        self.assertGreater(middle[0], middle[1] + 10, "the tower in the middle is red")

    def test_turntable(self):
        sheet = self.picture_of("turntable", 64)
        self.assertEqual(sheet.shape, (128, 256, 4))
        frames = sheet.reshape(2, 64, 4, 64, 4).swapaxes(1, 2).reshape(8, 64, 64, 4)
        for number, frame in enumerate(frames):
            red, _, blue = colors_of(frame)
            self.assertGreater(red, blue + 15, f"frame {number} shows copper")
            self.assertFalse(np.array_equal(frame, frames[number - 1]))

    def test_strokes(self):
        picture = self.picture_of("strokes", 120)
        colored = np.ptp(picture[..., :3].astype(int), axis=2) > 40
        self.assertGreater(float(colored.mean()), 0.01)

    def test_tutorial(self):
        shutil.copy(SQUARE_GLB, os.path.join(self.folder, "square.glb"))
        with open(os.path.join(SOURCE, "docs", "tutorials", "python.md"), encoding="utf-8") as file:
            blocks = re.findall(r"^```python\n(.*?)^```$", file.read(), re.MULTILINE | re.DOTALL)
        self.assertGreaterEqual(len(blocks), 4)
        names = {}
        printed = io.StringIO()
        before = os.getcwd()
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(printed):
                for number, block in enumerate(blocks):
                    exec(compile(block, f"block {number} of python.md", "exec"), names)
        finally:
            os.chdir(before)
        self.assertIn("wash (240, 320, 4) float32 multiply", printed.getvalue())
        self.assertIn("(4, 120, 160, 4)", printed.getvalue())
        for name in ("square.png", "page.png", "hill.png", "hill.ora", "hill.svg"):
            self.assertGreater(os.path.getsize(os.path.join(self.folder, name)), 500, name)
        red, _, blue = colors_of(estampe.load_image(os.path.join(self.folder, "hill.png")))
        self.assertGreater(red, blue + 10, "the hill is of sand")


if __name__ == "__main__":
    unittest.main()
