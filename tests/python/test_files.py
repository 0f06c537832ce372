# SPDX-License-Identifier: MIT
"""Scenes of files: animations, variants, axes, limits, and arrays that are added to what a file has."""

import base64
import json
import os
import pathlib
import shutil
import tempfile
import unittest

import numpy as np

import estampe
from helpers import FACING, QUAD, QUAD_TRIANGLES, SQUARE_GLB, plain_style, renderer

SIZE = {"width": 64, "height": 64}


def gltf_of_quad():
    """A red or green square of 2 m, which slides to the right by 1 m in 2 s."""
    arrays = [QUAD.astype("<f4"), QUAD_TRIANGLES.astype("<u2").ravel(), np.array([0, 2], "<f4"),
              np.array([[0, 0, 0], [1, 0, 0]], "<f4")]
    blocks = [array.tobytes() for array in arrays]
    starts = np.cumsum([0] + [len(block) for block in blocks])
    kinds = [(5126, "VEC3"), (5123, "SCALAR"), (5126, "SCALAR"), (5126, "VEC3")]

    def paint(name, color):
        return {"name": name, "pbrMetallicRoughness": {"baseColorFactor": color, "metallicFactor": 0},
                "extensions": {"KHR_materials_unlit": {}}}

    return {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "extensionsUsed": ["KHR_materials_unlit", "KHR_materials_variants"],
        "extensions": {"KHR_materials_variants": {"variants": [{"name": "red"}, {"name": "green"}]}},
        "nodes": [{"name": "quad", "mesh": 0}, {"name": "viewer", "camera": 0, "translation": [0, 0, 5]}],
        "cameras": [{"name": "front camera", "type": "orthographic",
                     "orthographic": {"xmag": 2, "ymag": 2, "znear": 0.1, "zfar": 100}}],
        "materials": [paint("red paint", [1, 0, 0, 1]), paint("green paint", [0, 1, 0, 1])],
        "meshes": [{"name": "square", "primitives": [{
            "attributes": {"POSITION": 0}, "indices": 1, "material": 0,
            "extensions": {"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0]},
                                                                   {"material": 1, "variants": [1]}]}}}]}],
        "animations": [{"name": "slide", "samplers": [{"input": 2, "output": 3}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
        "buffers": [{"byteLength": int(starts[-1]), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(b"".join(blocks)).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": int(start), "byteLength": len(block)}
                        for start, block in zip(starts, blocks)],
        "accessors": [{"bufferView": number, "componentType": kind, "type": shape,
                       "count": len(array), "min": np.atleast_1d(array.min(axis=0)).tolist(),
                       "max": np.atleast_1d(array.max(axis=0)).tolist()}
                      for number, ((kind, shape), array) in enumerate(zip(kinds, arrays))],
    }


class Files(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name
        self.path = os.path.join(self.folder, "quad.gltf")
        with open(self.path, "w", encoding="utf-8") as file:
            json.dump(gltf_of_quad(), file)

    def test_names(self):
        scene = estampe.Scene.load(self.path)
        self.assertEqual(scene.warnings, [])
        self.assertEqual((scene.cameras, scene.animations, scene.meshes), (["front camera"], ["slide"], ["square"]))
        self.assertEqual((scene.nodes, scene.variants), (["quad", "viewer"], ["red", "green"]))
        self.assertEqual(scene.materials[:2], ["red paint", "green paint"])
        np.testing.assert_allclose(scene.animation_durations_s, [2.0])

    def test_paths_of_all_kinds(self):
        for path in (self.path, pathlib.Path(self.path), os.fsencode(self.path)):
            self.assertEqual(estampe.Scene.load(path).nodes, ["quad", "viewer"])
        odd = os.fsencode(self.folder) + b"/\xff \xc3\xa9.gltf"
        shutil.copy(self.path, odd)
        self.assertEqual(estampe.Scene.load(odd).nodes, ["quad", "viewer"])
        os.remove(odd)
        with self.assertRaises(estampe.Error) as caught:
            estampe.Scene.load(odd)
        self.assertTrue(str(caught.exception))

    def test_time_moves_the_quad(self):
        scene = estampe.Scene.load(self.path)
        np.testing.assert_allclose(scene.bounds(), [[-1, -1, 0], [1, 1, 0]])
        for animation in (0, "slide", np.int64(0)):
            np.testing.assert_allclose(scene.bounds(1.0, animation), [[-0.5, -1, 0], [1.5, 1, 0]], atol=1e-6)
        renderer().set_scene(scene)
        middles = []
        for time_s in (0.0, 1.0):
            picture = renderer().render("front camera", plain_style(), time_s=time_s, animation="slide", **SIZE)
            middles.append(np.argwhere(picture[:, :, 1] < 160).mean(axis=0)[1])
        self.assertAlmostEqual(middles[1] - middles[0], 8.0, delta=0.5)
        motion = renderer().motion("front camera", plain_style(), time_s=1.0, since_time_s=0.0, **SIZE)
        np.testing.assert_allclose(motion[32, 40, :2], [8, 0], atol=0.05)

    def test_variants_change_the_colour(self):
        for variant, channel in (("red", 0), ("green", 1), ("1", 1), ("", 0)):
            renderer().set_scene(estampe.Scene.load(self.path, variant=variant))
            color = renderer().render("0", plain_style(), **SIZE)[32, 32, :3].astype(int)
            self.assertEqual(int(color.argmax()), channel, variant)
        with self.assertRaisesRegex(estampe.Error, "green"):
            estampe.Scene.load(self.path, variant="blue")

    def test_up_axis(self):
        np.testing.assert_allclose(estampe.Scene.load(self.path, up="z").bounds(), [[-1, 0, -1], [1, 0, 1]], atol=1e-6)

    def test_arrays_join_what_a_file_has(self):
        scene = estampe.Scene.load(self.path)
        blue = scene.add_material("blue", base_color=(0, 0, 1), unlit=True)
        mesh = scene.add_mesh("small", estampe.Part(QUAD * 0.25 + [0, 0, 1], QUAD_TRIANGLES, material=blue))
        scene.add_node("small", mesh=mesh, parent=scene.nodes.index("quad"))
        renderer().set_scene(scene)
        picture = renderer().render(FACING, plain_style(), **SIZE)
        self.assertEqual(int(picture[32, 32, :3].argmax()), 2)
        self.assertEqual(int(picture[8, 8, :3].argmax()), 0)

    def test_files_are_confined(self):
        inner = os.path.join(self.folder, "inner")
        os.mkdir(inner)
        gltf = gltf_of_quad()
        data = gltf["buffers"][0]["uri"].partition(",")[2]
        with open(os.path.join(self.folder, "outer.bin"), "wb") as file:
            file.write(base64.b64decode(data))
        gltf["buffers"][0]["uri"] = "../outer.bin"
        path = os.path.join(inner, "quad.gltf")
        with open(path, "w", encoding="utf-8") as file:
            json.dump(gltf, file)
        self.assertEqual(estampe.Scene.load(path).meshes, ["square"])
        with self.assertRaisesRegex(estampe.Error, "outer.bin"):
            estampe.Scene.load(path, confine=True)

    def test_limits_hold_for_lightmaps(self):
        light = np.full((4096, 4096, 4), 255, np.uint8).view(estampe.Picture)
        light.save(os.path.join(self.folder, "light.png"))
        del light
        gltf = gltf_of_quad()
        gltf["accessors"].append({"bufferView": 0, "componentType": 5126, "type": "VEC2", "count": 4})
        gltf["bufferViews"][0]["byteStride"] = 12
        gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4
        gltf["materials"][0]["extras"] = {"estampe": {"lightmap": {"uri": "light.png", "texCoord": 0}}}
        lit = os.path.join(self.folder, "lit.gltf")
        with open(lit, "w", encoding="utf-8") as file:
            json.dump(gltf, file)
        estampe.Scene.load(lit)
        with open("/proc/self/statm", encoding="ascii") as file:
            resident_bytes = int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        limit_bytes = resident_bytes + 20e6  # the pixels of the lightmap have 64 MiB
        estampe.Scene.load(self.path, max_memory=limit_bytes)
        with self.assertRaisesRegex(estampe.Error, "lit.gltf"):
            estampe.Scene.load(lit, max_memory=limit_bytes)

    def test_limits_and_damage(self):
        with self.assertRaises(estampe.Error):
            estampe.Scene.load(SQUARE_GLB, max_memory=1000)
        estampe.Scene.load(SQUARE_GLB, max_memory=8e9, max_seconds=60)
        with open(self.path, "r+", encoding="utf-8") as file:
            file.truncate(200)
        with self.assertRaises(estampe.Error) as caught:
            estampe.Scene.load(self.path)
        self.assertIn("quad.gltf", caught.exception.where)


if __name__ == "__main__":
    unittest.main()
