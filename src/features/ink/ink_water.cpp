// SPDX-License-Identifier: MIT
#include "features/ink/ink_water.hpp"

#include <algorithm>
#include <cmath>

#include "features/common/solver_meter.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/read_fields.hpp"
#include "techniques/ink/flow/flow.hpp"

namespace estampe::features {
namespace {

constexpr double steps_per_s = 24.0; ///< at least
constexpr double spin_up_s = 3.0;    ///< from rest
constexpr float metres_per_mm = 1e-3F;

/// The page and no more, walled, 64 cells along its longer side. y goes down.
fluid::Grid grid_of(glm::vec2 page_mm)
{
    constexpr float most = 64.0F;
    constexpr float fewest = 8.0F;
    const float cell_mm = std::max(page_mm.x, page_mm.y) / most;
    const glm::uvec2 cells(glm::clamp(glm::round(page_mm / cell_mm), fewest, most));
    constexpr fluid::Edge wall = fluid::Edge::free_slip;
    return {.cells = {cells, 1}, .cell_m = metres_per_mm * cell_mm, .edges = {wall, wall, wall}};
}

/// Where the given flow has a hold on the water: discs on a lattice, as far apart as smaller swirls are
/// large, and the zones.
class Spoons {
public:
    Spoons(const ink::InkStyle& style, glm::vec2 page_mm, const std::vector<shared::InkZone>& zones)
        : waves_(ink::page_waves(style)), page_mm_(page_mm), zones_(zones)
    {
        constexpr float most_spoons = 48.0F;
        const float area_mm = page_mm.x * page_mm.y;
        const float apart_mm = std::max(0.5F * style.swirl_mm, std::sqrt(area_mm / most_spoons));
        counts_ = glm::max(glm::uvec2(page_mm / apart_mm), 1U);
        radius_mm_ = 0.25F * std::min(page_mm.x / static_cast<float>(counts_.x),
                                      page_mm.y / static_cast<float>(counts_.y));
    }

    [[nodiscard]] std::vector<fluid::Source> at(double time_s) const
    {
        constexpr float stronger = 2.0F; // than the water, which comes to about the swirls' own speed by that
        const auto phases = ink::phases_at(waves_, time_s);
        std::vector<fluid::Source> sources;
        for (uint32_t i = 0; i < counts_.x * counts_.y; ++i) {
            const glm::vec2 place_mm =
                (glm::vec2(i % counts_.x, i / counts_.x) + 0.5F) / glm::vec2(counts_) * page_mm_;
            const auto slope = [&](const glm::vec2& aside_mm) {
                const auto stream = [&](const glm::vec2& place) {
                    return ink::stream_at(waves_, phases, glm::vec2(0.0F), place);
                };
                return (stream(place_mm + aside_mm) - stream(place_mm - aside_mm)) /
                       (2.0F * glm::length(aside_mm));
            };
            const glm::vec2 swirl_mm_s(slope({0.0F, 0.5F}), -slope({0.5F, 0.0F}));
            sources.push_back(spoon(place_mm, radius_mm_, stronger * swirl_mm_s));
        }
        for (const shared::InkZone& zone : zones_) {
            sources.push_back(spoon(zone.middle_mm, 0.5F * zone.radius_mm, zone.velocity_mm_s));
            sources.back().shape.spin_rad_s = zone.turn_rad_s;
        }
        return sources;
    }

private:
    static fluid::Source spoon(glm::vec2 place_mm, float radius_mm, glm::vec2 velocity_mm_s)
    {
        constexpr float push_per_s = 6.0F;
        fluid::Source source{
            .shape = fluid::disc(metres_per_mm * glm::vec3(place_mm, 0.0F), metres_per_mm * radius_mm),
            .push_per_s = push_per_s};
        source.shape.velocity_m_s = metres_per_mm * glm::vec3(velocity_mm_s, 0.0F);
        return source;
    }

    ink::Waves waves_;
    glm::vec2 page_mm_;
    const std::vector<shared::InkZone>& zones_;
    glm::uvec2 counts_{1};
    float radius_mm_ = 1.0F;
};

/// The stream function at the corners of cells, square millimetres a second: 0 along the walls. What flows
/// to the right through a face is its difference along it.
class Corners {
public:
    Corners(const fluid::Grid& grid, const std::vector<float>& velocity)
        : counts_(grid.cells + 1U), psi_(size_t{counts_.x} * counts_.y)
    {
        const auto cell_mm = static_cast<double>(grid.cell_m / metres_per_mm);
        const double mm_2 = cell_mm / static_cast<double>(metres_per_mm);
        for (uint32_t x = 1; x < grid.cells.x; ++x) {
            double psi = 0.0;
            for (uint32_t y = 0; y < grid.cells.y; ++y) {
                psi += mm_2 * static_cast<double>(velocity[size_t{y} * grid.cells.x + x]);
                psi_[size_t{y + 1} * counts_.x + x] = static_cast<float>(psi);
            }
        }
    }

    /// `place` in shares of the page.
    [[nodiscard]] float at(glm::vec2 place) const
    {
        const glm::vec2 corner = place * glm::vec2(glm::uvec2(counts_) - 1U);
        const glm::uvec2 low = glm::min(glm::uvec2(corner), glm::uvec2(counts_) - 2U);
        const glm::vec2 share = corner - glm::vec2(low);
        const auto psi = [&](uint32_t x, uint32_t y) {
            return psi_[size_t{low.y + y} * counts_.x + low.x + x];
        };
        return glm::mix(glm::mix(psi(0, 0), psi(1, 0), share.x), glm::mix(psi(0, 1), psi(1, 1), share.x),
                        share.y);
    }

private:
    glm::uvec3 counts_;
    std::vector<float> psi_;
};

std::vector<float> velocity_of(gpu::Device& device, gpu::Executor& executor, fluid::Fluid& fluid)
{
    gpu::Graph graph;
    const gpu::ImageId velocity = fluid.add_steps(graph, {}, 0).velocity;
    return fluid::run_and_read(device, executor, graph, velocity);
}

/// Returns what the meter found; nothing where no step is taken.
std::optional<SolverReport> pass(fluid::Fluid& fluid, SolverMeter meter, const Spoons& spoons, double from_s,
                                 double to_s)
{
    const auto count = static_cast<uint32_t>(std::ceil((to_s - from_s) * steps_per_s - 1e-6));
    const double step_s = count > 0 ? (to_s - from_s) / count : 0.0;
    const fluid::FluidStyle style{.step_s = static_cast<float>(step_s),
                                  .stepping = fluid::Stepping::project,
                                  // What splines would keep in jets is to spread over the page.
                                  .velocity_advection = fluid::Advection::maccormack,
                                  .forces = {.friction_per_s = 0.1F}};
    for (uint32_t done = 0; done < count;) {
        const uint32_t now = std::min(count - done, fluid.most_steps(style));
        fluid.set_shapes({}, spoons.at(from_s + (done + 0.5 * now) * step_s));
        gpu::Graph graph;
        const fluid::FluidFields fields = fluid.add_steps(graph, style, now);
        done += now;
        meter.run(graph, fluid, style, fields, now, done == count);
    }
    std::optional<SolverReport> report = meter.report();
    if (report) {
        report->fluid = "ink";
    }
    return report;
}

} // namespace

InkWater::InkWater() = default;
InkWater::~InkWater() = default;

void InkWater::forget()
{
    fluid_.reset();
    recalled_.reset();
    solver_report_.reset();
}

std::optional<KeptWater> InkWater::kept(gpu::Device& device, gpu::Executor& executor)
{
    if (!fluid_) {
        return recalled_;
    }
    return KeptWater{.time_s = time_s_, .velocity = velocity_of(device, executor, *fluid_)};
}

void InkWater::recall(KeptWater kept)
{
    fluid_.reset();
    recalled_ = std::move(kept);
}

std::vector<float> InkWater::stirred(gpu::Device& device, gpu::Executor& executor, const ink::InkStyle& style,
                                     const ink::Page& page, const ink::Time& time,
                                     const std::vector<shared::InkZone>& zones, bool is_measured)
{
    const fluid::Grid grid = grid_of(page.size_mm());
    if (recalled_ && recalled_->velocity.size() == 2 * grid.cell_count()) {
        fluid_ = std::make_unique<fluid::Fluid>(device, grid, 0, recalled_->velocity);
        time_s_ = recalled_->time_s;
    }
    recalled_.reset();
    if (time.is_fresh || !fluid_ || fluid_->grid() != grid || std::abs(time_s_ - time.from_s) > 1e-6) {
        fluid_ = std::make_unique<fluid::Fluid>(device, grid);
        time_s_ = time.from_s - spin_up_s;
    }
    auto found = pass(*fluid_, SolverMeter(device, executor, is_measured),
                      Spoons(style, page.size_mm(), zones), time_s_, time.to_s);
    if (found || !is_measured) {
        solver_report_ = std::move(found);
    }
    time_s_ = time.to_s;
    const Corners corners(grid, velocity_of(device, executor, *fluid_));
    std::vector<float> stream;
    constexpr uint32_t side = shared::ink_map_side;
    for (uint32_t i = 0; i < side * side; ++i) {
        stream.push_back(style.solved *
                         corners.at(glm::vec2(i % side, i / side) / static_cast<float>(side - 1)));
    }
    return stream;
}

} // namespace estampe::features
