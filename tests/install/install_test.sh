#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What is installed under a prefix of its own is found by CMake and by pkg-config, draws, and hides what is Estampe's own.
# Usage: install_test.sh CMAKE BUILD ESTAMPE_FOLDER MAKE_EXAMPLE [PYTHON]     PYTHON, where its module is built
set -euo pipefail
cmake="$1"
build="$2"
root="$3"
# shellcheck source=tests/support/harness.sh
source "$(dirname "${BASH_SOURCE[0]}")/../support/harness.sh"
# quietly COMMAND...: its output is shown where it fails
quietly() {
    "$@" >"$folder/log" 2>&1 || { cat "$folder/log" >&2; wrong "$*"; exit 1; }
}

quietly "$cmake" --install "$build" --prefix "$folder/first"
mv "$folder/first" "$folder/prefix" # no file may know where it was put
prefix="$folder/prefix"
libraries="$(dirname "$(find "$prefix" -name 'libestampe.so')")"
! grep -rlF -e "$root" -e "$folder" "$prefix/include" "$libraries/cmake" "$libraries/pkgconfig" ||
    wrong "these files name the folder of the build"
for file in share/man/man1/estampe.1.gz share/bash-completion/completions/estampe \
    share/mime/packages/estampe.xml share/icons/hicolor/scalable/apps/estampe.svg; do
    [[ -s "$prefix/$file" ]] || wrong "$file is not installed"
done
"$prefix/bin/estampe" --version >/dev/null || wrong "the installed program does not start"
desktop="$prefix/share/applications/estampe.desktop"
if [[ -f "$root/app/viewer/viewer.cpp" ]] && { [[ ! -f "$desktop" ]] || ! "$prefix/bin/estampe" "$(awk '/^Exec=/ { print $2 }' "$desktop")" --help >/dev/null 2>&1; }; then
    wrong "the desktop entry is missing, or opens a command that is none"
fi

# Names of C++ below estampe:: alone; the loader's variables, named as Vulkan's functions, would be taken for a host's.
for library in estampe estampe_bake; do
    shown="$(nm --dynamic --defined-only --demangle --format=posix "$libraries/lib$library.so" |
        grep -vE '^(typeinfo |typeinfo name |vtable |guard variable |VTT )?(for )?estampe::|^(non-)?virtual thunk to estampe::' || true)"
    [[ -z "$shown" ]] || wrong "lib$library.so shows $(head -n 5 <<<"$shown")"
done

"$4" "$folder/scene.glb" >/dev/null
# draws PROGRAM
draws() {
    rm -f "$folder/picture.png"
    LD_LIBRARY_PATH="$libraries" "$1" "$folder/scene.glb" "$folder/picture.png"
    [[ "$(head -c 4 "$folder/picture.png" | tail -c 3)" == PNG ]] || wrong "$1 draws no PNG"
}
quietly "$cmake" -S "$root/examples/installed" -B "$folder/found" -G Ninja -DCMAKE_PREFIX_PATH="$prefix"
quietly "$cmake" --build "$folder/found"
draws "$folder/found/installed"
! readelf --dynamic "$folder/found/installed" | grep NEEDED | grep -vE 'libestampe\.so|libstdc\+\+|libgcc_s|libc\.so|libm\.so' ||
    wrong "who links Estampe is linked to more than that"

# asks WORDS: whether find_package(estampe WORDS) is content
asks() {
    printf 'cmake_minimum_required(VERSION 3.25)\nproject(asks LANGUAGES CXX)\nfind_package(estampe %s REQUIRED)\n' "$1" >"$folder/CMakeLists.txt"
    "$cmake" -G Ninja -S "$folder" -B "$folder/asked" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null 2>&1
}
asks "0.1 COMPONENTS bake" || wrong "the component bake is not found"
! asks 9 || wrong "version 9 is found"
! asks "0.1 COMPONENTS film" || wrong "a component that is none is found"

export PKG_CONFIG_PATH="$libraries/pkgconfig"
# shellcheck disable=SC2046 # flags are words
quietly c++ -std=c++20 "$root/examples/installed/main.cpp" -o "$folder/packaged" $(pkg-config --cflags --libs estampe)
draws "$folder/packaged"

if [[ -n "${5:-}" ]]; then
    cat >"$folder/draw.py" <<'EOF'
import os
import sys

import estampe

assert os.path.realpath(estampe.__file__).startswith(os.path.realpath(sys.argv[1])), estampe.__file__
renderer = estampe.Renderer("cpu")
renderer.set_scene(estampe.Scene.load(sys.argv[2]))
renderer.render("auto", width=64, height=36).save(sys.argv[3])
EOF
    module="$(dirname "$(find "$prefix" -path '*/estampe/__init__.py')")"
    for file in __init__.pyi py.typed; do
        [[ -f "$module/$file" ]] || wrong "$file is not installed"
    done
    shown="$(nm --dynamic --defined-only --format=posix "$module"/_estampe.*.so | grep -v '^PyInit__estampe ' || true)"
    [[ -z "$shown" ]] || wrong "the extension shows $(head -n 5 <<<"$shown")"
    rm -f "$folder/picture.png"
    quietly env LD_LIBRARY_PATH="$libraries" PYTHONPATH="$(dirname "$module")" "$5" -B "$folder/draw.py" "$prefix" \
        "$folder/scene.glb" "$folder/picture.png"
    [[ "$(head -c 4 "$folder/picture.png" | tail -c 3)" == PNG ]] || wrong "the installed module draws no PNG"
fi
[[ $failures -eq 0 ]]
