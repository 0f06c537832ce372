// SPDX-License-Identifier: MIT
#include "gpu/graph/run_watch.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "gpu/graph/compile.hpp"
#include "gpu/graph/execute.hpp"
#include "gpu/shader_ops.hpp"

namespace estampe::gpu {
namespace {

RunWatch& watching()
{
    static RunWatch watch;
    return watch;
}

double ms_since(std::chrono::steady_clock::time_point begin)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

} // namespace

void watch_runs(RunWatch watch)
{
    watching() = std::move(watch);
}

bool are_runs_watched()
{
    return static_cast<bool>(watching());
}

void tell_run(std::span<const PassWork> passes)
{
    watching()(passes);
}

uint64_t bytes_of(const Graph& graph, const PassRecord& pass)
{
    uint64_t bytes = 0;
    for (const Use& use : pass.uses) {
        if (!use.bound && use.access != Access::transfer_read && use.access != Access::transfer_write &&
            !is_write(use.access)) {
            continue;
        }
        const ResourceRecord& resource = graph.resources()[use.resource];
        const uint64_t once = resource.is_image ? size_bytes(resource.image) : resource.buffer.size_bytes;
        bytes += is_write(use.access) && is_read(use.access) ? 2 * once : once;
    }
    return bytes;
}

std::optional<uint64_t> operations_of(const Graph& graph, const PassRecord& pass)
{
    if (pass.shader != nullptr && pass.dispatch.indirect_resource == UINT32_MAX) {
        const ShaderOps ops = ops_of(pass.shader->spirv, pass.variant);
        const uint64_t groups =
            uint64_t{pass.dispatch.groups_x} * pass.dispatch.groups_y * pass.dispatch.groups_z;
        return ops.operations * groups * ops.group.x * ops.group.y * ops.group.z;
    }
    if (pass.is_raster() && pass.draw.indirect_resource == UINT32_MAX) {
        uint64_t pixels = 0;
        for (const Use& use : pass.uses) {
            const ImageDesc& image = graph.resources()[use.resource].image;
            pixels = is_write(use.access) ? uint64_t{image.width} * image.height : pixels;
        }
        const uint64_t corners = ops_of(pass.draw.vertex->spirv, pass.variant).operations;
        const uint64_t fragments =
            pass.draw.fragment != nullptr ? ops_of(pass.draw.fragment->spirv, pass.variant).operations : 0;
        return corners * pass.draw.vertex_count + fragments * pixels;
    }
    return std::nullopt;
}

void Executor::run_by_passes()
{
    const auto time_ms = [&](const CompiledPass* compiled) {
        begin_commands();
        vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 0);
        if (compiled != nullptr) {
            record_pass(commands_, *compiled);
        }
        vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 1);
        const auto begin = std::chrono::steady_clock::now();
        end_and_run_commands();
        const double wall_ms = ms_since(begin);
        if (device_.info().software) {
            return wall_ms;
        }
        std::array<uint64_t, 2> ticks{};
        vk_check(vkGetQueryPoolResults(device_.handle(), queries_, 0, 2, sizeof(ticks), ticks.data(),
                                       sizeof(uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                 "vkGetQueryPoolResults");
        return static_cast<double>(ticks[1] - ticks[0]) * device_.timestamp_period_ns() * 1e-6;
    };
    const double empty_ms = device_.info().software ? std::min(time_ms(nullptr), time_ms(nullptr)) : 0.0;
    std::vector<PassWork> works;
    for (const CompiledPass& compiled : compiled_.passes) {
        const PassRecord& pass = graph_->passes()[compiled.pass];
        const double ms = std::max(time_ms(&compiled) - empty_ms, 0.0);
        note_timing(pass.name, ms);
        gpu_ms_ += ms;
        works.push_back({.name = pass.name,
                         .ms = ms,
                         .bytes = bytes_of(*graph_, pass),
                         .operations = operations_of(*graph_, pass)});
    }
    end_timings();
    tell_run(works);
}

} // namespace estampe::gpu
