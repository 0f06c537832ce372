// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "lab/kernels/kernels.hpp"
#include "shaders/lab_page_vert.hpp"
#include "shaders/lab_stay_comp.hpp"
#include "shaders/lab_stay_frag.hpp"

namespace estampe::lab::kernels {
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

/// One square of pixels in ten has work to do. Squares of 1: pixels that stay lie scattered.
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

} // namespace estampe::lab::kernels
