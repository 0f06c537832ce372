// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_grid_frag.hpp"
#include "shaders/lab_grid_vert.hpp"

namespace estampe::lab::kernels {

/// A page in two triangles, in some, and in more than it has pixels.
Experiment corners(gpu::Device& /*device*/, Effort effort)
{
    constexpr uint32_t at_corners = 1;
    const uint32_t side = by_effort(effort, 64U, 512U, 2048U);
    Experiment made;
    for (const uint32_t squares : {1U, side / 16U, side}) {
        const size_t first = made.kernels.size();
        for (const bool by_vertex : {false, true}) {
            const uint32_t triangles = 2U * squares * squares;
            made.kernels.push_back(
                {.name = fmt::format("{} triangles, work at {}", triangles, by_vertex ? "corners" : "pixels"),
                 .vertex = &shaders::lab_grid_vert,
                 .fragment = &shaders::lab_grid_frag,
                 .variant = by_vertex ? at_corners : 0U,
                 .numbers = {.threads = side * side, .rounds = 128, .a = squares, .b = 0},
                 .size_px = {side, side},
                 .picture = gpu::Format::r32f,
                 .vertex_count = 3U * triangles,
                 .against = first,
                 .is_right = [side](uint32_t index, uint32_t word) {
                     const float wanted =
                         (static_cast<float>(index % side) + 0.5F) / static_cast<float>(side);
                     return std::abs(std::bit_cast<float>(word) - wanted) < 1e-3F;
                 }});
        }
    }
    return made;
}

} // namespace estampe::lab::kernels
