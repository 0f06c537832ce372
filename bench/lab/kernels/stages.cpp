// SPDX-License-Identifier: MIT
// Experiments with the stage that does the work: compute or fragment shader, vertices or pixels.
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_grid_frag.hpp"
#include "shaders/lab_grid_vert.hpp"
#include "shaders/lab_page_vert.hpp"
#include "shaders/lab_stage_comp.hpp"
#include "shaders/lab_stage_frag.hpp"

namespace estampe::lab::kernels {

Experiment stages(gpu::Device& device, Effort effort)
{
    const uint32_t side = by_effort(effort, 128U, 1024U, 4096U);
    Experiment made;
    made.images.push_back(texture_of(device, side, gpu::Format::r32ui, scattered));
    for (const uint32_t steps : {0U, 256U}) {
        const size_t first = made.kernels.size();
        for (const bool by_fragments : {false, true}) {
            Kernel kernel{.name =
                              fmt::format("{}, by {}", steps == 0 ? "a copy" : fmt::format("{} steps", steps),
                                          by_fragments ? "fragments" : "compute"),
                          .numbers = {.threads = side * side, .rounds = steps, .a = 0, .b = 0},
                          .size_px = {side, side},
                          .leaves_picture = true,
                          .texture = made.images.front().get(),
                          .against = first,
                          .is_right = [steps](uint32_t index, uint32_t word) {
                              return word == stirred(scattered(index), steps);
                          }};
            if (by_fragments) {
                kernel.vertex = &shaders::lab_page_vert;
                kernel.fragment = &shaders::lab_stage_frag;
            } else {
                kernel.compute = &shaders::lab_stage_comp;
            }
            made.kernels.push_back(std::move(kernel));
        }
    }
    return made;
}

/// A page of two triangles, of some triangles, and of more triangles than pixels.
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
