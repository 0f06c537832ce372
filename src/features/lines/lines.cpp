// SPDX-License-Identifier: MIT
#include "features/lines/lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <estampe/image.hpp>

#include "core/long_jobs.hpp"
#include "techniques/contour/chains/chains.glsl.h"
#include "techniques/contour/chains/mesh/bending.hpp"
#include "techniques/tam/stroke.hpp"

namespace estampe::features {
namespace {

struct Share {
    float from = 0.0F;
    float to = 1.0F;
};

/// Shortens the range `kept` of a segment to the part where its values, `a` at one end and `b` at the other,
/// are between `least` and `most`. `kept` is measured in shares of the segment, 0 to 1.
void keep_between(float a, float b, float least, float most, Share& kept)
{
    for (const auto& [from, to] : {std::pair(a - least, b - least), std::pair(most - a, most - b)}) {
        if (from < 0.0F && to < 0.0F) {
            kept = {1.0F, 0.0F};
        } else if (from < 0.0F) {
            kept.from = std::max(kept.from, from / (from - to));
        } else if (to < 0.0F) {
            kept.to = std::min(kept.to, from / (from - to));
        }
    }
}

VectorPoint between(const VectorPoint& a, const VectorPoint& b, float share, const paper::Window& window)
{
    return {glm::clamp(glm::mix(a.page_mm, b.page_mm, share), window.min_mm, window.max_mm),
            glm::mix(a.width_mm, b.width_mm, share)};
}

bool has_length(const VectorStroke& stroke)
{
    return std::ranges::any_of(stroke.points, [&](const VectorPoint& point) {
        return point.page_mm != stroke.points.front().page_mm;
    });
}

} // namespace

std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window)
{
    std::vector<VectorStroke> parts;
    const bool is_inside = std::ranges::all_of(stroke.points, [&](const VectorPoint& point) {
        return glm::clamp(point.page_mm, window.min_mm, window.max_mm) == point.page_mm;
    });
    if (is_inside) {
        parts.push_back(stroke);
    }
    VectorStroke open = stroke;
    open.is_closed = false;
    open.points.clear();
    const auto finish = [&] {
        if (open.points.size() > 1) {
            parts.push_back(open);
        }
        open.points.clear();
    };
    for (size_t i = 1; i < stroke.points.size() && !is_inside; ++i) {
        const VectorPoint& a = stroke.points[i - 1];
        const VectorPoint& b = stroke.points[i];
        Share kept;
        keep_between(a.page_mm.x, b.page_mm.x, window.min_mm.x, window.max_mm.x, kept);
        keep_between(a.page_mm.y, b.page_mm.y, window.min_mm.y, window.max_mm.y, kept);
        if (kept.from >= kept.to) {
            finish();
            continue;
        }
        if (open.points.empty() || kept.from > 0.0F) {
            finish();
            open.points.push_back(between(a, b, kept.from, window));
        }
        open.points.push_back(between(a, b, kept.to, window));
        if (kept.to < 1.0F) {
            finish();
        }
    }
    finish();
    std::erase_if(parts, [](const VectorStroke& part) { return !has_length(part); });
    return parts;
}

namespace {

/// Numbers the bodies (instances of nodes), and returns for each draw call the number of its body.
std::vector<uint32_t> bodies_of_draws(const pose::MeshData& layout)
{
    std::map<std::pair<Index, uint32_t>, uint32_t> numbers;
    std::vector<uint32_t> bodies;
    bodies.reserve(layout.draws.size());
    for (const pose::DrawSource& source : layout.sources) {
        const auto number = static_cast<uint32_t>(numbers.size());
        bodies.push_back(numbers.try_emplace({source.node, source.instance}, number).first->second);
    }
    bodies.resize(layout.draws.size(), contour::no_side);
    return bodies;
}

/// Returns for each vertex the diameter of its object in the rest pose. The bending of lines is measured
/// relative to this diameter.
std::vector<float> sizes_of_objects(const pose::MeshData& layout)
{
    const std::vector<uint32_t> body_of_draw = bodies_of_draws(layout);
    // The scene has at most as many bodies as draw calls.
    std::vector<Bounds> bounds(layout.draws.size());
    for (size_t v = 0; v < layout.draw_of_vertex.size(); ++v) {
        const uint32_t body = body_of_draw[layout.draw_of_vertex[v]];
        if (body != contour::no_side) {
            bounds[body].extend(layout.stroke_coordinates[v]);
        }
    }
    std::vector<float> sizes;
    sizes.reserve(layout.draw_of_vertex.size());
    for (const uint32_t draw : layout.draw_of_vertex) {
        const bool has_lines =
            body_of_draw[draw] != contour::no_side && (layout.draws[draw].flags & shared::draw_is_cut) == 0;
        sizes.push_back(has_lines ? static_cast<float>(2.0 * bounds[body_of_draw[draw]].radius()) : 0.0F);
    }
    return sizes;
}

/// Returns for each triangle 1 if its corners run clockwise as seen from the side to which its normals point,
/// else 0.
std::vector<uint8_t> clockwise_triangles(const pose::MeshData& layout)
{
    std::vector<uint8_t> clockwise;
    clockwise.reserve(layout.triangles.size());
    for (const glm::uvec4& triangle : layout.triangles) {
        const shared::DrawRecord& draw = layout.draws[triangle.w & shared::triangle_draw_mask];
        const auto rest = [&](int k) -> const shared::RestVertex& {
            return layout.rest_vertices[draw.first_rest_vertex + triangle[k] - draw.first_posed_vertex];
        };
        const glm::vec3 a = rest(0).position;
        const glm::vec3 face = glm::cross(rest(1).position - a, rest(2).position - a);
        glm::vec3 normal(0.0F);
        for (int k = 0; k < 3; ++k) {
            normal += pose::unpack_normal(rest(k).normal);
        }
        const bool is_mirrored = (triangle.w & shared::triangle_mirrored) != 0;
        clockwise.push_back((glm::dot(face, normal) < 0.0F) != is_mirrored ? 1 : 0);
    }
    return clockwise;
}

bool has_chains(const pose::MeshData& layout, const contour::ContourStyle& style)
{
    return style.enabled && style.lines == contour::Lines::chains && !layout.triangles.empty();
}

} // namespace

contour::EdgeMesh edge_mesh_of(const pose::MeshData& layout)
{
    std::vector<glm::vec3> mesh_positions;
    std::vector<glm::vec3> mesh_normals;
    mesh_positions.reserve(layout.draw_of_vertex.size());
    mesh_normals.reserve(layout.draw_of_vertex.size());
    for (uint32_t v = 0; v < layout.draw_of_vertex.size(); ++v) {
        const shared::DrawRecord& draw = layout.draws[layout.draw_of_vertex[v]];
        const shared::RestVertex& rest =
            layout.rest_vertices[draw.first_rest_vertex + v - draw.first_posed_vertex];
        mesh_positions.push_back(rest.position);
        mesh_normals.push_back(pose::unpack_normal(rest.normal));
    }
    const std::vector<uint32_t> body_of_draw = bodies_of_draws(layout);
    std::vector<uint32_t> bodies;
    std::vector<uint32_t> materials;
    bodies.reserve(layout.triangles.size());
    materials.reserve(layout.triangles.size());
    for (uint32_t t = 0; t < layout.triangles.size(); ++t) {
        const uint32_t draw = layout.triangles[t].w & shared::triangle_draw_mask;
        const bool is_cut = (layout.draws[draw].flags & shared::draw_is_cut) != 0;
        bodies.push_back(is_cut ? contour::no_side : body_of_draw[draw]);
        materials.push_back(layout.draws[draw].material);
    }
    return contour::build_edge_mesh({.triangles = layout.triangles,
                                     .positions = layout.stroke_coordinates,
                                     .mesh_positions = mesh_positions,
                                     .mesh_normals = mesh_normals,
                                     .bodies = bodies,
                                     .materials = materials,
                                     .edge_marks = layout.edge_marks});
}

std::future<void> LineMeshes::find_edges(const pose::MeshData& layout, const contour::ContourStyle& style)
{
    if (edges_ || !has_chains(layout, style)) {
        return {};
    }
    return std::async(launch_if_possible, [this, &layout] { edges_ = edge_mesh_of(layout); });
}

contour::LineMesh* LineMeshes::ensure(gpu::Device& device, const pose::MeshData& layout,
                                      const contour::ContourStyle& style)
{
    if (!has_chains(layout, style)) {
        return nullptr;
    }
    if (!edges_) {
        edges_ = edge_mesh_of(layout);
    }
    const auto has = [&](uint32_t kind) { return contour::has_lines(style, kind); };
    const Choice choice{.features = {.crease_deg = style.crease_deg, .marked = has(shared::line_marked)},
                        .ridges = {has(shared::line_ridge), has(shared::line_valley), style.ridge_deg},
                        .along_edges = style.silhouettes == contour::Silhouettes::edges,
                        .suggestive = has(shared::line_suggestive)};
    if (!lines_ || choice_ != choice) {
        make_lines(device, layout, choice);
        choice_ = choice;
    }
    return &*lines_;
}

void LineMeshes::make_lines(gpu::Device& device, const pose::MeshData& layout, const Choice& choice)
{
    contour::FeatureChains features =
        contour::string_features(*edges_, layout.stroke_coordinates, choice.features);
    std::vector<shared::VertexBending> vertex_bendings;
    if (choice.ridges.ridges || choice.ridges.valleys || choice.suggestive) {
        const std::vector<float> sizes = sizes_of_objects(layout);
        const std::vector<uint8_t> clockwise = clockwise_triangles(layout);
        const contour::RestSurface surface{*edges_, layout.stroke_coordinates, sizes, clockwise};
        if (!bendings_) {
            bendings_ = contour::find_bending(surface);
        }
        contour::add_ridges(surface, *bendings_, choice.ridges, features);
        if (choice.suggestive) {
            vertex_bendings = contour::vertex_bendings(surface, *bendings_);
        }
    }
    lines_ =
        contour::upload_line_mesh(device, *edges_, std::move(features), vertex_bendings, choice.along_edges);
}

void LineMeshes::forget()
{
    edges_.reset();
    bendings_.reset();
    lines_.reset();
    choice_.reset();
}

namespace {

constexpr uint32_t brush_columns = shared::brush_columns;
constexpr uint32_t rows = shared::brush_rows;
constexpr uint32_t seed = 7;
// Number that sets how fine the hairs of a brush stroke are. The hairs of brush strokes are finer than in
// tonal art maps, where a stroke is only a few pixels wide.
constexpr float hairs = 4.0F;

/// Position along a brush's stroke: either a whole stroke from start to end, or a periodic stroke whose end
/// joins its start.
float progress(float share, contour::BrushFit fit)
{
    if (fit == contour::BrushFit::stretch) {
        return share;
    }
    return 0.55F - 0.17F * std::cos(2.0F * std::numbers::pi_v<float> * share);
}

contour::BrushStrip drawn_by(tam::Tool tool, contour::BrushFit fit)
{
    const tam::Brush brush({.tool = tool,
                            .width_px = static_cast<float>(rows),
                            .opacity = 1.0F,
                            .grain = tool == tam::Tool::pencil ? 0.7F : 0.95F});
    const bool feels_paper = brush.tooth_cell_px() > 0;
    const std::vector<float> tooth =
        feels_paper ? tam::paper_tooth(brush_columns, 2 * brush.tooth_cell_px(), seed) : std::vector<float>();
    contour::BrushStrip strip{.widths = static_cast<float>(brush_columns) / static_cast<float>(rows)};
    strip.ink.reserve(size_t{brush_columns} * rows);
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < brush_columns; ++x) {
            const size_t texel = size_t{y} * brush_columns + x;
            const float share = (static_cast<float>(x) + 0.5F) / static_cast<float>(brush_columns);
            strip.ink.push_back(
                brush.ink({.along = progress(share, fit),
                           .across_px = static_cast<float>(y) + 0.5F - 0.5F * static_cast<float>(rows),
                           .half_px = 0.5F * static_cast<float>(rows),
                           .tooth = feels_paper ? tooth[texel] : 0.0F,
                           .hairs = hairs},
                          seed));
        }
    }
    return strip;
}

contour::BrushStrip pictured(const std::string& path, const ReadScope& scope)
{
    const Image picture = load_image(path, scope);
    return {.ink = tam::stroke_of(picture, brush_columns, rows, path),
            .widths = static_cast<float>(picture.width) / static_cast<float>(std::max(picture.height, 1U))};
}

contour::BrushStrip strip_of(const std::string& brush, const BrushChoice& choice)
{
    if (brush == "pencil") {
        return drawn_by(tam::Tool::pencil, choice.fit);
    }
    if (brush == "charcoal") {
        return drawn_by(tam::Tool::charcoal, choice.fit);
    }
    return brush == "brush" ? drawn_by(tam::Tool::brush, choice.fit) : pictured(brush, choice.scope);
}

/// Draws the picture of one dash with round ends, and the gap after it.
contour::BrushStrip dash(const BrushChoice& choice)
{
    const float period_mm = choice.dash_mm + choice.gap_mm;
    const float texel_mm = period_mm / static_cast<float>(brush_columns);
    const float radius_mm = 0.5F * std::min(choice.dash_width_mm, choice.dash_mm);
    contour::BrushStrip strip{.widths = period_mm / std::max(choice.dash_width_mm, 0.01F)};
    strip.ink.reserve(size_t{brush_columns} * rows);
    for (uint32_t y = 0; y < rows; ++y) {
        const float across = 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(rows) - 1.0F;
        const float shorter_mm = radius_mm * (1.0F - std::sqrt(1.0F - across * across));
        for (uint32_t x = 0; x < brush_columns; ++x) {
            const float along_mm = (static_cast<float>(x) + 0.5F) * texel_mm;
            const float inside_mm = std::min(along_mm, choice.dash_mm - along_mm) - shorter_mm;
            strip.ink.push_back(std::clamp(inside_mm / texel_mm + 0.5F, 0.0F, 1.0F));
        }
    }
    return strip;
}

bool is_pen(const std::string& brush)
{
    return brush.empty() || brush == "pen";
}

} // namespace

BrushChoice brush_choice(const contour::ContourStyle& style)
{
    BrushChoice choice{.brush_of_kind = {}, .fit = style.brush_fit, .scope = style.scope};
    for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
        const std::string& own = contour::line_style(style, kind).brush;
        // Geometric kinds of lines, such as creases, are searched even if the style itself does not draw
        // them, because the style variant of a material may draw them.
        const bool is_found = kind < shared::line_marked || contour::has_lines(style, kind);
        if (is_found) {
            choice.brush_of_kind.at(kind) = own.empty() ? style.brush : own;
        }
    }
    if (style.hidden.enabled) {
        choice.dash_mm = style.hidden.dash_mm;
        choice.gap_mm = style.hidden.gap_mm;
        choice.dash_width_mm = style.hidden.width_mm;
    }
    return choice;
}

bool is_drawn_by_pen(const contour::ContourStyle& style)
{
    const BrushChoice choice = brush_choice(style);
    return std::ranges::all_of(choice.brush_of_kind, is_pen);
}

std::optional<contour::BrushSet> load_brushes(const contour::ContourStyle& style)
{
    const BrushChoice choice = brush_choice(style);
    contour::BrushSet set;
    std::map<std::string, uint32_t> known;
    for (size_t kind = 0; kind < choice.brush_of_kind.size(); ++kind) {
        const std::string& brush = choice.brush_of_kind.at(kind);
        if (is_pen(brush)) {
            continue;
        }
        const auto [place, is_new] = known.try_emplace(brush, static_cast<uint32_t>(set.strips.size()));
        if (is_new) {
            set.strips.push_back(strip_of(brush, choice));
        }
        set.strip_of_use.at(kind) = place->second;
    }
    if (choice.dash_mm > 0.0F) {
        set.strip_of_use.at(shared::brush_hidden) = static_cast<uint32_t>(set.strips.size());
        set.strips.push_back(dash(choice));
    }
    return set.strips.empty() ? std::nullopt : std::optional(std::move(set));
}

contour::BrushImages* LineBrushes::ensure(gpu::Device& device, const contour::ContourStyle& style)
{
    if (!style.enabled || style.lines != contour::Lines::chains) {
        return nullptr;
    }
    const BrushChoice wanted = brush_choice(style);
    if (choice_ != wanted) {
        choice_.reset();
        const std::optional<contour::BrushSet> set = load_brushes(style);
        images_.reset();
        if (set) {
            images_.emplace(contour::upload_brushes(device, *set));
        }
        choice_ = wanted;
    }
    return images_ ? &*images_ : nullptr;
}

namespace {

constexpr std::array line_classes{contour::LineClass::seen, contour::LineClass::hidden};

} // namespace

void Lines::invalidate(Event event)
{
    switch (event) {
    case Event::scene_replaced:
        meshes_.forget();
        history_.forget();
        break;
    case Event::layout_replaced:
    case Event::triangles_changed:
        meshes_.forget();
        break;
    case Event::ground_replaced:
    case Event::anchor_moved:
    case Event::film_recalled:
        history_.forget();
        break;
    case Event::lights_changed:
    case Event::pose_changed:
        break;
    }
}

void Lines::ensure(gpu::Device& device, const pose::MeshData& layout, const contour::ContourStyle& style)
{
    mesh_ = meshes_.ensure(device, layout, style);
    brush_images_ = brushes_.ensure(device, style);
}

gpu::ImageId Lines::record(gpu::Graph& graph, const contour::ContourInputs& in, const LineJob& job)
{
    std::optional<gpu::ImageId> of_pixels;
    if (mesh_ == nullptr || job.has_cuts) {
        of_pixels = contour::add_contours(graph, in, job.style);
    }
    if (mesh_ == nullptr) {
        return *of_pixels;
    }
    return job.linked ? contour::add_linked_contours(graph, in, *job.linked->lines, job.linked->part,
                                                     job.style, of_pixels)
                      : contour::add_chain_contours(graph, in, *mesh_, job.remembers ? &history_ : nullptr,
                                                    job.style, of_pixels);
}

std::optional<gpu::ImageId> Lines::record_behind(gpu::Graph& graph, const contour::ContourInputs& in,
                                                 const contour::ContourStyle& style)
{
    if (mesh_ == nullptr) {
        return std::nullopt;
    }
    contour::ContourStyle seen = style;
    seen.hidden.enabled = false;
    return contour::add_chain_contours(graph, in, *mesh_, nullptr, seen, std::nullopt);
}

void Lines::record_linked(gpu::Graph& graph, gpu::Device& device, const contour::ContourInputs& in,
                          const contour::ContourStyle& style, contour::LinkedLines& linked)
{
    if (mesh_ != nullptr) {
        contour::add_keeping(graph, device, contour::add_shaped_strokes(graph, in, *mesh_, nullptr, style),
                             in.size_px, linked);
    }
}

void Lines::save(FilmWriter& writer)
{
    if (!history_.holds_frame(contour::LineClass::seen)) {
        return;
    }
    writer.value(history_.size_px());
    writer.value(history_.clip_from_anchor_before());
    for (const contour::LineClass lines : line_classes) {
        writer.flag(history_.holds_frame(lines));
        if (history_.holds_frame(lines)) {
            contour::LineHistory::Drawn& drawn = history_.before(lines);
            writer.buffers(std::array{&drawn.grid, &drawn.samples});
        }
    }
}

void Lines::load(FilmReader& reader)
{
    const auto size_px = reader.value<glm::uvec2>();
    const auto clip_from_anchor = reader.value<glm::mat4>();
    constexpr uint32_t longest_side_px = 1U << 16U;
    const auto is_side = [](uint32_t side_px) { return side_px > 0 && side_px <= longest_side_px; };
    if (!is_side(size_px.x) || !is_side(size_px.y)) {
        fail_damaged();
    }
    std::array<std::optional<contour::LineHistory::Drawn>, line_classes.size()> drawn;
    for (auto& of_class : drawn) {
        if (reader.flag()) {
            gpu::Buffer grid =
                reader.buffer("line grid", sizeof(glm::uvec2) * contour::grid_cell_count(size_px));
            of_class = {std::move(grid),
                        reader.buffer("drawn samples",
                                      sizeof(shared::DrawnSample) * contour::sample_capacity(size_px))};
        }
    }
    history_.recall(reader.device(), size_px, std::move(drawn), clip_from_anchor);
}

} // namespace estampe::features
