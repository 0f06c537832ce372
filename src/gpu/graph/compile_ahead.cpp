// SPDX-License-Identifier: MIT
#include "gpu/graph/compile_ahead.hpp"

#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "gpu/device.hpp"
#include "gpu/graph/execute.hpp"

namespace estampe::gpu {
namespace {

/// A shader that is in the cache takes less, one that has to be compiled more.
constexpr std::chrono::milliseconds cached_time{25};
/// How many of the last passes have to be in the cache for all of them to be taken as known.
constexpr int passes_tried = 2;

void compile_on_twin(RendererOptions options, std::future<const Graph*> wanted, const std::atomic<bool>& stop)
{
    options.validation = false;
    try {
        Device twin(options);
        Executor executor(twin);
        const Graph* const graph = wanted.get();
        if (graph == nullptr) {
            return;
        }
        int passes_cached = 0;
        auto begun = std::chrono::steady_clock::now();
        executor.use_shaders(*graph, [&] {
            const auto now = std::chrono::steady_clock::now();
            passes_cached = now - begun < cached_time ? passes_cached + 1 : -1000;
            begun = now;
            return !stop && passes_cached < passes_tried;
        });
    } catch (const std::exception&) {
        // The device that draws meets the same trouble and reports it, or has none.
        return;
    }
}

} // namespace

CompileAhead::CompileAhead(const RendererOptions& options)
{
    try {
        thread_ = std::thread([options, wanted = graph_.get_future(), this]() mutable {
            compile_on_twin(options, std::move(wanted), stop_);
        });
    } catch (const std::system_error&) {
        // Without a second thread the device that draws compiles all by itself.
        return;
    }
}

void CompileAhead::start(const Graph& graph)
{
    has_graph_ = true;
    graph_.set_value(&graph);
}

CompileAhead::~CompileAhead()
{
    stop_ = true;
    if (!has_graph_) {
        graph_.set_value(nullptr);
    }
    if (thread_.joinable()) {
        thread_.join();
    }
}

} // namespace estampe::gpu
