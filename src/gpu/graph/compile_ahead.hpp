// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <future>
#include <thread>

#include <estampe/renderer.hpp>

#include "gpu/graph/graph.hpp"

namespace estampe::gpu {

/// Shares the compiling of a graph's shaders between two threads, on devices that are processors.
///
/// Such a driver compiles a shader when it is first used, one after another in the queue's thread, and keeps
/// the result in its cache on disk. So a second device of the same kind, in a thread of its own, uses the
/// shaders too, from the last pass to the first and without running them: where the two meet, each finds in
/// the cache what the other has made. It gives up at once when the cache knows the last passes already, and
/// whatever goes wrong there is of no consequence.
///
/// Memory  address space for the graph's resources once more, hardly touched
/// Cost    a cold start of 17 shaders takes about 0.6 of the time on two cores; a warm one a few milliseconds
class CompileAhead {
public:
    /// Opens the second device, in its thread.
    explicit CompileAhead(const RendererOptions& options);
    /// To be called once at most; `graph` must outlive this.
    void start(const Graph& graph);
    /// Waits for the shader in hand, if any.
    ~CompileAhead();
    CompileAhead(const CompileAhead&) = delete;
    CompileAhead& operator=(const CompileAhead&) = delete;

private:
    std::promise<const Graph*> graph_; ///< null: there is none to come
    bool has_graph_ = false;
    std::atomic<bool> stop_ = false;
    std::thread thread_;
};

} // namespace estampe::gpu
