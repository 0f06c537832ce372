// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/stroke/linked_lines.hpp"

#include <algorithm>

#include "gpu/graph/execute.hpp"
#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/take_part_comp.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {
namespace {

/// Creates an empty buffer of the size of `from`, as the target of a copy.
gpu::Buffer room_for(gpu::Graph& graph, gpu::Device& device, gpu::BufferId from,
                     gpu::MemoryUse use = gpu::MemoryUse::device)
{
    return {device, "strung lines", graph.describe(from).size_bytes, use};
}

/// Copies to make: pairs of source and target.
using Copies = std::vector<std::pair<gpu::BufferId, gpu::Buffer*>>;

void list_copies(const ChainStrokes& from, std::span<const HandDrawn> hands, LinkedLines::Strokes& to,
                 Copies& copies)
{
    copies.insert(copies.end(), {{from.samples, &to.samples},
                                 {from.strokes_before, &to.strokes_before},
                                 {from.strokes, &to.strokes},
                                 {from.grid, &to.grid}});
    to.hands.resize(hands.size());
    for (size_t i = 0; i < hands.size(); ++i) {
        copies.emplace_back(hands[i].line_points, &to.hands[i].line_points);
        copies.emplace_back(hands[i].touches, &to.hands[i].touches);
    }
}

/// Shrinks the buffer of a list to the buffer's first `size_bytes` bytes.
void shrink(gpu::Graph& graph, gpu::Device& device, gpu::Buffer& list, uint64_t size_bytes,
            std::vector<gpu::Buffer>& outgrown)
{
    if (size_bytes >= list.size_bytes()) {
        return;
    }
    outgrown.push_back(std::move(list));
    list = gpu::Buffer(device, "strung lines", std::max<uint64_t>(size_bytes, 16), gpu::MemoryUse::device);
    gpu::add_copy_out(graph, "shrink", gpu::import_whole(graph, "outgrown", outgrown.back()), list);
}

ChainStrokes import_strokes(gpu::Graph& graph, gpu::BufferId sizes, LinkedLines::Strokes& strokes)
{
    const auto before = gpu::import_whole(graph, "strung strokes before", strokes.strokes_before);
    return {.sizes = sizes,
            .samples = gpu::import_whole(graph, "strung samples", strokes.samples),
            .samples_before = before, // a placeholder buffer; no shader reads it
            .strokes_before = before,
            .strokes = gpu::import_whole(graph, "strung strokes", strokes.strokes),
            .grid = gpu::import_whole(graph, "strung grid", strokes.grid)};
}

HandDrawn take_hand(gpu::Graph& graph, gpu::BufferId sizes, LinkedLines::Hand& hand, const PartOfPage& part)
{
    const bool has_touches = hand.touches.size_bytes() > sizeof(shared::LineTouch);
    auto take = graph.compute("contour/take part", shaders::take_part_comp);
    take.read(sizes).read(gpu::import_whole(graph, "strung points", hand.line_points));
    take.read(gpu::import_whole(graph, "strung touches", hand.touches));
    const gpu::BufferId points =
        take.write(graph.buffer("contour/line points", {.size_bytes = hand.line_points.size_bytes()}));
    const gpu::BufferId touches =
        take.write(graph.buffer("contour/touches", {.size_bytes = hand.touches.size_bytes()}));
    take.push(shared::PartConstants{
                  .from_px = part.from_px, .scale = part.scale, .has_touches = has_touches ? 1U : 0U})
        .dispatch_indirect(sizes, indirect_offset(shared::list_samples));
    return {points, touches};
}

} // namespace

void add_keeping(gpu::Graph& graph, gpu::Device& device, const ShapedStrokes& shaped, glm::uvec2 page_px,
                 LinkedLines& lines)
{
    lines = {};
    lines.page_px = page_px;
    Copies copies;
    list_copies(shaped.strokes, shaped.hands, lines.seen, copies);
    if (shaped.hidden) {
        lines.hidden.emplace();
        list_copies(shaped.hidden->first, {&shaped.hidden->second, 1}, *lines.hidden, copies);
    }
    for (const auto& [from, to] : copies) {
        *to = room_for(graph, device, from);
        gpu::add_copy_out(graph, "keep", from, *to);
    }
    lines.sizes = room_for(graph, device, shaped.strokes.sizes, gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "keep sizes", shaped.strokes.sizes, lines.sizes);
}

LinkedLines shrunk(gpu::Device& device, gpu::Executor& executor, LinkedLines lines)
{
    const uint64_t samples = gpu::items_of<shared::ListSize>(lines.sizes)[shared::list_samples].count;
    std::vector<gpu::Buffer> outgrown;
    outgrown.reserve(64);
    gpu::Graph graph;
    const auto shrink_strokes = [&](LinkedLines::Strokes& strokes) {
        shrink(graph, device, strokes.samples, sizeof(shared::LineSample) * samples, outgrown);
        shrink(graph, device, strokes.strokes_before, sizeof(uint32_t) * (samples + 1), outgrown);
        shrink(graph, device, strokes.strokes, sizeof(shared::Stroke) * samples, outgrown);
        for (LinkedLines::Hand& hand : strokes.hands) {
            shrink(graph, device, hand.line_points, 2 * sizeof(shared::LinePoint) * samples, outgrown);
            shrink(graph, device, hand.touches, 2 * sizeof(shared::LineTouch) * samples, outgrown);
        }
    };
    shrink_strokes(lines.seen);
    if (lines.hidden) {
        shrink_strokes(*lines.hidden);
    }
    executor.run(graph);
    return lines;
}

ShapedStrokes take_part(gpu::Graph& graph, LinkedLines& lines, const PartOfPage& part)
{
    const auto sizes = gpu::import_whole(graph, "strung sizes", lines.sizes);
    ShapedStrokes shaped{
        .strokes = import_strokes(graph, sizes, lines.seen), .facing = sizes, .hands = {}, .hidden = {}};
    for (LinkedLines::Hand& hand : lines.seen.hands) {
        shaped.hands.push_back(take_hand(graph, sizes, hand, part));
    }
    if (lines.hidden) {
        shaped.hidden.emplace(import_strokes(graph, sizes, *lines.hidden),
                              take_hand(graph, sizes, lines.hidden->hands.front(), part));
    }
    return shaped;
}

} // namespace estampe::contour
