# SPDX-License-Identifier: MIT
"""Threads: drawing leaves Python's global lock to others, threads may share a renderer and a scene; nothing leaks."""

import gc
import os
import sys
import threading
import time
import unittest

import numpy as np

import estampe
from helpers import QUAD, QUAD_TRIANGLES, SQUARE_GLB, renderer, scene_of_quad

SIZE = {"width": 64, "height": 48}


def resident_bytes():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Threads(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = estampe.Scene.load(SQUARE_GLB)
        renderer().set_scene(cls.scene)
        renderer().render("square", "comic", **SIZE)  # compiles the shaders

    def counted_while(self, work):
        """How often a second thread ran while `work` ran, and how long that took in seconds."""
        stamps = []
        done = threading.Event()

        def count():
            while not done.is_set():
                stamps.append(time.perf_counter())
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        begin = time.perf_counter()
        work()
        end = time.perf_counter()
        done.set()
        counter.join()
        return sum(begin < stamp < end for stamp in stamps), end - begin

    def test_drawing_lets_others_run(self):
        works = {
            "render": lambda: renderer().render("square", "pencil", width=320, height=240, samples=4),
            "layers": lambda: renderer().layers("square", "pencil", width=320, height=240, samples=4),
            "strokes": lambda: [renderer().strokes("square", "comic", width=320, height=240) for _ in range(3)],
            "load": lambda: [estampe.Scene.load(SQUARE_GLB) for _ in range(5)],
        }
        for name, work in works.items():
            work()
            count, took_s = self.counted_while(work)
            # A thread that is let run counts about once per millisecond, on a busy machine still far more often than
            # the few times between two calls.
            self.assertGreater(count, 10 + 20 * took_s, f"{name} took {took_s:.3f} s")

    def test_two_threads_share_a_renderer(self):
        expected = {style: renderer().render("square", style, **SIZE) for style in ("comic", "pencil")}
        failures = []

        def draw(style):
            try:
                for _ in range(5):
                    picture = renderer().render("square", style, **SIZE)
                    if not np.array_equal(picture, expected[style]):
                        failures.append(f"another picture in {style}")
            except Exception as error:  # a thread's exception would be lost
                failures.append(repr(error))

        threads = [threading.Thread(target=draw, args=(style,)) for style in expected]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def test_two_renderers_draw_side_by_side(self):
        other = estampe.Renderer("cpu")
        other.set_scene(self.scene)
        expected = renderer().render("square", "comic", **SIZE)
        found = []
        threads = [threading.Thread(target=lambda r=r: found.append(r.render("square", "comic", **SIZE)))
                   for r in (renderer(), other)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(found), 2)
        for picture in found:
            np.testing.assert_array_equal(picture, expected)

    def test_arguments_may_change_while_a_picture_is_drawn(self):
        own = estampe.Renderer("cpu")
        scene = scene_of_quad(double_sided=True)
        style = estampe.Style("comic")
        own.set_scene(scene)
        size = {"width": 320, "height": 240, "samples": 4}
        expected = own.render("front", style, **size)
        changes = 0
        for _ in range(5):
            found = []
            drawer = threading.Thread(target=lambda: found.append(own.render("front", style, **size)))
            drawer.start()
            time.sleep(0.01)  # render() copies its arguments before it lets this thread run
            while drawer.is_alive():
                scene.add_node("more", mesh=scene.add_mesh("more", estampe.Part(QUAD, QUAD_TRIANGLES)))
                style["contour.ink"], style["paper.color"] = "#ff0000", "#00ff00"
                estampe.Camera("front").placed(scene, style)
                changes += 1
            drawer.join()
            np.testing.assert_array_equal(found[0], expected)
            style = estampe.Style("comic")
        self.assertGreater(changes, 5)
        self.assertGreater(len(scene.nodes), 1)

    def test_values_are_never_stale(self):
        style = estampe.Style()
        done = threading.Event()

        def read():
            while not done.is_set():
                style["hatch.width_mm"]

        reader = threading.Thread(target=read)
        reader.start()
        try:
            for number in range(200):
                width_mm = 0.25 + number % 16 / 64
                style["hatch.width_mm"] = width_mm
                self.assertEqual(style["hatch.width_mm"], width_mm)
        finally:
            done.set()
            reader.join()

    def test_set_scene_takes_the_scene_as_it_is(self):
        scene = scene_of_quad(double_sided=True)
        renderer().set_scene(scene)
        before = renderer().render("front", "comic", **SIZE)
        far = np.eye(4)
        far[0, 3] = 3
        scene.add_node("far", far, mesh=0)
        np.testing.assert_array_equal(renderer().render("front", "comic", **SIZE), before)
        renderer().set_scene(scene)
        self.assertFalse(np.array_equal(renderer().render("front", "comic", **SIZE), before))
        renderer().set_scene(self.scene)

    def test_pictures_do_not_leak(self):
        size = {"width": 160, "height": 120}

        def round_of_calls():
            renderer().render("square", "comic", width=400, height=300)
            layers = renderer().layers("square", "comic", **size)
            layers["wash"].sum()
            [stroke.points for stroke in renderer().strokes("square", "comic", **size)]
            scene_of_quad(image=np.zeros((256, 256, 3), np.uint8), uvs=QUAD[:, :2])
            estampe.Style("pencil").to_toml()
            try:
                renderer().render("none of these", **size)
            except estampe.Error:
                pass

        for _ in range(10):
            round_of_calls()
        gc.collect()
        before = resident_bytes()
        for _ in range(50):
            round_of_calls()
        gc.collect()
        # 50 pictures of 400 x 300 pixels have 24 MB, the layers of smaller ones 60 MB, and 50 textures 13 MB.
        self.assertLess(resident_bytes() - before, 4e6)

    def test_references_are_released(self):
        scene = scene_of_quad()
        renderer().set_scene(scene)
        count = sys.getrefcount(scene)
        for _ in range(5):
            renderer().set_scene(scene)
            scene.bounds()
        self.assertEqual(sys.getrefcount(scene), count)
        renderer().set_scene(self.scene)


if __name__ == "__main__":
    unittest.main()
