// SPDX-License-Identifier: MIT
#include "techniques/focus/focus.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/constants.hpp>

#include "shaders/focus_comp.hpp"
#include "style/parameter.hpp"

namespace estampe::focus {
namespace {

constexpr size_t least_lines = 3;
constexpr size_t most_lines = 20000;

/// Random numbers that are equal on every computer.
class Random {
public:
    explicit Random(uint32_t seed) : engine_(seed) {}

    /// A random number from 0 to 1.
    float next() { return static_cast<float>(engine_() >> 8U) * 0x1p-24F; }

private:
    std::mt19937 engine_;
};

/// Length of focus lines: the distance from the middle to just beyond the window's farthest corner.
float reach_px(const glm::vec2& middle, const Window& window)
{
    return glm::length(glm::max(glm::abs(window.min_px - middle), glm::abs(window.max_px - middle))) + 1.0F;
}

uint32_t seed_at(const FocusStyle& style, double time_s)
{
    const double drawings = std::floor(std::abs(time_s) * static_cast<double>(style.redraws_per_s) + 1e-6);
    return static_cast<uint32_t>(style.seed) * 7919U + static_cast<uint32_t>(std::fmod(drawings, 1e6));
}

} // namespace

glm::vec2 middle_px(const FocusStyle& style, const Window& window)
{
    return glm::mix(window.min_px, window.max_px, glm::vec2(style.x, style.y));
}

std::vector<shared::FocusLine> focus_lines(const FocusStyle& style, const Window& window, float pixels_per_mm,
                                           double time_s)
{
    if (!style.enabled) {
        return {};
    }
    const glm::vec2 middle = middle_px(style, window);
    const glm::vec2 half_size = 0.5F * (window.max_px - window.min_px);
    const float end_px = reach_px(middle, window);
    // The spacing of focus lines is measured near the picture's edge, halfway between the distances of sides
    // and corners.
    const float edge_px = 0.5F * (std::max(half_size.x, half_size.y) + glm::length(half_size));
    const auto turn = glm::two_pi<float>();
    const auto count =
        static_cast<size_t>(std::clamp(turn * edge_px / (style.spacing_mm * pixels_per_mm),
                                       static_cast<float>(least_lines), static_cast<float>(most_lines)));
    Random random(seed_at(style, time_s));
    std::vector<shared::FocusLine> lines;
    lines.reserve(count);
    float bundle = random.next();
    for (size_t i = 0; i < count; ++i) {
        // Neighbouring focus lines share a random value for a while, which forms bundles and gaps.
        bundle = random.next() < 0.35F ? random.next() : bundle;
        const float share = 1.0F - style.bundles * bundle;
        const float angle =
            turn * (static_cast<float>(i) + 0.15F + 0.7F * random.next()) / static_cast<float>(count);
        const glm::vec2 outwards(std::cos(angle), std::sin(angle));
        const float oval_px = style.clear / glm::length(outwards / half_size);
        const float stray = style.ragged * (0.9F * random.next() - 0.2F - 0.5F * share + 0.25F);
        const float wide = (0.35F + 1.3F * random.next() * random.next()) * share;
        const float at_edge = edge_px / end_px;
        lines.push_back({.outwards = outwards,
                         .tip_px = std::min(oval_px * (1.0F + stray), end_px - 1.0F),
                         .end_px = end_px,
                         .half_width_px = 0.5F * style.width_mm * pixels_per_mm * wide / at_edge});
    }
    return lines;
}

gpu::ImageId add_focus(gpu::Graph& graph, const FocusInputs& in, const FocusStyle& style, gpu::ImageId ink)
{
    auto pass = graph.compute("focus", shaders::focus_comp);
    pass.read(in.lines);
    const gpu::ImageId drawn = pass.modify(ink);
    pass
        .push(shared::FocusConstants{
            .size_px = in.size_px, .middle_px = in.middle_px, .line_count = in.line_count, .ink = style.ink})
        .dispatch_over(in.size_px.x, in.size_px.y);
    return drawn;
}

const style::Table<FocusStyle>& focus_table()
{
    static const auto table =
        style::Table<FocusStyle>(
            "focus_lines",
            "Focus lines: thin wedges of ink that point at the centre of attention, as in manga")
            .toggle("enabled", &FocusStyle::enabled,
                    "Turns focus lines on: wedges from the edge of the picture towards one point")
            .number("x", &FocusStyle::x, {-1.0F, 2.0F}, "",
                    "Horizontal position of the point where focus lines meet. 0 is the left edge of the "
                    "picture, 1 is the right edge.")
            .number("y", &FocusStyle::y, {-1.0F, 2.0F}, "",
                    "Vertical position of the point where focus lines meet. 0 is the top edge of the "
                    "picture, 1 is the bottom edge.")
            .number("clear", &FocusStyle::clear, {0.0F, 3.0F}, "",
                    "Size of the empty oval around the point where focus lines meet, as a share of the "
                    "picture. Less lets focus lines reach further in.")
            .number("ragged", &FocusStyle::ragged, {0.0F, 1.0F}, "",
                    "How much focus lines differ in length. 0 ends all lines at the edge of the empty oval "
                    "in the middle, 1 gives very uneven lengths.")
            .number("width_mm", &FocusStyle::width_mm, {0.05F, 20.0F}, "mm",
                    "Width of an average focus line at the edge of the picture: more is bolder")
            .number("spacing_mm", &FocusStyle::spacing_mm, {0.2F, 100.0F}, "mm",
                    "Average distance between focus lines at the edge of the picture: less gives more lines")
            .number("bundles", &FocusStyle::bundles, {0.0F, 1.0F}, "",
                    "How much focus lines gather in bundles with gaps between them. 0 spreads the lines "
                    "evenly, 1 gathers them most.")
            .color("ink", &FocusStyle::ink, "Colour of the ink of focus lines")
            .number("redraws_per_s", &FocusStyle::redraws_per_s, {0.0F, 60.0F}, "",
                    "How often focus lines are drawn again with new random shapes, per second of a film. 12 "
                    "flickers as in hand-drawn animation, 0 never draws them again.");
    return table;
}

} // namespace estampe::focus
