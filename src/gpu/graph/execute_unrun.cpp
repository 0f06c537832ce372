// SPDX-License-Identifier: MIT
// Uses the shaders of a graph without running them.
#include "gpu/graph/access.hpp"
#include "gpu/graph/execute.hpp"

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

/// One for each resource, because what a driver compiles may depend on an image's size and format.
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
    unrun.draw.vertex_count = 3; // of no area: all corners are the same
    unrun.draw.indirect_resource = UINT32_MAX;
    if (pass.shader != nullptr) {
        record_dispatch(commands_, unrun);
    } else {
        record_draw(commands_, unrun);
    }
    end_and_run_commands();
}

} // namespace estampe::gpu
