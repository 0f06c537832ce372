// SPDX-License-Identifier: MIT
#include "gpu/graph/compile.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace estampe::gpu {

namespace {

constexpr uint32_t none = UINT32_MAX;

/// All that one pass does to one resource.
struct PassUse {
    uint32_t resource = 0;
    AccessSet accesses;
    bool writes = false;
    Layout layout = Layout::undefined; ///< images only
};

std::vector<PassUse> merge_uses(const Graph& graph, const PassRecord& pass)
{
    std::vector<PassUse> merged;
    for (const Use& use : pass.uses) {
        const ResourceRecord& resource = graph.resources()[use.resource];
        const bool writes = is_write(use.access);
        const Layout layout = resource.is_image ? layout_for(use.access) : Layout::undefined;
        const auto same = std::ranges::find(merged, use.resource, &PassUse::resource);
        if (same == merged.end()) {
            merged.push_back({use.resource, use.access, writes, layout});
            continue;
        }
        if (same->writes || writes || same->layout != layout)
            throw std::logic_error(
                fmt::format("pass '{}' binds '{}' twice with clashing accesses ({} among them)", pass.name,
                            resource.name, name_of(use.access)));
        same->accesses |= use.access;
    }
    return merged;
}

/// What checking knows about a resource while it walks the passes in order.
struct History {
    uint32_t version = 0;
    const PassRecord* writer = nullptr;
    const PassRecord* host_reader = nullptr;
};

void check_use(const PassRecord& pass, const Use& use, const ResourceRecord& resource, const History& history)
{
    const char* verb = is_write(use.access) ? "writes" : "reads";
    if (use.version < history.version)
        throw std::logic_error(fmt::format("pass '{}' {} a version of '{}' that pass '{}' has overwritten",
                                           pass.name, verb, resource.name, history.writer->name));
    if (use.version > history.version)
        throw std::logic_error(
            fmt::format("pass '{}' {} a version of '{}' that is written only by a later pass", pass.name,
                        verb, resource.name));
    const bool clears = use.access == Access::depth_attachment;
    if (history.version == 0 && is_read(use.access) && !clears && !resource.is_imported())
        throw std::logic_error(
            fmt::format("pass '{}' reads '{}', which no pass has written", pass.name, resource.name));
    if (is_write(use.access) && history.host_reader != nullptr)
        throw std::logic_error(
            fmt::format("pass '{}' overwrites '{}', which pass '{}' gives to the host to read "
                        "after the frame",
                        pass.name, resource.name, history.host_reader->name));
}

void check(const Graph& graph)
{
    std::vector<History> histories(graph.resources().size());
    for (const PassRecord& pass : graph.passes()) {
        for (const Use& use : pass.uses) {
            History& history = histories[use.resource];
            check_use(pass, use, graph.resources()[use.resource], history);
            if (is_write(use.access)) {
                history.version = use.version + 1;
                history.writer = &pass;
            }
            if (use.access == Access::host_read)
                history.host_reader = &pass;
        }
    }
    for (const ResourceRecord& resource : graph.resources()) {
        if (resource.exported && !resource.is_imported() && resource.newest_version == 0)
            throw std::logic_error(fmt::format("'{}' is exported, but no pass writes it", resource.name));
    }
}

/// Indices of the passes whose work is wanted, in order.
std::vector<uint32_t> find_kept(const Graph& graph)
{
    std::vector<std::vector<bool>> wanted; // by resource and version
    for (const ResourceRecord& resource : graph.resources())
        wanted.emplace_back(resource.newest_version + 1, false);

    std::vector<uint32_t> kept;
    for (auto index = static_cast<uint32_t>(graph.passes().size()); index-- > 0;) {
        const PassRecord& pass = graph.passes()[index];
        const bool keep =
            pass.has_side_effect || std::ranges::any_of(pass.uses, [&](const Use& use) {
                const ResourceRecord& resource = graph.resources()[use.resource];
                if (!is_write(use.access))
                    return use.access == Access::host_read;
                return resource.exported || resource.is_imported() || wanted[use.resource][use.version + 1];
            });
        if (!keep)
            continue;
        kept.push_back(index);
        for (const Use& use : pass.uses) {
            if (is_read(use.access))
                wanted[use.resource][use.version] = true;
        }
    }
    std::ranges::reverse(kept);
    return kept;
}

/// The kept passes and what each does, side by side.
struct Schedule {
    std::vector<uint32_t> passes;
    std::vector<std::vector<PassUse>> uses;
};

std::vector<size_t> find_last_uses(const Graph& graph, const Schedule& schedule)
{
    std::vector<size_t> last_use(graph.resources().size(), 0);
    for (size_t step = 0; step < schedule.uses.size(); ++step) {
        for (const PassUse& use : schedule.uses[step])
            last_use[use.resource] = step;
    }
    return last_use;
}

std::vector<bool> find_unshared(const Graph& graph, const Schedule& schedule)
{
    std::vector<bool> unshared;
    for (const ResourceRecord& resource : graph.resources())
        unshared.push_back(resource.exported);
    for (const std::vector<PassUse>& uses : schedule.uses) {
        for (const PassUse& use : uses) {
            if (use.accesses.contains(Access::host_read))
                unshared[use.resource] = true;
        }
    }
    return unshared;
}

void assign_slots(const Graph& graph, const Schedule& schedule, CompiledGraph& compiled)
{
    const std::vector<size_t> last_use = find_last_uses(graph, schedule);
    const std::vector<bool> unshared = find_unshared(graph, schedule);
    std::vector<size_t> busy_until; // by slot; SIZE_MAX when never to be shared

    compiled.slot_of_resource.assign(graph.resources().size(), none);
    const auto take_slot = [&](const ResourceRecord& resource, bool shareable, size_t step) {
        for (uint32_t i = 0; shareable && i < compiled.slots.size(); ++i) {
            const Slot& slot = compiled.slots[i];
            if (busy_until[i] < step && slot.is_image == resource.is_image && slot.image == resource.image &&
                slot.buffer == resource.buffer)
                return i;
        }
        compiled.slots.push_back({resource.is_image, resource.image, resource.buffer, {}});
        busy_until.push_back(0);
        return static_cast<uint32_t>(compiled.slots.size() - 1);
    };
    for (size_t step = 0; step < schedule.uses.size(); ++step) {
        for (const PassUse& use : schedule.uses[step]) {
            const ResourceRecord& resource = graph.resources()[use.resource];
            if (resource.is_imported())
                continue;
            uint32_t& slot = compiled.slot_of_resource[use.resource];
            if (slot == none) {
                slot = take_slot(resource, !unshared[use.resource], step);
                busy_until[slot] = unshared[use.resource] ? SIZE_MAX : last_use[use.resource];
            }
            compiled.slots[slot].accesses |= use.accesses;
        }
    }
}

/// What one piece of memory has seen so far: a slot, or an imported resource.
struct MemoryState {
    uint32_t holder = none; ///< the resource that lives there
    Layout layout = Layout::undefined;
    AccessSet source;  ///< the last write, or what waited for the last layout change
    AccessSet readers; ///< reads since then, all of which have waited for `source`
    AccessSet covered; ///< those of `readers` that another of them has waited for, so that nobody else need
};

/// Brings `state` past `use`, and returns the barrier in between; its `after` is empty when none is needed.
Barrier advance(MemoryState& state, const PassUse& use)
{
    const bool changes_layout = state.layout != use.layout;
    const bool changes_holder = state.holder != use.resource;
    Barrier barrier{.resource = use.resource, .old_layout = state.layout, .new_layout = use.layout};
    state.holder = use.resource;
    state.layout = use.layout;
    if (use.writes || changes_layout || changes_holder) {
        // The readers have waited for the source, so whoever waits for them waits for it too.
        barrier.before = state.readers.empty() ? state.source : state.readers.without(state.covered);
        if (changes_layout || !barrier.before.empty())
            barrier.after = use.accesses;
        state.source = use.accesses;
        state.readers = use.writes ? AccessSet() : use.accesses;
        state.covered = {};
        return barrier;
    }
    if (!state.source.empty()) {
        barrier.before = state.source;
        barrier.after = use.accesses.without(state.readers);
    }
    // The source is a reader where that reader changed the layout.
    if (!barrier.after.empty())
        state.covered |= state.source.without(state.source.without(state.readers));
    state.covered = state.covered.without(use.accesses);
    state.readers |= use.accesses;
    return barrier;
}

void add_barriers(const Graph& graph, const Schedule& schedule, CompiledGraph& compiled)
{
    std::vector<MemoryState> slots(compiled.slots.size());
    std::vector<MemoryState> imported(graph.resources().size());
    for (uint32_t i = 0; i < imported.size(); ++i) {
        imported[i].holder = i;
        imported[i].layout = graph.resources()[i].initial_layout;
        compiled.final_layout.push_back(imported[i].layout);
    }
    for (size_t step = 0; step < schedule.uses.size(); ++step) {
        CompiledPass pass{schedule.passes[step], {}};
        for (const PassUse& use : schedule.uses[step]) {
            const uint32_t slot = compiled.slot_of_resource[use.resource];
            MemoryState& state = slot == none ? imported[use.resource] : slots[slot];
            if (state.holder != use.resource)
                state.layout = Layout::undefined; // the new resource does not want the old content
            const Barrier barrier = advance(state, use);
            if (!barrier.after.empty())
                pass.barriers.push_back(barrier);
            compiled.final_layout[use.resource] = use.layout;
        }
        compiled.passes.push_back(std::move(pass));
    }
}

} // namespace

Layout layout_for(Access access)
{
    switch (access) {
    case Access::compute_sampled:
    case Access::raster_sampled:
        return Layout::shader_read;
    case Access::transfer_read:
        return Layout::transfer_source;
    case Access::transfer_write:
        return Layout::transfer_target;
    case Access::color_attachment:
    case Access::color_attachment_modify:
        return Layout::color;
    case Access::depth_attachment:
        return Layout::depth;
    case Access::compute_storage_read:
    case Access::compute_storage_write:
    case Access::compute_storage_modify:
    case Access::raster_storage_read:
        return Layout::general;
    case Access::compute_uniform:
    case Access::raster_uniform:
    case Access::indirect:
    case Access::host_read:
        break; // buffers only
    }
    return Layout::undefined;
}

std::string_view name_of(Access access)
{
    switch (access) {
    case Access::compute_sampled:
        return "compute_sampled";
    case Access::compute_storage_read:
        return "compute_storage_read";
    case Access::compute_storage_write:
        return "compute_storage_write";
    case Access::compute_storage_modify:
        return "compute_storage_modify";
    case Access::compute_uniform:
        return "compute_uniform";
    case Access::raster_sampled:
        return "raster_sampled";
    case Access::raster_storage_read:
        return "raster_storage_read";
    case Access::raster_uniform:
        return "raster_uniform";
    case Access::indirect:
        return "indirect";
    case Access::transfer_read:
        return "transfer_read";
    case Access::transfer_write:
        return "transfer_write";
    case Access::color_attachment:
        return "color_attachment";
    case Access::color_attachment_modify:
        return "color_attachment_modify";
    case Access::depth_attachment:
        return "depth_attachment";
    case Access::host_read:
        return "host_read";
    }
    return "unknown";
}

CompiledGraph compile(const Graph& graph)
{
    check(graph);
    for (const PassRecord& pass : graph.passes())
        (void)merge_uses(graph, pass);
    Schedule schedule{find_kept(graph), {}};
    for (const uint32_t pass : schedule.passes)
        schedule.uses.push_back(merge_uses(graph, graph.passes()[pass]));

    CompiledGraph compiled;
    assign_slots(graph, schedule, compiled);
    add_barriers(graph, schedule, compiled);
    return compiled;
}

} // namespace estampe::gpu
