// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_memory_comp.hpp"
#include "shaders/lab_texels_comp.hpp"

namespace estampe::lab::kernels {
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

} // namespace estampe::lab::kernels
