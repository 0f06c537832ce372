// SPDX-License-Identifier: MIT
#pragma once

// What the strokes of each draw follow, decided from the style and what the meshes can offer.

#include <cstdint>
#include <vector>

#include "techniques/hatch/hatch.hpp"
#include "techniques/pose/mesh_data.hpp"

namespace estampe::frame {

struct StrokePlan {
    std::vector<uint32_t> kind_of_draw; ///< numbered as in shaders/stroke_kind.glsl.h
    uint32_t present = 0;               ///< a bit for each kind that occurs

    [[nodiscard]] bool has(uint32_t kind) const { return (present >> kind & 1U) != 0; }
};

/// UVs are followed only where there are any; the ground, which has neither UVs nor form, keeps to the solid.
/// Cost: linear in draws.
[[nodiscard]] StrokePlan plan_strokes(const pose::MeshData& meshes, hatch::Coordinates wanted);

} // namespace estampe::frame
