// SPDX-License-Identifier: MIT
#include <bit>
#include <cmath>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_dead_comp.hpp"

namespace estampe::lab::kernels {

/// Every kernel leaves a 1, but for what 16 numbers below 1 add when they are multiplied by 1e-8.
Experiment dead_code(gpu::Device& device, Effort effort)
{
    const uint32_t log_side = by_effort(effort, 8U, 10U, 12U);
    const uint32_t mask = (1U << (2U * log_side)) - 1U;
    Experiment made;
    made.images.push_back(texture_of(device, 1U << log_side, gpu::Format::r32f, [](uint32_t p) {
        return std::bit_cast<uint32_t>(static_cast<float>(p % 251U) / 251.0F);
    }));
    const Numbers numbers{.threads = by_effort(effort, 1U << 12U, 1U << 16U, 1U << 22U),
                          .rounds = 0, // the zero that no compiler knows
                          .a = mask,
                          .b = log_side};
    uint32_t variant = 0;
    for (const char* const name : {"16 reads, times 0.00000001", "16 reads, times 0.00000000",
                                   "16 reads, times a zero not known before", "16 reads, not used",
                                   "16 reads, used in a case that never comes", "one place read 16 times"}) {
        made.kernels.push_back({.name = name,
                                .compute = &shaders::lab_dead_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .texture = made.images.front().get(),
                                .is_right = [](uint32_t, uint32_t word) {
                                    return std::abs(std::bit_cast<float>(word) - 1.0F) < 1e-6F;
                                }});
        ++variant;
    }
    return made;
}

} // namespace estampe::lab::kernels
