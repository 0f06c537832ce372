#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The check of include directions sees each kind of wrong include, and lets right ones pass.
set -euo pipefail
check="$(cd "$(dirname "$0")" && pwd)/check"
tree="$(mktemp -d)"
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/src/{core,scene,style,gpu,frame,features/common,features/smoke,features/ink,techniques/hatch/alternatives,techniques/light,techniques/shadow} \
    "$tree"/{app,bench,examples,python,tests/support,worlds/hill}

# write FILE INCLUDE: one file with one include
write() { printf '#include "%s"\n' "$2" >"$tree/$1"; }

write app/main.cpp frame/frame.hpp
write src/frame/frame.cpp techniques/hatch/hatch.hpp
write src/frame/plan.cpp features/smoke/smoke.hpp
write src/features/smoke/smoke.cpp features/common/view.hpp
write src/features/ink/ink.cpp techniques/hatch/hatch.hpp
write src/techniques/hatch/hatch.cpp gpu/device.hpp
write src/techniques/hatch/own.cpp techniques/hatch/hatch.hpp
write src/techniques/hatch/public.cpp estampe/scene.hpp
write src/techniques/hatch/hatch.comp shaders/noise.glsl
write src/techniques/hatch/hatch_gpu_test.cpp techniques/light/light.hpp
write src/techniques/light/light.comp techniques/shadow/lookup.glsl
write src/techniques/hatch/dispatch.cpp techniques/hatch/alternatives/other.hpp
write src/techniques/hatch/alternatives/other_test.cpp techniques/hatch/alternatives/other.hpp
write bench/hatches.cpp techniques/hatch/alternatives/other.hpp
write src/scene/scene.cpp core/file.hpp
write src/scene/scene_test_support.hpp support/drawing.hpp
write bench/speed.cpp scene/pose.hpp
write tests/support/drawing.cpp frame/frame.hpp
write worlds/hill/hill.cpp estampe/scene.hpp
write app/options.cpp world/registry.hpp
write python/bind.cpp estampe/scene.hpp
write app/options_test.cpp hill/hill.hpp
bash "$check" "$tree" || { echo "right includes were refused"; exit 1; }

failures=0
expect_refused() {
    write "$1" "$2"
    if bash "$check" "$tree" >/dev/null; then
        echo "not seen: $1 includes $2"
        failures=1
    fi
    rm "$tree/$1"
}
expect_refused src/core/bad.cpp scene/scene.hpp
expect_refused src/scene/bad.cpp style/schema.hpp
expect_refused src/gpu/bad.hpp techniques/hatch/hatch.hpp
expect_refused src/techniques/hatch/bad.cpp techniques/light/light.hpp
expect_refused src/techniques/hatch/bad.comp techniques/light/light.glsl.h
expect_refused src/techniques/light/bad.cpp techniques/shadow/map.glsl.h
expect_refused src/techniques/light/bad.comp techniques/shadow/map.hpp
expect_refused src/techniques/shadow/bad.glsl techniques/light/light.glsl.h
expect_refused src/techniques/light/bad.cpp frame/frame.hpp
expect_refused src/features/smoke/bad.cpp features/ink/ink.hpp
expect_refused src/features/common/bad.cpp features/ink/ink.hpp
expect_refused src/features/smoke/bad.cpp frame/frame.hpp
expect_refused src/techniques/hatch/bad.cpp features/common/view.hpp
expect_refused src/frame/bad.cpp techniques/hatch/alternatives/other.hpp
expect_refused src/frame/bad_test.cpp techniques/hatch/alternatives/other.hpp
expect_refused src/techniques/light/bad.cpp techniques/hatch/alternatives/other.hpp
expect_refused tests/support/bad.cpp techniques/hatch/alternatives/other.hpp
expect_refused src/frame/bad.cpp app/text.hpp
expect_refused src/frame/bad.cpp bench/speed.hpp
expect_refused src/frame/bad.cpp support/drawing.hpp
expect_refused src/frame/bad.cpp scene/scene_test_support.hpp
expect_refused worlds/hill/bad.cpp scene/shapes.hpp
expect_refused python/bad.cpp scene/shapes.hpp
expect_refused app/bad.cpp hill/hill.hpp
expect_refused bench/bad.cpp app/text.hpp
expect_refused bench/bad.cpp support/drawing.hpp
expect_refused tests/support/bad.cpp app/text.hpp
expect_refused tests/support/bad.hpp bench/speed.hpp
exit "$failures"
