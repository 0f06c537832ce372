#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the page that lists every approximation of the techniques, from the tables "Approximations" of their READMEs.

Usage: tools/approximations.py            writes docs/reference/approximations.md
       tools/approximations.py --check    a test: each technique has a row, each row names a test that exists and a
                                          figure that was measured, and the page is up to date
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
TECHNIQUES = ROOT / "src" / "techniques"
PAGE = ROOT / "docs" / "reference" / "approximations.md"
COLUMNS = ["approximation", "measured against", "required", "measured", "test"]
HEADER = """# Approximations

A technique that draws in real time computes many things only approximately. Each table below lists the approximations
of one technique, the ground truth that a test compares the approximation with, the largest error that the test allows,
and the measured error. The tests run on lavapipe with `script/test`. The tables come from the READMEs of the
techniques; `tools/approximations.py` puts them together.
"""


def rows_of(readme):
    """The cells of each row of the table "Approximations" of a README."""
    rows = []
    inside = False
    for line in readme.read_text().splitlines():
        if line.startswith("## "):
            inside = line == "## Approximations"
        elif inside and line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip().strip("|").split("|")])
    return [row for row in rows if row != COLUMNS and set("".join(row)) != {"-"}]


def page_of(rows_of_folder):
    """The text of the page."""
    text = HEADER
    for folder, rows in rows_of_folder.items():
        text += f"\n## [{folder}](../../src/techniques/{folder}/README.md)\n\n"
        text += "| " + " | ".join(COLUMNS) + " |\n|---|---|---|---|---|\n"
        text += "".join("| " + " | ".join(row) + " |\n" for row in rows)
    return text


def names_of_tests():
    """Suite.Name of all tests in the sources."""
    macro = re.compile(r"\b(?:TYPED_TEST|TEST)(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)")
    names = set()
    for folder in ("src", "tests", "app", "worlds"):
        for source in (ROOT / folder).rglob("*_test.cpp"):
            names.update(".".join(match) for match in macro.findall(source.read_text()))
    return names


def check(rows_of_folder):
    """What is wrong, as sentences."""
    failures = []
    tests = names_of_tests()
    for technique in sorted(path for path in TECHNIQUES.iterdir() if path.is_dir()):
        if not any(folder.split("/")[0] == technique.name for folder in rows_of_folder):
            failures.append(f"src/techniques/{technique.name} lists no approximation in its README.md")
    for folder, rows in rows_of_folder.items():
        for row in rows:
            if len(row) != len(COLUMNS) or not all(row):
                failures.append(f"src/techniques/{folder}/README.md: a row needs {len(COLUMNS)} filled cells: {row}")
                continue
            name = row[4].strip("`")
            if name not in tests:
                failures.append(f"src/techniques/{folder}/README.md: there is no test {name}")
            if "?" in row[3] or not re.search(r"\d|equal|none", row[3]):
                failures.append(f"src/techniques/{folder}/README.md: nothing measured for: {row[0]}")
    if not PAGE.exists() or PAGE.read_text() != page_of(rows_of_folder):
        failures.append("docs/reference/approximations.md is not up to date: run tools/approximations.py")
    return failures


def main():
    readmes = sorted(TECHNIQUES.rglob("README.md"))
    rows_of_folder = {str(readme.parent.relative_to(TECHNIQUES)): rows_of(readme) for readme in readmes}
    rows_of_folder = {folder: rows for folder, rows in rows_of_folder.items() if rows}
    if sys.argv[1:] == ["--check"]:
        failures = check(rows_of_folder)
        for failure in failures:
            print("FAILED:", failure, file=sys.stderr)
        return 1 if failures else 0
    if sys.argv[1:]:
        print(__doc__, file=sys.stderr)
        return 1
    PAGE.write_text(page_of(rows_of_folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())
