# SPDX-License-Identifier: MIT
"""Arrays that become parts, images, materials and nodes, and wrong arrays, which raise exceptions that name them."""

import copy
import pickle
import unittest

import numpy as np

import estampe
from helpers import QUAD, QUAD_TRIANGLES


def cube():
    """The corners and triangles of a cube of 1 m, counter-clockwise seen from outside."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return corners, np.array([[q[i], q[j], q[k]] for q in quads for i, j, k in ((0, 1, 2), (0, 2, 3))])


class Parts(unittest.TestCase):
    def test_arrays_are_copied(self):
        positions = QUAD.copy()
        part = estampe.Part(positions, QUAD_TRIANGLES)
        positions[:] = 9
        np.testing.assert_array_equal(np.sort(part.positions, axis=0), np.sort(QUAD, axis=0))
        np.testing.assert_allclose(part.normals, np.tile([0.0, 0.0, 1.0], (4, 1)))
        np.testing.assert_array_equal(part.positions[part.indices], QUAD[QUAD_TRIANGLES])
        with self.assertRaises(ValueError):
            part.positions[0] = 1

    def test_arrays_outlive_their_part(self):
        positions = estampe.Part(QUAD, QUAD_TRIANGLES).positions
        self.assertEqual(float(np.abs(positions).max()), 1.0)

    def test_flat_cube_has_a_normal_per_face(self):
        corners, triangles = cube()
        part = estampe.Part(corners, triangles)
        self.assertEqual(len(part.positions), 24)
        centres = part.positions[part.indices].mean(axis=1)
        for centre, corner_normals in zip(centres, part.normals[part.indices]):
            for normal in corner_normals:
                self.assertAlmostEqual(float(np.abs(normal).max()), 1.0, places=6)
                self.assertGreater(float(normal @ (centre - 0.5)), 0.3)

    def test_smooth_cube_has_a_normal_per_corner(self):
        corners, triangles = cube()
        part = estampe.Part(corners, triangles, crease_deg=180)
        self.assertEqual(len(part.positions), 8)
        np.testing.assert_allclose(part.normals, (part.positions - 0.5) * 2 / np.sqrt(3), atol=1e-6)

    def test_normals_do_not_depend_on_shared_vertices(self):
        corners, triangles = cube()
        apart = estampe.Part(corners[triangles].reshape(-1, 3), crease_deg=180)
        np.testing.assert_allclose(apart.normals, (apart.positions - 0.5) * 2 / np.sqrt(3), atol=1e-6)

    def test_many_faces_at_one_position(self):
        turn = np.linspace(0.0, 6.28, 200_000)
        rim = np.stack([np.cos(turn), 0.1 * np.sin(7 * turn), -np.sin(turn)], axis=1)
        first = np.arange(1, len(rim))
        fan = np.stack([np.zeros_like(first), first, first + 1], axis=1)
        for crease_deg in (0, 47):
            part = estampe.Part(np.concatenate([[[0, 0, 0]], rim]), fan, crease_deg=crease_deg)
            self.assertGreater(float(part.normals[:, 1].min()), 0.5)

    def test_sizes_do_not_matter(self):
        corners, triangles = cube()
        for scale in (1e-18, 1e18, 3e37):
            part = estampe.Part(corners * scale, triangles)
            np.testing.assert_allclose(np.abs(part.normals).max(axis=1), 1, atol=1e-6)

    def test_given_normals_are_scaled(self):
        part = estampe.Part(QUAD, QUAD_TRIANGLES, normals=np.tile([0, 0, 1e-30], (4, 1)))
        np.testing.assert_allclose(part.normals, np.tile([0.0, 0.0, 1.0], (4, 1)))

    def test_kinds_of_numbers(self):
        for dtype in (np.float16, np.float32, np.float64, np.int8, np.uint64, np.dtype(">f4")):
            part = estampe.Part((QUAD + 1).astype(dtype), QUAD_TRIANGLES)
            np.testing.assert_array_equal(part.positions[part.indices], (QUAD + 1)[QUAD_TRIANGLES])
        for dtype in (np.uint8, np.int16, np.uint32, np.int64, np.uint64, np.dtype(">i4")):
            part = estampe.Part(QUAD, QUAD_TRIANGLES.astype(dtype))
            self.assertEqual(part.indices.shape, (2, 3))
        part = estampe.Part(np.asfortranarray(QUAD), QUAD_TRIANGLES[::-1])
        np.testing.assert_array_equal(part.positions[part.indices], QUAD[QUAD_TRIANGLES[::-1]])
        part = estampe.Part(np.repeat(QUAD, 2, axis=0)[::2], QUAD_TRIANGLES.tolist())
        np.testing.assert_array_equal(part.positions[part.indices], QUAD[QUAD_TRIANGLES])

    def test_lines_and_points(self):
        lines = estampe.Part(QUAD, [[0, 1], [1, 2]], topology="lines")
        self.assertEqual((lines.indices.shape, lines.normals), ((2, 2), None))
        self.assertEqual(estampe.Part(QUAD, topology="lines").indices.tolist(), [[0, 1], [2, 3]])
        self.assertEqual(estampe.Part(QUAD, topology="points").indices.shape, (4, 1))
        self.assertEqual(estampe.Part(QUAD, [0, 3], topology="points").indices.tolist(), [[0], [3]])

    def test_wrong_arrays_are_named(self):
        wrong = [
            (ValueError, "positions", dict(positions=QUAD[:, :2])),
            (ValueError, "positions", dict(positions=QUAD[0])),
            (ValueError, "positions", dict(positions=np.zeros((0, 3)))),
            (ValueError, "positions", dict(positions=QUAD * np.nan)),
            (ValueError, "positions", dict(positions=QUAD.astype(float) * 1e300)),
            (ValueError, "positions", dict(indices=None)),
            (TypeError, "positions", dict(positions=QUAD.astype(complex))),
            (TypeError, "positions", dict(positions=QUAD.astype(str))),
            (TypeError, "positions", dict(positions=QUAD > 0)),
            (TypeError, "positions", dict(positions=None)),
            (TypeError, "positions", dict(positions=QUAD.astype(object))),
            (IndexError, "indices", dict(indices=[[0, 1, 4]])),
            (IndexError, "indices", dict(indices=[[0, 1, -1]])),
            (IndexError, "indices", dict(indices=np.array([[0, 1, 2**32]]))),
            (IndexError, "indices", dict(indices=np.array([[0, 1, 2**64 - 1]], np.uint64))),
            (TypeError, "indices", dict(indices=QUAD_TRIANGLES.astype(float))),
            (ValueError, "indices", dict(indices=[0, 1, 2])),
            (ValueError, "indices", dict(indices=[])),
            (ValueError, "indices", dict(indices=np.zeros((0, 3), int))),
            (ValueError, "normals", dict(normals=QUAD[:3])),
            (ValueError, "normals", dict(normals=QUAD * 0)),
            (ValueError, "uvs", dict(uvs=QUAD)),
            (ValueError, "uvs1", dict(uvs1=QUAD[:3, :2])),
            (ValueError, "colors", dict(colors=QUAD[:, :2])),
            (TypeError, "colors", dict(colors=QUAD.astype(np.uint8))),
            (ValueError, "tangents", dict(tangents=np.zeros((4, 4)))),
            (IndexError, "edge_marks", dict(edge_marks=[8, 0])),
            (ValueError, "edge_marks", dict(edge_marks=[1])),
            (ValueError, "edge_marks", dict(edge_marks=[1], topology="points")),
            (ValueError, "crease_deg", dict(crease_deg=181)),
            (ValueError, "crease_deg", dict(crease_deg=float("nan"))),
            (ValueError, "topology", dict(topology="quads")),
            (IndexError, "material", dict(material=-1)),
            (IndexError, "material", dict(material=2**40)),
            (TypeError, "material", dict(material=1.5)),
            (TypeError, "material", dict(material=None)),
        ]
        for error, name, changes in wrong:
            arguments = {"positions": QUAD, "indices": QUAD_TRIANGLES, **changes}
            if changes.get("topology") == "points":
                arguments["indices"] = None
            with self.assertRaisesRegex(error, f"^{name}: ", msg=str(changes)):
                estampe.Part(**arguments)


class Scenes(unittest.TestCase):
    def test_numbers_count_up(self):
        scene = estampe.Scene()
        image = np.zeros((2, 3, 3), np.uint8)
        self.assertEqual([scene.add_image(image), scene.add_image(image)], [0, 1])
        self.assertEqual([scene.add_material("a"), scene.add_material("b", base_color_image=1)], [0, 1])
        self.assertEqual(scene.add_mesh("m", [estampe.Part(QUAD, QUAD_TRIANGLES, material=k) for k in (0, 1)]), 0)
        self.assertEqual(scene.add_light("spot", name="lamp", outer_cone_deg=20), 0)
        self.assertEqual(scene.add_camera("eye", fov_deg=30), 0)
        self.assertEqual(scene.add_node("root"), 0)
        self.assertEqual(scene.add_node("child", np.eye(4), mesh=0, light=0, camera=0, parent=0), 1)
        self.assertEqual((scene.materials, scene.meshes, scene.lights), (["a", "b"], ["m"], ["lamp"]))
        self.assertEqual((scene.cameras, scene.nodes, scene.animations), (["eye"], ["root", "child"], []))

    def test_bounds_are_those_of_the_world(self):
        scene = estampe.Scene()
        self.assertIsNone(scene.bounds())
        scene.add_material()
        mesh = scene.add_mesh("m", estampe.Part(QUAD, QUAD_TRIANGLES))
        up, right = np.eye(4), np.eye(4)
        up[1, 3], right[0, 3] = 10, 5
        parent = scene.add_node("up", up)
        scene.add_node("right", right, mesh=mesh, parent=parent)
        np.testing.assert_allclose(scene.bounds(), [[4, 9, 0], [6, 11, 0]])
        turned = np.eye(4)[:, [2, 1, 0, 3]] * [1, 1, -1, 1]
        scene.add_node("turned", turned, mesh=mesh, instances=np.stack([np.eye(4), right]))
        np.testing.assert_allclose(scene.bounds()[:, 2], [-1, 6], err_msg="of the instance at 5 m along x, turned to z")

    def test_wrong_arguments_are_named(self):
        scene = estampe.Scene()
        part = estampe.Part(QUAD, QUAD_TRIANGLES, material=1)
        image = np.zeros((2, 2, 4), np.uint8)
        wrong = [
            (IndexError, "material", lambda: scene.add_mesh("m", part)),
            (TypeError, "parts", lambda: scene.add_mesh("m", None)),
            (TypeError, "parts", lambda: scene.add_mesh("m", "part")),
            (TypeError, "parts", lambda: scene.add_mesh("m", [QUAD])),
            (ValueError, "parts", lambda: scene.add_mesh("m", [])),
            (TypeError, "pixels", lambda: scene.add_image(image.astype(float))),
            (TypeError, "pixels", lambda: scene.add_image(image.astype(np.uint16))),
            (ValueError, "pixels", lambda: scene.add_image(image[:, :, :2])),
            (ValueError, "pixels", lambda: scene.add_image(image[:0])),
            (ValueError, "wrap", lambda: scene.add_image(image, wrap="around")),
            (IndexError, "base_color_image", lambda: scene.add_material(base_color_image=0)),
            (IndexError, "emissive_image", lambda: scene.add_material(emissive_image=-1)),
            (ValueError, "base_color", lambda: scene.add_material(base_color=(1, 2, 0))),
            (ValueError, "base_color", lambda: scene.add_material(base_color=1.0)),
            (TypeError, "base_color", lambda: scene.add_material(base_color="red")),
            (ValueError, "emissive", lambda: scene.add_material(emissive=(-1, 0, 0))),
            (ValueError, "roughness", lambda: scene.add_material(roughness=float("nan"))),
            (ValueError, "alpha_mode", lambda: scene.add_material(alpha_mode="glass")),
            (ValueError, "type", lambda: scene.add_light("sun")),
            (ValueError, "intensity", lambda: scene.add_light("point", intensity=float("inf"))),
            (ValueError, "inner_cone_deg", lambda: scene.add_light("spot", inner_cone_deg=50)),
            (ValueError, "fov_deg", lambda: scene.add_camera(fov_deg=0)),
            (IndexError, "mesh", lambda: scene.add_node(mesh=0)),
            (TypeError, "mesh", lambda: scene.add_node(mesh=1.0)),
            (TypeError, "node", lambda: scene.set_matrix("quad", np.eye(4))),
            (TypeError, "base_color_image", lambda: scene.add_material(base_color_image=True)),
            (IndexError, "light", lambda: scene.add_node(light=0)),
            (IndexError, "camera", lambda: scene.add_node(camera=0)),
            (IndexError, "parent", lambda: scene.add_node(parent=0)),
            (ValueError, "matrix", lambda: scene.add_node(matrix=np.eye(3))),
            (ValueError, "matrix", lambda: scene.add_node(matrix=np.eye(4).T + np.eye(4)[3])),
            (ValueError, "instances", lambda: scene.add_node(instances=np.eye(4))),
            (ValueError, "time_s", lambda: scene.bounds(float("nan"))),
            (IndexError, "animation", lambda: scene.bounds(animation=1)),
            (IndexError, "animation", lambda: scene.bounds(animation=10**30)),
            (ValueError, "animation", lambda: scene.bounds(animation="walk")),
            (TypeError, "animation", lambda: scene.bounds(animation=0.5)),
            (TypeError, "path", lambda: estampe.Scene.load(3)),
            (ValueError, "up", lambda: estampe.Scene.load("scene.glb", up="up")),
            (ValueError, "max_memory", lambda: estampe.Scene.load("scene.glb", max_memory=-1)),
            (ValueError, "max_seconds", lambda: estampe.Scene.load("scene.glb", max_seconds=0)),
        ]
        for error, name, call in wrong:
            with self.assertRaisesRegex(error, f"^{name}: "):
                call()
        self.assertEqual((scene.nodes, scene.materials, scene.meshes), ([], [], []))

    def test_exceptions_of_indices_pass(self):
        class Broken:
            def __index__(self):
                raise KeyError("broken")

        with self.assertRaisesRegex(KeyError, "broken"):
            estampe.Scene().bounds(animation=Broken())
        with self.assertRaisesRegex(KeyError, "broken"):
            estampe.Scene().add_node(mesh=Broken())

    def test_a_scene_without_materials_gets_one(self):
        scene = estampe.Scene()
        scene.add_node(mesh=scene.add_mesh("m", estampe.Part(QUAD, QUAD_TRIANGLES)))
        self.assertEqual((scene.materials, scene.faults()), (["default"], []))
        scene.add_mesh("again", estampe.Part(QUAD, QUAD_TRIANGLES))
        self.assertEqual(scene.materials, ["default"])
        self.assertEqual(estampe.Scene().faults(), [])

    def test_normal_maps_need_tangents(self):
        scene = estampe.Scene()
        scene.add_material(normal_image=scene.add_image(np.full((1, 1, 3), 128, np.uint8)))
        with self.assertRaisesRegex(ValueError, "tangents"):
            scene.add_mesh("m", estampe.Part(QUAD, QUAD_TRIANGLES))
        normals, tangents = np.tile([0.0, 0, 1], (4, 1)), np.tile([1.0, 0, 0, 1], (4, 1))
        scene.add_mesh("m", estampe.Part(QUAD, QUAD_TRIANGLES, normals=normals, tangents=tangents))

    def test_missing_files_say_so(self):
        with self.assertRaises(estampe.Error) as caught:
            estampe.Scene.load("/nonexistent/scene.glb")
        self.assertIn("/nonexistent/scene.glb", str(caught.exception))


class Cameras(unittest.TestCase):
    def test_texts_and_numbers_agree(self):
        text = estampe.Camera("eye=2,1,3 target=0,0.5,0 fov=40")
        numbers = estampe.Camera(eye=(2, 1, 3), target=(0, 0.5, 0), fov_deg=40)
        for camera in (text, numbers):
            self.assertEqual((camera.eye.tolist(), camera.target.tolist()), ([2, 1, 3], [0, 0.5, 0]))
            self.assertAlmostEqual(camera.fov_deg, 40)
            self.assertAlmostEqual(camera.near_m, np.linalg.norm([2, 0.5, 3]) / 1000)
        self.assertEqual(estampe.Camera(eye=(2, 1, 3), near_m=0.5).near_m, 0.5)
        self.assertIn("isometric", estampe.Camera.views)
        self.assertIsNone(estampe.Camera("auto").eye)

    def test_matrices_look_along_minus_z(self):
        matrix = np.array([[0, 0, 1, 4], [0, 1, 0, 2], [-1, 0, 0, 0], [0, 0, 0, 1.0]])
        camera = estampe.Camera(matrix=matrix, half_height_m=3)
        np.testing.assert_allclose(camera.target - camera.eye, [-1, 0, 0])
        np.testing.assert_allclose(camera.up, [0, 1, 0])
        self.assertEqual(camera.half_height_m, 3)

    def test_wrong_arguments_are_named(self):
        wrong = [
            (ValueError, "text", dict(text="auto", eye=(0, 0, 1))),
            (ValueError, "matrix", dict(matrix=np.zeros((4, 4)))),
            (ValueError, "matrix", dict(matrix=np.diag([1.0, 1, 0, 1]))),
            (ValueError, "matrix", dict(matrix=np.eye(4), eye=(0, 0, 1))),
            (ValueError, "target", dict(eye=(0, 0, 0))),
            (ValueError, "eye", dict(target=(0, 0, 0))),
            (ValueError, "eye", dict(eye=(0, 0))),
            (ValueError, "up", dict(eye=(0, 1, 0))),
            (ValueError, "fov_deg", dict(eye=(0, 0, 1), fov_deg=180)),
            (ValueError, "camera", dict(text="")),
            (ValueError, "text", dict(text="eye=0,0,5 shift=0.1,0", shift=(0.2, 0))),
        ]
        for error, name, arguments in wrong:
            with self.assertRaisesRegex(error, f"^{name}: ", msg=str(arguments)):
                estampe.Camera(**arguments)
        with self.assertRaises(estampe.Error):
            estampe.Camera("eye=1,2")


class Pages(unittest.TestCase):
    def test_copies(self):
        page = estampe.Page("A4", dpi=150)
        for other in (copy.copy(page), copy.deepcopy(page), pickle.loads(pickle.dumps(page))):
            self.assertIsInstance(other, estampe.Page)
            self.assertEqual(other, page)

    def test_sizes(self):
        page = estampe.Page("A4", dpi=150)
        self.assertEqual((page.width, page.height, page.height_mm), (1240, 1754, 297.0))
        self.assertEqual(estampe.Page("a4", dpi=150, landscape=True)[:2], (1754, 1240))
        self.assertEqual(estampe.Page("254x127mm", dpi=100)[:2], (1000, 500))
        for arguments in (("A7",), ("A4", 0.5), ("1x1mm",), ("A0", 10000), ("A4", float("nan"))):
            with self.assertRaises(ValueError):
                estampe.Page(*arguments)


if __name__ == "__main__":
    unittest.main()
