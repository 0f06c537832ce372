// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "common/rounds.hpp"
#include "gpu/graph/execute.hpp"
#include "gpu/imports.hpp"
#include "lab/roofline/roofline.hpp"
#include "shaders/roof_arithmetic_comp.hpp"
#include "shaders/roof_copy_comp.hpp"

namespace estampe::lab::roofline {
namespace {

/// Seconds of the quickest run; the first makes the pipeline.
double least_s(gpu::Executor& executor, bool software, const gpu::Graph& graph, uint32_t rounds)
{
    double least = std::numeric_limits<double>::max();
    for (uint32_t round = 0; round <= rounds; ++round) {
        const bench::WallClock clock;
        executor.run(graph);
        const double wall_s = 1e-3 * clock.ms();
        if (round > 0) {
            const double gpu_s = 1e-3 * executor.timings().back().gpu_ms;
            least = std::min(least, software ? wall_s : gpu_s);
        }
    }
    return std::max(least, 1e-9);
}

/// Pages that nobody has written are one page on some systems, which a cache holds.
void write_all(gpu::Executor& executor, gpu::Buffer& buffer)
{
    gpu::Graph graph;
    auto pass = graph.custom("fill");
    const gpu::BufferId filled =
        pass.touch_write(import_whole(graph, "filled", buffer), gpu::Access::transfer_write);
    pass.execute([filled](gpu::Recorder& recorder) {
        vkCmdFillBuffer(recorder.commands(), recorder.buffer(filled).handle(), 0, VK_WHOLE_SIZE, 1);
    });
    executor.run(graph);
}

double copied_bytes_a_s(gpu::Device& device, gpu::Executor& executor, uint32_t rounds)
{
    const bool software = device.info().software;
    const uint32_t count = software ? 1U << 21U : 1U << 24U;
    const uint64_t size_bytes = 16ULL * count;
    gpu::Buffer from(device, "from", size_bytes, gpu::MemoryUse::device);
    gpu::Buffer to(device, "to", size_bytes, gpu::MemoryUse::device);
    write_all(executor, from);
    write_all(executor, to);
    gpu::Graph graph;
    auto pass = graph.compute("copy", shaders::roof_copy_comp);
    pass.read(import_whole(graph, "from", from));
    static_cast<void>(pass.write(import_whole(graph, "to", to)));
    pass.push(count).dispatch_items(count);
    return 2.0 * static_cast<double>(size_bytes) / least_s(executor, software, graph, rounds);
}

double computed_operations_a_s(gpu::Executor& executor, bool software, uint32_t rounds)
{
    struct Constants {
        uint32_t threads, rounds;
        float factor, step_up;
    };

    constexpr double operations_a_round = 2.0 * 64.0;
    const Constants constants{
        .threads = software ? 1U << 15U : 1U << 21U, .rounds = 256, .factor = 0.999F, .step_up = 0.001F};
    gpu::Graph graph;
    auto pass = graph.compute("arithmetic", shaders::roof_arithmetic_comp);
    const gpu::BufferId results =
        pass.write(graph.buffer("results", {.size_bytes = sizeof(float) * constants.threads}));
    pass.push(constants).dispatch_items(constants.threads);
    graph.export_buffer(results);
    return operations_a_round * constants.rounds * constants.threads /
           least_s(executor, software, graph, rounds);
}

} // namespace

Ceilings measure_ceilings(gpu::Device& device, uint32_t rounds)
{
    gpu::Executor executor(device);
    const bool software = device.info().software;
    return {.bytes_a_s = copied_bytes_a_s(device, executor, rounds),
            .operations_a_s = computed_operations_a_s(executor, software, rounds)};
}

} // namespace estampe::lab::roofline
