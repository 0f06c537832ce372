// SPDX-License-Identifier: MIT
#include "features/particles/smoke_sheet.hpp"

#include <algorithm>
#include <cmath>

#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/read_fields.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t side = 64;
constexpr uint32_t frames_a_side = 6;
constexpr float lasts_s = 4.0F;
constexpr uint32_t step_count = 240;

/// Density and temperature of the puff that it begins with: a few lobes low in the middle.
std::vector<float> first_puff()
{
    std::vector<float> density;
    for (uint32_t i = 0; i < side * side; ++i) {
        const glm::vec2 at = (glm::vec2(i % side, i / side) + 0.5F) / static_cast<float>(side);
        const glm::vec2 away = at - glm::vec2(0.5F, 0.36F);
        const float angle = std::atan2(away.y, away.x);
        const float radius =
            0.25F * (1.0F + 0.15F * std::sin(3.0F * angle + 1.0F) + 0.1F * std::sin(5.0F * angle));
        density.push_back(1.0F - glm::smoothstep(0.75F, 1.1F, glm::length(away) / radius));
    }
    std::vector<float> both = density;
    both.insert(both.end(), density.begin(), density.end());
    return both;
}

fluid::FluidStyle smoke_style()
{
    fluid::FluidStyle style;
    style.step_s = lasts_s / step_count;
    style.forces.lift_m_s2 = 0.12F;
    style.forces.confinement_per_s = 0.5F;
    style.matter.cooling_per_s = 0.5F;
    style.matter.fading_per_s = 0.08F;
    return style;
}

/// Into the frame's place on the sheet, upside up.
void copy_frame(const std::vector<float>& quantities, uint32_t frame, particles::SheetImage& sheet)
{
    const glm::uvec2 from = side * glm::uvec2(frame % frames_a_side, frame / frames_a_side);
    for (uint32_t y = 0; y < side; ++y) {
        for (uint32_t x = 0; x < side; ++x) {
            const size_t place = size_t{from.y + side - 1 - y} * sheet.size_px.x + from.x + x;
            sheet.brightness[place] = std::clamp(quantities[size_t{y} * side + x], 0.0F, 1.0F);
        }
    }
}

} // namespace

particles::SheetImage smoke_sheet(gpu::Device& device, gpu::Executor& executor)
{
    constexpr uint32_t frame_count = frames_a_side * frames_a_side;
    constexpr uint32_t sheet_px = frames_a_side * side;
    particles::SheetImage sheet{.size_px = glm::uvec2(sheet_px),
                                .frames = glm::uvec2(frames_a_side),
                                .brightness = std::vector<float>(size_t{sheet_px} * sheet_px)};
    const fluid::Grid grid{.cells = {side, side, 1},
                           .cell_m = 1.0F / side,
                           .edges = {fluid::Edge::free_slip, fluid::Edge::free_slip, fluid::Edge::free_slip}};
    const std::vector<float> puff = first_puff();
    fluid::Fluid air(device, grid, 2, {}, puff);
    const fluid::FluidStyle style = smoke_style();
    copy_frame(puff, 0, sheet);
    uint32_t done = 0;
    for (uint32_t frame = 1; frame < frame_count; ++frame) {
        std::vector<float> quantities;
        for (const uint32_t until = step_count * frame / (frame_count - 1); done < until;) {
            const uint32_t now = std::min(until - done, air.most_steps(style));
            gpu::Graph graph;
            const fluid::FluidFields fields = air.add_steps(graph, style, now);
            quantities = fluid::run_and_read(device, executor, graph, *fields.quantities);
            done += now;
        }
        copy_frame(quantities, frame, sheet);
    }
    return sheet;
}

} // namespace estampe::features
