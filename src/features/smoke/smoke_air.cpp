// SPDX-License-Identifier: MIT
#include "features/smoke/smoke_air.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace estampe::features {
namespace {

/// Air in a source of smoke has at least the density that it would gain within this time, in seconds.
constexpr float held_s = 0.2F;
/// Decrease of the air's saturation with height, as a natural logarithm: saturation at the floor divided by
/// saturation at the top of the box. The value is that of air some kilometres high.
constexpr float holds_less_above = 2.0F;

fluid::Solver solver_of(const smoke::SmokeStyle& style)
{
    switch (style.solver) {
    case smoke::Solver::spectral:
        // Smoke with obstacles cannot use the spectral solver, which does not support them.
        return style.obstacles ? fluid::Solver::automatic : fluid::Solver::spectral;
    case smoke::Solver::multigrid:
        return fluid::Solver::multigrid;
    case smoke::Solver::jacobi:
        return fluid::Solver::jacobi;
    case smoke::Solver::mass:
        return fluid::Solver::mass;
    case smoke::Solver::automatic:
        break;
    }
    return fluid::Solver::automatic;
}

fluid::Advection advection_of(const smoke::SmokeStyle& style)
{
    switch (style.advection) {
    case smoke::Advection::linear:
        return fluid::Advection::linear;
    case smoke::Advection::cubic:
        return fluid::Advection::cubic;
    case smoke::Advection::maccormack:
        return fluid::Advection::maccormack;
    case smoke::Advection::automatic:
        break;
    }
    return fluid::Advection::automatic;
}

/// Width of the zone at the open faces of a smoke box in which the outside air acts.
float rim_m(const Draught& draught)
{
    return 0.15F * draught.width_m;
}

float water_held_at_floor(const smoke::SmokeStyle& style)
{
    return style.humidity * std::exp(holds_less_above * style.cloud_base);
}

float outside_vapour(const smoke::SmokeStyle& style)
{
    return style.humidity_outside * style.humidity;
}

/// Returns how the quantities that the air carries, such as density, change over time.
fluid::MatterStyle changing(const Draught& draught, const smoke::SmokeStyle& style)
{
    return {.fading_per_s = 1.0F / style.life_s,
            .cooling_per_s = 1.2F / style.rise_s,
            .burning_per_s = smoke::is_burning(style) ? 1.0F / style.burn_s : 0.0F,
            .ignition = smoke_ignition,
            .heat_of_fuel = style.burn_heat,
            .smoke_of_fuel = style.soot,
            .condensing_per_s = smoke::is_moist(style) ? 30.0F / style.rise_s : 0.0F,
            .saturation = water_held_at_floor(style),
            .saturation_growth = 0.25F,
            .saturation_fall_per_m = holds_less_above / draught.height_m,
            .latent_heat = style.latent_heat,
            .expands_above = style.explodes_above,
            .expansion_per_s = style.explosion_per_s,
            .rim = {},
            .outside_vapour = outside_vapour(style)};
}

} // namespace

Draught draught_of(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    const float height_m = box.cell_m * static_cast<float>(box.cells.y);
    const float angle = glm::radians(style.wind.towards_deg);
    const glm::vec3 wind = wind::speed_m_per_s(style.wind, style.wind_m_per_s) *
                           glm::vec3(std::sin(angle), 0.0F, std::cos(angle));
    return {.speed_m_per_s = height_m / style.rise_s,
            .width_m = box.width_m(),
            .height_m = height_m,
            .wind_m_per_s = box.cell_m * glm::mat3(box.grid_from_anchor) * wind};
}

uint32_t smoke_channels(const smoke::SmokeStyle& style)
{
    if (smoke::is_moist(style)) {
        return shared::fluid_cloud + 1;
    }
    return smoke::is_burning(style) ? shared::fluid_fuel + 1 : shared::fluid_temperature + 1;
}

double steps_per_s(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    const Draught draught = draught_of(box, style);
    const float of_wind = 2.0F * glm::length(draught.wind_m_per_s) / rim_m(draught);
    const float of_blasts = smoke::is_explosive(style) ? 2.0F * style.explosion_per_s : 0.0F;
    return static_cast<double>(std::clamp(std::max(of_wind, of_blasts), 24.0F, 480.0F));
}

fluid::Grid grid_of(const smoke::Box& box)
{
    // Periodic faces are used as open faces. A zone along the periodic faces removes smoke, so that the smoke
    // does not enter again at the opposite face.
    constexpr fluid::Edge open = fluid::Edge::periodic;
    return {.cells = box.cells, .cell_m = box.cell_m, .edges = {open, open, open}};
}

fluid::FluidStyle solving(const smoke::Box& box, const smoke::SmokeStyle& style, double step_s)
{
    const Draught draught = draught_of(box, style);
    const float crossing_per_s = (draught.speed_m_per_s + glm::length(draught.wind_m_per_s)) / rim_m(draught);
    const fluid::Rim calming{.breadth_m = rim_m(draught), .share_per_s = crossing_per_s};
    const fluid::Rim clearing{.breadth_m = rim_m(draught), .share_per_s = 8.0F * crossing_per_s};
    fluid::MatterStyle matter = changing(draught, style);
    matter.rim = clearing;
    return {.step_s = static_cast<float>(step_s),
            .stepping = style.stepping == smoke::Stepping::reflect ? fluid::Stepping::reflect
                                                                   : fluid::Stepping::project,
            .velocity_advection = advection_of(style),
            .quantity_advection = advection_of(style),
            .projection = {.solver = solver_of(style), .jacobi_rounds = style.jacobi_passes},
            .forces = {.lift_m_s2 = 5.0F * draught.speed_m_per_s * draught.speed_m_per_s / draught.height_m,
                       .confinement_per_s = 4.0F * std::min(style.curl, 1.0F) / style.rise_s,
                       .surplus_per_s = 4.0F * std::max(style.curl - 1.0F, 0.0F) / style.rise_s,
                       .rim = calming,
                       .outside_m_per_s = draught.wind_m_per_s},
            .matter = matter};
}

fluid::Source source_of(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    const float radius_m = 0.5F * style.source * box.width_m();
    const glm::vec3 floor = 0.5F * box.cell_m * glm::vec3(box.cells) * glm::vec3(1.0F, 0.0F, 1.0F);
    fluid::Source source{.shape = fluid::disc(floor + glm::vec3(0.0F, 0.6F * radius_m, 0.0F), radius_m)};
    source.gain_per_s[shared::fluid_density] = style.amount_per_s;
    // Without a least density, air that enters at the source's floor would rise before it becomes visible,
    // and the invisible part of its path would be longer at a higher speed.
    source.least_density = std::min(held_s * style.amount_per_s, 1.0F);
    source.gain_per_s[shared::fluid_temperature] = 6.0F / style.rise_s;
    source.gain_per_s[shared::fluid_fuel] = style.fuel_per_s;
    source.least_vapour = style.humidity;
    return source;
}

fluid::Source blasting_source_of(const smoke::Box& box, const smoke::SmokeStyle& style, double step_s)
{
    fluid::Source source = source_of(box, style);
    const auto at_once_per_s = static_cast<float>(1.0 / step_s);
    const float growth = style.blast_heat / style.explodes_above;
    source.gain_per_s[shared::fluid_temperature] += at_once_per_s * style.blast_heat;
    source.gain_per_s[shared::fluid_density] += at_once_per_s * growth;
    return source;
}

std::optional<Blast> blast_of(const smoke::Box& box, const smoke::SmokeStyle& style, const glm::dvec3& anchor)
{
    if (!smoke::is_blasting(style)) {
        return std::nullopt;
    }
    const fluid::Shape& ball = source_of(box, style).shape;
    const auto radius_m = static_cast<double>(ball.radius_m);
    // The part of the ball that lies below the floor of the box has no air.
    const double sunk_m = std::max(radius_m - static_cast<double>(ball.centre_m.y), 0.0);
    const double sunk_m3 = std::numbers::pi * sunk_m * sunk_m * (radius_m - sunk_m / 3.0);
    const glm::dmat4 anchor_from_grid = glm::inverse(glm::dmat4(box.grid_from_anchor));
    return Blast{.centre =
                     anchor + glm::dvec3(anchor_from_grid * glm::dvec4(ball.centre_m / box.cell_m, 1.0)),
                 .at_s = static_cast<double>(style.blast_at_s),
                 .start_m3 = 4.0 / 3.0 * std::numbers::pi * std::pow(radius_m, 3.0) - sunk_m3,
                 .growth = static_cast<double>(style.blast_heat / style.explodes_above),
                 .rate_per_s = static_cast<double>(style.explosion_per_s)};
}

std::vector<float> stirred_air(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    constexpr int wave_count = 10;
    constexpr double most_waves = 3.0; // Most waves along a side of the smoke box
    const Draught draught = draught_of(box, style);
    std::mt19937 random(static_cast<uint32_t>(style.seed) + 7919U * box.number);
    const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };

    struct Wave {
        glm::dvec3 turns; ///< Number of periods of the wave along each side of the box, whole numbers
        glm::dvec3 swing;
        double phase = 0.0;
    };

    std::vector<Wave> waves;
    for (int i = 0; i < wave_count; ++i) {
        const glm::dvec3 turns = glm::round(most_waves * glm::dvec3(number(), number(), number()));
        const glm::dvec3 any(number(), number(), number());
        const double size = glm::length(turns);
        const glm::dvec3 along = size > 0.0 ? turns / size : glm::dvec3(0.0);
        waves.push_back(
            {turns, 0.25 * static_cast<double>(draught.speed_m_per_s) * (any - along * glm::dot(any, along)),
             number()});
    }
    std::vector<float> speeds;
    speeds.reserve(size_t{3} * box.cells.x * box.cells.y * box.cells.z);
    for (int axis = 0; axis < 3; ++axis) {
        for (uint32_t z = 0; z < box.cells.z; ++z) {
            for (uint32_t y = 0; y < box.cells.y; ++y) {
                for (uint32_t x = 0; x < box.cells.x; ++x) {
                    const glm::dvec3 place = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(box.cells);
                    auto speed = static_cast<double>(draught.wind_m_per_s[axis]);
                    for (const Wave& wave : waves) {
                        speed += wave.swing[axis] * std::sin(2.0 * std::numbers::pi *
                                                             (glm::dot(wave.turns, place) + wave.phase));
                    }
                    speeds.push_back(static_cast<float>(speed));
                }
            }
        }
    }
    return speeds;
}

std::vector<float> clean_air(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    if (!(outside_vapour(style) > 0.0F)) {
        return {};
    }
    const fluid::Grid grid = grid_of(box);
    std::vector<float> quantities(smoke_channels(style) * grid.cell_count(), 0.0F);
    for (uint64_t i = 0; i < grid.cell_count(); ++i) {
        const auto height =
            (static_cast<float>(i / box.cells.x % box.cells.y) + 0.5F) / static_cast<float>(box.cells.y);
        quantities[shared::fluid_vapour * grid.cell_count() + i] = std::min(
            outside_vapour(style), water_held_at_floor(style) * std::exp(-holds_less_above * height));
    }
    return quantities;
}

namespace {

using Triangle = std::array<glm::dvec3, 3>;

constexpr double half_cell = 0.5;

/// Returns whether a plane perpendicular to the axis separates the triangle from a cell centred at the
/// origin.
bool parts(const glm::dvec3& axis, const Triangle& triangle)
{
    const double reach = half_cell * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    const auto [low, high] =
        std::minmax({glm::dot(axis, triangle[0]), glm::dot(axis, triangle[1]), glm::dot(axis, triangle[2])});
    return low > reach || high < -reach;
}

bool touches_cell(const Triangle& triangle, const glm::dvec3& middle)
{
    const Triangle at{triangle[0] - middle, triangle[1] - middle, triangle[2] - middle};
    const std::array<glm::dvec3, 3> sides{at[1] - at[0], at[2] - at[1], at[0] - at[2]};
    if (parts(glm::cross(sides[0], sides[1]), at)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 axis(0.0);
        axis[i] = 1.0;
        if (parts(axis, at) || std::ranges::any_of(sides, [&](const glm::dvec3& side) {
                return parts(glm::cross(axis, side), at);
            })) {
            return false;
        }
    }
    return true;
}

/// Marks the cells of a smoke box that a triangle touches.
class Cells {
public:
    explicit Cells(const glm::uvec3& size) : size_(size), flags_(size_t{size.x} * size.y * size.z) {}

    void touch(const Triangle& triangle)
    {
        const glm::dvec3 low = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
        const glm::dvec3 high = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
        const glm::dvec3 last = glm::dvec3(size_) - 1.0;
        if (!glm::all(glm::lessThanEqual(low, glm::dvec3(size_))) ||
            !glm::all(glm::greaterThanEqual(high, glm::dvec3(0.0)))) {
            return; // The triangle is outside of the box; this form of the test also catches NaN
        }
        const glm::uvec3 from(glm::clamp(glm::floor(low), glm::dvec3(0.0), last));
        const glm::uvec3 to(glm::clamp(glm::floor(high), glm::dvec3(0.0), last));
        for (uint32_t z = from.z; z <= to.z; ++z) {
            for (uint32_t y = from.y; y <= to.y; ++y) {
                for (uint32_t x = from.x; x <= to.x; ++x) {
                    if (touches_cell(triangle, glm::dvec3(x, y, z) + half_cell)) {
                        flags_[(size_t{z} * size_.y + y) * size_.x + x] = 1;
                    }
                }
            }
        }
    }

    [[nodiscard]] std::vector<uint8_t> take() { return std::move(flags_); }

private:
    glm::uvec3 size_;
    std::vector<uint8_t> flags_;
};

void touch_all(Cells& cells, const Primitive& primitive, const glm::dmat4& grid_from_mesh)
{
    for (size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        Triangle triangle;
        for (size_t corner = 0; corner < 3; ++corner) {
            const glm::vec3& position = primitive.positions[primitive.indices[i + corner]];
            triangle.at(corner) = glm::dvec3(grid_from_mesh * glm::dvec4(position, 1.0));
        }
        cells.touch(triangle);
    }
}

} // namespace

std::vector<uint8_t> standing_cells(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                                    const smoke::Box& box)
{
    Cells cells(box.cells);
    glm::dmat4 anchor_from_world(1.0);
    anchor_from_world[3] = glm::dvec4(-anchor, 1.0);
    const glm::dmat4 grid_from_world = glm::dmat4(box.grid_from_anchor) * anchor_from_world;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.mesh == no_index || node.skin != no_index) {
            continue;
        }
        const glm::dmat4 grid_from_node = grid_from_world * pose.world_from_node[i];
        const std::vector<glm::mat4> one{glm::mat4(1.0F)};
        for (const glm::mat4& instance : node.instances.empty() ? one : node.instances) {
            for (const Primitive& primitive : scene.meshes[node.mesh].primitives) {
                const bool is_rigid =
                    primitive.morph_targets.empty() && cloth_of(scene, node, primitive) == nullptr;
                if (primitive.topology == Topology::triangles && is_rigid) {
                    touch_all(cells, primitive, grid_from_node * glm::dmat4(instance));
                }
            }
        }
    }
    return cells.take();
}

} // namespace estampe::features
