#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the folders of the code and the includes between them as Graphviz text.

A box says how many files a folder has; the more includes, the thicker the arrow. Tests and generated headers are left out.
Usage: folder_arrows.py [ROOT] | dot -Tsvg
"""
import collections
import math
import os
import re
import subprocess
import sys

ROWS = [["app", "bench", "examples", "worlds"], ["frame"], ["features"], ["features/common"], ["techniques"],
        ["scene", "style", "gpu", "output"], ["core"]]


def folder_of(path):
    parts = path.split("/")
    if parts[0] != "src":
        return parts[0]
    return "/".join(parts[1:3]) if parts[1] == "features" and len(parts) > 3 else parts[1]


def row_of(folder):
    for number, names in enumerate(ROWS):
        if folder in names:
            return number
    return 2 if folder.startswith("features/") else None


def main():
    os.chdir(sys.argv[1] if len(sys.argv) > 1 else os.path.join(os.path.dirname(__file__), ".."))
    listed = subprocess.run(["git", "ls-files", "src", "app", "bench", "examples", "worlds"], check=True,
                            capture_output=True, text=True).stdout.split()
    sources = [path for path in listed if re.search(r"\.(cpp|hpp|h|glsl|comp|vert|frag)$", path)
               and not re.search(r"(^|[/_])test[_.]", path)]
    files = collections.Counter(folder_of(path) for path in sources)
    arrows = collections.Counter()
    for path in sources:
        with open(path, encoding="utf-8") as source:
            for included in re.findall(r'^\s*#\s*include "([^"]+)"', source.read(), re.MULTILINE):
                ends = folder_of(path), folder_of("src/" + included)
                if ends[0] != ends[1] and None not in map(row_of, ends):
                    arrows[ends] += 1
    print('digraph folders {\n  rankdir=TB; ranksep=0.5; nodesep=0.12; bgcolor=white;\n'
          '  node [shape=box, style="rounded,filled", fillcolor="#f7f3ea", color="#8a7a5c", fontname="Helvetica",'
          ' fontsize=11, margin="0.1,0.05"];\n  edge [color="#5c503c50", arrowsize=0.6];')
    for number in range(len(ROWS)):
        names = sorted(folder for folder in files if row_of(folder) == number)
        boxes = " ".join(f'"{name}" [label="{name.split("/")[-1]}\\n{files[name]}"];' for name in names)
        is_features = ROWS[number] == ["features"]
        print("  subgraph cluster_features { label=features; labeljust=l; color=\"#d8cdb6\"; fontname=Helvetica;"
              if is_features else "  {", f"rank=same; {boxes} }}")
    print('  worlds -> frame -> "features/cloth" [style=invis];')  # public headers alone lead from there
    for (start, end), count in sorted(arrows.items()):
        print(f'  "{start}" -> "{end}" [penwidth={0.5 + math.log(count) / 1.5:.1f}, tooltip="{count} includes"];')
    print("}")


main()
