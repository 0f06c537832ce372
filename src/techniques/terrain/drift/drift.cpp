// SPDX-License-Identifier: MIT
#include "techniques/terrain/drift/drift.hpp"

#include <cmath>

#include "gpu/transfers.hpp"
#include "shaders/drift_ink_comp.hpp"
#include "shaders/drift_streaks_comp.hpp"
#include "style/parameter.hpp"
#include "style/wind.hpp"
#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {
namespace {

constexpr uint32_t grid_side = 128;
constexpr double least_wind_m_per_s = 6.0;
constexpr double sand_by_wind = 0.6; ///< speed of sand in the air divided by the speed of the wind
constexpr double life_s = static_cast<double>(shared::drift_life_s);

} // namespace

std::optional<DriftPlan> drift_at(const TerrainWind& wind, const DriftStyle& style, const DriftView& view)
{
    const auto speed_m_per_s = static_cast<double>(wind.speed_m_per_s);
    const bool blows =
        style.enabled == style::AutoToggle::on
            ? speed_m_per_s > 0.0
            : style.enabled == style::AutoToggle::automatic && speed_m_per_s >= least_wind_m_per_s;
    if (!blows || style.amount <= 0.0F) {
        return std::nullopt;
    }
    const double cell_m = 2.0 * static_cast<double>(style.reach_m) / grid_side;
    const glm::dvec2 first = glm::round(view.eye_m / cell_m) - 0.5 * grid_side;
    const glm::vec2 corner_m(first * cell_m - view.anchor_m);
    const double lives = view.time_s / life_s;
    const double direction_rad = glm::radians(static_cast<double>(wind::from_x_deg(wind.towards_deg)));
    return DriftPlan{.streaks = {.corner_m = corner_m,
                                 .cell_m = static_cast<float>(cell_m),
                                 .side = grid_side,
                                 .first_x = wrapped_cells(first.x),
                                 .first_y = wrapped_cells(first.y),
                                 .wind = glm::vec2(std::cos(direction_rad), std::sin(direction_rad)),
                                 .speed_m_per_s = static_cast<float>(sand_by_wind * speed_m_per_s),
                                 .life = wrapped_cells(std::floor(lives)),
                                 .life_share = static_cast<float>(lives - std::floor(lives)),
                                 .length_m = style.length_m,
                                 .lift_m = style.lift_m,
                                 .reach_m = style.reach_m,
                                 .half_width_px = 0.5F * style.width_mm * view.pixels_per_mm,
                                 .amount = style.amount},
                     .field = {.origin_m = corner_m, .texel_m = static_cast<float>(cell_m)}};
}

gpu::ImageId add_drift(gpu::Graph& graph, const DriftInputs& in, const shared::DriftConstants& streaks,
                       const glm::vec3& ink, gpu::ImageId lines)
{
    const gpu::BufferId blank = gpu::add_zeros(graph, "drift", uint64_t{4} * in.size_px.x * in.size_px.y);
    auto drawing = graph.compute("drift/streaks", shaders::drift_streaks_comp);
    drawing.uniform(in.frame).sample(in.heights, gpu::Sampling::linear).sample(in.depth);
    const gpu::BufferId drawn = drawing.modify(blank);
    drawing.push(streaks).dispatch_items(streaks.side * streaks.side * shared::drift_streaks_a_cell);

    auto pass = graph.compute("drift/ink", shaders::drift_ink_comp);
    pass.read(drawn);
    const gpu::ImageId over = pass.modify(lines);
    pass.push(shared::DriftInk{.ink = ink, .size_px = in.size_px})
        .dispatch_over_page(in.size_px.x, in.size_px.y);
    return over;
}

const style::Table<DriftStyle>& drift_table()
{
    static const auto table =
        style::Table<DriftStyle>("drift", "Drifting sand that the wind blows off the crests of a terrain")
            .auto_toggle("enabled", &DriftStyle::enabled,
                         "Draws drifting sand. true: in any wind; false: never; auto: if the terrain's wind "
                         "is 6 m/s or more.")
            .number("amount", &DriftStyle::amount, {0.0F, 1.0F}, "",
                    "Amount of drifting sand along the crests of dunes: 0 draws none, 1 draws the densest "
                    "streaks")
            .number("length_m", &DriftStyle::length_m, {0.05F, 20.0F}, "m",
                    "Length of an average streak of drifting sand: more draws longer streaks")
            .number("lift_m", &DriftStyle::lift_m, {0.0F, 20.0F}, "m",
                    "Largest height above the crest of a dune to which drifting sand rises: more gives "
                    "higher plumes")
            .number(
                "width_mm", &DriftStyle::width_mm, {0.05F, 5.0F}, "mm",
                "Width on the page of a streak of drifting sand, in the middle of the streak: more is bolder")
            .number("reach_m", &DriftStyle::reach_m, {5.0F, 1000.0F}, "m",
                    "Distance from the camera up to which drifting sand is drawn. More draws sand farther "
                    "away, but misses the sand at small crests.")
            .color("ink", &DriftStyle::ink, "Colour of the streaks of drifting sand");
    return table;
}

} // namespace estampe::terrain
