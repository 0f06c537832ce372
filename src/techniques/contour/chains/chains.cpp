// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/chains.hpp"

#include <algorithm>
#include <cmath>

#include "gpu/resources.hpp"
#include "shaders/crests_comp.hpp"
#include "shaders/emit_comp.hpp"
#include "shaders/emit_suggestive_comp.hpp"
#include "shaders/mark_edges_comp.hpp"
#include "shaders/mark_suggestive_comp.hpp"
#include "shaders/mark_triangles_comp.hpp"
#include "shaders/order_features_comp.hpp"
#include "shaders/order_segments_comp.hpp"
#include "shaders/rank_comp.hpp"
#include "shaders/string_comp.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/extract/page_cells.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {
namespace {

/// Returns every edge between two triangles that has no feature line (a line fixed to the surface, such as a
/// crease).
std::vector<glm::uvec2> all_loose_edges(const EdgeMesh& mesh, const FeatureChains& features)
{
    std::vector<uint32_t> lined;
    lined.reserve(features.points.size());
    for (const shared::FeaturePoint& point : features.points) {
        lined.push_back(point.side);
    }
    std::sort(lined.begin(), lined.end());
    std::vector<glm::uvec2> edges;
    for (uint32_t t = 0; t < mesh.neighbors.size(); ++t) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t side = side_of(t, k);
            const uint32_t beyond = mesh.neighbors[t][static_cast<int>(k)];
            if (beyond != no_side && side < beyond && !std::binary_search(lined.begin(), lined.end(), side) &&
                !std::binary_search(lined.begin(), lined.end(), beyond)) {
                edges.emplace_back(side, beyond);
            }
        }
    }
    return edges;
}

std::vector<uint32_t> edges_of_sides(const EdgeMesh& mesh, const std::vector<glm::uvec2>& edges)
{
    if (edges.empty()) {
        return {};
    }
    std::vector<uint32_t> of_side(3 * mesh.triangles.size(), no_side);
    for (uint32_t i = 0; i < edges.size(); ++i) {
        for (const uint32_t side : {edges[i].x, edges[i].y}) {
            of_side[3 * size_t{side >> 2U} + (side & 3U)] = i;
        }
    }
    return of_side;
}

} // namespace

LineMesh upload_line_mesh(gpu::Device& device, const EdgeMesh& mesh, FeatureChains features,
                          const std::vector<shared::VertexBending>& bendings, bool along_edges)
{
    if (along_edges) {
        features.loose_edges = all_loose_edges(mesh, features);
    }
    LineMesh lines;
    lines.triangles = gpu::upload_buffer(device, "line triangles", mesh.triangles);
    lines.neighbors = gpu::upload_buffer(device, "line neighbors", mesh.neighbors);
    lines.loose_edges = gpu::upload_buffer(device, "loose edges", features.loose_edges);
    lines.loose_edge_of_side =
        gpu::upload_buffer(device, "loose edges of sides", edges_of_sides(mesh, features.loose_edges));
    lines.feature_points = gpu::upload_buffer(device, "feature points", features.points);
    lines.feature_chains = gpu::upload_buffer(device, "feature chains", features.chains);
    if (!bendings.empty()) {
        lines.bendings = gpu::upload_buffer(device, "bendings", bendings);
        lines.bending_count = static_cast<uint32_t>(bendings.size());
    }
    lines.triangle_count = static_cast<uint32_t>(mesh.triangles.size());
    lines.loose_edge_count = static_cast<uint32_t>(features.loose_edges.size());
    lines.feature_point_count = static_cast<uint32_t>(features.points.size());
    lines.feature_chain_count = static_cast<uint32_t>(features.chains.size());
    lines.features_leave_edges = features.leave_edges;
    lines.shell_count = mesh.shell_count;
    return lines;
}

void LineHistory::begin_frame(gpu::Device& device, glm::uvec2 size_px, bool continues, bool has_hidden)
{
    for (const LineClass lines : {LineClass::seen, LineClass::hidden}) {
        Memory& memory = memories_.at(static_cast<size_t>(lines));
        memory.is_kept = lines == LineClass::seen || has_hidden;
        if (memory.is_kept && memory.size_px != size_px) {
            for (Drawn& drawn : memory.drawn) {
                drawn.grid = gpu::Buffer(device, "line grid", sizeof(glm::uvec2) * grid_cell_count(size_px),
                                         gpu::MemoryUse::device);
                drawn.samples = gpu::Buffer(device, "drawn samples",
                                            sizeof(shared::DrawnSample) * sample_capacity(size_px),
                                            gpu::MemoryUse::device);
            }
            memory.size_px = size_px;
            memory.holds_frame = false;
        }
        memory.holds_frame = memory.holds_frame && continues;
    }
}

void LineHistory::end_frame(const glm::mat4& clip_from_anchor)
{
    clip_from_anchor_ = clip_from_anchor;
    now_ = 1 - now_;
    for (Memory& memory : memories_) {
        memory.holds_frame = memory.is_kept;
    }
}

void LineHistory::recall(gpu::Device& device, glm::uvec2 size_px, std::array<std::optional<Drawn>, 2> drawn,
                         const glm::mat4& clip_from_anchor)
{
    forget();
    begin_frame(device, size_px, false, drawn.at(static_cast<size_t>(LineClass::hidden)).has_value());
    for (size_t i = 0; i < memories_.size(); ++i) {
        if (drawn.at(i)) {
            memories_.at(i).drawn.at(1 - now_) = std::move(*drawn.at(i));
            memories_.at(i).holds_frame = true;
        }
    }
    clip_from_anchor_ = clip_from_anchor;
}

void LineHistory::forget()
{
    for (Memory& memory : memories_) {
        memory.holds_frame = false;
    }
}

uint32_t grid_cell_count(glm::uvec2 size_px)
{
    const glm::uvec2 cells = (size_px + shared::grid_cell_px - 1U) / shared::grid_cell_px;
    return cells.x * cells.y;
}

uint32_t sample_capacity(glm::uvec2 size_px)
{
    // Capacity of the list of line samples for scenes with many lines. Hidden lines also need samples. For
    // example, a view of the built-in scene `temple` needs 0.8 samples per pixel on a page of 400 x 300
    // pixels.
    constexpr uint32_t crowded_scene = 262144;
    const uint32_t pixels = size_px.x * size_px.y;
    return std::max(pixels / 4, std::min(2 * pixels, crowded_scene));
}

namespace {

/// The outline of a mesh with n triangles crosses about 0.7 n^0.8 triangles (McGuire 2004).
/// segment_capacity() reserves space for six times that number of segments.
uint32_t segment_capacity(const LineMesh& mesh, uint32_t suggestive, bool along_edges, uint32_t cells)
{
    const auto items = static_cast<double>((along_edges ? 0 : mesh.triangle_count) + mesh.loose_edge_count +
                                           suggestive + cells);
    const double usual = 4096.0 + 6.0 * 0.7 * std::pow(items, 0.8);
    return std::max(1U, static_cast<uint32_t>(std::min(items, usual)));
}

struct Marks {
    gpu::BufferId facing;
    /// For each loose edge (an edge without a fixed line such as a crease): the part that is outline; unused
    /// if the mesh has no loose edges.
    gpu::BufferId edge_parts;
    gpu::BufferId words;
    gpu::BufferId before;
    gpu::BufferId sizes;
    InlineVector<PageLines, most_page_lines> page_lines;
};

/// Number of words of mark bits (1: a line runs through) for triangles and loose edges. The mark bits of the
/// page lattice's cells follow after the words for triangles and edges.
uint32_t mesh_words(const shared::ChainConstants& constants)
{
    return (constants.triangle_count + 31) / 32 + (constants.loose_edge_count + 31) / 32 +
           (constants.suggestive_count + 31) / 32;
}

/// Computes where suggestive contours and crests run. Returns nothing if neither kind of line is drawn.
std::optional<gpu::BufferId> add_bends(gpu::Graph& graph, const ChainInputs& in, LineMesh& mesh)
{
    std::optional<gpu::BufferId> bends;
    if (mesh.bending_count > 0) {
        bends = add_view_bends(graph, in.frame, in.posed_vertices,
                               gpu::import_whole(graph, "bendings", mesh.bendings), mesh.bending_count,
                               in.suggestive_cut);
    }
    if (!in.crests) {
        return bends;
    }
    const shared::CrestConstants constants{.first_vertex = in.crests->first_vertex,
                                           .vertex_count = in.crests->vertex_count,
                                           .keeps_others = bends ? 1U : 0U,
                                           .along = in.crests->along};
    auto pass = graph.compute("contour/crests", shaders::crests_comp);
    pass.sample(in.posed_vertices);
    bends = bends ? pass.modify(*bends)
                  : pass.write(graph.buffer("contour/view bends",
                                            list_of(in.crests->vertex_count, sizeof(glm::vec2))));
    pass.push(constants).dispatch_items(constants.vertex_count -
                                        (constants.keeps_others != 0 ? constants.first_vertex : 0));
    return bends;
}

/// Number of workgroups of 64 threads that write mark bits (1: a line runs through) for `count` items. Each
/// subgroup writes one word, for 32 items. A CPU has eight subgroups per workgroup; an empty workgroup costs
/// a CPU as much time as a full one.
uint32_t mark_groups(uint32_t count, const gpu::ExecutionProfile& execution)
{
    const uint32_t items = execution.items_per_group();
    return (count + items - 1) / items;
}

Marks add_marks(gpu::Graph& graph, const ChainInputs& in, gpu::BufferId loose_edges,
                const std::optional<gpu::BufferId>& view_bends, const shared::ChainConstants& constants,
                bool along_edges)
{
    const uint32_t triangle_words = (constants.triangle_count + 31) / 32;
    const uint32_t words = mesh_words(constants) + constants.page_words;
    auto triangles = graph.compute("contour/mark triangles", shaders::mark_triangles_comp);
    triangles.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
    const gpu::BufferId facing =
        triangles.write(graph.buffer("contour/facing", list_of(triangle_words, sizeof(uint32_t))));
    gpu::BufferId marks = triangles.write(graph.buffer("contour/marks", list_of(words, sizeof(uint32_t))));
    triangles.variant(along_edges ? shared::mark_along_edges : 0U).push(constants);
    triangles.dispatch(mark_groups(constants.triangle_count, in.execution));
    gpu::BufferId parts = facing;
    if (constants.loose_edge_count > 0) {
        auto edges = graph.compute("contour/mark edges", shaders::mark_edges_comp);
        edges.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
        edges.sample(loose_edges, gpu::Format::rg32ui)
            .sample(in.neighbors)
            .sample(facing, gpu::Format::r32ui);
        marks = edges.modify(marks);
        parts = edges.write(
            graph.buffer("contour/edge parts", list_of(constants.loose_edge_count, sizeof(uint32_t))));
        edges.variant(along_edges ? shared::mark_along_edges : 0U)
            .push(constants)
            .dispatch(mark_groups(constants.loose_edge_count, in.execution));
    }
    if (view_bends) {
        auto suggestive = graph.compute("contour/mark suggestive", shaders::mark_suggestive_comp);
        suggestive.sample(in.line_triangles).sample(*view_bends, gpu::Format::rg32ui);
        marks = suggestive.modify(marks);
        suggestive.push(constants).dispatch(mark_groups(constants.suggestive_count, in.execution));
    }
    const InlineVector<PageLines, most_page_lines> page_lines =
        add_page_lines(graph, in, mesh_words(constants));
    for (const PageLines& lines : page_lines) {
        marks = add_cell_marks(graph, lines, in.size_px, marks);
    }
    const gpu::BufferId sizes =
        graph.buffer("contour/sizes", list_of(shared::list_count, sizeof(shared::ListSize)));
    const Scanned scanned = add_scan(graph, "marks",
                                     {.sizes = sizes,
                                      .values = marks,
                                      .sizes_are_new = true,
                                      .value_capacity = words,
                                      .is_spread = in.execution.spreads_scans(),
                                      .constants = {.fixed_count = words,
                                                    .count_of = shared::no_list,
                                                    .total_to = shared::list_segments,
                                                    .capacity = constants.segment_capacity,
                                                    .slots_before = constants.feature_chain_count,
                                                    .counts_bits = 1}});
    return {facing, parts, marks, scanned.before, scanned.sizes, page_lines};
}

} // namespace

ChainInputs chain_inputs(gpu::Graph& graph, const ContourInputs& in, LineMesh& mesh,
                         const ContourStyle& style)
{
    ChainInputs inputs{.frame = in.frame,
                       .posed_vertices = in.posed_vertices,
                       .visibility = in.line_hiders.value_or(in.visibility),
                       .neighbors = gpu::import_whole(graph, "line neighbors", mesh.neighbors),
                       .line_triangles = gpu::import_whole(graph, "line triangles", mesh.triangles),
                       .suggestive_cut = {style.suggestive_growth, style.suggestive_deg},
                       .crests = has_lines(style, shared::line_crest) ? in.crests : std::nullopt,
                       .crest_deg = style.crest_deg,
                       .meetings = has_lines(style, shared::line_intersection) && mesh.shell_count > 1,
                       .sun = {},
                       .foliage = {},
                       .step_px = in.line_step_px,
                       .pixels_per_mm = in.pixels_per_mm,
                       .shortest_px = style.shortest_mm * in.pixels_per_mm,
                       .gap_px = style.gap_mm * in.pixels_per_mm,
                       .pen_px = style.outline.width_mm * in.pixels_per_mm,
                       .has_brushes = in.brushes != nullptr,
                       .shell_count = mesh.shell_count,
                       .size_px = in.size_px,
                       .execution = in.execution};
    if (in.sun) {
        inputs.sun = SunPixels{.share = *in.sun,
                               .visibility = in.visibility,
                               .draw = in.draw,
                               .depth = in.depth,
                               .normal = in.normal};
    }
    if (in.has_clumps) {
        inputs.foliage = FoliagePixels{.visibility = in.visibility,
                                       .draws = in.draws,
                                       .draw = in.draw,
                                       .depth = in.depth,
                                       .light = in.light,
                                       .tone = in.tone,
                                       .clump_px = style.clump_mm * in.pixels_per_mm,
                                       .first_leaf = in.first_cut_triangle,
                                       .has_outlines = has_lines(style, shared::line_clump),
                                       .has_marks = has_lines(style, shared::line_leaf)};
    }
    return inputs;
}

Chains add_chains(gpu::Graph& graph, const ChainInputs& in, LineMesh& mesh, bool along_edges)
{
    const uint32_t words_of_page =
        ((in.meetings ? 1 : 0) + (in.sun ? 1 : 0) + (in.foliage ? 1 : 0)) * page_words(in.size_px);
    const uint32_t suggestive_count = mesh.bending_count > 0 || in.crests ? mesh.triangle_count : 0;
    const uint32_t segments_most = segment_capacity(mesh, suggestive_count, along_edges, 32 * words_of_page);
    const shared::ChainConstants constants{.triangle_count = mesh.triangle_count,
                                           .loose_edge_count = mesh.loose_edge_count,
                                           .suggestive_count = suggestive_count,
                                           .page_words = words_of_page,
                                           .feature_chain_count = mesh.feature_chain_count,
                                           .feature_point_count = mesh.feature_point_count,
                                           .segment_capacity = segments_most,
                                           .point_capacity = 2 * segments_most + mesh.feature_point_count,
                                           .sample_capacity = sample_capacity(in.size_px),
                                           .step_px = in.step_px,
                                           .most_rounding_px = 0.5F * in.pen_px,
                                           .first_crest_vertex =
                                               in.crests ? in.crests->first_vertex : UINT32_MAX,
                                           .least_turn = std::tan(glm::radians(in.crest_deg))};
    const auto loose_edges = gpu::import_whole(graph, "loose edges", mesh.loose_edges);
    const std::optional<gpu::BufferId> view_bends = add_bends(graph, in, mesh);
    const Marks marks = add_marks(graph, in, loose_edges, view_bends, constants, along_edges);

    auto emit = graph.compute("contour/emit", shaders::emit_comp);
    emit.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices).sample(in.neighbors);
    emit.sample(loose_edges, gpu::Format::rg32ui);
    emit.sample(gpu::import_whole(graph, "loose edges of sides", mesh.loose_edge_of_side),
                gpu::Format::r32ui);
    for (const gpu::BufferId words : {marks.edge_parts, marks.facing, marks.words, marks.before}) {
        emit.sample(words, gpu::Format::r32ui);
    }
    emit.read(marks.sizes);
    gpu::BufferId segments =
        emit.write(graph.buffer("contour/segments", list_of(segments_most, sizeof(shared::Segment))));
    gpu::BufferId ranks =
        emit.write(graph.buffer("contour/ranks", list_of(segments_most, sizeof(shared::Rank))));
    emit.variant((mesh.loose_edge_count > 0 ? shared::emit_has_loose_edges : 0U) |
                 (along_edges ? shared::emit_along_edges : 0U))
        .push(constants);
    emit.dispatch_indirect(marks.sizes, indirect_offset(shared::list_segments));
    if (view_bends) {
        auto suggestive = graph.compute("contour/emit suggestive", shaders::emit_suggestive_comp);
        suggestive.sample(in.line_triangles).sample(in.posed_vertices).sample(in.neighbors);
        suggestive.sample(*view_bends, gpu::Format::rg32ui);
        for (const gpu::BufferId words : {marks.words, marks.before}) {
            suggestive.sample(words, gpu::Format::r32ui);
        }
        suggestive.read(marks.sizes);
        segments = suggestive.modify(segments);
        ranks = suggestive.modify(ranks);
        suggestive.push(constants);
        suggestive.dispatch_indirect(marks.sizes, indirect_offset(shared::list_segments));
    }

    CellSegments cells{.marks = marks.words,
                       .marks_before = marks.before,
                       .sizes = marks.sizes,
                       .segments = segments,
                       .ranks = ranks,
                       .word_count = mesh_words(constants) + words_of_page};
    for (const PageLines& lines : marks.page_lines) {
        add_cell_segments(graph, in, lines, cells);
    }
    segments = cells.segments;
    ranks = cells.ranks;

    for (uint64_t reach = 1; reach < segments_most; reach *= 4) {
        auto rank = graph.compute("contour/rank", shaders::rank_comp);
        rank.read(marks.sizes).sample(ranks);
        ranks = rank.write(graph.buffer("contour/ranks", list_of(segments_most, sizeof(shared::Rank))));
        rank.dispatch_indirect(marks.sizes, indirect_offset(shared::list_segments));
    }

    const uint32_t slots_most = segments_most + mesh.feature_chain_count;
    const auto feature_chains = gpu::import_whole(graph, "feature chains", mesh.feature_chains);
    auto string = graph.compute("contour/string", shaders::string_comp);
    string.read(marks.sizes).read(feature_chains).sample(segments).sample(ranks);
    const gpu::BufferId points_of_slot =
        string.write(graph.buffer("contour/points of slot", list_of(slots_most, sizeof(uint32_t))));
    const gpu::BufferId flags_of_slot =
        string.write(graph.buffer("contour/flags of slot", list_of(slots_most, sizeof(uint32_t))));
    const gpu::BufferId first_of_end =
        string.write(graph.buffer("contour/first of end", list_of(segments_most, sizeof(uint32_t))));
    string.push(constants).dispatch_indirect(marks.sizes, indirect_offset(shared::list_slots));
    const Scanned scanned = add_scan(graph, "points",
                                     {.sizes = marks.sizes,
                                      .values = points_of_slot,
                                      .value_capacity = slots_most,
                                      .is_spread = in.execution.spreads_scans(),
                                      .constants = {.fixed_count = 0,
                                                    .count_of = shared::list_slots,
                                                    .total_to = shared::list_points,
                                                    .capacity = constants.point_capacity,
                                                    .slots_before = shared::no_list,
                                                    .counts_bits = 0}});

    auto order = graph.compute("contour/order outline", shaders::order_segments_comp);
    order.uniform(in.frame).read(scanned.sizes).sample(segments).sample(ranks).read(first_of_end);
    order.sample(scanned.before, gpu::Format::r32ui);
    order.sample(in.line_triangles).sample(in.posed_vertices).sample(in.neighbors);
    gpu::BufferId points = order.write(
        graph.buffer("contour/points", list_of(constants.point_capacity, sizeof(shared::ChainPoint))));
    gpu::BufferId lengths =
        order.write(graph.buffer("contour/lengths", list_of(constants.point_capacity, sizeof(uint32_t))));
    order.push(constants).dispatch_indirect(scanned.sizes, indirect_offset(shared::list_segments));
    if (mesh.feature_point_count > 0) {
        auto features = graph.compute("contour/order features", shaders::order_features_comp);
        features.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
        features.sample(in.neighbors);
        features.read(gpu::import_whole(graph, "feature points", mesh.feature_points));
        features.read(feature_chains).sample(scanned.before, gpu::Format::r32ui);
        points = features.modify(points);
        lengths = features.modify(lengths);
        features.variant(mesh.features_leave_edges ? shared::order_features_leave_edges : 0U);
        features.push(constants).dispatch_items(mesh.feature_point_count);
    }
    return {.constants = constants,
            .facing = marks.facing,
            .marks = marks.words,
            .view_bends = view_bends,
            .sizes = scanned.sizes,
            .points_of_slot = points_of_slot,
            .flags_of_slot = flags_of_slot,
            .points_before = scanned.before,
            .points = points,
            .lengths = lengths};
}

} // namespace estampe::contour
