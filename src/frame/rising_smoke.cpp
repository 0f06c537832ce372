// SPDX-License-Identifier: MIT
#include "frame/rising_smoke.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/luminance.hpp"
#include "frame/smoke_obstacles.hpp"
#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "style/raw.hpp"
#include "style/surfaces.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/fluid/read_fields.hpp"

namespace estampe::frame {
namespace {

constexpr double steps_per_s = 24.0; ///< at least
constexpr double longest_gap_s = 1.0;
constexpr float held_s = 0.2F;   ///< that air has been in a source at least, going by its density
constexpr uint32_t channels = 2; // density and temperature

/// Proportions of the box and how fast smoke goes through it.
struct Draught {
    float speed_m_s = 1.0F;
    float width_m = 1.0F;
    float height_m = 1.0F;
    glm::vec3 wind_m_s{0.0F}; ///< in the grid's axes
};

Draught draught_of(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    const float height_m = box.cell_m * static_cast<float>(box.cells.y);
    const float angle = glm::radians(style.wind_deg);
    const glm::vec3 wind = style.wind_m_s * glm::vec3(std::sin(angle), 0.0F, std::cos(angle));
    return {.speed_m_s = height_m / style.rise_s,
            .width_m = box.width_m(),
            .height_m = height_m,
            .wind_m_s = box.cell_m * glm::mat3(box.grid_from_anchor) * wind};
}

fluid::Grid grid_of(const smoke::Box& box)
{
    // What leaves at one face would come back at the other, if the rim did not take it.
    constexpr fluid::Edge open = fluid::Edge::periodic;
    return {.cells = box.cells, .cell_m = box.cell_m, .edges = {open, open, open}};
}

fluid::Solver solver_of(const smoke::SmokeStyle& style)
{
    switch (style.solver) {
    case smoke::Solver::spectral:
        // Which knows of nothing in its way.
        return style.obstacles ? fluid::Solver::automatic : fluid::Solver::spectral;
    case smoke::Solver::multigrid:
        return fluid::Solver::multigrid;
    case smoke::Solver::jacobi:
        return fluid::Solver::jacobi;
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

fluid::FluidStyle solving(const smoke::Box& box, const smoke::SmokeStyle& style, double step_s)
{
    const Draught draught = draught_of(box, style);
    const float crossing_per_s =
        (draught.speed_m_s + glm::length(draught.wind_m_s)) / (0.15F * draught.width_m);
    const fluid::Rim calming{.breadth_m = 0.15F * draught.width_m, .share_per_s = crossing_per_s};
    const fluid::Rim clearing{.breadth_m = 0.15F * draught.width_m, .share_per_s = 8.0F * crossing_per_s};
    return {.step_s = static_cast<float>(step_s),
            .stepping = style.stepping == smoke::Stepping::reflect ? fluid::Stepping::reflect
                                                                   : fluid::Stepping::project,
            .velocity_advection = advection_of(style),
            .quantity_advection = advection_of(style),
            .projection = {.solver = solver_of(style)},
            .forces = {.lift_m_s2 = 5.0F * draught.speed_m_s * draught.speed_m_s / draught.height_m,
                       .confinement_per_s = 4.0F * style.curl / style.rise_s,
                       .rim = calming,
                       .outside_m_s = draught.wind_m_s},
            .matter = {
                .fading_per_s = 1.0F / style.life_s, .cooling_per_s = 1.2F / style.rise_s, .rim = clearing}};
}

fluid::Source source_of(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    const float radius_m = 0.5F * style.source * box.width_m();
    const glm::vec3 floor = 0.5F * box.cell_m * glm::vec3(box.cells) * glm::vec3(1.0F, 0.0F, 1.0F);
    fluid::Source source{.shape = fluid::disc(floor + glm::vec3(0.0F, 0.6F * radius_m, 0.0F), radius_m)};
    source.gain_per_s[shared::fluid_density] = style.amount_per_s;
    // Or air that comes in by the floor would be a way above it before it is seen, the longer the quicker.
    source.least_density = std::min(held_s * style.amount_per_s, 1.0F);
    source.gain_per_s[shared::fluid_temperature] = 6.0F / style.rise_s;
    return source;
}

/// Air that stirs a little, or smoke would rise as straight as a column.
std::vector<float> stirred_air(const smoke::Box& box, const smoke::SmokeStyle& style)
{
    constexpr int wave_count = 10;
    constexpr double most_waves = 3.0; // along a side
    const Draught draught = draught_of(box, style);
    std::mt19937 random(static_cast<uint32_t>(style.seed) + 7919U * box.number);
    const auto number = [&] { return 2.0 * static_cast<double>(random()) / 4294967295.0 - 1.0; };

    struct Wave {
        glm::dvec3 turns; ///< over the box: whole numbers
        glm::dvec3 swing;
        double phase = 0.0;
    };

    std::vector<Wave> waves;
    for (int i = 0; i < wave_count; ++i) {
        const glm::dvec3 turns = glm::round(most_waves * glm::dvec3(number(), number(), number()));
        const glm::dvec3 any(number(), number(), number());
        const double size = glm::length(turns);
        const glm::dvec3 along = size > 0.0 ? turns / size : glm::dvec3(0.0);
        waves.push_back({turns,
                         0.25 * static_cast<double>(draught.speed_m_s) * (any - along * glm::dot(any, along)),
                         number()});
    }
    std::vector<float> speeds;
    speeds.reserve(size_t{3} * box.cells.x * box.cells.y * box.cells.z);
    for (int axis = 0; axis < 3; ++axis) {
        for (uint32_t z = 0; z < box.cells.z; ++z) {
            for (uint32_t y = 0; y < box.cells.y; ++y) {
                for (uint32_t x = 0; x < box.cells.x; ++x) {
                    const glm::dvec3 place = (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(box.cells);
                    auto speed = static_cast<double>(draught.wind_m_s[axis]);
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

/// Sides in cells, powers of two nearest to the proportions.
glm::uvec3 sides_of(const glm::dvec3& size_m, uint32_t longest)
{
    constexpr double fewest = 8.0;
    const double whole_m = std::max({size_m.x, size_m.y, size_m.z});
    glm::uvec3 sides(0);
    for (int axis = 0; axis < 3; ++axis) {
        const double wanted = std::max(longest * size_m[axis] / whole_m, fewest);
        sides[axis] = std::min(1U << static_cast<uint32_t>(std::lround(std::log2(wanted))), longest);
    }
    return sides;
}

/// None for a node that is scaled to nothing.
std::optional<smoke::Box> box_about(const glm::dmat4& world_from_node, const glm::dvec3& anchor,
                                    uint32_t cells)
{
    const auto column = [&](int axis) { return glm::dvec3(world_from_node[axis]); };
    glm::dvec3 size_m(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        size_m[axis] = 2.0 * glm::length(column(axis));
    }
    if (!(std::min({size_m.x, size_m.y, size_m.z}) > 1e-4)) {
        return std::nullopt;
    }
    const glm::dvec3 up = 2.0 * column(1) / size_m.y;
    const glm::dvec3 across = glm::cross(up, 2.0 * column(2) / size_m.z);
    const glm::dvec3 right =
        glm::length(across) > 1e-6 ? glm::normalize(across) : glm::normalize(glm::cross(up, {0.3, 0.1, 1.0}));
    const glm::uvec3 sides = sides_of(size_m, cells);
    const double cell_m = std::max({size_m.x, size_m.y, size_m.z}) / cells;
    const glm::dvec3 middle = column(3) - anchor;
    glm::dmat4 anchor_from_grid(1.0);
    anchor_from_grid[0] = glm::dvec4(cell_m * right, 0.0);
    anchor_from_grid[1] = glm::dvec4(cell_m * up, 0.0);
    anchor_from_grid[2] = glm::dvec4(cell_m * glm::cross(right, up), 0.0);
    const glm::dvec3 low =
        middle - glm::dmat3(anchor_from_grid) * (0.5 * glm::dvec3(sides) * glm::dvec3(1.0, 0.0, 1.0));
    anchor_from_grid[3] = glm::dvec4(low, 1.0);
    return smoke::Box{.cells = sides,
                      .cell_m = static_cast<float>(cell_m),
                      .grid_from_anchor = glm::mat4(glm::inverse(anchor_from_grid))};
}

void let_rise(fluid::Fluid& fluid, gpu::Executor& executor, const smoke::Box& box,
              const smoke::SmokeStyle& style, double gap_s)
{
    const auto count = static_cast<uint32_t>(std::ceil(gap_s * steps_per_s - 1e-6));
    fluid.set_shapes({}, std::vector{source_of(box, style)});
    for (uint32_t left = count; left > 0;) {
        const fluid::FluidStyle solver = solving(box, style, gap_s / count);
        const uint32_t now = std::min(left, fluid.most_steps(solver));
        gpu::Graph graph;
        static_cast<void>(fluid.add_steps(graph, solver, now));
        executor.run(graph);
        left -= now;
    }
}

/// Puffs and strokes go with the draught.
void carry_along(smoke::Box& box, const smoke::SmokeStyle& style, double time_s)
{
    const Draught draught = draught_of(box, style);
    const glm::dvec3 drift_m_s(draught.wind_m_s + glm::vec3(0.0F, draught.speed_m_s, 0.0F));
    box.puffs_risen_m = glm::vec3(time_s * drift_m_s);
    box.strokes_risen_m = static_cast<float>(std::fmod(time_s * static_cast<double>(draught.speed_m_s), 1e3));
}

} // namespace

struct RisingSmoke::Column {
    uint32_t number = 0;
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    double time_s = 0.0;
    KeptSmoke recalled;                  ///< until it is asked for
    std::unique_ptr<fluid::Fluid> fluid; ///< none until then

    [[nodiscard]] bool is_of(const smoke::Box& box) const
    {
        return number == box.number && cells == box.cells && cell_m == box.cell_m;
    }
};

std::vector<smoke::Lamp> smoke_lamps(const light::Lighting& lighting, bool has_sun_map)
{
    std::vector<smoke::Lamp> lamps;
    for (const shared::LightRecord& record : lighting.records) {
        const uint32_t type = record.type & shared::light_type_mask;
        const bool is_sun = type == shared::light_directional;
        const bool has_cone = type == shared::light_spot || type == shared::light_pyramid;
        const uint32_t of_sun =
            has_sun_map && lamps.empty() ? shared::smoke_sun_shadow : shared::smoke_no_shadow;
        const uint32_t of_lamp =
            record.shadow > 0 ? shared::smoke_local_shadow + record.shadow - 1 : shared::smoke_no_shadow;
        lamps.push_back({.place = is_sun ? record.direction : record.position,
                         .beam = record.direction,
                         .luminance = luminance(record.color),
                         .range_m = is_sun ? 0.0F : record.range_m,
                         .cone_scale = has_cone ? record.cone_scale : 0.0F,
                         .cone_offset = has_cone ? record.cone_offset : 1.0F,
                         .shadow = is_sun ? of_sun : of_lamp});
    }
    return lamps;
}

void add_fires(light::Lighting& lighting, const std::vector<smoke::Box>& boxes,
               const smoke::SmokeStyle& style, double time_s)
{
    if (style.glow <= 0.0F) {
        return;
    }
    for (const smoke::Box& box : boxes) {
        const fluid::Source source = source_of(box, style);
        const glm::mat4 anchor_from_grid = glm::inverse(box.grid_from_anchor);
        const float half_m = 0.5F * box.width_m();
        // Two waves whose lengths have no common measure.
        const auto flicker = static_cast<float>(1.0 + 0.12 * std::sin(17.3 * time_s + box.number) +
                                                0.08 * std::sin(41.7 * time_s + 2.0 * box.number));
        shared::LightRecord record{};
        record.type = shared::light_point;
        record.position = glm::vec3(anchor_from_grid * glm::vec4(source.shape.centre_m / box.cell_m, 1.0F));
        record.range_m = 20.0F * half_m;
        record.color = style.glow_color * (style.glow * flicker * half_m * half_m);
        record.groups = 0xffffffffU;
        record.radius_m = -1.0F;
        lighting.records.push_back(record);
    }
}

std::vector<smoke::Box> smoke_boxes(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                                    const std::string& pattern, uint32_t cells)
{
    std::vector<smoke::Box> boxes;
    uint32_t number = 0;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].mesh != no_index || !style::matches(pattern, scene.nodes[i].name)) {
            continue;
        }
        if (auto box = box_about(pose.world_from_node[i], anchor, cells)) {
            box->number = number;
            boxes.push_back(*box);
        }
        ++number;
    }
    return boxes;
}

RisingSmoke::RisingSmoke() = default;
RisingSmoke::~RisingSmoke() = default;

uint64_t kept_cell_count(const KeptSmoke& kept)
{
    const auto is_side = [](uint32_t cells) {
        return cells >= 8 && cells <= 256 && std::has_single_bit(cells);
    };
    if (!is_side(kept.cells.x) || !is_side(kept.cells.y) || !is_side(kept.cells.z) || !(kept.cell_m > 0.0F)) {
        throw Error("this is not the memory of a film's frame");
    }
    return uint64_t{kept.cells.x} * kept.cells.y * kept.cells.z;
}

void RisingSmoke::forget()
{
    columns_.clear();
}

std::vector<KeptSmoke> RisingSmoke::kept(gpu::Device& device, gpu::Executor& executor)
{
    std::vector<KeptSmoke> kept;
    for (const auto& column : columns_) {
        if (!column->fluid) {
            kept.push_back(column->recalled);
            continue;
        }
        const auto numbers = [&](bool are_quantities) {
            gpu::Graph graph;
            const fluid::FluidFields fields = column->fluid->add_steps(graph, {}, 0);
            return fluid::run_and_read(device, executor, graph,
                                       are_quantities ? fields.quantities.value() : fields.velocity);
        };
        kept.push_back({.number = column->number,
                        .cells = column->cells,
                        .cell_m = column->cell_m,
                        .time_s = column->time_s,
                        .velocity = numbers(false),
                        .quantities = numbers(true)});
    }
    return kept;
}

void RisingSmoke::recall(std::vector<KeptSmoke> kept)
{
    forget();
    for (KeptSmoke& box : kept) {
        auto column = std::make_unique<Column>(Column{.number = box.number,
                                                      .cells = box.cells,
                                                      .cell_m = box.cell_m,
                                                      .time_s = box.time_s,
                                                      .fluid = nullptr});
        column->recalled = std::move(box);
        columns_.push_back(std::move(column));
    }
}

std::unique_ptr<RisingSmoke::Column> RisingSmoke::started(gpu::Device& device, gpu::Executor& executor,
                                                          const smoke::Box& box, const SmokeInputs& in)
{
    const smoke::SmokeStyle& style = in.style.smoke;
    const auto found =
        std::ranges::find_if(columns_, [&](const auto& column) { return column && column->is_of(box); });
    std::unique_ptr<Column> column =
        found != columns_.end() ? std::move(*found)
                                : std::make_unique<Column>(Column{
                                      .number = box.number,
                                      .cells = box.cells,
                                      .cell_m = box.cell_m,
                                      .time_s = in.settings.time_s - static_cast<double>(style.age_s),
                                      .recalled = {.velocity = stirred_air(box, style), .quantities = {}},
                                      .fluid = nullptr});
    if (!column->fluid) {
        const KeptSmoke start = std::exchange(column->recalled, {});
        column->fluid =
            std::make_unique<fluid::Fluid>(device, grid_of(box), channels, start.velocity, start.quantities);
        if (style.obstacles) {
            column->fluid->set_standing(
                device, standing_cells(in.loaded.scene, in.pose, in.loaded.layout.anchor, box));
        }
        static_cast<void>(column->fluid->check_spectral(device, executor));
    }
    return column;
}

std::vector<smoke::Box> RisingSmoke::rise(gpu::Device& device, gpu::Executor& executor, const SmokeInputs& in,
                                          std::vector<std::string>& notes)
{
    const smoke::SmokeStyle& style = in.style.smoke;
    std::vector<smoke::Box> boxes;
    if (style.drawn) {
        boxes = smoke_boxes(in.loaded.scene, in.pose, in.loaded.layout.anchor, style.objects,
                            std::bit_floor(style.cells));
    }
    if (style.drawn && boxes.empty()) {
        notes.push_back(
            fmt::format("smoke.objects speaks of objects without a mesh {}, of which the scene has none",
                        style::in_quotes(style.objects)));
    }
    if (boxes.empty()) {
        forget();
        return {};
    }
    if (boxes.size() > shared::smoke_most_boxes) {
        notes.push_back(fmt::format("smoke rises from the first {} of {} objects", shared::smoke_most_boxes,
                                    boxes.size()));
        boxes.resize(shared::smoke_most_boxes);
    }
    const double time_s = in.settings.time_s;
    std::erase_if(columns_, [&](const auto& column) {
        return in.settings.continuity != Continuity::follows || time_s < column->time_s ||
               time_s - column->time_s > longest_gap_s;
    });
    std::vector<std::unique_ptr<Column>> columns;
    for (smoke::Box& box : boxes) {
        columns.push_back(started(device, executor, box, in));
        Column& column = *columns.back();
        let_rise(*column.fluid, executor, box, style, time_s - column.time_s);
        column.time_s = time_s;
        carry_along(box, style, time_s);
    }
    columns_ = std::move(columns);
    return boxes;
}

gpu::ImageId RisingSmoke::velocity(gpu::Graph& graph, size_t box)
{
    return columns_.at(box)->fluid->add_steps(graph, {}, 0).velocity;
}

std::optional<SmokePlan> RisingSmoke::provide(gpu::Device& device, gpu::Executor& executor,
                                              const SmokeInputs& in, std::vector<std::string>& notes)
{
    const smoke::SmokeStyle& style = in.style.smoke;
    SmokePlan plan{.boxes = in.risen ? *in.risen : rise(device, executor, in, notes)};
    if (plan.boxes.empty()) {
        return std::nullopt;
    }
    const shared::SmokeGlobals globals =
        smoke::globals_of(plan.boxes, style, {.lamps = in.lamps, .ambient = in.ambient});
    globals_ = gpu::upload_buffer(device, "smoke globals", std::vector{globals});
    volume_.provide(device, globals);
    return plan;
}

smoke::Fields RisingSmoke::fields(gpu::Graph& graph)
{
    smoke::Fields fields{.globals = gpu::import_whole(graph, "smoke", globals_), .densities = {}};
    for (const auto& column : columns_) {
        fields.densities.push_back(column->fluid->add_steps(graph, {}, 0).quantities.value());
    }
    return fields;
}

} // namespace estampe::frame
