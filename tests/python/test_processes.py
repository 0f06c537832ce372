# SPDX-License-Identifier: MIT
"""Processes: a fork does not hang, and a program ends while its daemon threads draw."""

import os
import subprocess
import sys
import textwrap
import unittest

import estampe
from helpers import SQUARE_GLB, renderer, scene_of_quad

DRAWING = textwrap.dedent("""
    import sys, threading, time, estampe
    renderer = estampe.Renderer("cpu")
    renderer.set_scene(estampe.Scene.load(sys.argv[1]))
    renderer.render("square", width=64, height=48)

    def draw():
        while True:
            renderer.render("square", width=160, height=120)

    for _ in range(2):
        threading.Thread(target=draw, daemon=True).start()
    time.sleep(0.05)
""")


class Processes(unittest.TestCase):
    def test_programs_end_while_daemon_threads_draw(self):
        for _ in range(3):
            done = subprocess.run([sys.executable, "-c", DRAWING, SQUARE_GLB], capture_output=True, text=True,
                                  check=False, timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_renderers_stay_with_their_process(self):
        renderer().set_scene(scene_of_quad())
        reader, writer = os.pipe()
        child = os.fork()
        if child == 0:
            text = b"no error"
            try:
                renderer().render("front", width=16, height=16)
            except estampe.Error as error:
                text = f"{error}; {error.remedy}".encode()
            finally:
                os.write(writer, text)
                os._exit(0)
        os.close(writer)
        with open(reader, encoding="utf-8") as file:
            text = file.read()
        os.waitpid(child, 0)
        self.assertIn("another process", text)
        self.assertIn("spawn", text)


if __name__ == "__main__":
    unittest.main()
