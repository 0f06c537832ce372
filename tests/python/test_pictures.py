# SPDX-License-Identifier: MIT
"""Pictures of scenes that are known: their colours, their orientation, and the same bytes as from the program."""

import copy
import os
import pickle
import tempfile
import unittest

import numpy as np

import estampe
from helpers import FACING, QUAD, QUAD_TRIANGLES, SQUARE_GLB, plain_style, renderer, run_program, scene_of_quad

SIZE = {"width": 64, "height": 64}


def draw(scene, camera=FACING, style=None, **settings):
    renderer().set_scene(scene)
    return renderer().render(camera, style or plain_style(), **{**SIZE, **settings})


class Orientation(unittest.TestCase):
    def test_colours_stand_where_they_belong(self):
        image = np.array([[[255, 0, 0], [0, 255, 0]], [[0, 0, 255], [255, 255, 255]]], np.uint8)
        uvs = [[0, 1], [1, 1], [1, 0], [0, 0]]
        for camera in ("eye=0,0,5 target=0,0,0 ortho=1",
                       estampe.Camera(eye=(0, 0, 5), target=(0, 0, 0), half_height_m=1),
                       estampe.Camera(matrix=np.eye(4) + 5 * np.outer(np.eye(4)[2], np.eye(4)[3]), half_height_m=1)):
            picture = draw(scene_of_quad(image=image, uvs=uvs, unlit=True), camera)
            quarters = [[picture[y, x, :3].astype(int) for x in (8, 55)] for y in (8, 55)]
            for (y, x), channel in (((0, 0), 0), ((0, 1), 1), ((1, 0), 2)):
                color = quarters[y][x]
                self.assertEqual(int(color.argmax()), channel, (camera, y, x, color))
                self.assertGreater(color[channel] - np.delete(color, channel).max(), 60)
            self.assertGreater(quarters[1][1].min(), 200)

    def test_a_lens_shift_moves_the_picture(self):
        scene = scene_of_quad(unlit=True)
        renderer().set_scene(scene)
        straight = estampe.Camera(eye=(0, 0, 5), target=(0, 0, 0), half_height_m=2)
        shifted = estampe.Camera(eye=(0, 0, 5), target=(0, 0, 0), half_height_m=2, shift=(0.25, -0.125))
        text = "eye=0,0,5 target=0,0,0 ortho=2 shift=0.25,-0.125"
        self.assertEqual(shifted.shift, (0.25, -0.125))
        self.assertEqual(repr(shifted), f"<estampe.Camera {text}>")
        self.assertEqual(repr(estampe.Camera(text)), repr(shifted))
        self.assertRegex(repr(renderer()), "^<estampe.Renderer on .*>$")
        before = renderer().buffers(straight, plain_style(), **SIZE).objects
        after = renderer().buffers(shifted, plain_style(), **SIZE).objects
        self.assertEqual((before == 0).sum(), 32 * 32)
        np.testing.assert_array_equal(np.roll(before, (-8, -16), axis=(0, 1)), after)
        np.testing.assert_array_equal(renderer().buffers(text, plain_style(), **SIZE).objects, after)
        with self.assertRaisesRegex(ValueError, "^text: .*shift"):
            estampe.Camera("auto", shift=(0, 0))
        with self.assertRaisesRegex(ValueError, "shift"):
            estampe.Camera(eye=(0, 0, 5), shift=(np.nan, 0))

    def test_buffers_hold_distances_normals_and_numbers(self):
        renderer().set_scene(scene_of_quad(unlit=True))
        buffers = renderer().buffers("eye=0,0,5 target=0,0,0 ortho=2", plain_style(), **SIZE)
        self.assertEqual([array.dtype for array in buffers], [np.float32, np.float32, np.int32, np.int32])
        self.assertEqual([array.shape for array in buffers], [(64, 64), (64, 64, 3), (64, 64), (64, 64)])
        self.assertAlmostEqual(float(buffers.depth_m[32, 32]), 5.0, places=3)
        np.testing.assert_allclose(buffers.normals[32, 32], [0, 0, 1], atol=1e-3)
        self.assertEqual((buffers.objects[32, 32], buffers.materials[32, 32]), (0, 0))
        self.assertEqual((buffers.objects[0, 0], buffers.materials[0, 0]), (-1, -1))
        self.assertEqual(buffers.depth_m[0, 0], np.inf)

    def test_views_show_their_sides(self):
        scene = estampe.Scene()
        colors = {"front": (1, 0, 0), "right": (0, 1, 0), "top": (0, 0, 1)}
        turns = {"front": np.eye(3), "right": np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]),
                 "top": np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]])}
        for name, color in colors.items():
            material = scene.add_material(name, base_color=color, unlit=True)
            positions = (QUAD + [0, 0, 1]) @ turns[name].T
            scene.add_node(name, mesh=scene.add_mesh(name, estampe.Part(positions, QUAD_TRIANGLES, material=material)))
        for number, name in enumerate(colors):
            color = draw(scene, name)[32, 32, :3].astype(int)
            self.assertEqual(int(color.argmax()), number, (name, color))

    def test_parents_move_their_children(self):
        scene = estampe.Scene()
        scene.add_material(base_color=(1, 0, 0), unlit=True, double_sided=True)
        mesh = scene.add_mesh("quad", estampe.Part(QUAD * 0.25, QUAD_TRIANGLES))
        right, up = np.eye(4), np.eye(4)
        right[0, 3] = up[1, 3] = 0.5
        scene.add_node("child", up, mesh=mesh, parent=scene.add_node("parent", right))
        red = np.argwhere(draw(scene)[:, :, 1] < 160)
        self.assertAlmostEqual(len(red) / 64**2, 1 / 16, delta=0.01)
        np.testing.assert_allclose(red.mean(axis=0), [15.5, 47.5], atol=1.0)


    def test_nodes_are_placed(self):
        scene = scene_of_quad(base_color=(1, 0, 0), unlit=True)
        half_size_right = np.diag([0.25, 0.25, 0.25, 1.0])
        half_size_right[:3, 3] = 0.5, 0.5, 0
        expected = draw(scene)
        scene.set_matrix(0, half_size_right)
        moved = draw(scene)
        self.assertFalse(np.array_equal(expected, moved))
        scene.set_matrix(0, np.eye(4))
        np.testing.assert_array_equal(draw(scene), expected)
        renderer().place({0: half_size_right})
        np.testing.assert_array_equal(renderer().render(FACING, plain_style(), **SIZE), moved)
        sheared = np.eye(4)
        sheared[0, 1] = 0.5
        flat = np.diag([0.0, 1, 1, 1])
        for error, matrices in ((ValueError, {0: sheared}), (ValueError, {0: np.zeros((3, 3))}),
                                (ValueError, {0: flat}), (IndexError, {1: np.eye(4)}),
                                (TypeError, {"quad": np.eye(4)})):
            with self.assertRaisesRegex(error, "^matrices: "):
                renderer().place(matrices)

    def test_mirrored_nodes_are_placed(self):
        scene = scene_of_quad(base_color=(1, 0, 0), unlit=True, double_sided=True)
        mirrored = np.diag([-0.5, 0.25, 1.0, 1.0])
        mirrored[0, 3] = 0.25
        scene.set_matrix(0, mirrored)
        expected = draw(scene)
        scene.set_matrix(0, np.eye(4))
        draw(scene)
        renderer().place({0: mirrored})
        picture = renderer().render(FACING, plain_style(), **SIZE)
        self.assertLess(float((picture != expected).any(axis=2).mean()), 0.02)


class Tones(unittest.TestCase):
    def test_light_makes_the_quad_bright(self):
        style = plain_style()
        style["light.source"] = "scene"
        from_front = np.eye(4)
        from_behind = np.diag([1.0, 1, -1, 1])
        lit, shaded = (draw(scene_of_quad(light, base_color=(0.5, 0.5, 0.5)), style=style)[32, 32, :3].astype(int)
                       for light in (from_front, from_behind))
        self.assertGreater(lit.min(), shaded.max() + 40)

    def test_brightness_changes_the_tone(self):
        style = plain_style()
        style["light.source"] = "scene"
        scene = scene_of_quad(np.eye(4), base_color=(0.5, 0.5, 0.5))
        draw(scene, style=style)
        bright = renderer().render(FACING, style, **SIZE)[32, 32, :3].astype(int)
        renderer().set_brightness({0: 0.0})
        dark = renderer().render(FACING, style, **SIZE)[32, 32, :3].astype(int)
        self.assertGreater(bright.min(), dark.max() + 20)
        for error, intensities in ((IndexError, {1: 1.0}), (ValueError, {0: -1.0}), (TypeError, {0: "bright"})):
            with self.assertRaisesRegex(error, "^intensities: "):
                renderer().set_brightness(intensities)

    def test_hatching_gives_ink_where_it_is_dark(self):
        style = plain_style()
        style.update({"hatch.enabled": True, "wash.strength": 0, "light.source": "scene"})
        scenes = [scene_of_quad(light, base_color=(0.3, 0.3, 0.3)) for light in (np.eye(4), np.diag([1.0, 1, -1, 1]))]
        bright, dark = (255 - draw(scene, style=style, width=128, height=128)[:, :, :3].mean() for scene in scenes)
        self.assertGreater(dark, bright + 20)
        self.assertGreater(dark, 40)

    def test_transparent_paper(self):
        half = "eye=0,0,5 target=0,0,0 ortho=2"
        scene = scene_of_quad(base_color=(1, 0, 0), unlit=True)
        self.assertEqual(int(draw(scene, half)[..., 3].min()), 255)
        clear = draw(scene, half, transparent=True)
        self.assertAlmostEqual(float((clear[..., 3] > 0).mean()), 0.25, delta=0.02)
        self.assertEqual(int(draw(scene, half, transparent=False)[..., 3].min()), 255)


class SameAsProgram(unittest.TestCase):
    def test_bytes_are_those_of_the_program(self):
        scene = estampe.Scene.load(SQUARE_GLB)
        renderer().set_scene(scene)
        cases = [
            (None, "default", {}, []),
            ("auto", "comic+no-color", {}, ["--camera", "auto", "--style", "comic+no-color"]),
            ("isometric", "default", {}, ["--view", "isometric"]),
            ("square", "pencil", {"samples": 2}, ["--camera", "square", "--style", "pencil", "--samples", "2"]),
            ("azimuth=200 elevation=30", "default", {"transparent": True},
             ["--camera", "azimuth=200 elevation=30", "--transparent"]),
        ]
        with tempfile.TemporaryDirectory() as folder:
            for number, (camera, style, settings, options) in enumerate(cases):
                path = os.path.join(folder, f"{number}.png")
                run_program("render", SQUARE_GLB, "-o", path, "--size", "96x64", "--device", "cpu", *options)
                own = os.path.join(folder, f"own-{number}.png")
                style = estampe.Style(style)
                renderer().render(camera, style, width=96, height=64, **settings).save(own)
                with open(path, "rb") as theirs, open(own, "rb") as ours:
                    self.assertEqual(theirs.read(), ours.read(), (camera, style))

    def test_pages_are_those_of_the_program(self):
        scene = estampe.Scene.load(SQUARE_GLB)
        renderer().set_scene(scene)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.png")
            run_program("render", SQUARE_GLB, "-o", path, "--page", "A6", "--dpi", 20, "--landscape", "--device", "cpu")
            picture = renderer().render(page=estampe.Page("A6", dpi=20, landscape=True))
            np.testing.assert_array_equal(picture, estampe.load_image(path))


class Results(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = estampe.Scene.load(SQUARE_GLB)

    def setUp(self):
        renderer().set_scene(self.scene)

    def test_pictures_save_themselves(self):
        picture = renderer().render(style="pencil", **SIZE)
        self.assertIsInstance(picture, estampe.Picture)
        self.assertEqual((picture.shape, picture.dtype, type(picture.array)), ((64, 64, 4), np.uint8, np.ndarray))
        self.assertTrue(np.shares_memory(picture.array, picture))
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.png", "a.webp"):
                picture.save(os.path.join(folder, name))
                np.testing.assert_array_equal(estampe.load_image(os.path.join(folder, name)), picture)
            picture.save(os.path.join(folder, "a.jpg"), quality=95)
            with open(os.path.join(folder, "a.png"), "rb") as file:
                self.assertEqual(picture._repr_png_(), file.read())
            with self.assertRaisesRegex(ValueError, "path"):
                picture.save(os.path.join(folder, "a.gif"))
            with self.assertRaisesRegex(ValueError, "quality"):
                picture.save(os.path.join(folder, "b.jpg"), quality=0)
            with self.assertRaises(estampe.Error):
                picture.save(os.path.join(folder, "missing", "a.png"))
            self.assertEqual(sorted(os.listdir(folder)), ["a.jpg", "a.png", "a.webp"])
        self.assertIsNone(picture[..., 0]._repr_png_())

    def test_arithmetic_makes_plain_arrays(self):
        picture = renderer().render(style="pencil", **SIZE)
        for other in (picture * 0.5, 255 - picture, picture / 255, picture.mean(axis=0), np.sqrt(picture),
                      picture.astype(np.float32), picture == picture):
            self.assertIs(type(other), np.ndarray)
        for number in (picture.mean(), picture.max(), np.sum(picture), picture.any()):
            self.assertNotIsInstance(number, np.ndarray)
        for part in (picture[::2], picture[:, ::-1].copy(), picture.view()):
            self.assertIsInstance(part, estampe.Picture)
        kept = picture
        picture += 0
        self.assertIs(kept, picture)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.png")
            with self.assertRaisesRegex(TypeError, "float64"):
                (picture / 255).view(estampe.Picture).save(path)
            with self.assertRaisesRegex(ValueError, "^quality: "):
                picture.save(path, quality=50)
            with self.assertRaisesRegex(ValueError, "^quality: "):
                renderer().render_linear(**SIZE).save(os.path.join(folder, "a.exr"), quality=50)
            self.assertEqual(os.listdir(folder), [])
        clear = renderer().render_linear(transparent=True, **SIZE)
        for other in (pickle.loads(pickle.dumps(clear)), copy.copy(clear), copy.deepcopy(clear)):
            self.assertIsInstance(other, estampe.Picture)
            self.assertEqual(other.paper, clear.paper)
            np.testing.assert_array_equal(other, clear)

    def test_linear_pictures_encode_to_the_bytes(self):
        linear = renderer().render_linear(**SIZE).array
        self.assertEqual((linear.shape, linear.dtype), ((64, 64, 4), np.float32))
        c = np.clip(linear[..., :3], 0, 1)
        encoded = np.where(c <= 0.0031308, 12.92 * c, 1.055 * np.power(np.maximum(c, 1e-9), 1 / 2.4) - 0.055) * 255
        self.assertLess(np.abs(encoded - renderer().render(**SIZE)[..., :3]).max(), 2.0)
        clear = renderer().render_linear(transparent=True, **SIZE)
        self.assertEqual(len(clear.paper), 3)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.exr", "a.png"):
                clear.save(os.path.join(folder, name))
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 100)

    def test_layers_give_the_picture(self):
        layers = renderer().layers(style="comic", **SIZE)
        self.assertEqual(list(layers), ["paper", "wash", "hatch", "lines"])
        self.assertEqual(dict(layers).keys(), set(layers.keys()))
        self.assertEqual(layers.blend("wash"), "multiply")
        self.assertTrue(layers.is_visible("paper"))
        below = np.zeros((64, 64, 3), np.float32)
        for name, pixels in layers.items():
            self.assertEqual((pixels.shape, pixels.dtype), ((64, 64, 4), np.float32))
            color, alpha = pixels[..., :3], pixels[..., 3:]
            below = color * below if layers.blend(name) == "multiply" else color + (1 - alpha) * below
        np.testing.assert_allclose(layers.flattened()[..., :3], below, atol=1e-4)
        np.testing.assert_array_equal(layers.picture, renderer().render(style="comic", **SIZE))
        self.assertIn("ground", [mask.name for mask in layers.masks])
        with self.assertRaises(KeyError):
            layers["none of these"]
        self.assertIsNone(layers.get("none of these"))
        self.assertEqual(layers.get(3, "missing"), "missing")
        self.assertTrue(np.shares_memory(layers.get("wash"), layers["wash"]))
        self.assertEqual(layers._repr_png_(), layers.picture._repr_png_())
        self.assertIn("wash", repr(layers))
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.png", "a.psd", "a.b.c"):
                with self.assertRaisesRegex(ValueError, "^path: "):
                    layers.save(os.path.join(folder, name))
            self.assertEqual(os.listdir(folder), [])
            layers.save(os.path.join(folder, "ending.of.folder/"))
            self.assertIn("layers.json", os.listdir(os.path.join(folder, "ending.of.folder")))
            layers.save(os.path.join(folder, "A.ORA"))
            self.assertTrue(os.path.isfile(os.path.join(folder, "A.ORA")))
            layers.save(os.path.join(folder, "a.ora"))
            layers.save(os.path.join(folder, "a"))
            self.assertIn("layers.json", os.listdir(os.path.join(folder, "a")))
        before = layers.flattened()
        layers["lines"][:] = 0
        self.assertFalse(np.array_equal(layers.flattened(), before), "arrays share the memory of the layers")
        layers = renderer().layers(style="comic", **SIZE)
        lines = layers["lines"]
        del layers
        self.assertGreater(float(lines[..., 3].max()), 0.1)

    def test_strokes_lie_on_the_page(self):
        drawing = renderer().strokes("square", "comic", **SIZE)
        self.assertEqual(len(drawing), len(drawing.strokes))
        self.assertAlmostEqual(drawing.width_mm, 150, places=3)
        kinds = {stroke.kind for stroke in drawing}
        self.assertLessEqual({"hatch", "outline"}, kinds)
        for stroke in drawing:
            points = stroke.points
            self.assertEqual((points.dtype, points.shape[1]), (np.float32, 3))
            self.assertGreaterEqual(len(points), 2)
            self.assertGreaterEqual(float(points.min()), -0.01)
            self.assertLessEqual(float(points[:, :2].max()), 150.01)
            self.assertIn(stroke.object, drawing.objects)
        self.assertGreater(len(renderer().strokes("square", "comic", hidden=True, **SIZE)), len(drawing))
        last = drawing[-1].points
        np.testing.assert_array_equal(last, drawing[len(drawing) - 1].points)
        with self.assertRaises(IndexError):
            drawing[len(drawing)]
        with self.assertRaisesRegex(TypeError, "^number: "):
            drawing[1.5]
        self.assertEqual([len(stroke.points) for stroke in drawing[-3:]],
                         [len(stroke.points) for stroke in drawing.strokes[-3:]])
        self.assertIn("<svg", drawing._repr_svg_())
        self.assertIn(f"{len(drawing)} strokes", repr(drawing))
        for name in ("a.png", "a", "/nonexistent/a.pdf"):
            with self.assertRaisesRegex(ValueError, "^path: "):
                drawing.save(name)
        prepared = drawing.for_plotter()
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "a.svg")
            prepared.save(path, plotter=True)
            with open(path, encoding="utf-8") as file:
                self.assertIn("<svg", file.read())
        del drawing, prepared
        self.assertGreater(float(last.max()), 0)

    def test_motion_is_that_of_the_camera(self):
        scene = scene_of_quad(double_sided=True)
        renderer().set_scene(scene)
        moved = "eye=0.25,0,5 target=0.25,0,0 ortho=1"
        motion = renderer().motion(FACING, plain_style(), since_time_s=0.0, since_camera=moved, **SIZE)
        self.assertEqual((motion.shape, motion.dtype), ((64, 64, 4), np.float32))
        np.testing.assert_allclose(motion[32, 32, :2], [8, 0], atol=0.05)

    def test_films_repeat_themselves(self):
        def film():
            return [renderer().render("azimuth=%d elevation=20" % (10 + k), "comic", follows=k > 0, **SIZE)
                    for k in range(3)]
        first, second = film(), film()
        for a, b in zip(first, second):
            np.testing.assert_array_equal(a, b)
        self.assertFalse(np.array_equal(first[0], first[2]))

    def test_cameras_are_placed(self):
        style = estampe.Style()
        camera = estampe.Camera("auto").placed(self.scene, style, **SIZE)
        expected = renderer().render("auto", style, **SIZE)
        np.testing.assert_array_equal(renderer().render(camera, style, **SIZE), expected)
        self.assertEqual(camera.eye.shape, (3,))
        named = estampe.Camera("auto").placed(self.scene, "comic", **SIZE)
        same = estampe.Camera("auto").placed(self.scene, estampe.Style("comic"), **SIZE)
        self.assertEqual(named.eye.tolist(), same.eye.tolist())
        with self.assertRaisesRegex(TypeError, "^scene: "):
            camera.placed(None)
        with self.assertRaisesRegex(TypeError, "^style: "):
            camera.placed(self.scene, 3)

    def test_wrong_arguments_are_named(self):
        wrong = [
            (TypeError, "camera", dict(camera=3)),
            (TypeError, "style", dict(style=3)),
            (ValueError, "width", dict(width=0)),
            (ValueError, "height", dict(height=65536)),
            (TypeError, "width", dict(width="wide")),
            (TypeError, "width", dict(width=6.5)),
            (ValueError, "samples", dict(samples=0)),
            (ValueError, "time_s", dict(time_s=float("nan"))),
            (IndexError, "animation", dict(animation=5)),
            (ValueError, "animation", dict(animation="none of these")),
            (TypeError, "transparent", dict(transparent=3)),
            (TypeError, "page", dict(page="A4")),
            (ValueError, "page", dict(page=estampe.Page("A6", 20), width=8)),
            (ValueError, "page.width", dict(page=estampe.Page("A6", 20)._replace(width=-5))),
            (ValueError, "page", dict(page=estampe.Page("A6", 20)._replace(height=float("nan")))),
            (ValueError, "page.height_mm", dict(page=estampe.Page("A6", 20)._replace(height_mm=float("nan")))),
            (TypeError, "follows", dict(follows="yes")),
            (ValueError, "max_seconds", dict(max_seconds=-1)),
            (TypeError, "widht", dict(widht=8)),
        ]
        for error, name, arguments in wrong:
            with self.assertRaisesRegex(error, f"^{name}: ", msg=str(arguments)):
                renderer().render(**{**({} if "page" in arguments else SIZE), **arguments})
        for arguments in (dict(camera="none of these"), dict(style="none of these"), dict(transparent="water"),
                          dict(max_seconds=1e-9), dict(max_memory=1)):
            with self.assertRaises(estampe.Error, msg=str(arguments)):
                renderer().render(**SIZE, **arguments)
        with self.assertRaisesRegex(TypeError, "^scene: "):
            renderer().set_scene(None)
        with self.assertRaisesRegex(TypeError, "device"):
            estampe.Renderer(2.5)
        with self.assertRaises(estampe.Error):
            estampe.Renderer("none of these")


if __name__ == "__main__":
    unittest.main()
