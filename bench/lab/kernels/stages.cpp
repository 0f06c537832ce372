// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
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

} // namespace estampe::lab::kernels
