# SPDX-License-Identifier: MIT
"""Random arguments: whatever comes in, only Python's exceptions come out, and what is accepted can be drawn."""

import random
import unittest

import numpy as np

import estampe
from helpers import renderer

ROUNDS = 600
REFUSED = (estampe.Error, TypeError, ValueError, IndexError)
DTYPES = [np.float16, np.float32, np.float64, np.int8, np.uint8, np.int32, np.uint32, np.int64, np.uint64, bool,
          complex, "U3", object, "M8[s]", ">f4", ">i8"]
ODD_NUMBERS = [np.nan, np.inf, -np.inf, 1e30, -1e38, 1e-40, 2**31, 2**63]


class Strangers:
    """Random values, mostly nearly right, as only those come far."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.numpy = np.random.default_rng(seed)

    def array(self, shape, low, high, dtype):
        r = self.random
        if r.random() < 0.08:
            shape = tuple(r.choice([0, 1, 2, 3, 4, 5, 7]) for _ in range(r.randint(0, 4)))
        if r.random() < 0.08:
            dtype = r.choice(DTYPES)
        values = self.numpy.uniform(low, high, shape)
        if r.random() < 0.1 and values.size:
            values.flat[r.randrange(values.size)] = r.choice(ODD_NUMBERS)
        with np.errstate(all="ignore"):
            try:
                array = values.astype(dtype)
            except (TypeError, ValueError):
                array = values.astype(object)
        how = r.random()
        if how < 0.1 and array.ndim == 2:
            return np.asfortranarray(array)
        if how < 0.2 and array.ndim:
            return np.repeat(array, 2, axis=0)[::2]
        if how < 0.25:
            return array.tolist()
        if how < 0.28:
            return r.choice([None, "text", 7, {}, [[1], [2, 3]], b"bytes", np.float32(1), object()])
        return array

    def part(self):
        r = self.random
        topology = r.choice(["triangles", "triangles", "triangles", "lines", "points"])
        width = {"triangles": 3, "lines": 2, "points": 1}[topology]
        vertices, elements = r.randint(1, 12), r.randint(1, 12)
        scale = r.choice([1, 1, 1, 1e-6, 1e6, 1e15, 1e30])
        arguments = {"positions": self.array((vertices, 3), -scale, scale, np.float32), "topology": topology,
                     "material": r.choice([0, 0, 0, 1, 5, -1])}
        if r.random() < 0.9:
            beyond = 0.3 if r.random() < 0.1 else 0.0
            shape = (elements, width) if width > 1 else (elements,)
            arguments["indices"] = self.array(shape, 0 - beyond, vertices + beyond, np.int64)
        extras = {"normals": ((vertices, 3), -1, 1, np.float32), "uvs": ((vertices, 2), 0, 1, np.float32),
                  "uvs1": ((vertices, 2), 0, 1, np.float64), "colors": ((vertices, r.choice([3, 4])), 0, 1, np.float32),
                  "edge_marks": ((elements,), 0, 8, np.uint8), "tangents": ((vertices, 4), -1, 1, np.float32)}
        for name, how in extras.items():
            if r.random() < 0.2:
                arguments[name] = self.array(*how)
        if r.random() < 0.3:
            arguments["crease_deg"] = r.choice([0, 30, 180, 181, -1, float("nan"), "wide"])
        return estampe.Part(**arguments)

    def matrix(self):
        matrix = np.eye(4)
        matrix[:3] += self.numpy.normal(0, self.random.choice([0.1, 1, 1e9]), (3, 4))
        return self.array((4, 4), -1, 1, np.float64) if self.random.random() < 0.2 else matrix

    def number(self):
        return self.random.choice([None, 0, 0, 0, 0, 1, 2, -1, 2**32, 2**70, "0", 0.5])

    def change(self, scene):
        """Add one random thing."""
        r = self.random
        kind = r.randrange(7)
        if kind == 0:
            scene.add_image(self.array((r.randint(1, 4), r.randint(1, 4), r.choice([3, 4])), 0, 255, np.uint8))
        elif kind == 1:
            scene.add_material(base_color=self.array((4,), 0, 1, float), base_color_image=self.number(),
                               alpha_mode=r.choice(["opaque", "mask", "blend", "x"]), normal_image=self.number())
        elif kind == 2:
            scene.add_light(r.choice(["directional", "point", "spot", "ambient", ""]),
                            intensity=r.choice([1, 0, 1e9, -1, float("nan")]), color=self.array((3,), 0, 1, float))
        elif kind == 3:
            scene.add_camera("c", fov_deg=r.choice([30, 1, 170, 0]), near_m=r.choice([0.01, 1e8, 0]))
        elif kind == 4:
            scene.add_mesh("m", [self.part() for _ in range(r.randint(0, 3))])
        else:
            scene.add_node("n", self.matrix(), mesh=self.number(), light=self.number() if r.random() < 0.3 else None,
                           camera=self.number() if r.random() < 0.2 else None,
                           parent=self.number() if r.random() < 0.3 else None, visible=r.random() < 0.9,
                           instances=self.array((2, 4, 4), -1, 1, float) if r.random() < 0.1 else None)


class Fuzz(unittest.TestCase):
    def test_random_parts(self):
        accepted = 0
        for seed in range(ROUNDS):
            try:
                part = Strangers(seed).part()
            except REFUSED as error:
                self.assertTrue(str(error), seed)
                continue
            accepted += 1
            self.assertLess(int(part.indices.max()), len(part.positions))
            self.assertTrue(np.isfinite(part.positions).all())
            if part.normals is not None:
                np.testing.assert_allclose(np.linalg.norm(part.normals.astype(float), axis=1), 1, atol=1e-4)
        self.assertGreater(accepted, ROUNDS // 10)
        self.assertLess(accepted, ROUNDS * 9 // 10)

    def test_random_scenes(self):
        drawn = refused = 0
        for seed in range(60):
            strangers = Strangers(1000 + seed)
            scene = estampe.Scene()
            scene.add_material("usual")
            for _ in range(12):
                try:
                    strangers.change(scene)
                except (*REFUSED, OverflowError):
                    refused += 1
            try:
                scene.bounds()
                renderer().set_scene(scene)
                picture = renderer().render(strangers.random.choice(["auto", None, "front", "eye=0,0,5 target=0,0,0"]),
                                            strangers.random.choice([None, "comic"]), width=24, height=16)
            except estampe.Error as error:
                self.assertTrue(str(error), seed)
                continue
            self.assertEqual(picture.shape, (16, 24, 4))
            drawn += 1
        self.assertGreater(drawn, 20)
        self.assertGreater(refused, 100)

    def test_deep_trees_of_nodes(self):
        scene = estampe.Scene()
        scene.add_material()
        parent = None
        for _ in range(50000):
            parent = scene.add_node(parent=parent)
        scene.add_node(mesh=scene.add_mesh("m", estampe.Part(np.eye(3), [[0, 1, 2]])), parent=parent)
        self.assertEqual(scene.bounds().tolist(), [[0, 0, 0], [1, 1, 1]])
        try:
            renderer().set_scene(scene)
            renderer().render("front", width=16, height=16)
        except estampe.Error as error:
            self.assertTrue(str(error))

    def test_random_keywords(self):
        scene = estampe.Scene()
        scene.add_material()
        scene.add_node(mesh=scene.add_mesh("m", estampe.Part(np.eye(3), [[0, 1, 2]])))
        renderer().set_scene(scene)
        values = [None, 0, 1, -1, 7, 1e9, 2**70, float("nan"), "auto", "", "\0", "x" * 10000, b"x", (), [1], True,
                  np.int8(9), np.array([1, 2]), object(),
                  estampe.Camera("front"), estampe.Style(), estampe.Page("A6", 4)]
        names = ["camera", "style", "time_s", "samples", "animation", "transparent", "page", "follows", "max_memory",
                 "max_seconds", "other"]
        chance = random.Random(5)
        for _ in range(300):
            arguments = {chance.choice(names): chance.choice(values) for _ in range(2)}
            if "page" not in arguments:
                arguments.update(width=8, height=8)
            try:
                renderer().render(**arguments)
            except (*REFUSED, OverflowError) as error:
                self.assertTrue(str(error), arguments)


if __name__ == "__main__":
    unittest.main()
