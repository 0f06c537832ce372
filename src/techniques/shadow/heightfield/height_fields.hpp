// SPDX-License-Identifier: MIT
#pragma once

// What all methods of height shadows have in common.

#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {

/// A horizon as good as upright.
inline constexpr float steepest_slope = 1e6F;

struct HeightFields {
    glm::uvec2 size;
    uint32_t count;      ///< of the fields
    glm::dvec2 sunwards; ///< unit, over the field
    double elevation_rad;
    shared::SunConstants sun;
};

/// Throws std::logic_error as add_height_shadow().
[[nodiscard]] HeightFields height_fields_of(const gpu::Graph& graph, const HeightShadowInputs& in);

/// r16f, as large as all fields.
[[nodiscard]] gpu::ImageId height_result(gpu::Graph& graph, const char* name, const HeightFields& fields);

} // namespace estampe::shadow
