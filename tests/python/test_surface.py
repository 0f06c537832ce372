# SPDX-License-Identifier: MIT
"""What the package shows: every public name has a description and a type in the stub file."""

import ast
import inspect
import os
import tomllib
import unittest

import estampe

PACKAGE = os.path.dirname(estampe.__file__)


def public_names(thing):
    """The names of a class or module that users call; of what a class inherits only what the package defines."""
    return [name for name in vars(thing) if not name.startswith("_") or name in ("__getitem__", "__setitem__")]


class Surface(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(PACKAGE, "__init__.pyi"), encoding="utf-8") as file:
            self.stub = ast.parse(file.read())

    def stub_of(self):
        """Names of the stub: of the module, and of each class."""
        names = {}
        for node in self.stub.body:
            if isinstance(node, ast.ClassDef):
                names[node.name] = {
                    item.target.id if isinstance(item, ast.AnnAssign) else item.name
                    for item in node.body if isinstance(item, (ast.FunctionDef, ast.AnnAssign))}
            elif isinstance(node, ast.FunctionDef):
                names[node.name] = set()
            elif isinstance(node, ast.AnnAssign):
                names[node.target.id] = set()
        return names

    def test_every_name_is_in_the_stub(self):
        stub = self.stub_of()
        names = [name for name in stub if not name.startswith("_") or name == "__version__"]
        self.assertEqual(sorted(names), sorted(estampe.__all__))
        for name in estampe.__all__:
            thing = getattr(estampe, name)
            if not inspect.isclass(thing):
                continue
            shown = set(public_names(thing)) - ({"count", "index"} if issubclass(thing, tuple) else set())
            typed = {n for n in stub[name] if not n.startswith("_") or n in ("__getitem__", "__setitem__")}
            inherited = {n for base in thing.__mro__[1:-1] if base.__module__.startswith("estampe")
                         for n in public_names(base)}
            self.assertLessEqual(shown, typed | {"paper"}, name)
            self.assertLessEqual(typed, shown | inherited, name)

    def test_arguments_of_the_stub_are_those_of_the_module(self):
        for node in self.stub.body:
            if not isinstance(node, ast.ClassDef) or node.name not in ("Part", "Scene", "Camera", "Drawing"):
                continue
            for item in node.body:
                thing = getattr(getattr(estampe, node.name), getattr(item, "name", ""), None)
                if not isinstance(item, ast.FunctionDef) or not callable(thing) or item.name.startswith("__get"):
                    continue
                for argument in item.args.args[1:] + item.args.kwonlyargs:
                    self.assertIn(f"{argument.arg}:", thing.__doc__, f"{node.name}.{item.name}")

    def test_everything_is_described(self):
        self.assertTrue(estampe.__doc__)
        for name in estampe.__all__:
            thing = getattr(estampe, name)
            if name == "__version__":
                continue
            self.assertTrue(thing.__doc__, name)
            if inspect.isclass(thing):
                self.assertIn("estampe", (thing.__module__,), name)
                for member in public_names(thing):
                    value = inspect.getattr_static(thing, member)
                    if callable(value) or isinstance(value, (property, staticmethod, classmethod)):
                        doc = getattr(thing, member).__doc__
                        text = doc.partition("\n\n")[2] if doc and "self: " in doc.partition("\n")[0] else doc
                        self.assertTrue(text, f"{name}.{member}")

    def test_help_names_the_package_alone(self):
        for name in estampe.__all__:
            thing = getattr(estampe, name)
            members = vars(thing) if inspect.isclass(thing) else {}
            docs = [thing.__doc__] + [getattr(thing, member).__doc__ for member in members]
            for doc in docs:
                for word in ("::", "SharedScene", "CameraChoice", "LitScene"):
                    self.assertNotIn(word, doc or "", name)

    def test_errors_are_exceptions(self):
        self.assertTrue(issubclass(estampe.Error, RuntimeError))
        self.assertTrue(issubclass(estampe.DeviceLost, estampe.Error))
        self.assertEqual((estampe.Error("text").where, estampe.Error("text").remedy), ("", ""))

    def test_package_is_typed(self):
        self.assertTrue(os.path.exists(os.path.join(PACKAGE, "py.typed")))
        with open(os.path.join(os.environ["ESTAMPE_SOURCE"], "pyproject.toml"), "rb") as file:
            self.assertEqual(tomllib.load(file)["project"]["version"], estampe.__version__)


if __name__ == "__main__":
    unittest.main()
