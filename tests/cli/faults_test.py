#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the program while one call after another fails: memory, threads, writing, renaming, Vulkan.

Each run must end with status 1 and one line of error, or with status 0 and the bytes of the undisturbed run. A run
leaves no temporary file, no half output and no changed input. The numbers of the failing calls are spread over all
calls that an undisturbed run makes, for as long as the budget lasts.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

# Words of the C++ library and of the system that must not reach the user.
FORBIDDEN = re.compile(
    r"bad_alloc|terminate|[Aa]ssert|runtime error|Sanitizer|std::|basic_string|vector::|core dumped|filesystem error")
ALLOWED = re.compile(r"estampe: (note: |warning: |(film|batch|bake|frame): +\d+ %)")
RUN_LIMIT_S = 120

# The result that the failing Vulkan call gives: out of host memory, out of device memory, device lost.
VULKAN = {"vulkan-host": -1, "vulkan-memory": -2, "vulkan-lost": -4}
# Kinds of failing_calls.cpp, each as a single failure, and those that fail again and again once they fail.
ONCE = ["memory", "thread", "map", "write", "sync", "create", "rename", "process"]
FROM_ON = ["memory", "thread", "write", "create", "rename", "process"]


def png(side_px: int) -> bytes:
    """A PNG file with a checkerboard."""
    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = b"".join(
        b"\0" + b"".join(b"\xff\xff\xff" if (x // 2 + y // 2) % 2 else b"\x40\x60\xa0" for x in range(side_px))
        for y in range(side_px))
    head = struct.pack(">IIBBBBB", side_px, side_px, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")


def cube() -> bytes:
    """A binary glTF file: a textured cube that turns, on a floor."""
    positions, uvs, indices = [], [], []
    for axis in range(3):
        for side in (-1.0, 1.0):
            first = len(positions)
            for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                place = [0.0, 0.0, 0.0]
                place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, u * side, v
                positions.append(place)
                uvs.append([(u + 1) / 2, (v + 1) / 2])
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    picture = png(8)
    parts = [
        b"".join(struct.pack("<3f", *p) for p in positions),
        b"".join(struct.pack("<2f", *uv) for uv in uvs),
        b"".join(struct.pack("<H", i) for i in indices),
        struct.pack("<2f", 0.0, 1.0),
        struct.pack("<8f", 0, 0, 0, 1, 0, 0.70710678, 0, 0.70710678),
        picture + b"\0" * (-len(picture) % 4),
    ]
    views, at = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": at, "byteLength": len(part)})
        at += len(part)
    accessors = [
        {"bufferView": 0, "componentType": 5126, "count": 24, "type": "VEC3", "min": [-1, -1, -1], "max": [1, 1, 1]},
        {"bufferView": 1, "componentType": 5126, "count": 24, "type": "VEC2"},
        {"bufferView": 2, "componentType": 5123, "count": 36, "type": "SCALAR"},
        {"bufferView": 3, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
        {"bufferView": 4, "componentType": 5126, "count": 2, "type": "VEC4"},
    ]
    primitive = {"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}
    document = json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "name": "cube"},
                  {"mesh": 0, "name": "floor", "scale": [4, 0.1, 4], "translation": [0, -1.2, 0]}],
        "meshes": [{"primitives": [primitive]}],
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicFactor": 0}}],
        "textures": [{"source": 0}], "images": [{"bufferView": 5, "mimeType": "image/png"}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
                        "samplers": [{"input": 3, "output": 4}]}],
        "buffers": [{"byteLength": at}], "bufferViews": views, "accessors": accessors}).encode()
    document += b" " * (-len(document) % 4)
    body = struct.pack("<II", len(document), 0x4E4F534A) + document + struct.pack("<II", at, 0x004E4942) + b"".join(parts)
    return struct.pack("<4sII", b"glTF", 2, 12 + len(body)) + body


TRIANGLE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="f" count="9">0 0 0 1 0 0 0 1 0</float_array><technique_common>
<accessor source="#f" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry>
</library_geometries><library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>
"""

JOBS = """[defaults]
size = "48x32"
[[job]]
scene = "cube.glb"
output = "one.png"
[[job]]
scene = "cube.glb"
output = "two.svg"
style = "pen-sketch"
"""

SMALL = ["--size", "48x32", "--device", "cpu"]
COMMANDS = {
    "render": ["render", "cube.glb", "-o", "a.png", *SMALL],
    "files": ["render", "cube.glb", "-o", "a.exr", "--motion", "motion.exr", "--layers", "layers", "--time", "0.5", *SMALL],
    "film": ["render", "cube.glb", "-o", "frames/%d.png", "--frames", "3", *SMALL],
    "clip": ["render", "cube.glb", "-o", "clip.gif", "--frames", "2", *SMALL],
    "child": ["render", "triangle.dae", "-o", "a.jpg", *SMALL],  # a process of its own reads the file
    "bake": ["bake", "cube.glb", "-o", "map.exr", "--size", "64", "--samples", "2"],
    "batch": ["batch", "jobs.toml", "--device", "cpu"],
}


def content(path: pathlib.Path) -> str:
    """What a file holds; reports of a batch differ in their times alone."""
    data = path.read_bytes()
    if path.name.endswith(".report.json"):
        report = json.loads(data)
        return "report of %d" % len(report["jobs"])
    return hashlib.sha256(data).hexdigest()


def files_in(folder: pathlib.Path) -> dict:
    """The content of all files, by their paths."""
    return {str(path.relative_to(folder)): content(path) for path in sorted(folder.rglob("*")) if path.is_file()}


class Suite:
    """The program, its inputs, and what it writes where nothing fails."""

    def __init__(self, options, folder: pathlib.Path):
        self.estampe = str(pathlib.Path(options.estampe).resolve())
        self.layer = pathlib.Path(options.layer).resolve()
        self.is_cold = options.cold
        self.folder = folder
        self.inputs = folder / "inputs"
        self.inputs.mkdir()
        (self.inputs / "cube.glb").write_bytes(cube())
        (self.inputs / "triangle.dae").write_text(TRIANGLE)
        (self.inputs / "jobs.toml").write_text(JOBS)
        self.input_files = files_in(self.inputs)
        self.wanted = {}
        self.counts = {}

    def run(self, scenario: str, name: str, more: dict):
        """Runs a command in a new folder; returns the folder, the status, and what was said."""
        work = self.folder / name
        shutil.copytree(self.inputs, work)
        cache = str(self.folder / (f"{name}.cache" if self.is_cold else "cache"))
        environment = dict(os.environ, XDG_CACHE_HOME=cache, MESA_SHADER_CACHE_DIR=cache,
                           LD_PRELOAD=str(self.layer / "libestampe_failing_calls.so"), **more)
        environment.pop("GALLIVM_PERF", None)
        with subprocess.Popen([self.estampe, *COMMANDS[scenario]], cwd=work, env=environment, text=True, errors="replace",
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as running:
            try:
                said, _ = running.communicate(timeout=RUN_LIMIT_S)
                return work, running.returncode, said
            except subprocess.TimeoutExpired:
                running.kill()
                said, _ = running.communicate()
                return work, None, said
            finally:
                if self.is_cold:
                    shutil.rmtree(cache, ignore_errors=True)

    def prepare(self, scenario: str):
        """Draws without failures, and counts the calls of each kind. The second run finds what the first has cached."""
        counted = self.folder / f"{scenario}.calls"
        for turn in ("warm", "counted"):
            more = self.layer_environment(None)
            if turn == "counted":
                more["ESTAMPE_COUNT_CALLS"] = str(counted)
            work, status, said = self.run(scenario, f"{scenario}-{turn}", more)
            if status != 0:
                raise RuntimeError(f"{scenario} without failures ends with {status}: {said}")
            self.wanted[scenario] = files_in(work)
            shutil.rmtree(work)
        counts = dict(line.split() for line in counted.read_text().splitlines())
        self.counts[scenario] = {kind: int(count) for kind, count in counts.items()}

    def layer_environment(self, failure):
        """The environment under which the layer counts, and lets a call fail."""
        more = {"VK_LAYER_PATH": str(self.layer), "VK_INSTANCE_LAYERS": "VK_LAYER_ESTAMPE_failing"}
        if failure is not None:
            more["ESTAMPE_FAIL"] = failure
        return more

    def problems_of(self, scenario: str, kind: str, number: int, count: int):
        """Lets one call fail, or with a count of 0 all from this one on, and returns what is wrong about the end."""
        if kind in VULKAN:
            more = self.layer_environment(f"any:{number}:{VULKAN[kind]}")
        else:
            more = {"ESTAMPE_FAIL_CALLS": f"{kind}:{number}:{count}"}
        work, status, said = self.run(scenario, f"{scenario}-{kind}-{number}-{count}", more)
        problems = list(self.check(scenario, work, status, said))
        shutil.rmtree(work)
        return [f"{problem}\n    {said.strip()[-1500:]}" for problem in problems[:1]]

    def check(self, scenario: str, work: pathlib.Path, status, said: str):
        """What is wrong about a run."""
        if status is None:
            yield f"does not end within {RUN_LIMIT_S} s"
            return
        if status not in (0, 1):
            yield f"ends with {status}"
            return
        if (found := FORBIDDEN.search(said)) is not None:
            yield f"says {found.group()}"
        lines = [line for line in said.splitlines() if not ALLOWED.match(line)]
        errors = [line for line in lines if line.startswith("estampe: error: ")]
        if len(lines) != len(errors) or len(errors) != status:
            yield f"has {len(errors)} lines of error and {len(lines) - len(errors)} others with status {status}"
        try:
            there = files_in(work)
        except ValueError as problem:
            yield f"a report is no JSON: {problem}"
            return
        for name, wanted in self.input_files.items():
            if there.get(name) != wanted:
                yield f"changes its input {name}"
        for name, found in there.items():
            if ".part-" in name or ".estampe-" in name:
                yield f"leaves {name}"
            elif name not in self.wanted[scenario]:
                # Work that was stopped keeps its progress, to be taken up again.
                if status == 0 or not (name.endswith("film-state") or ".partial" in name):
                    yield f"leaves {name}"
            elif found != self.wanted[scenario][name]:
                yield f"{name} differs"
        # One command writes all of its files or none; films and batches keep what is done.
        outputs = set(self.wanted[scenario]) - set(self.input_files)
        if status == 1 and scenario not in ("film", "clip", "batch") and outputs & set(there):
            yield f"fails, and writes {sorted(outputs & set(there))[0]}"
        if status == 0 and set(there) != set(self.wanted[scenario]):
            yield f"does not write {sorted(set(self.wanted[scenario]) - set(there))}"


def spread(count: int, seed: int):
    """1 and count, then all numbers between, each once: any few of them in a row lie evenly."""
    yield from dict.fromkeys([1, count])
    size = 1 << max(count - 1, 1).bit_length()
    step = int(size * 0.6180339887) | 1
    for i in range(size):
        number = 1 + (seed + i) * step % size
        if 1 < number < count:
            yield number


def turns(series):
    """One number of each series after the other, until all are used up."""
    running = list(series)
    while running:
        for each in list(running):
            try:
                head, numbers = each
                yield (*head[:2], next(numbers), head[2])
            except StopIteration:
                running.remove(each)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("estampe")
    parser.add_argument("layer", help="folder of the libraries that let calls fail")
    parser.add_argument("--seconds", type=float, default=0.0, help="budget of the runs with failures; 0: every call of every kind")
    parser.add_argument("--seed", type=int, default=0, help="where the numbers of calls begin")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--cold", action="store_true", help="nothing is cached on disk; each run compiles all shaders")
    parser.add_argument("--only", metavar="SCENARIO:KIND[:NUMBER[:COUNT]]", help="one series, or one run")
    parser.add_argument("--most", type=int, default=10, help="ends after this many findings")
    options = parser.parse_args()

    only = options.only.split(":") if options.only else None
    scenarios = [only[0]] if only else list(COMMANDS)
    with tempfile.TemporaryDirectory(prefix="estampe-faults-") as folder:
        suite = Suite(options, pathlib.Path(folder))
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            list(pool.map(suite.prepare, scenarios))
        begun = time.monotonic()
        series = []
        for scenario in scenarios:
            counts = suite.counts[scenario]
            every = [(kind, 1, counts[kind]) for kind in ONCE] + [(kind, 0, counts[kind]) for kind in FROM_ON]
            every += [(kind, 1, counts.get("vulkan", 0)) for kind in VULKAN]
            series += [((scenario, kind, count), spread(calls, options.seed)) for kind, count, calls in every
                       if calls > 0 and (only is None or only[1] == kind)]
        todo = turns(series)
        if only and len(only) > 2:
            todo = iter([(only[0], only[1], int(only[2]), int(only[3]) if len(only) > 3 else 1)])
        runs, findings = 0, 0
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            waiting = {}
            is_open = True
            while is_open or waiting:
                while is_open and len(waiting) < options.jobs:
                    is_late = options.seconds > 0 and time.monotonic() - begun > options.seconds
                    work = None if is_late or findings >= options.most else next(todo, None)
                    is_open = work is not None
                    if is_open:
                        waiting[pool.submit(suite.problems_of, *work)] = work
                done, _ = concurrent.futures.wait(waiting, return_when=concurrent.futures.FIRST_COMPLETED)
                for future in done:
                    work = ":".join(str(part) for part in waiting.pop(future))
                    runs += 1
                    for problem in future.result():
                        findings += 1
                        print(f"FAILED: --only {work}: {problem}", flush=True)
        for scenario, counts in sorted(suite.counts.items()):
            print(f"{scenario}: " + ", ".join(f"{count} {kind}" for kind, count in counts.items() if count > 0))
        print(f"{runs} runs, {findings} findings")
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
