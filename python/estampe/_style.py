# SPDX-License-Identifier: MIT
"""Styles as mappings from keys to values."""

import difflib
import functools
import json
import math
import numbers
import re
import tomllib

import numpy as np

from . import _estampe

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_SEGMENT = re.compile(r"""\s*(?:"((?:[^"\\]|\\.)*)"|'([^']*)'|([A-Za-z0-9_-]+))\s*(?:\.|$)""")


class Style(_estampe.Style):
    """All drawing parameters of a picture: a mapping from keys, such as "hatch.width_mm", to values.

    Style() holds the default of every parameter. Style("comic") is a preset, Style("mine.toml") a file, and
    Style("comic+no-color") joins several: each part overrides the parameters that it sets. With `confine` only files in
    the folders of the named files are read, for styles of strangers. Raises Error with file, line and column, the key,
    and the allowed values.

    With `confine` and presets alone, no file is read at all. Copies and pickles keep the limit.

    Values are bool, int, float or str; colours are texts such as "#1b1a22". Setting a value also takes a colour as
    three sRGB numbers from 0 to 1. The type of a value depends on its key alone, as schema() says: a colour is always a
    text, rounded to 8 bits per component, and a number of type "number" always a float.
    Keys can be limited to materials or objects: 'material."brick*".hatch.width_mm'.
    """

    def __init__(self, name="default", confine=False):
        if isinstance(name, _estampe.Style):
            if confine:
                raise ValueError("confine: is only valid with the name of a style")
            super().__init__(name)
            self._folders = getattr(name, "_folders", [])
        else:
            self._folders = _estampe.Style._folders_of(name) if confine else []
            super().__init__(name, self._folders)
        # What _values() has read, with the token that the style had then. Each change makes a token.
        self._token = object()
        self._known = (None, {})

    @classmethod
    def load(cls, name, confine=False):
        """Read a preset, a file, or several joined by '+'. The same as Style(name, confine)."""
        return cls(name, confine)

    def copy(self):
        """Return a copy, whose changes do not change this style."""
        return type(self)(self)

    __copy__ = copy

    def __deepcopy__(self, memo):
        return self.copy()

    def __reduce__(self):
        return _from_toml, (self.to_toml(), self._folders)

    def set(self, assignment):
        """Apply one assignment, such as "hatch.contrast=12".

        Raises Error for an unknown key, with the nearest known one, and for a value that is not allowed.
        """
        try:
            super().set(assignment)
        finally:
            self._token = object()

    def __setitem__(self, key, value):
        """Set a parameter. Raises Error for an unknown key or a value that is not allowed, TypeError for its type."""
        self.set(f"{_key(key)}={_toml_of(value, key)}")

    def __getitem__(self, key):
        """Return the value of a parameter. Raises KeyError, with the nearest known key, if there is none."""
        values = self._values()
        try:
            return values[_key(key)]
        except KeyError:
            near = difflib.get_close_matches(str(key), values, 1)
            raise KeyError(f"{key}: is no parameter" + (f"; did you mean {near[0]}?" if near else "")) from None

    def __contains__(self, key):
        """Return whether the style has a parameter of this key."""
        return isinstance(key, str) and bool(_segments(key)) and _key(key) in self._values()

    def __len__(self):
        """Return the number of parameters."""
        return len(self._values())

    def __iter__(self):
        """Iterate over the keys of all parameters."""
        return iter(self._values())

    def __eq__(self, other):
        """Return whether all parameters of two styles are equal."""
        return self.to_toml() == other.to_toml() if isinstance(other, _estampe.Style) else NotImplemented

    __hash__ = None

    def __repr__(self):
        return f"<estampe.Style of {len(self)} parameters>"

    def keys(self):
        """Return a view of the keys of all parameters."""
        return self._values().keys()

    def values(self):
        """Return a view of the values of all parameters."""
        return self._values().values()

    def items(self):
        """Return a view of (key, value) of all parameters."""
        return self._values().items()

    def get(self, key, default=None):
        """Return the value of a parameter, or `default` if there is none of this key."""
        return self[key] if key in self else default

    def update(self, *values, **more):
        """Set several parameters of a mapping, or of (key, value) pairs. Equal to setting each in turn."""
        for key, value in dict(*values, **more).items():
            self[key] = value

    @staticmethod
    def schema():
        """Return the JSON schema (2020-12) of style files as a dict: types, ranges, defaults and help of all keys."""
        return json.loads(_estampe.Style._json_schema())

    def _values(self):
        token, values = self._known
        if token is not self._token:
            token = self._token
            values = {key: _typed(key, value) for key, value in _flat(tomllib.loads(self.to_toml()), "")}
            self._known = token, values
        return values


def _from_toml(text, folders):
    """Return the style that to_toml() wrote, with its files limited to folders, if there are any."""
    style = Style()
    defaults = dict(_flat(tomllib.loads(style.to_toml()), ""))
    for key, value in _flat(tomllib.loads(text), ""):
        if defaults.get(key) != value:
            style[key] = value
    if folders:
        style._limit_files(folders)
        style._folders = folders
    return style


@functools.cache
def _float_keys():
    """Return the keys, section and name, of all parameters that are numbers with a fraction."""
    sections = Style.schema()["properties"]
    return frozenset(path for path, kind in _kinds(sections, "") if kind == "number")


def _kinds(properties, before):
    for name, about in properties.items():
        yield before + name, about.get("type")
        yield from _kinds(about.get("properties", {}), before + name + ".")


def _typed(key, value):
    """Return a value of TOML in the type that all values of its parameter have."""
    if isinstance(value, list):  # a colour that 8 bits do not hold
        return "#" + "".join(f"{round(255 * component):02x}" for component in value)
    if isinstance(value, int) and not isinstance(value, bool):
        names = _segments(key)
        # A key of a material or an object is that of the style after the name of the material.
        known = ".".join(names[2:] if names[0] in ("material", "object") else names)
        return float(value) if known in _float_keys() else value
    return value


def _flat(table, before):
    for name, value in table.items():
        key = before + (name if _BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False))
        if isinstance(value, dict):
            yield from _flat(value, key + ".")
        else:
            yield key, value


def _segments(key):
    """Split a key at its dots, but not within quotes. The list is empty if the key is not well formed."""
    names = []
    at = 0
    while at < len(key):
        found = _SEGMENT.match(key, at)
        if found is None:
            return []
        quoted, literal, bare = found.groups()
        names.append(re.sub(r"\\(.)", r"\1", quoted) if quoted is not None else bare if bare is not None else literal)
        at = found.end()
    return names


def _key(key):
    """Return a key in the one form that is compared: names are quoted only where that is necessary."""
    if not isinstance(key, str):
        raise TypeError(f"key: {key!r} is not a text")
    names = _segments(key)
    return ".".join(n if _BARE.fullmatch(n) else json.dumps(n, ensure_ascii=False) for n in names) or key


def _toml_of(value, key):
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise ValueError(f"{key}: {value} is not finite")
        return repr(float(value))
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_toml_of(item, key) for item in value) + "]"
    raise TypeError(f"{key}: {value!r} is not a bool, a number, a text or a colour")
