// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_reads_comp.hpp"

namespace estampe::lab::kernels {
namespace {

constexpr uint32_t each_needs_the_last = 1;
constexpr uint32_t eight = 2;

uint32_t sum_of_reads(uint32_t thread, const Numbers& numbers, uint32_t count)
{
    uint32_t p = scattered(thread) & numbers.a;
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count * numbers.rounds; ++i) {
        p = next_of(p) & numbers.a;
        sum += p;
    }
    return sum;
}

} // namespace

/// The texture holds at each texel the number of the next, which the shader can also work out: so the same
/// places are read, with the same outcome, whether a read waits for the one before or not.
Experiment reads(gpu::Device& device, Effort effort)
{
    const uint32_t log_side = by_effort(effort, 8U, 10U, 12U);
    const uint32_t mask = (1U << (2U * log_side)) - 1U;
    Experiment made;
    made.images.push_back(texture_of(device, 1U << log_side, gpu::Format::r32ui,
                                     [&](uint32_t p) { return next_of(p) & mask; }));
    const uint32_t many = by_effort(effort, 1U << 12U, 1U << 17U, 1U << 22U);
    const auto add = [&](const std::string& name, uint32_t variant, uint32_t threads, uint32_t rounds,
                         size_t against) {
        const Numbers numbers{.threads = threads, .rounds = rounds, .a = mask, .b = log_side};
        const uint32_t count = (variant & eight) != 0 ? 8 : 2;
        made.kernels.push_back({.name = name,
                                .compute = &shaders::lab_reads_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .texture = made.images.front().get(),
                                .against = against,
                                .is_right = [numbers, count](uint32_t index, uint32_t word) {
                                    return word == sum_of_reads(index, numbers, count);
                                }});
    };
    add("2 reads, independent", 0, many, 4, 0);
    add("2 reads, the second needs the first", each_needs_the_last, many, 4, 0);
    add("8 reads, independent", eight, many, 1, 2);
    add("8 reads, each needs the last", eight | each_needs_the_last, many, 1, 2);
    const uint32_t rounds = by_effort(effort, 2U, 1024U, 128U);
    add("8 reads, independent, 64 threads in all", eight, 64, rounds, 4);
    add("8 reads, each needs the last, 64 threads in all", eight | each_needs_the_last, 64, rounds, 4);
    return made;
}

} // namespace estampe::lab::kernels
