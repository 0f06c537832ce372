// SPDX-License-Identifier: MIT
#pragma once

// What the strokes of each draw follow, decided from the style and what the meshes can offer.

#include <cstdint>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "features/common/looks.hpp"
#include "shaders/stroke_kind.glsl.h"
#include "techniques/hatch/hatch.hpp"
#include "techniques/shadow/local/edge_look.hpp"

namespace estampe::features {

struct StrokePlan {
    std::vector<uint32_t> kind_of_draw; ///< numbered as in shaders/stroke_kind.glsl.h
    uint32_t present = 0;               ///< a bit for each kind that occurs
    glm::vec2 ground_wind{1.0F, 0.0F};  ///< horizontal direction x, z

    [[nodiscard]] bool has(uint32_t kind) const { return (present >> kind & 1U) != 0; }

    /// Whether some strokes follow height, wind, light or slope.
    [[nodiscard]] bool has_directions() const
    {
        return has(shared::strokes_height) || has(shared::strokes_wind) || has(shared::strokes_light) ||
               has(shared::strokes_slope);
    }
};

/// The wish of each surface's look, or that for a single material by `hatch.materials`. UVs are followed only
/// where there are any; grounds have no form, dunes keep to their slopes. The list takes `room`. Throws Error
/// when `hatch.materials` cannot be read, or names what is not there. Cost: linear in draws.
[[nodiscard]] StrokePlan plan_strokes(const pose::MeshData& meshes, const std::vector<Material>& materials,
                                      const LookPlan& looks, std::vector<uint32_t> room = {});

/// The lines of the hatching that edges of shadows can follow; none where no lines are drawn.
[[nodiscard]] std::optional<shadow::HatchedLines>
hatched_lines(const hatch::HatchStyle& style, const glm::vec3& towards_light, const StrokePlan& strokes);

} // namespace estampe::features
