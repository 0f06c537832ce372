// SPDX-License-Identifier: MIT
// Experiments with branches, loops, early exits, and code that a compiler removes.
#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_branches_comp.hpp"
#include "shaders/lab_dead_comp.hpp"
#include "shaders/lab_loops_comp.hpp"
#include "shaders/lab_min_comp.hpp"
#include "shaders/lab_page_vert.hpp"
#include "shaders/lab_stay_comp.hpp"
#include "shaders/lab_stay_frag.hpp"

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

/// Half of the threads do one thing and half do another, in alternating blocks of threads. In the first
/// kernel the blocks are so large that no subgroup of any device contains both.
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

namespace {

constexpr uint32_t by_hand = 0;
constexpr uint32_t known = 1;
constexpr uint32_t uniform_count = 2;
constexpr uint32_t own_count = 3;
constexpr uint32_t as_long_as_any = 4;
constexpr uint32_t most = 15;

} // namespace

/// Loops of eight rounds, or of 1 to 15 rounds, which are 8 on average.
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

namespace {

constexpr uint32_t leaves_early = 1;

uint32_t left_at(uint32_t index, uint32_t side, uint32_t block, uint32_t rounds)
{
    const uint32_t x = index % side;
    const uint32_t y = index / side;
    const bool stays = scattered(y / block * 4096U + x / block) % 10U == 0U;
    return stays ? stirred(y * 4096U + x, rounds) : 0U;
}

} // namespace

/// One square of pixels in ten has work to do. In squares of 1 pixel, the pixels with work are scattered.
Experiment leaving(gpu::Device& /*device*/, Effort effort)
{
    const uint32_t side = by_effort(effort, 128U, 512U, 4096U);
    Experiment made;
    const auto add = [&](const std::string& name, bool leaves, uint32_t block, bool by_fragments,
                         size_t against) {
        const Numbers numbers{.threads = side * side, .rounds = 128, .a = block, .b = side};
        Kernel kernel{.name = name,
                      .variant = leaves ? leaves_early : 0U,
                      .numbers = numbers,
                      .size_px = {side, side},
                      .against = against,
                      .is_right = [=](uint32_t index, uint32_t word) {
                          return word == left_at(index, side, block, numbers.rounds);
                      }};
        if (by_fragments) {
            kernel.vertex = &shaders::lab_page_vert;
            kernel.fragment = &shaders::lab_stay_frag;
        } else {
            kernel.compute = &shaders::lab_stay_comp;
        }
        made.kernels.push_back(std::move(kernel));
    };
    for (const bool by_fragments : {false, true}) {
        const std::string stage = by_fragments ? "fragment: " : "compute: ";
        const size_t first = made.kernels.size();
        add(stage + "all work, nine in ten for nothing", false, 1, by_fragments, first);
        for (const uint32_t block : {1U, 2U, 4U, 8U, 32U}) {
            add(stage + fmt::format("nine squares in ten of {0} x {0} leave", block), true, block,
                by_fragments, first);
        }
    }
    return made;
}

namespace {

constexpr uint32_t limit = 0xc0000000U; // a quarter of all numbers is greater

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

/// Every kernel writes a 1, plus at most the sum of 16 numbers below 1 times 1e-8.
Experiment dead_code(gpu::Device& device, Effort effort)
{
    const uint32_t log_side = by_effort(effort, 8U, 10U, 12U);
    const uint32_t mask = (1U << (2U * log_side)) - 1U;
    Experiment made;
    made.images.push_back(texture_of(device, 1U << log_side, gpu::Format::r32f, [](uint32_t p) {
        return std::bit_cast<uint32_t>(static_cast<float>(p % 251U) / 251.0F);
    }));
    const Numbers numbers{.threads = by_effort(effort, 1U << 12U, 1U << 16U, 1U << 22U),
                          .rounds = 0, // a zero that the compiler cannot know
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
