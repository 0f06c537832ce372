// SPDX-License-Identifier: MIT
// Uses the shaders of a graph without running them, so that the driver compiles them.
#include "gpu/graph/compile_ahead.hpp"

#include <chrono>
#include <exception>
#include <system_error>
#include <utility>

#include "gpu/device.hpp"
#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"

namespace estampe::gpu {

void Executor::use_shaders(const Graph& graph, const std::function<bool()>& go_on)
{
    compiler_.compile(graph, compiled_);
    graph_ = &graph;
    ensure_stand_ins();
    for (size_t i = compiled_.passes.size(); i-- > 0;) {
        const PassRecord& pass = graph.passes()[compiled_.passes[i].pass];
        if (pass.shader == nullptr && !pass.is_raster()) {
            continue;
        }
        use_shader(pass);
        if (!go_on()) {
            break;
        }
    }
    stand_in_images_.clear();
    stand_in_buffers_.clear();
    graph_ = nullptr;
}

/// Creates a placeholder for each resource of the graph, because the compiled code may depend on the size and
/// format of images.
void Executor::ensure_stand_ins()
{
    for (const ResourceRecord& resource : graph_->resources()) {
        stand_in_images_.push_back(resource.is_image ? Image(device_, "stand-in", resource.image,
                                                             resource.imported_image != nullptr &&
                                                                 resource.imported_image->is_array())
                                                     : Image());
        stand_in_buffers_.push_back(
            resource.is_image ? Buffer()
                              : Buffer(device_, "stand-in", resource.buffer.size_bytes, MemoryUse::device));
    }
}

void Executor::use_shader(const PassRecord& pass)
{
    begin_commands();
    std::vector<Barrier> layouts;
    for (const Use& use : pass.uses) {
        if (graph_->resources()[use.resource].is_image) {
            layouts.push_back({.resource = use.resource,
                               .after = AccessSet(use.access),
                               .old_layout = Layout::undefined,
                               .new_layout = layout_for(use.access)});
        }
    }
    record_barriers(commands_, layouts);
    PassRecord unrun = pass;
    unrun.dispatch = {};
    unrun.draw.vertex_count = 3; // A triangle without area: all corners are equal
    unrun.draw.indirect_resource = UINT32_MAX;
    if (pass.shader != nullptr) {
        record_dispatch(commands_, unrun);
    } else {
        record_draw(commands_, unrun);
    }
    end_and_run_commands();
}

namespace {

/// Using a cached shader takes less time than this; compiling a shader takes more.
constexpr std::chrono::milliseconds cached_time{25};
/// If the shaders of this many last passes are cached, the shaders of all passes are assumed to be cached.
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
        // If the drawing device has the same problem, the drawing device reports the problem.
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
        // Without a second thread, the drawing device compiles all shaders itself.
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
