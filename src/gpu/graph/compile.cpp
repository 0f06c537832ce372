// SPDX-License-Identifier: MIT
#include "gpu/graph/compile.hpp"

#include <algorithm>
#include <span>
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

/// Adds them to `merged`.
void merge_uses(const Graph& graph, const PassRecord& pass, std::vector<PassUse>& merged)
{
    const size_t first = merged.size();
    for (const Use& use : pass.uses) {
        const ResourceRecord& resource = graph.resources()[use.resource];
        const bool writes = is_write(use.access);
        const Layout layout = resource.is_image ? layout_for(use.access) : Layout::undefined;
        const auto same = std::find_if(merged.begin() + static_cast<std::ptrdiff_t>(first), merged.end(),
                                       [&](const PassUse& known) { return known.resource == use.resource; });
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

void check(const Graph& graph, std::vector<History>& histories)
{
    histories.assign(graph.resources().size(), {});
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

/// The kept passes in order, and what each does.
struct Schedule {
    std::vector<uint32_t> passes;
    std::vector<PassUse> uses;       ///< of all of them, one after another
    std::vector<uint32_t> first_use; ///< by kept pass, and the end of the last

    [[nodiscard]] std::span<const PassUse> uses_of(size_t step) const
    {
        return {uses.data() + first_use[step], first_use[step + 1] - first_use[step]};
    }
};

/// Versions of resources that some kept pass reads.
struct Wanted {
    std::vector<uint32_t> first; ///< by resource
    std::vector<uint8_t> is_wanted;

    void forget(const Graph& graph)
    {
        first.clear();
        uint32_t versions = 0;
        for (const ResourceRecord& resource : graph.resources()) {
            first.push_back(versions);
            versions += resource.newest_version + 1;
        }
        is_wanted.assign(versions, 0);
    }

    [[nodiscard]] uint8_t& at(uint32_t resource, uint32_t version)
    {
        return is_wanted[first[resource] + version];
    }
};

/// Fills in the passes whose work is wanted.
void find_kept(const Graph& graph, Wanted& wanted, Schedule& schedule)
{
    wanted.forget(graph);
    schedule.passes.clear();
    for (auto index = static_cast<uint32_t>(graph.passes().size()); index-- > 0;) {
        const PassRecord& pass = graph.passes()[index];
        const bool keep = pass.has_side_effect || std::ranges::any_of(pass.uses, [&](const Use& use) {
                              const ResourceRecord& resource = graph.resources()[use.resource];
                              if (!is_write(use.access))
                                  return use.access == Access::host_read;
                              return resource.exported || resource.is_imported() ||
                                     wanted.at(use.resource, use.version + 1) != 0;
                          });
        if (!keep)
            continue;
        schedule.passes.push_back(index);
        for (const Use& use : pass.uses) {
            if (is_read(use.access))
                wanted.at(use.resource, use.version) = 1;
        }
    }
    std::ranges::reverse(schedule.passes);
}

void schedule_uses(const Graph& graph, Schedule& schedule)
{
    schedule.uses.clear();
    schedule.first_use.clear();
    for (const uint32_t pass : schedule.passes) {
        schedule.first_use.push_back(static_cast<uint32_t>(schedule.uses.size()));
        merge_uses(graph, graph.passes()[pass], schedule.uses);
    }
    schedule.first_use.push_back(static_cast<uint32_t>(schedule.uses.size()));
}

/// How resources share slots.
struct Sharing {
    std::vector<size_t> last_use;   ///< by resource
    std::vector<uint8_t> unshared;  ///< by resource
    std::vector<size_t> busy_until; ///< by slot; SIZE_MAX when never to be shared
};

void find_last_uses(const Graph& graph, const Schedule& schedule, Sharing& sharing)
{
    sharing.last_use.assign(graph.resources().size(), 0);
    sharing.unshared.clear();
    for (const ResourceRecord& resource : graph.resources())
        sharing.unshared.push_back(resource.exported ? 1 : 0);
    for (size_t step = 0; step < schedule.passes.size(); ++step) {
        for (const PassUse& use : schedule.uses_of(step)) {
            sharing.last_use[use.resource] = step;
            if (use.accesses.contains(Access::host_read))
                sharing.unshared[use.resource] = 1;
        }
    }
}

void assign_slots(const Graph& graph, const Schedule& schedule, Sharing& sharing, CompiledGraph& compiled)
{
    find_last_uses(graph, schedule, sharing);
    std::vector<size_t>& busy_until = sharing.busy_until;
    busy_until.clear();
    compiled.slots.clear();
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
    for (size_t step = 0; step < schedule.passes.size(); ++step) {
        for (const PassUse& use : schedule.uses_of(step)) {
            const ResourceRecord& resource = graph.resources()[use.resource];
            if (resource.is_imported())
                continue;
            const bool is_unshared = sharing.unshared[use.resource] != 0;
            uint32_t& slot = compiled.slot_of_resource[use.resource];
            if (slot == none) {
                slot = take_slot(resource, !is_unshared, step);
                busy_until[slot] = is_unshared ? SIZE_MAX : sharing.last_use[use.resource];
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

/// What barriers are found with.
struct Memory {
    std::vector<MemoryState> slots;
    std::vector<MemoryState> imported;
    std::vector<std::vector<Barrier>> spare; ///< room that passes of the graph before had
};

void take_back(CompiledGraph& compiled, Memory& memory)
{
    for (CompiledPass& pass : compiled.passes) {
        pass.barriers.clear();
        memory.spare.push_back(std::move(pass.barriers));
    }
    compiled.passes.clear();
    std::ranges::reverse(memory.spare); // each pass gets its own again
}

CompiledPass& new_pass(CompiledGraph& compiled, Memory& memory, uint32_t pass)
{
    compiled.passes.push_back({pass, {}});
    CompiledPass& made = compiled.passes.back();
    if (!memory.spare.empty()) {
        made.barriers = std::move(memory.spare.back());
        memory.spare.pop_back();
    }
    return made;
}

void add_barriers(const Graph& graph, const Schedule& schedule, Memory& memory, CompiledGraph& compiled)
{
    take_back(compiled, memory);
    memory.slots.assign(compiled.slots.size(), {});
    memory.imported.assign(graph.resources().size(), {});
    compiled.final_layout.clear();
    for (uint32_t i = 0; i < memory.imported.size(); ++i) {
        memory.imported[i].holder = i;
        memory.imported[i].layout = graph.resources()[i].initial_layout;
        compiled.final_layout.push_back(memory.imported[i].layout);
    }
    for (size_t step = 0; step < schedule.passes.size(); ++step) {
        CompiledPass& pass = new_pass(compiled, memory, schedule.passes[step]);
        for (const PassUse& use : schedule.uses_of(step)) {
            const uint32_t slot = compiled.slot_of_resource[use.resource];
            MemoryState& state = slot == none ? memory.imported[use.resource] : memory.slots[slot];
            if (state.holder != use.resource)
                state.layout = Layout::undefined; // the new resource does not want the old content
            const Barrier barrier = advance(state, use);
            if (!barrier.after.empty())
                pass.barriers.push_back(barrier);
            compiled.final_layout[use.resource] = use.layout;
        }
    }
    memory.spare.clear();
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

struct Compiler::Room {
    std::vector<History> histories;
    std::vector<PassUse> uses_of_one;
    Wanted wanted;
    Schedule schedule;
    Sharing sharing;
    Memory memory;
};

Compiler::Compiler() : room_(std::make_unique<Room>()) {}

Compiler::~Compiler() = default;

void Compiler::compile(const Graph& graph, CompiledGraph& compiled)
{
    check(graph, room_->histories);
    for (const PassRecord& pass : graph.passes()) {
        room_->uses_of_one.clear();
        merge_uses(graph, pass, room_->uses_of_one); // clashes count in passes that are culled too
    }
    find_kept(graph, room_->wanted, room_->schedule);
    schedule_uses(graph, room_->schedule);
    assign_slots(graph, room_->schedule, room_->sharing, compiled);
    add_barriers(graph, room_->schedule, room_->memory, compiled);
}

CompiledGraph compile(const Graph& graph)
{
    CompiledGraph compiled;
    Compiler().compile(graph, compiled);
    return compiled;
}

} // namespace estampe::gpu
