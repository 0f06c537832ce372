// SPDX-License-Identifier: MIT
#include "frame/vectors.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <optional>
#include <span>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "features/common/view.hpp"
#include "features/lines/lines.hpp"
#include "gpu/transfers.hpp"
#include "style/parameter.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/stroke/line_paths.hpp"
#include "techniques/hatch/trace/trace.hpp"

namespace estampe::frame {
namespace {

constexpr float hidden_share = 0.6F;     // width of a hidden line relative to a visible line
constexpr float thinnest_mm = 0.02F;     // a dot of a printer of 1200 dpi: a thinner stroke is not seen
constexpr float least_ink_left = 0.125F; // strokes are dropped if haze leaves a smaller share of their width

/// Reads the contents of `from` back into `to`.
void read_back(gpu::Graph& graph, gpu::Device& device, gpu::BufferId from, gpu::Buffer& to)
{
    to = gpu::Buffer(device, "read-back of strokes", graph.describe(from).size_bytes,
                     gpu::MemoryUse::readback);
    gpu::add_read_back(graph, "read back strokes", from, to);
}

StrokeKind kind_of_line(uint32_t kind)
{
    constexpr std::array<StrokeKind, shared::line_kind_count> kinds{
        StrokeKind::outline, StrokeKind::border,       StrokeKind::boundary, StrokeKind::crease,
        StrokeKind::marked,  StrokeKind::ridge,        StrokeKind::valley,   StrokeKind::suggestive,
        StrokeKind::crest,   StrokeKind::intersection, StrokeKind::shadow,   StrokeKind::outline,
        StrokeKind::leaf};
    return kinds.at(kind);
}

/// Collects strokes. Objects and inks get numbers in the order in which they first appear.
class Gathering {
public:
    Gathering(const DrawnScene& drawn, const features::StyleTables& style)
        : drawn_(drawn), mm_per_px_(style.paper.height_mm / static_cast<float>(drawn.size_px.y))
    {
        drawing_.height_mm = style.paper.height_mm;
        drawing_.width_mm = mm_per_px_ * static_cast<float>(drawn.size_px.x);
        window_ = paper::window_of(style.paper, drawing_.width_mm);
        drawing_.hatch_width_mm = style.hatch.width_mm;
        drawing_.paper_srgb = style::srgb_from_linear(style.paper.color);
        drawing_.has_paper = style.paper.transparent == paper::Transparency::none;
        drawing_.has_mitred_corners = style.contour.joints == contour::Joints::mitre;
        if (style.contour.hidden.enabled) {
            // The length of a dash in a picture includes its round ends; in a path it does not, so the dashes
            // are shortened.
            const float ends_mm =
                std::min(style.contour.hidden.width_mm, 0.9F * style.contour.hidden.dash_mm);
            drawing_.dash_mm = style.contour.hidden.dash_mm - ends_mm;
            drawing_.dash_gap_mm = style.contour.hidden.gap_mm + ends_mm;
        }
    }

    /// Makes all strokes thinner that are added after this call, because of haze. `of` is the component of
    /// `ink_left` to read: 0 for hatching strokes, 1 for lines. An empty span leaves the widths unchanged.
    void thin_by(std::span<const glm::vec2> ink_left, int of)
    {
        ink_left_ = ink_left;
        ink_left_of_ = of;
    }

    /// Adds a stroke along `points`, whose type must have the members page_px and width_px.
    template <class Points>
    void add(VectorStroke stroke, uint32_t draw, const glm::vec3& ink, const Points& points)
    {
        if (std::ranges::none_of(points, [&](const auto& point) { return is_left(point.page_px); })) {
            return;
        }
        stroke.object = object_of(draw);
        stroke.ink = number_of(ink);
        bool is_whole = true;
        VectorStroke part = stroke;
        part.is_closed = false;
        for (const auto& point : points) {
            const float width_mm = mm_per_px_ * ink_left_at(point.page_px) * point.width_px;
            const bool is_lost = stroke.kind != StrokeKind::hatch && width_mm < thinnest_mm;
            if (is_lost || !is_left(point.page_px)) {
                is_whole = false;
                add_line(part);
                continue;
            }
            part.points.push_back({mm_per_px_ * point.page_px, width_mm});
        }
        part.is_closed = stroke.is_closed && is_whole;
        add_line(part);
    }

    void add_focus(const FocusPlan& plan, const glm::vec3& ink)
    {
        if (plan.lines.empty()) {
            return;
        }
        const auto object = static_cast<uint32_t>(drawing_.objects.size());
        drawing_.objects.emplace_back("focus");
        for (const shared::FocusLine& line : plan.lines) {
            const glm::vec2 tip_px = plan.middle_px + line.tip_px * line.outwards;
            const glm::vec2 end_px = plan.middle_px + line.end_px * line.outwards;
            add_parts({.kind = StrokeKind::focus,
                       .object = object,
                       .ink = number_of(ink),
                       .points = {{mm_per_px_ * tip_px, 0.0F},
                                  {mm_per_px_ * end_px, 2.0F * mm_per_px_ * line.half_width_px}}});
        }
    }

    /// Adds the four border lines around the picture, with square corners as if drawn along a ruler.
    void add_border(const paper::PaperStyle& paper)
    {
        const auto object = static_cast<uint32_t>(drawing_.objects.size());
        drawing_.objects.emplace_back("page");
        const uint32_t ink = number_of(paper.ink);
        const glm::vec2& from = window_.min_mm;
        const glm::vec2& to = window_.max_mm;
        const std::array<glm::vec2, 5> corners{from, {to.x, from.y}, to, {from.x, to.y}, from};
        for (size_t i = 0; i + 1 < corners.size(); ++i) {
            drawing_.strokes.push_back(
                {.kind = StrokeKind::frame,
                 .object = object,
                 .ink = ink,
                 .points = {{corners[i], paper.border_mm}, {corners[i + 1], paper.border_mm}}});
        }
    }

    [[nodiscard]] VectorDrawing take() { return std::move(drawing_); }

private:
    [[nodiscard]] float ink_left_at(const glm::vec2& page_px) const
    {
        if (ink_left_.empty()) {
            return 1.0F;
        }
        const glm::uvec2 pixel(glm::clamp(page_px, glm::vec2(0.0F), glm::vec2(drawn_.size_px) - 1.0F));
        return ink_left_[size_t{pixel.y} * drawn_.size_px.x + pixel.x][ink_left_of_];
    }

    [[nodiscard]] bool is_left(const glm::vec2& page_px) const
    {
        return ink_left_at(page_px) >= least_ink_left;
    }

    /// Adds the stroke to the drawing if it has at least two points and can be seen. Afterwards the function
    /// clears the stroke's points.
    void add_line(VectorStroke& stroke)
    {
        const bool is_seen = std::ranges::any_of(
            stroke.points, [](const VectorPoint& point) { return point.width_mm >= thinnest_mm; });
        if (stroke.points.size() > 1 && is_seen) {
            add_parts(stroke);
        }
        stroke.points.clear();
    }

    void add_parts(const VectorStroke& stroke)
    {
        const std::vector<VectorStroke> parts = features::clipped(stroke, window_);
        drawing_.strokes.insert(drawing_.strokes.end(), parts.begin(), parts.end());
    }

    uint32_t object_of(uint32_t draw)
    {
        const bool is_ground = draw >= drawn_.layout.sources.size();
        const Index node = is_ground ? no_index : drawn_.layout.sources[draw].node;
        const auto number = static_cast<uint32_t>(drawing_.objects.size());
        const auto [place, is_new] = objects_.try_emplace(node, number);
        if (is_new) {
            const std::string name = is_ground ? "ground" : drawn_.scene.nodes.at(node).name;
            drawing_.objects.push_back(name.empty() ? fmt::format("object {}", node) : name);
        }
        return place->second;
    }

    uint32_t number_of(const glm::vec3& ink)
    {
        const glm::vec3 srgb(style::srgb_from_linear(ink));
        auto& inks = drawing_.inks_srgb;
        const auto found = std::ranges::find(inks, srgb);
        const auto number = static_cast<uint32_t>(found - inks.begin());
        if (found == inks.end()) {
            inks.push_back(srgb);
        }
        return number;
    }

    const DrawnScene& drawn_;
    float mm_per_px_;
    VectorDrawing drawing_;
    paper::Window window_;
    std::span<const glm::vec2> ink_left_;
    int ink_left_of_ = 0;
    std::map<Index, uint32_t> objects_;
};

void add_hatching(Gathering& gathering, const StrokeLists& lists, const DrawnScene& drawn,
                  const features::StyleTables& style)
{
    const uint32_t count = gpu::items_of<uint32_t>(lists.crossings).front();
    const auto crossings = gpu::items_of<shared::Crossing>(lists.crossings, sizeof(uint32_t));
    if (count > crossings.size()) {
        throw Error("there are more strokes than the device has room for", "hatch.width_mm",
                    "draw fewer pixels with --size, or wider strokes");
    }
    for (const hatch::TracedStroke& stroke : hatch::string_crossings(crossings.first(count), drawn.size_px)) {
        gathering.add({.kind = StrokeKind::hatch, .is_closed = stroke.is_closed}, stroke.draw,
                      style.paper.ink, stroke.points);
    }
}

/// Returns the widths of hidden lines, one per kind of line.
contour::LineWidths hidden_widths_px(const contour::ContourStyle& contour, float pixels_per_mm)
{
    contour::LineWidths widths{};
    for (uint32_t kind = 0; kind < widths.size(); ++kind) {
        const float width_mm = contour::width_on_page_mm(contour, kind);
        const float own_mm = width_mm > 0.0F ? contour.hidden.width_mm : 0.0F;
        widths.at(kind) = pixels_per_mm * (contour.hidden.enabled ? own_mm : hidden_share * width_mm);
    }
    return widths;
}

/// Returns the ink of a line along a surface of draw call `draw`.
glm::vec3 ink_of(const contour::LinePath& path, uint32_t draw, const Scene& scene,
                 const features::StyleVariants& variants)
{
    const bool is_of_material = path.ink > 0 && (path.ink & shared::ink_of_variant) == 0;
    if (is_of_material && scene.materials.at(path.ink - 1).toon) {
        return scene.materials[path.ink - 1].toon->outline_color;
    }
    const uint32_t variant = variants.has_several() ? variants.variant_of_draw.at(draw) : 0U;
    return contour::ink_of_kind(variants.styles.at(variant).contour, path.kind);
}

void add_lines(Gathering& gathering, const StrokeLists& lists, const DrawnScene& drawn,
               const features::StyleVariants& variants, bool with_hidden_lines)
{
    const contour::ContourStyle& contour = variants.lines;
    const float px_per_mm = features::pixels_per_mm(drawn.size_px.y, variants.styles.front().paper.height_mm);
    bool with_hidden = with_hidden_lines || contour.hidden.enabled;
    std::vector<contour::LinePath> paths;
    for (const gpu::Buffer& line_points : lists.line_points) {
        std::vector<contour::LinePath> hand = contour::line_paths(
            {.sizes = gpu::items_of<shared::ListSize>(lists.line_sizes),
             .samples = gpu::items_of<shared::LineSample>(lists.line_samples),
             .samples_before = gpu::items_of<uint32_t>(lists.line_samples_before),
             .strokes_before = gpu::items_of<uint32_t>(lists.line_strokes_before),
             .points = gpu::items_of<shared::LinePoint>(line_points),
             .facing = gpu::items_of<uint32_t>(lists.line_facing)},
            *drawn.edges, with_hidden ? std::optional(hidden_widths_px(contour, px_per_mm)) : std::nullopt);
        contour::JoinRule rule =
            contour.joints == contour::Joints::mitre ? contour::mitred_corners : contour::rounded_corners;
        rule.shortest_px = contour.shortest_mm * px_per_mm;
        hand = contour::join_paths(std::move(hand), rule);
        std::move(hand.begin(), hand.end(), std::back_inserter(paths));
        with_hidden = false; // lines may be drawn several times; only the first time includes hidden lines
    }
    for (const contour::LinePath& path : paths) {
        const uint32_t draw = drawn.layout.triangles[path.triangle].w & shared::triangle_draw_mask;
        gathering.add(
            {.kind = kind_of_line(path.kind), .is_hidden = path.is_hidden, .is_closed = path.is_closed}, draw,
            ink_of(path, draw, drawn.scene, variants), path.points);
    }
}

} // namespace

void check_has_paths(const features::StyleVariants& variants)
{
    const auto is_no_line = [](const features::StyleTables& style) {
        return style.hatch.enabled && style.hatch.strokes != hatch::Strokes::lines;
    };
    if (std::ranges::any_of(variants.styles, is_no_line)) {
        throw Error("the strokes of a tonal art map have no paths, nor have dots", "hatch.strokes",
                    "--set hatch.strokes=lines draws others, --set hatch.enabled=false none");
    }
    if (variants.lines.enabled && variants.lines.lines == contour::Lines::page) {
        throw Error("lines that are found between pixels have no paths", "contour.lines",
                    "--set contour.lines=chains draws others, --set contour.enabled=false none");
    }
}

void declare_stroke_lists(gpu::Graph& graph, const HatchStrokes& hatch, const LineStrokes& lines,
                          const features::StyleVariants& variants, const std::optional<StrokeHaze>& haze,
                          StrokeLists& lists)
{
    gpu::Device& device = lists.device;
    if (haze) {
        read_back(graph, device, haze::add_ink_left(graph, haze->inputs, haze->style), lists.ink_left);
    }
    if (std::ranges::any_of(variants.styles,
                            [](const features::StyleTables& style) { return style.hatch.enabled; })) {
        read_back(
            graph, device,
            hatch::add_trace(graph, hatch.inputs, hatch.variants, device.limits().maxStorageBufferRange),
            lists.crossings);
    }
    if (lines.mesh != nullptr) {
        const contour::ShapedStrokes shaped =
            contour::add_shaped_strokes(graph, lines.inputs, *lines.mesh, nullptr, variants.lines);
        read_back(graph, device, shaped.strokes.sizes, lists.line_sizes);
        read_back(graph, device, shaped.strokes.samples, lists.line_samples);
        read_back(graph, device, shaped.strokes.samples_before, lists.line_samples_before);
        read_back(graph, device, shaped.strokes.strokes_before, lists.line_strokes_before);
        lists.line_points.resize(shaped.hands.size());
        for (size_t hand = 0; hand < shaped.hands.size(); ++hand) {
            read_back(graph, device, shaped.hands[hand].line_points, lists.line_points[hand]);
        }
        read_back(graph, device, shaped.facing, lists.line_facing);
    }
}

VectorDrawing drawing_of(const StrokeLists& lists, const DrawnScene& drawn, const FramePlan& plan,
                         bool with_hidden_lines)
{
    const features::StyleTables& style = plan.variants.styles.front();
    Gathering gathering(drawn, style);
    const auto ink_left =
        lists.ink_left.empty() ? std::span<const glm::vec2>() : gpu::items_of<glm::vec2>(lists.ink_left);
    gathering.thin_by(ink_left, 0);
    if (!lists.crossings.empty()) {
        add_hatching(gathering, lists, drawn, style);
    }
    gathering.thin_by(ink_left, 1);
    if (!lists.line_sizes.empty()) {
        add_lines(gathering, lists, drawn, plan.variants, with_hidden_lines);
    }
    gathering.add_focus(plan.focus, style.focus_lines.ink);
    if (style.paper.border_mm > 0.0F) {
        gathering.add_border(style.paper);
    }
    return gathering.take();
}

} // namespace estampe::frame
