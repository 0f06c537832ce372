// SPDX-License-Identifier: MIT
#include "lab/kernels/kernels.hpp"
#include "shaders/lab_loops_comp.hpp"

namespace estampe::lab::kernels {
namespace {

constexpr uint32_t by_hand = 0;
constexpr uint32_t known = 1;
constexpr uint32_t uniform_count = 2;
constexpr uint32_t own_count = 3;
constexpr uint32_t as_long_as_any = 4;
constexpr uint32_t most = 15;

} // namespace

/// Eight turns, or from 1 to 15 that are 8 on average.
Experiment loops(gpu::Device& /*device*/, Effort effort)
{
    const uint32_t threads = by_effort(effort, 1U << 12U, 1U << 18U, 1U << 23U);
    Experiment made;
    const auto add = [&](const char* name, uint32_t variant, uint32_t block) {
        const Numbers numbers{.threads = threads, .rounds = 16, .a = block, .b = 8};
        const bool is_own = variant == own_count || variant == as_long_as_any;
        made.kernels.push_back({.name = name,
                                .compute = &shaders::lab_loops_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .is_right = [=](uint32_t index, uint32_t word) {
                                    const uint32_t turns = is_own ? scattered(index / block) % most + 1U : 8U;
                                    return word == stirred(index, turns * numbers.rounds);
                                }});
    };
    add("8 turns, written out by hand", by_hand, 1);
    add("8 turns, known to the compiler", known, 1);
    add("8 turns, known when the frame is drawn", uniform_count, 1);
    add("1 to 15 turns, blocks of 64 threads alike", own_count, 64);
    add("1 to 15 turns, each thread its own", own_count, 1);
    add("15 turns for all, of which 1 to 15 count", as_long_as_any, 1);
    return made;
}

} // namespace estampe::lab::kernels
