// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_live_128_comp.hpp"
#include "shaders/lab_live_32_comp.hpp"
#include "shaders/lab_live_4_comp.hpp"
#include "shaders/lab_shared_comp.hpp"

namespace estampe::lab::kernels {
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

/// Chases of pointers through memory, in which a thread does little but wait: what hides the waiting are
/// other threads, of which fewer fit the more each holds.
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
    numbers.rounds = by_effort(effort, 16U, 64U, 128U); // so many that loading what is kept weighs little
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
