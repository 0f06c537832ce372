#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Two shaders of one file name would be one symbol: the second is refused. Usage: namesake_test.sh CMAKE ESTAMPE_FOLDER
set -euo pipefail
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cat >"$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(namesakes LANGUAGES NONE)
set(PROJECT_SOURCE_DIR "$2")
include("$2/cmake/shaders.cmake")
add_library(estampe_hatch STATIC empty.cpp)
add_library(estampe_light STATIC empty.cpp)
estampe_shaders(hatch hatch/clear.comp)
estampe_shaders(light light/clear.comp)
END
touch "$folder/empty.cpp"
if "$1" -G Ninja -S "$folder" -B "$folder/build" >"$folder/log" 2>&1 || ! grep -q 'Two shaders are named clear.comp' "$folder/log"; then
    echo "FAILED: two shaders of one name were taken" >&2
    cat "$folder/log" >&2
    exit 1
fi
