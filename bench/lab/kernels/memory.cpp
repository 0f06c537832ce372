// SPDX-License-Identifier: MIT
// Experiments with reads: whether reads depend on each other, in which order they come, and what hides their
// latency.
#include <array>

#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_live_128_comp.hpp"
#include "shaders/lab_live_32_comp.hpp"
#include "shaders/lab_live_4_comp.hpp"
#include "shaders/lab_memory_comp.hpp"
#include "shaders/lab_reads_comp.hpp"
#include "shaders/lab_shared_comp.hpp"
#include "shaders/lab_texels_comp.hpp"

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

/// Each texel holds the number of the next texel. The shader can also compute this number. So dependent and
/// independent reads read the same texels and give the same result.
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

namespace {

constexpr uint32_t reads_a_thread = 16;
constexpr uint32_t side_by_side = 0;
constexpr uint32_t own_run = 1;
constexpr uint32_t anywhere = 2;

uint32_t place(uint32_t variant, uint32_t thread, uint32_t k, uint32_t threads)
{
    if (variant == side_by_side) {
        return k * threads + thread;
    }
    return variant == own_run ? reads_a_thread * thread + k : scattered(reads_a_thread * thread + k);
}

void add_words(Experiment& made, gpu::Device& device, uint32_t threads, uint32_t count)
{
    made.buffers.push_back(words_of(device, count, stir));
    const size_t first = made.kernels.size();
    const Numbers numbers{.threads = threads, .rounds = 1, .a = count - 1U, .b = 0};
    const auto add = [&](const char* name, uint32_t variant) {
        made.kernels.push_back({.name = fmt::format("{} KiB of words, {}", count / 256U, name),
                                .compute = &shaders::lab_memory_comp,
                                .variant = variant,
                                .numbers = numbers,
                                .words = made.buffers.back().get(),
                                .against = first,
                                .is_right = [=](uint32_t index, uint32_t word) {
                                    uint32_t sum = 0;
                                    for (uint32_t k = 0; k < reads_a_thread; ++k) {
                                        sum += stir(place(variant, index, k, numbers.threads) & numbers.a);
                                    }
                                    return word == sum;
                                }});
    };
    add("neighbours side by side", side_by_side);
    add("each thread a run of 16", own_run);
    add("anywhere", anywhere);
}

void add_texels(Experiment& made, gpu::Device& device, uint32_t side)
{
    made.images.push_back(texture_of(device, side, gpu::Format::r32ui, stir));
    const size_t first = made.kernels.size();
    const auto add = [&](const char* name, bool is_anywhere) {
        made.kernels.push_back({.name = fmt::format("{0} x {0} texels, {1}", side, name),
                                .compute = &shaders::lab_texels_comp,
                                .variant = is_anywhere ? 1U : 0U,
                                .numbers = {.threads = side * side, .rounds = 1, .a = 0, .b = side},
                                .size_px = {side, side},
                                .texture = made.images.back().get(),
                                .against = first,
                                .is_right = [=](uint32_t index, uint32_t word) {
                                    uint32_t sum = 0;
                                    for (uint32_t k = 0; k < reads_a_thread; ++k) {
                                        const uint32_t elsewhere = scattered(reads_a_thread * index + k);
                                        const uint32_t x = is_anywhere ? elsewhere : index % side + k % 4U;
                                        const uint32_t y =
                                            is_anywhere ? elsewhere >> 16U : index / side + k / 4U;
                                        sum += stir((y % side) * side + x % side);
                                    }
                                    return word == sum;
                                }});
    };
    add("4 x 4 about the pixel", false);
    add("16 anywhere", true);
}

} // namespace

Experiment memory_order(gpu::Device& device, Effort effort)
{
    const uint32_t many = by_effort(effort, 1U << 16U, 1U << 24U, 1U << 26U);
    Experiment made;
    made.buffers.reserve(2);
    add_words(made, device, many / reads_a_thread, by_effort(effort, 1U << 10U, 1U << 12U, 1U << 14U));
    add_words(made, device, many / reads_a_thread, many);
    add_texels(made, device, by_effort(effort, 64U, 1024U, 4096U));
    return made;
}

namespace {

constexpr uint32_t group = 64;

uint32_t chased(uint32_t p, const Numbers& numbers)
{
    uint32_t sum = 0;
    for (uint32_t r = 0; r < numbers.rounds; ++r) {
        p = next_of(p) & numbers.a;
        sum += p;
    }
    return sum;
}

void add_shared(Experiment& made, const Numbers& numbers, uint32_t most_bytes)
{
    for (const uint32_t kib : {1U, 4U, 8U, 16U, 32U, 48U}) {
        const uint32_t bytes = 1024U * kib;
        if (bytes > most_bytes) {
            break;
        }
        made.kernels.push_back({.name = fmt::format("a workgroup of 64 holds {} KiB of shared memory", kib),
                                .compute = &shaders::lab_shared_comp,
                                .variant = bytes / 4U,
                                .numbers = numbers,
                                .words = made.buffers.front().get(),
                                .is_right = [numbers](uint32_t index, uint32_t word) {
                                    return word == chased((index ^ 1U) * 16U & numbers.a, numbers);
                                }});
    }
}

uint32_t live_sum(uint32_t index, const Numbers& numbers, uint32_t live)
{
    uint32_t sum = chased(scattered(index) & numbers.a, numbers);
    uint32_t q = index;
    for (uint32_t i = 0; i < live / 4U; ++i) {
        for (int read = 0; read < 2; ++read) {
            q = next_of(q);
            sum += next_of(q & numbers.a) & numbers.a;
        }
        sum += q + (q ^ numbers.b);
    }
    return sum;
}

} // namespace

/// Dependent reads through memory, in which a thread does little but wait. Other threads hide the latency;
/// the more each thread keeps in registers, the fewer threads fit.
Experiment occupancy(gpu::Device& device, Effort effort)
{
    const uint32_t count = by_effort(effort, 1U << 16U, 1U << 22U, 1U << 26U);
    Experiment made;
    made.buffers.push_back(words_of(device, count, [&](uint32_t p) { return next_of(p) & (count - 1U); }));
    Numbers numbers{.threads = by_effort(effort, 16U * group, 1U << 15U, 1U << 20U),
                    .rounds = 16,
                    .a = count - 1U,
                    .b = 1};
    add_shared(made, numbers, device.limits().maxComputeSharedMemorySize);
    const size_t first = made.kernels.size();
    const std::array<std::pair<uint32_t, const gpu::Shader*>, 3> lives{{{4U, &shaders::lab_live_4_comp},
                                                                        {32U, &shaders::lab_live_32_comp},
                                                                        {128U, &shaders::lab_live_128_comp}}};
    numbers.rounds = by_effort(effort, 16U, 64U, 128U); // so many that loading the kept numbers costs little
    for (const auto& [live, shader] : lives) {
        made.kernels.push_back({.name = fmt::format("a thread keeps {} numbers", live),
                                .compute = shader,
                                .numbers = numbers,
                                .words = made.buffers.front().get(),
                                .against = first,
                                .is_right = [numbers, live = live](uint32_t index, uint32_t word) {
                                    return word == live_sum(index, numbers, live);
                                }});
    }
    return made;
}

} // namespace estampe::lab::kernels
