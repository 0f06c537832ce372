// SPDX-License-Identifier: MIT
#include "gpu/graph/compile.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "gpu/graph/schedule.hpp"

namespace estampe::gpu {

namespace {

constexpr uint32_t none = UINT32_MAX;

/// State of a resource while the checks visit the passes in order.
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

/// Working memory for assigning transient resources to memory slots.
struct Sharing {
    std::vector<size_t> last_use;   ///< For each resource: level of passes that last uses it
    std::vector<uint8_t> unshared;  ///< For each resource: whether it needs its own slot
    std::vector<size_t> busy_until; ///< For each slot: last level that uses it; SIZE_MAX: never shared
};

void find_last_uses(const Graph& graph, const Schedule& schedule, Sharing& sharing)
{
    sharing.last_use.assign(graph.resources().size(), 0);
    sharing.unshared.clear();
    for (const ResourceRecord& resource : graph.resources())
        sharing.unshared.push_back(resource.exported ? 1 : 0);
    for (size_t step = 0; step < schedule.passes.size(); ++step) {
        for (const PassUse& use : schedule.uses_of(step)) {
            sharing.last_use[use.resource] = schedule.levels[step];
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
    const auto take_slot = [&](const ResourceRecord& resource, bool shareable, size_t level) {
        for (uint32_t i = 0; shareable && i < compiled.slots.size(); ++i) {
            const Slot& slot = compiled.slots[i];
            if (busy_until[i] < level && slot.is_image == resource.is_image && slot.image == resource.image &&
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
                slot = take_slot(resource, !is_unshared, schedule.levels[step]);
                busy_until[slot] = is_unshared ? SIZE_MAX : sharing.last_use[use.resource];
            }
            compiled.slots[slot].accesses |= use.accesses;
        }
    }
}

/// Earlier accesses to the memory of one slot or of one imported resource.
struct MemoryState {
    uint32_t holder = none; ///< Resource that occupies the memory
    Layout layout = Layout::undefined;
    AccessSet source;  ///< The last write, or the accesses that waited for the last layout change
    AccessSet readers; ///< Reads since the accesses in `source`; each read has waited for these accesses
    /// The accesses in `readers` for which another reader has already waited. Later accesses need not wait
    /// for the readers in `covered`.
    AccessSet covered;
};

/// Updates `state` with `use`, and returns the barrier that `use` requires. If no barrier is required, the
/// returned barrier has an empty `after`.
Barrier advance(MemoryState& state, const PassUse& use)
{
    const bool changes_layout = state.layout != use.layout;
    const bool changes_holder = state.holder != use.resource;
    Barrier barrier{.resource = use.resource, .old_layout = state.layout, .new_layout = use.layout};
    state.holder = use.resource;
    state.layout = use.layout;
    if (use.writes || changes_layout || changes_holder) {
        // The readers have waited for `source`, so an access that waits for the readers also waits for
        // `source`.
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
    // If the barrier of a reader changed the layout, `source` consists of that reader.
    if (!barrier.after.empty())
        state.covered |= state.source.without(state.source.without(state.readers));
    state.covered = state.covered.without(use.accesses);
    state.readers |= use.accesses;
    return barrier;
}

/// Working memory of the barrier computation.
struct Memory {
    std::vector<MemoryState> slots;
    std::vector<MemoryState> imported;
    std::vector<PassUse> uses_of_level;
    std::vector<uint32_t> use_in_level;      ///< Index into `uses_of_level`, for each resource
    std::vector<std::vector<Barrier>> spare; ///< Barrier lists of the previous graph, whose memory is reused
};

void take_back(CompiledGraph& compiled, Memory& memory)
{
    for (CompiledPass& pass : compiled.passes) {
        pass.barriers.clear();
        memory.spare.push_back(std::move(pass.barriers));
    }
    compiled.passes.clear();
    // Each pass gets the list of barriers that the pass had in the previous graph.
    std::ranges::reverse(memory.spare);
}

void add_pass(CompiledGraph& compiled, Memory& memory, uint32_t pass)
{
    compiled.passes.push_back({pass, {}});
    if (!memory.spare.empty()) {
        compiled.passes.back().barriers = std::move(memory.spare.back());
        memory.spare.pop_back();
    }
}

/// Merges all uses of a resource within one level of passes into one use. All uses within the level must
/// require the same layout.
void add_uses(std::span<const PassUse> uses, Memory& memory)
{
    for (const PassUse& use : uses) {
        uint32_t& known = memory.use_in_level[use.resource];
        if (known == none) {
            known = static_cast<uint32_t>(memory.uses_of_level.size());
            memory.uses_of_level.push_back(use);
        } else {
            memory.uses_of_level[known].accesses |= use.accesses;
        }
    }
}

void add_barriers(const Graph& graph, const Schedule& schedule, Memory& memory, CompiledGraph& compiled)
{
    take_back(compiled, memory);
    memory.slots.assign(compiled.slots.size(), {});
    memory.imported.assign(graph.resources().size(), {});
    memory.use_in_level.assign(graph.resources().size(), none);
    compiled.final_layout.clear();
    for (uint32_t i = 0; i < memory.imported.size(); ++i) {
        memory.imported[i].holder = i;
        memory.imported[i].layout = graph.resources()[i].initial_layout;
        compiled.final_layout.push_back(memory.imported[i].layout);
    }
    for (size_t step = 0; step < schedule.passes.size();) {
        const size_t first = step;
        for (; step < schedule.passes.size() && schedule.levels[step] == schedule.levels[first]; ++step) {
            add_pass(compiled, memory, schedule.passes[step]);
            add_uses(schedule.uses_of(step), memory);
        }
        CompiledPass& pass = compiled.passes[first];
        for (const PassUse& use : memory.uses_of_level) {
            memory.use_in_level[use.resource] = none;
            const uint32_t slot = compiled.slot_of_resource[use.resource];
            MemoryState& state = slot == none ? memory.imported[use.resource] : memory.slots[slot];
            if (state.holder != use.resource)
                state.layout = Layout::undefined; // The new resource discards the old content
            const Barrier barrier = advance(state, use);
            if (!barrier.after.empty())
                pass.barriers.push_back(barrier);
            compiled.final_layout[use.resource] = use.layout;
        }
        memory.uses_of_level.clear();
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
        break; // Accesses of buffers, which have no layout
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
    Scheduler scheduler;
    Schedule schedule;
    Sharing sharing;
    Memory memory;
};

Compiler::Compiler() : room_(std::make_unique<Room>()) {}

Compiler::~Compiler() = default;

void Compiler::compile(const Graph& graph, CompiledGraph& compiled)
{
    check(graph, room_->histories);
    room_->scheduler.run(graph, room_->schedule);
    assign_slots(graph, room_->schedule, room_->sharing, compiled);
    add_barriers(graph, room_->schedule, room_->memory, compiled);
}

CompiledGraph compile(const Graph& graph)
{
    CompiledGraph compiled;
    Compiler().compile(graph, compiled);
    return compiled;
}

namespace {

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += '\\';
        out += c;
    }
    return out;
}

std::string resource_node(const Graph& graph, const CompiledGraph& compiled, uint32_t index, uint32_t version)
{
    const ResourceRecord& resource = graph.resources()[index];
    std::string label = escaped(resource.name);
    if (resource.newest_version > 1)
        label += fmt::format(" v{}", version);
    if (resource.is_image)
        label += fmt::format("\\n{} x {}", resource.image.width, resource.image.height);
    else
        label += fmt::format("\\n{} bytes", resource.buffer.size_bytes);
    if (compiled.slot_of_resource[index] != UINT32_MAX)
        label += fmt::format(", slot {}", compiled.slot_of_resource[index]);
    const bool is_lasting = resource.exported || resource.is_imported();
    return fmt::format("    r{}_{} [shape=ellipse, label=\"{}\"{}];\n", index, version, label,
                       is_lasting ? ", penwidth=2" : "");
}

} // namespace

std::string to_dot(const Graph& graph, const CompiledGraph& compiled)
{
    std::string nodes;
    std::string edges;
    std::set<std::pair<uint32_t, uint32_t>> versions;
    for (uint32_t i = 0; i < graph.passes().size(); ++i) {
        const PassRecord& pass = graph.passes()[i];
        const auto kept = std::ranges::find(compiled.passes, i, &CompiledPass::pass);
        if (kept == compiled.passes.end())
            nodes += fmt::format("    p{} [shape=box, style=dashed, label=\"{}\"];\n", i, escaped(pass.name));
        else
            nodes += fmt::format("    p{} [shape=box, label=\"{}\\n{} barriers\"];\n", i, escaped(pass.name),
                                 kept->barriers.size());
        for (const Use& use : pass.uses) {
            // Version 0 of a transient resource has no content, so no edge starts at it.
            if (is_read(use.access) && (use.version > 0 || !is_write(use.access))) {
                edges += fmt::format("    r{}_{} -> p{} [label=\"{}\"];\n", use.resource, use.version, i,
                                     name_of(use.access));
                versions.emplace(use.resource, use.version);
            }
            if (is_write(use.access)) {
                edges += fmt::format("    p{} -> r{}_{} [label=\"{}\"];\n", i, use.resource, use.version + 1,
                                     name_of(use.access));
                versions.emplace(use.resource, use.version + 1);
            }
        }
    }
    for (const auto& [resource, version] : versions)
        nodes += resource_node(graph, compiled, resource, version);
    return fmt::format("digraph frame {{\n    rankdir=LR;\n{}{}}}\n", nodes, edges);
}

} // namespace estampe::gpu
