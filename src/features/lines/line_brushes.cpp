// SPDX-License-Identifier: MIT
#include "features/lines/line_brushes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <estampe/image.hpp>

#include "techniques/tam/brush.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t columns = shared::brush_columns;
constexpr uint32_t rows = shared::brush_rows;
constexpr uint32_t seed = 7;
constexpr float hairs = 4.0F; // finer than in maps, where strokes are a few pixels wide

/// How far along a stroke a tool is: as a picture of a whole stroke, or so that the end meets the start.
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
        feels_paper ? tam::paper_tooth(columns, 2 * brush.tooth_cell_px(), seed) : std::vector<float>();
    contour::BrushStrip strip{.widths = static_cast<float>(columns) / static_cast<float>(rows)};
    strip.ink.reserve(size_t{columns} * rows);
    for (uint32_t y = 0; y < rows; ++y) {
        for (uint32_t x = 0; x < columns; ++x) {
            const size_t texel = size_t{y} * columns + x;
            const float share = (static_cast<float>(x) + 0.5F) / static_cast<float>(columns);
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

contour::BrushStrip pictured(const std::string& path)
{
    const Image picture = load_image(path);
    return {.ink = tam::stroke_of(picture, columns, rows, path),
            .widths = static_cast<float>(picture.width) / static_cast<float>(std::max(picture.height, 1U))};
}

contour::BrushStrip strip_of(const std::string& brush, contour::BrushFit fit)
{
    if (brush == "pencil") {
        return drawn_by(tam::Tool::pencil, fit);
    }
    if (brush == "charcoal") {
        return drawn_by(tam::Tool::charcoal, fit);
    }
    return brush == "brush" ? drawn_by(tam::Tool::brush, fit) : pictured(brush);
}

/// A dash with round ends, and the gap behind it.
contour::BrushStrip dash(const BrushChoice& choice)
{
    const float period_mm = choice.dash_mm + choice.gap_mm;
    const float texel_mm = period_mm / static_cast<float>(columns);
    const float radius_mm = 0.5F * std::min(choice.dash_width_mm, choice.dash_mm);
    contour::BrushStrip strip{.widths = period_mm / std::max(choice.dash_width_mm, 0.01F)};
    strip.ink.reserve(size_t{columns} * rows);
    for (uint32_t y = 0; y < rows; ++y) {
        const float across = 2.0F * (static_cast<float>(y) + 0.5F) / static_cast<float>(rows) - 1.0F;
        const float shorter_mm = radius_mm * (1.0F - std::sqrt(1.0F - across * across));
        for (uint32_t x = 0; x < columns; ++x) {
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
    BrushChoice choice{.fit = style.brush_fit};
    for (uint32_t kind = 0; kind < shared::line_kind_count; ++kind) {
        const std::string& own = style.*contour::line_kind_keys.at(kind).brush;
        // Of the rest there are lines without a width: a material may bring it.
        const bool is_found = kind < shared::line_marked || contour::has_lines(style, kind);
        if (is_found) {
            choice.brush_of_kind.at(kind) = own.empty() ? style.brush : own;
        }
    }
    if (style.hidden == contour::Hidden::dashed) {
        choice.dash_mm = style.hidden_dash_mm;
        choice.gap_mm = style.hidden_gap_mm;
        choice.dash_width_mm = style.hidden_mm;
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
            set.strips.push_back(strip_of(brush, choice.fit));
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
    if (!style.drawn || style.lines != contour::Lines::chains) {
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

} // namespace estampe::features
