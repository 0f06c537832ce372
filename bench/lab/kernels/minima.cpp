// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_min_comp.hpp"

namespace estampe::lab::kernels {
namespace {

constexpr uint32_t limit = 0xc0000000U; // a quarter of all numbers is above

uint32_t limited(uint32_t x, uint32_t rounds)
{
    for (uint32_t r = 0; r < rounds; ++r) {
        x = std::min(stir(x + r), limit);
        for (int i = 0; i < 3; ++i) {
            x = std::min(stir(x), limit);
        }
    }
    return x;
}

} // namespace

Experiment minima(gpu::Device& /*device*/, Effort effort)
{
    const Numbers numbers{
        .threads = by_effort(effort, 1U << 12U, 1U << 18U, 1U << 23U), .rounds = 32, .a = limit, .b = 0};
    Experiment made;
    uint32_t variant = 0;
    for (const char* const name :
         {"min(x, a)", "if (x > a) x = a", "x > a ? a : x", "(1 - over) x + over a"}) {
        made.kernels.push_back({.name = name,
                                .compute = &shaders::lab_min_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .is_right = [numbers](uint32_t index, uint32_t word) {
                                    return word == limited(index, numbers.rounds);
                                }});
        ++variant;
    }
    return made;
}

} // namespace estampe::lab::kernels
