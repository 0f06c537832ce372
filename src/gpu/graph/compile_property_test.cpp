// SPDX-License-Identifier: MIT
// Compiles random graphs and checks the results with a simulator that shares no code with compile.cpp. The
// simulator detects hazards, wrong layouts and overlapping memory slots. The simulator is also tested: it
// must report an error in every graph from which one part of one barrier is removed.
#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "gpu/graph/compile.hpp"
#include "gpu/graph/graph_test_support.hpp"

namespace estampe::gpu {
namespace {

using enum Access;

/// An access to memory, with the accesses that later barriers order after this event.
struct Event {
    std::string what;
    uint32_t resource;
    bool writes;
    /// The accesses of this event and all accesses that have waited for it. A later barrier may name any of
    /// them to wait for this event.
    AccessSet reached;
    AccessSet waited; ///< Accesses that have waited for this event
};

bool meets(AccessSet a, AccessSet b)
{
    return !a.empty() && a.without(b) != a;
}

bool covers(AccessSet all, AccessSet some)
{
    return some.without(all).empty();
}

/// Replays a compiled graph, access by access. A barrier orders an event before the accesses in `after` if
/// `before` names the event, or names an access that is already ordered after the event. A layout change is a
/// separate event.
class Simulator {
public:
    Simulator(const Graph& graph, const CompiledGraph& compiled) : graph_(graph), compiled_(compiled) {}

    /// Returns the errors that were found; empty if the compiled graph is correct.
    std::vector<std::string> run()
    {
        for (const CompiledPass& pass : compiled_.passes) {
            for (const Barrier& barrier : pass.barriers)
                pass_barrier(graph_.passes()[pass.pass], barrier);
            std::map<uint32_t, AccessSet> accesses;
            for (const Use& use : graph_.passes()[pass.pass].uses)
                accesses[use.resource] |= use.access;
            for (const auto& [resource, set] : accesses)
                touch(graph_.passes()[pass.pass], resource, set);
        }
        return complaints_;
    }

private:
    uint64_t memory_of(uint32_t resource) const
    {
        const uint32_t slot = compiled_.slot_of_resource[resource];
        return slot == UINT32_MAX ? (uint64_t{1} << 32) + resource : slot;
    }

    Layout& layout_of(uint32_t resource)
    {
        return layouts_.try_emplace(resource, graph_.resources()[resource].initial_layout).first->second;
    }

    void pass_barrier(const PassRecord& pass, const Barrier& barrier)
    {
        const std::string what = label(pass, barrier.resource);
        std::vector<Event>& events = events_[memory_of(barrier.resource)];
        const bool changes = barrier.old_layout != barrier.new_layout;
        for (Event& event : events) {
            const bool orders = meets(event.reached, barrier.before);
            if (changes && !orders)
                complaints_.push_back(what + ": layout change races with " + event.what);
            if (orders) {
                event.reached |= barrier.after;
                event.waited |= barrier.after;
            }
        }
        if (!changes)
            return;
        Layout& layout = layout_of(barrier.resource);
        const bool is_new =
            std::ranges::none_of(events, [&](const Event& e) { return e.resource == barrier.resource; });
        if (barrier.old_layout != layout)
            complaints_.push_back(what + ": the barrier starts from the wrong layout");
        if (barrier.old_layout == Layout::undefined && !is_new)
            complaints_.push_back(what + ": the barrier discards the content");
        layout = barrier.new_layout;
        events.push_back(
            {"the layout change before " + what, barrier.resource, true, barrier.after, barrier.after});
    }

    void touch(const PassRecord& pass, uint32_t resource, AccessSet accesses)
    {
        const std::string what = label(pass, resource);
        bool writes = false;
        accesses.for_each([&](Access access) {
            writes |= is_write(access);
            if (graph_.resources()[resource].is_image && layout_of(resource) != layout_for(access))
                complaints_.push_back(what + ": the image is in the wrong layout");
        });
        std::vector<Event>& events = events_[memory_of(resource)];
        for (const Event& event : events) {
            const bool conflicts = event.writes || writes || event.resource != resource;
            if (conflicts && !covers(event.waited, accesses))
                complaints_.push_back(what + " does not wait for " + event.what);
        }
        accesses.for_each([&](Access access) { events.push_back({what, resource, writes, access, {}}); });
    }

    std::string label(const PassRecord& pass, uint32_t resource) const
    {
        return pass.name + " on " + graph_.resources()[resource].name;
    }

    const Graph& graph_;
    const CompiledGraph& compiled_;
    std::map<uint64_t, std::vector<Event>> events_;
    std::map<uint32_t, Layout> layouts_;
    std::vector<std::string> complaints_;
};

/// Generates random valid graphs. The graphs are so small that passes often conflict over resources.
class GraphMaker {
public:
    explicit GraphMaker(uint32_t seed) : random_(seed) {}

    Graph make()
    {
        Graph graph;
        const uint32_t resource_count = 4 + below(10);
        for (uint32_t i = 0; i < resource_count; ++i)
            add_resource(graph, i);
        const uint32_t pass_count = 10 + below(20);
        for (uint32_t i = 0; i < pass_count; ++i)
            add_pass(graph, i);
        for (const ImageId image : images_) {
            if (image.version > 0 && below(8) == 0)
                graph.export_image(image);
        }
        for (const BufferId buffer : buffers_) {
            if (buffer.version > 0 && below(8) == 0)
                graph.custom("read back").touch(buffer, host_read);
        }
        return graph;
    }

private:
    uint32_t below(uint32_t limit) { return static_cast<uint32_t>(random_() % limit); }

    Access one_of(const std::vector<Access>& accesses)
    {
        return accesses[below(static_cast<uint32_t>(accesses.size()))];
    }

    void add_resource(Graph& graph, uint32_t i)
    {
        const std::string name = "resource " + std::to_string(i);
        const bool is_imported = below(4) == 0;
        if (below(2) == 0) {
            const BufferDesc desc{.size_bytes = 64 + 64 * uint64_t{below(2)}};
            buffers_.push_back(is_imported ? graph.import_buffer(name, fake_buffer(i), desc)
                                           : graph.buffer(name, desc));
            return;
        }
        const ImageDesc desc{.width = 8 + below(2), .height = 8};
        const Layout layouts[] = {Layout::undefined, Layout::general, Layout::shader_read};
        images_.push_back(is_imported ? graph.import_image(name, fake_image(i), desc, layouts[below(3)])
                                      : graph.image(name, desc));
    }

    void add_pass(Graph& graph, uint32_t index)
    {
        Pass pass = graph.custom("pass " + std::to_string(index));
        if (below(3) == 0)
            pass.keep();
        const uint32_t density = 1 + below(3);
        for (ImageId& image : images_) {
            if (is_alive(image.resource, index) && below(density) == 0)
                use(pass, image, has_content(graph, image.resource, image.version));
        }
        for (BufferId& buffer : buffers_) {
            if (is_alive(buffer.resource, index) && below(density) == 0)
                use(pass, buffer, has_content(graph, buffer.resource, buffer.version));
        }
    }

    /// Whether a resource may be used at a pass. Each resource is used only in a part of the frame, so that
    /// other resources can share its memory.
    static bool is_alive(uint32_t resource, uint32_t pass)
    {
        return pass >= 2 * resource && pass < 2 * resource + 8;
    }

    static bool has_content(const Graph& graph, uint32_t resource, uint32_t version)
    {
        const ResourceRecord& record = graph.resources()[resource];
        return version > 0 || record.imported_image != nullptr || record.imported_buffer != nullptr;
    }

    void use(Pass& pass, ImageId& image, bool has_content)
    {
        if (has_content && below(5) < 3)
            pass.touch(image, one_of({compute_sampled, compute_storage_read, raster_sampled,
                                      raster_storage_read, transfer_read}));
        else if (has_content && below(2) == 0)
            image = pass.touch_write(image, image.version % 2 == 0 ? compute_storage_modify
                                                                   : color_attachment_modify);
        else
            image = pass.touch_write(
                image, one_of({compute_storage_write, transfer_write, color_attachment, depth_attachment}));
    }

    void use(Pass& pass, BufferId& buffer, bool has_content)
    {
        const std::vector<Access> reads{compute_storage_read, compute_uniform, raster_storage_read,
                                        raster_uniform,       indirect,        transfer_read};
        if (has_content && below(5) < 3) {
            for (uint32_t i = 0; i < 1 + below(2); ++i)
                pass.touch(buffer, one_of(reads));
        } else if (has_content && below(2) == 0) {
            buffer = pass.touch_write(buffer, compute_storage_modify);
        } else {
            buffer = pass.touch_write(buffer, one_of({compute_storage_write, transfer_write}));
        }
    }

    std::mt19937 random_;
    std::vector<ImageId> images_;
    std::vector<BufferId> buffers_;
};

constexpr uint32_t compiled_graphs = 1500;

TEST(CompilePropertyTest, RandomGraphsHaveNoHazards)
{
    size_t barrier_count = 0;
    size_t shared_count = 0;
    for (uint32_t seed = 0; seed < compiled_graphs; ++seed) {
        const Graph graph = GraphMaker(seed).make();
        const CompiledGraph compiled = compile(graph);
        const std::vector<std::string> complaints = Simulator(graph, compiled).run();
        ASSERT_TRUE(complaints.empty()) << "seed " << seed << ": " << complaints.front();
        for (const CompiledPass& pass : compiled.passes)
            barrier_count += pass.barriers.size();
        const auto in_slots =
            std::ranges::count_if(compiled.slot_of_resource, [](uint32_t s) { return s != UINT32_MAX; });
        shared_count += static_cast<size_t>(in_slots) - compiled.slots.size();
    }
    // The random graphs must contain enough barriers and shared slots for a meaningful test.
    EXPECT_GT(barrier_count, 5 * compiled_graphs);
    EXPECT_GT(shared_count, compiled_graphs / 2);
}

TEST(CompilePropertyTest, ACompilerThatHasSeenOtherGraphsDoesTheSame)
{
    Compiler compiler;
    CompiledGraph kept;
    for (uint32_t seed = 0; seed < compiled_graphs; ++seed) {
        const Graph graph = GraphMaker(seed).make();
        compiler.compile(graph, kept);
        const CompiledGraph fresh = compile(graph);
        ASSERT_EQ(kept.passes.size(), fresh.passes.size()) << "seed " << seed;
        for (size_t i = 0; i < fresh.passes.size(); ++i) {
            ASSERT_EQ(kept.passes[i].pass, fresh.passes[i].pass) << "seed " << seed;
            ASSERT_EQ(kept.passes[i].barriers, fresh.passes[i].barriers) << "seed " << seed;
        }
        ASSERT_EQ(kept.slot_of_resource, fresh.slot_of_resource) << "seed " << seed;
        ASSERT_EQ(kept.final_layout, fresh.final_layout) << "seed " << seed;
        ASSERT_EQ(kept.slots.size(), fresh.slots.size()) << "seed " << seed;
        for (size_t i = 0; i < fresh.slots.size(); ++i) {
            ASSERT_EQ(kept.slots[i].accesses, fresh.slots[i].accesses) << "seed " << seed;
            ASSERT_EQ(kept.slots[i].image, fresh.slots[i].image) << "seed " << seed;
            ASSERT_EQ(kept.slots[i].buffer, fresh.slots[i].buffer) << "seed " << seed;
        }
    }
}

/// Calls `check` for each copy of `compiled` from which one part of one barrier is removed.
template <class Check>
void for_each_weakened(const CompiledGraph& compiled, Check&& check)
{
    for (size_t p = 0; p < compiled.passes.size(); ++p) {
        for (size_t b = 0; b < compiled.passes[p].barriers.size(); ++b) {
            CompiledGraph weakened = compiled;
            std::vector<Barrier>& barriers = weakened.passes[p].barriers;
            const Barrier whole = barriers[b];
            whole.before.for_each([&](Access access) {
                barriers[b] = whole;
                barriers[b].before = whole.before.without(access);
                check(weakened, whole);
            });
            whole.after.for_each([&](Access access) {
                barriers[b] = whole;
                barriers[b].after = whole.after.without(access);
                check(weakened, whole);
            });
            if (whole.old_layout != whole.new_layout) {
                barriers[b] = whole;
                barriers[b].new_layout = whole.old_layout;
                check(weakened, whole);
            }
            barriers.erase(barriers.begin() + static_cast<std::ptrdiff_t>(b));
            check(weakened, whole);
        }
    }
}

TEST(CompilePropertyTest, NoPartOfABarrierCanBeSpared)
{
    size_t weakened_count = 0;
    for (uint32_t seed = 0; seed < compiled_graphs / 5; ++seed) {
        const Graph graph = GraphMaker(seed).make();
        for_each_weakened(compile(graph), [&](const CompiledGraph& weakened, const Barrier& barrier) {
            ++weakened_count;
            EXPECT_FALSE(Simulator(graph, weakened).run().empty()) << "seed " << seed << ", " << barrier;
        });
    }
    EXPECT_GT(weakened_count, 3 * compiled_graphs);
}

TEST(CompilePropertyTest, SlotsHoldOneResourceAtATime)
{
    for (uint32_t seed = 0; seed < compiled_graphs; ++seed) {
        const Graph graph = GraphMaker(seed).make();
        const CompiledGraph compiled = compile(graph);
        std::map<uint32_t, std::vector<uint32_t>> holders; // For each slot, its resource at each use
        for (const CompiledPass& pass : compiled.passes) {
            for (const Use& use : graph.passes()[pass.pass].uses) {
                const uint32_t slot = compiled.slot_of_resource[use.resource];
                if (slot == UINT32_MAX)
                    continue;
                ASSERT_EQ(compiled.slots[slot].image, graph.resources()[use.resource].image);
                ASSERT_EQ(compiled.slots[slot].buffer, graph.resources()[use.resource].buffer);
                ASSERT_TRUE(compiled.slots[slot].accesses.contains(use.access));
                holders[slot].push_back(use.resource);
            }
        }
        for (auto& [slot, uses] : holders) {
            uses.erase(std::ranges::unique(uses).begin(), uses.end());
            const size_t changes = uses.size();
            std::ranges::sort(uses);
            uses.erase(std::ranges::unique(uses).begin(), uses.end());
            ASSERT_EQ(changes, uses.size())
                << "seed " << seed << ": slot " << slot << " goes back to an earlier holder";
            for (const uint32_t resource : uses)
                ASSERT_TRUE(uses.size() == 1 || !graph.resources()[resource].exported) << "seed " << seed;
        }
    }
}

/// Returns for each pass whether its results are needed. The search is repeated until it finds no further
/// needed pass.
std::vector<bool> wanted_passes(const Graph& graph)
{
    const std::span<const PassRecord> passes = graph.passes();
    std::vector<bool> wanted(passes.size());
    const auto feeds = [&](const Use& made, const Use& used) {
        return is_write(made.access) && is_read(used.access) && made.resource == used.resource &&
               made.version + 1 == used.version;
    };
    const auto has_reason = [&](const PassRecord& pass) {
        return pass.has_side_effect || std::ranges::any_of(pass.uses, [&](const Use& use) {
                   const ResourceRecord& r = graph.resources()[use.resource];
                   const bool lasts =
                       r.exported || r.imported_image != nullptr || r.imported_buffer != nullptr;
                   if (use.access == host_read || (is_write(use.access) && lasts))
                       return true;
                   for (size_t other = 0; other < passes.size(); ++other) {
                       if (wanted[other] && std::ranges::any_of(passes[other].uses,
                                                                [&](const Use& u) { return feeds(use, u); }))
                           return true;
                   }
                   return false;
               });
    };
    for (bool found = true; found;) {
        found = false;
        for (size_t i = 0; i < passes.size(); ++i) {
            if (!wanted[i] && has_reason(passes[i])) {
                wanted[i] = true;
                found = true;
            }
        }
    }
    return wanted;
}

TEST(CompilePropertyTest, ExactlyTheUnwantedPassesAreCulled)
{
    size_t culled_count = 0;
    for (uint32_t seed = 0; seed < compiled_graphs; ++seed) {
        const Graph graph = GraphMaker(seed).make();
        std::vector<bool> kept(graph.passes().size());
        for (const CompiledPass& pass : compile(graph).passes)
            kept[pass.pass] = true;
        ASSERT_EQ(kept, wanted_passes(graph)) << "seed " << seed;
        culled_count += static_cast<size_t>(std::ranges::count(kept, false));
    }
    EXPECT_GT(culled_count, compiled_graphs);
}

} // namespace
} // namespace estampe::gpu
