// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_branches_comp.hpp"

namespace estampe::lab::kernels {
namespace {

constexpr uint32_t does_both = 1;
constexpr uint32_t in_a_line = 2;
constexpr uint32_t steps_in_line = 32;

uint32_t worked_on(uint32_t thread, uint32_t block, uint32_t steps)
{
    uint32_t x = thread;
    for (uint32_t i = 0; i < steps; ++i) {
        x = (thread / block) % 2 == 0 ? stir(x) : stir_otherwise(x);
    }
    return x;
}

} // namespace

/// Half of the threads do one thing and half the other, by turns of so many; in the first kernel so many that
/// no group of any device holds both.
Experiment branches(gpu::Device& /*device*/, Effort effort)
{
    constexpr uint32_t coherent = 4096;
    const uint32_t threads = by_effort(effort, 1U << 14U, 1U << 18U, 1U << 24U);
    Experiment made;
    const auto add = [&](const std::string& name, uint32_t variant, uint32_t block, size_t against) {
        const Numbers numbers{.threads = threads, .rounds = 64, .a = block, .b = 0};
        const uint32_t steps = (variant & in_a_line) != 0 ? steps_in_line : numbers.rounds;
        made.kernels.push_back({.name = name,
                                .compute = &shaders::lab_branches_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .against = against,
                                .is_right = [block, steps](uint32_t index, uint32_t word) {
                                    return word == worked_on(index, block, steps);
                                }});
    };
    add("two loops, by blocks of 4096", 0, coherent, 0);
    for (const uint32_t block : {1U, 2U, 4U, 8U, 16U, 32U, 64U, 128U}) {
        add(fmt::format("two loops, by blocks of {}", block), 0, block, 0);
    }
    add("both loops, and choose", does_both, coherent, 0);
    const size_t in_line = made.kernels.size();
    add("32 steps in a line, by blocks of 4096", in_a_line, coherent, in_line);
    for (const uint32_t block : {1U, 8U, 32U, 64U}) {
        add(fmt::format("32 steps in a line, by blocks of {}", block), in_a_line, block, in_line);
    }
    add("both in a line, and choose", in_a_line | does_both, coherent, in_line);
    return made;
}

} // namespace estampe::lab::kernels
