// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <estampe/scene.hpp>

#include "scene/static_triangles.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::bake {

/// Changes with everything that a map depends on: places, normals, materials, pictures and settings.
[[nodiscard]] uint64_t work_fingerprint(const Scene& scene, const StaticTriangles& triangles,
                                        const BakeSettings& settings);

} // namespace estampe::bake
