// SPDX-License-Identifier: MIT
#pragma once

// Functions that all methods of height-field shadows share.

#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {

/// Slope of a horizon that counts as vertical.
inline constexpr float steepest_slope = 1e6F;

struct HeightFields {
    glm::uvec2 size;
    uint32_t count;
    glm::dvec2 sunwards; ///< unit vector towards the sun in field coordinates
    double elevation_rad;
    shared::SunConstants sun;
};

/// Checks the inputs of a height-field shadow. Throws std::logic_error in the cases that add_height_shadow()
/// documents.
[[nodiscard]] HeightFields height_fields_of(const gpu::Graph& graph, const HeightShadowInputs& in);

/// Creates an r16f image as large as all height fields together.
[[nodiscard]] gpu::ImageId height_result(gpu::Graph& graph, const char* name, const HeightFields& fields);

} // namespace estampe::shadow
