#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Two shaders of one file name would be one symbol: the second is refused, and so is a variant of that name. Variants of
# several names are taken. Usage: check_test.sh CMAKE ESTAMPE_FOLDER
set -euo pipefail
cmake=$1
sources=$2
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
touch "$folder/empty.cpp"

# configures SHADERS: whether a project that declares these can be configured
configures() {
    cat >"$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(namesakes LANGUAGES CXX)
set(PROJECT_SOURCE_DIR "$sources")
include("$sources/cmake/shaders.cmake")
add_library(estampe_hatch STATIC empty.cpp)
add_library(estampe_light STATIC empty.cpp)
$1
END
    rm -rf "$folder/build"
    "$cmake" -G Ninja -S "$folder" -B "$folder/build" >"$folder/log" 2>&1
}

wrong() {
    echo "FAILED: $1" >&2
    cat "$folder/log" >&2
    exit 1
}

hatch='estampe_shaders(hatch hatch/clear.comp)'
for light in 'estampe_shaders(light light/clear.comp)' 'estampe_shader_variants(light light/fill.comp VARIANT clear ZERO)'; do
    if configures "$hatch
$light" || ! grep -q 'Two shaders are named clear.comp' "$folder/log"; then
        wrong "two shaders of one name were taken: $light"
    fi
done
configures "$hatch
estampe_shader_variants(light light/fill.comp
  VARIANT fill
  VARIANT fill_masked MASKED ROWS=4)" || wrong "variants of two names were refused"
commands="$(sed -n '/COMMAND = /p' "$folder/build/build.ninja")"
[[ $(grep -c -- '-DMASKED -DROWS=4 .*light/fill.comp' <<<"$commands") == 1 ]] || wrong "a variant has not its macros"
[[ $(grep -c 'light/fill.comp' <<<"$commands") == 2 ]] || wrong "a source of two variants is not compiled twice"
