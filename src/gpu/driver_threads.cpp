// SPDX-License-Identifier: MIT
#include "gpu/driver_threads.hpp"

#include <algorithm>
#include <latch>
#include <system_error>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe::gpu {

void require_driver_threads()
{
    // As many as there are cores for triangles, the same again for computing, and a few that wait.
    constexpr unsigned most_cores_used = 16;
    constexpr unsigned waiting = 4;
    const unsigned count = 2 * std::clamp(std::thread::hardware_concurrency(), 1U, most_cores_used) + waiting;
    std::latch all_tried(1);
    std::vector<std::jthread> threads;
    try {
        for (unsigned i = 0; i < count; ++i) {
            threads.emplace_back([&all_tried] { all_tried.wait(); });
        }
    } catch (const std::system_error& problem) {
        all_tried.count_down();
        throw Error(fmt::format("drawing on the processor takes {} threads, {} could be started: {}", count,
                                threads.size(), problem.code().message()),
                    {}, "end other programs, or raise the limit of threads (ulimit -u)");
    }
    all_tried.count_down();
}

} // namespace estampe::gpu
