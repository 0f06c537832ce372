# SPDX-License-Identifier: MIT
"""Styles as mappings."""

import copy
import os
import pickle
import tempfile
import unittest
from collections import abc

import numpy as np

import estampe
from helpers import renderer, run_program, scene_of_quad


class Styles(unittest.TestCase):
    def test_every_value_survives_being_set(self):
        for preset in ("default", "comic", "pencil", "blueprint+no-color"):
            style = estampe.Style(preset)
            fresh = estampe.Style()
            for key, value in style.items():
                self.assertIn(key, style)
                fresh[key] = value
            self.assertEqual(fresh.to_toml(), style.to_toml(), preset)

    def test_toml_is_that_of_the_program(self):
        self.assertEqual(estampe.Style("comic+no-color").to_toml(), run_program("styles", "comic+no-color"))

    def test_values_have_types(self):
        style = estampe.Style("comic")
        self.assertIsInstance(style["light.shadows"], bool)
        self.assertIsInstance(style["hatch.layers"], int)
        self.assertIsInstance(style["contour.ink"], str)
        style["hatch.width_mm"] = 0.3
        self.assertAlmostEqual(style["hatch.width_mm"], 0.3, places=6)
        style["hatch.width_mm"] = np.float32(0.5)
        self.assertEqual(style["hatch.width_mm"], 0.5)
        style["light.shadows"] = np.bool_(False)
        self.assertIs(style["light.shadows"], False)
        style["contour.ink"] = (1.0, 0.0, 0.0)
        self.assertEqual(style["contour.ink"], "#ff0000")
        style["contour.ink"] = np.array([0.0, 0.0, 1.0])
        self.assertEqual(style["contour.ink"], "#0000ff")
        style.set("hatch.layers=2")
        self.assertEqual(style["hatch.layers"], 2)
        style.update({"hatch.layers": 1, "tone.contrast": 2.0})
        self.assertEqual((style["hatch.layers"], style["tone.contrast"]), (1, 2.0))

    def test_is_a_mapping(self):
        style = estampe.Style()
        self.assertIsInstance(style, abc.Mapping)
        self.assertEqual(len(list(style)), len(style))
        self.assertGreater(len(style), 300)
        self.assertEqual(dict(style), dict(style.items()))
        self.assertNotIn("hatch.wdth_mm", style)
        self.assertNotIn(7, style)
        self.assertNotIn("", style)
        self.assertIsNone(style.get("hatch.wdth_mm"))
        self.assertEqual(style.get("hatch.width_mm"), style["hatch.width_mm"])

    def test_wrong_keys_and_values_are_named(self):
        style = estampe.Style()
        before = style.to_toml()
        with self.assertRaisesRegex(KeyError, "hatch.width_mm"):
            style["hatch.wdth_mm"]
        with self.assertRaisesRegex(estampe.Error, "width_mm"):
            style["hatch.wdth_mm"] = 1
        with self.assertRaisesRegex(estampe.Error, "hatch.width_mm"):
            style["hatch.width_mm"] = -1
        with self.assertRaisesRegex(estampe.Error, "hatch.width_mm"):
            style["hatch.width_mm"] = "wide"
        with self.assertRaisesRegex(ValueError, "hatch.width_mm"):
            style["hatch.width_mm"] = float("nan")
        with self.assertRaisesRegex(TypeError, "hatch.width_mm"):
            style["hatch.width_mm"] = None
        with self.assertRaises(TypeError):
            style[3] = 1
        with self.assertRaises(TypeError):
            style[3]
        with self.assertRaises(estampe.Error):
            style.set("hatch.width_mm")
        with self.assertRaises(estampe.Error):
            style["hatch.width_mm=2\nhatch.layers"] = 1
        self.assertEqual(style.to_toml(), before)

    def test_loading_fails_with_a_remedy(self):
        with self.assertRaises(estampe.Error) as caught:
            estampe.Style("penciil")
        self.assertIn("penciil", str(caught.exception))
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "mine.toml")
            with open(path, "w", encoding="utf-8") as file:
                file.write("[hatch]\nwidth_mm = 0.3\nlayers = 99\n")
            with self.assertRaises(estampe.Error) as caught:
                estampe.Style.load(path)
            self.assertIn("mine.toml:3:", caught.exception.where)
            self.assertEqual(caught.exception.args, (str(caught.exception),))

    def test_files_are_confined(self):
        with tempfile.TemporaryDirectory() as folder:
            inner = os.path.join(folder, "inner")
            os.mkdir(inner)
            for path, text in ((folder + "/outer.toml", "[hatch]\nlayers = 1\n"),
                               (inner + "/mine.toml", 'extends = "../outer.toml"\n')):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            self.assertEqual(estampe.Style(inner + "/mine.toml")["hatch.layers"], 1)
            with self.assertRaisesRegex(estampe.Error, "outer.toml"):
                estampe.Style(inner + "/mine.toml", confine=True)

    def test_confinement_knows_the_names_of_styles(self):
        with tempfile.TemporaryDirectory() as folder:
            uploads = os.path.join(folder, "a+b")
            os.mkdir(uploads)
            for path, text in ((folder + "/outer.toml", "[hatch]\nlayers = 1\n"),
                               (uploads + "/mine.toml", "[hatch]\nlayers = 2\n"),
                               (uploads + "/bad.toml", f'extends = "{folder}/outer.toml"\n')):
                with open(path, "w", encoding="utf-8") as file:
                    file.write(text)
            before = os.getcwd()
            os.chdir(folder)
            try:
                folders = estampe.Style(f"comic+{uploads}/mine.toml", confine=True)._folders
                self.assertEqual(folders, [os.fsencode(uploads)])
                self.assertEqual(estampe.Style(f"comic+default+{uploads}/mine.toml", confine=True)["hatch.layers"], 2)
                with self.assertRaisesRegex(estampe.Error, "outer.toml"):
                    estampe.Style(f"comic+{uploads}/bad.toml", confine=True)
            finally:
                os.chdir(before)

    def test_copies_of_confined_styles_are_confined(self):
        scene = scene_of_quad()
        renderer().set_scene(scene)
        with tempfile.TemporaryDirectory() as folder:
            brush = os.path.join(folder, "brush.png")
            np.full((8, 8, 4), 128, np.uint8).view(estampe.Picture).save(brush)
            style = estampe.Style("comic", confine=True)
            style["contour.brush"] = brush
            for other in (style, style.copy(), pickle.loads(pickle.dumps(style)), copy.deepcopy(style)):
                with self.assertRaisesRegex(estampe.Error, "brush.png"):
                    renderer().render("front", other, width=32, height=32)
            free = estampe.Style("comic")
            free["contour.brush"] = brush
            renderer().render("front", pickle.loads(pickle.dumps(free)), width=32, height=32)

    def test_types_depend_on_keys_alone(self):
        style = estampe.Style()
        style['material."brick*".hatch.width_mm'] = 2
        style["hatch.width_mm"] = 1
        for key in ("hatch.width_mm", 'material."brick*".hatch.width_mm'):
            self.assertIs(type(style[key]), float, key)
        style["contour.ink"] = (0.123, 0.4567, 0.3)
        self.assertEqual(style["contour.ink"], "#1f744c")
        self.assertEqual(pickle.loads(pickle.dumps(style)).to_toml(), style.to_toml())
        properties = estampe.Style.schema()["properties"]
        kinds = {"number": float, "integer": int, "boolean": bool, "string": str}
        for key, value in estampe.Style("pencil").items():
            section, _, name = key.partition(".")
            kind = properties[section].get("properties", {}).get(name, {}).get("type")
            if kind in kinds:
                self.assertIs(type(value), kinds[kind], key)

    def test_copies_are_independent(self):
        style = estampe.Style("pencil")
        for other in (style.copy(), copy.copy(style), copy.deepcopy(style), pickle.loads(pickle.dumps(style)),
                      estampe.Style(style)):
            self.assertIsInstance(other, estampe.Style)
            self.assertEqual(other, style)
            other["hatch.layers"] = 1 if style["hatch.layers"] != 1 else 2
            self.assertNotEqual(other, style)
        self.assertEqual(style, estampe.Style("pencil"))

    def test_keys_of_materials(self):
        style = estampe.Style()
        style['material."brick*".hatch.width_mm'] = 0.7
        self.assertAlmostEqual(style['material."brick*".hatch.width_mm'], 0.7, places=6)
        self.assertIn('material."brick*".hatch.width_mm', style)
        self.assertEqual(estampe.Style(style), style)
        self.assertEqual(pickle.loads(pickle.dumps(style)), style)

    def test_lists(self):
        self.assertIn("pencil", estampe.Style.presets())
        self.assertIn("no-color", estampe.Style.additions())
        self.assertTrue(estampe.Style.about("pencil"))
        self.assertIn("width_mm", estampe.Style.help("hatch"))
        schema = estampe.Style.schema()
        self.assertEqual(schema["properties"]["hatch"]["properties"]["width_mm"]["type"], "number")
        with self.assertRaises(estampe.Error):
            estampe.Style.about("none of these")
        with self.assertRaises(estampe.Error):
            estampe.Style.help("none of these")


if __name__ == "__main__":
    unittest.main()
