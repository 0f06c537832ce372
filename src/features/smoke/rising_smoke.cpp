// SPDX-License-Identifier: MIT
#include "features/smoke/rising_smoke.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/color.hpp"
#include "features/common/solver_meter.hpp"
#include "features/smoke/smoke_air.hpp"
#include "gpu/resources.hpp"
#include "style/parameter.hpp"
#include "style/toml.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::features {
namespace {

constexpr double longest_gap_s = 1.0;
// Time that is simulated per picture, until smoke that starts during a film has reached the film's time.
constexpr double caught_up_s = 0.25;

/// Returns the grid size in cells: powers of two whose proportions are nearest to those of the smoke's box.
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

/// Returns the smoke box of a node; none if the node's scale is zero.
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

/// Steps of the smoke simulation that run in the picture's graph.
struct StepsLeft {
    fluid::FluidStyle style;
    uint32_t count = 0;
};

/// The inputs for simulating the smoke in a box over a period of time.
struct Rise {
    const smoke::Box& box;
    const smoke::SmokeStyle& style;
    double from_s = 0.0; ///< Scene time up to which the smoke is simulated
    double gap_s = 0.0;
    uint32_t boxes = 1; ///< Number of smoke boxes that are simulated together
    bool is_measured = false;
};

/// The result of simulating smoke with let_rise().
struct Risen {
    std::optional<SolverReport> report; ///< Report of the pressure solver; none if no step was taken
    StepsLeft left;
};

/// Returns the number of the step in which a blast goes off; none if no step of the period does.
std::optional<uint32_t> step_of_blast(const Rise& rise, uint32_t count)
{
    const double after_s = static_cast<double>(rise.style.blast_at_s) - rise.from_s;
    if (!smoke::is_blasting(rise.style) || after_s < 0.0 || after_s >= rise.gap_s) {
        return std::nullopt;
    }
    return std::min(static_cast<uint32_t>(after_s / rise.gap_s * count), count - 1);
}

/// Returns the settings of steps that end at `until_s`. A blast may blow smoke through the floor so fast that
/// it would come back from above; so the zone at the open faces removes smoke more quickly after a blast.
fluid::FluidStyle solving_until(const Rise& rise, double step_s, double until_s)
{
    constexpr float clearings = 5.0F; // per time constant of the blast
    fluid::FluidStyle solver = solving(rise.box, rise.style, step_s);
    if (smoke::is_blasting(rise.style) && until_s > static_cast<double>(rise.style.blast_at_s)) {
        solver.matter.rim.share_per_s += clearings * rise.style.explosion_per_s;
    }
    return solver;
}

/// Runs the steps of the simulation, except for the last ones, which run in the picture's own graph. If the
/// solver is measured, or in a period with a blast, all steps run here.
Risen let_rise(fluid::Fluid& fluid, gpu::Device& device, SolverMeter meter, const Rise& rise)
{
    const auto count =
        static_cast<uint32_t>(std::ceil(rise.gap_s * steps_per_s(rise.box, rise.style) - 1e-6));
    fluid.set_shapes({}, std::vector{source_of(rise.box, rise.style)});
    if (count == 0) {
        return {};
    }
    const double step_s = rise.gap_s / count;
    const fluid::FluidStyle usual = solving(rise.box, rise.style, step_s);
    fluid.ensure_mass(device, usual);
    const uint32_t most = fluid.most_steps(usual);
    const std::optional<uint32_t> blast = step_of_blast(rise, count);
    const uint32_t room = rise.is_measured || blast ? 0 : most / rise.boxes;
    for (uint32_t done = 0; count - done > room;) {
        const bool is_blast = done == blast;
        const uint32_t until = is_blast ? done + 1 : blast && done < *blast ? *blast : count - room;
        const uint32_t now = std::min(until - done, most);
        if (blast) {
            fluid.set_shapes({}, std::vector{is_blast ? blasting_source_of(rise.box, rise.style, step_s)
                                                      : source_of(rise.box, rise.style)});
        }
        gpu::Graph graph;
        const fluid::FluidStyle solver = solving_until(rise, step_s, rise.from_s + (done + now) * step_s);
        const fluid::FluidFields fields = fluid.add_steps(graph, solver, now);
        done += now;
        meter.run(graph, fluid, solver, fields, now, done == count);
    }
    return {.report = meter.report(),
            .left = {solving_until(rise, step_s, rise.from_s + rise.gap_s), std::min(count, room)}};
}

/// Moves the random patterns of puffs and strokes in the smoke with the wind and the rising air.
void carry_along(smoke::Box& box, const smoke::SmokeStyle& style, double time_s)
{
    const Draught draught = draught_of(box, style);
    const glm::dvec3 drift_m_per_s(draught.wind_m_per_s + glm::vec3(0.0F, draught.speed_m_per_s, 0.0F));
    box.puffs_risen_m = glm::vec3(time_s * drift_m_per_s);
    box.strokes_risen_m =
        static_cast<float>(std::fmod(time_s * static_cast<double>(draught.speed_m_per_s), 1e3));
}

/// Returns the number of cells of the smoke's grid. Throws Error if smoke cannot have the dimensions of the
/// box.
uint64_t checked_cell_count(const glm::uvec3& cells, float cell_m, uint32_t channels)
{
    const auto is_count = [](uint32_t count) {
        return count >= 8 && count <= 256 && std::has_single_bit(count);
    };
    const bool are_channels = channels == shared::fluid_temperature + 1 ||
                              channels == shared::fluid_fuel + 1 || channels == shared::fluid_cloud + 1;
    if (!are_channels || !is_count(cells.x) || !is_count(cells.y) || !is_count(cells.z) || !(cell_m > 0.0F)) {
        fail_damaged();
    }
    return uint64_t{cells.x} * cells.y * cells.z;
}

} // namespace

struct RisingSmoke::Kept {
    uint32_t number = 0;
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    double time_s = 0.0;
    double behind_s = 0.0; ///< Time by which the smoke is behind the picture's time
    uint32_t channels = 2;
    std::vector<float> velocity;   ///< Velocity of the air, three numbers per cell
    std::vector<float> quantities; ///< Density, temperature and so on, one number per quantity and cell
    std::vector<float> mass;       ///< Mass of the air per cell if smoke.solver is mass; else empty
};

struct RisingSmoke::Column {
    uint32_t number = 0;
    glm::uvec3 cells{0};
    float cell_m = 1.0F;
    double time_s = 0.0;
    double behind_s = 0.0;               ///< Time by which the smoke is behind the last picture's time
    Kept recalled;                       ///< Saved state of the smoke; used when the simulation is created
    std::unique_ptr<fluid::Fluid> fluid; ///< Simulation of the smoke; made when it is first used
    std::optional<SolverReport> solver_report = {};
    StepsLeft left = {}; ///< Steps that run in the next graph that uses the fluid

    /// Returns the smoke simulated up to time_s. Call this function at most once per graph.
    [[nodiscard]] fluid::FluidFields add(gpu::Graph& graph)
    {
        const StepsLeft now = std::exchange(left, {});
        return fluid->add_steps(graph, now.style, now.count);
    }

    /// Runs the remaining steps of the smoke, if no picture's graph has run them.
    void catch_up(gpu::Executor& executor)
    {
        if (left.count > 0) {
            gpu::Graph graph;
            static_cast<void>(add(graph));
            executor.run(graph);
        }
    }

    [[nodiscard]] bool is_of(const smoke::Box& box, uint32_t wanted_channels) const
    {
        return number == box.number && cells == box.cells && cell_m == box.cell_m &&
               (fluid ? fluid->channels() : recalled.channels) == wanted_channels;
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
        // The flicker of a fire is the sum of two waves with an irrational ratio of frequencies, so that it
        // does not repeat.
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
        const Node& node = scene.nodes[i];
        if (!node.visible || node.mesh != no_index || !style::matches(pattern, node.name)) {
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

std::vector<Blast> smoke_blasts(const Scene& scene, const ScenePose& pose, const glm::dvec3& anchor,
                                const smoke::SmokeStyle& style)
{
    std::vector<Blast> blasts;
    if (!style.enabled || !smoke::is_blasting(style)) {
        return blasts;
    }
    for (const smoke::Box& box :
         smoke_boxes(scene, pose, anchor, style.objects, std::bit_floor(style.cells))) {
        const auto blast =
            blasts.size() < shared::smoke_most_boxes ? blast_of(box, style, anchor) : std::nullopt;
        if (blast) {
            blasts.push_back(*blast);
        }
    }
    return blasts;
}

RisingSmoke::RisingSmoke() = default;
RisingSmoke::~RisingSmoke() = default;

std::vector<SolverReport> RisingSmoke::solver_reports() const
{
    std::vector<SolverReport> reports;
    for (size_t i = 0; i < columns_.size(); ++i) {
        if (const auto& report = columns_[i]->solver_report) {
            reports.push_back(*report);
            reports.back().fluid = columns_.size() > 1 ? fmt::format("smoke {}", i + 1) : "smoke";
        }
    }
    return reports;
}

void RisingSmoke::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::film_recalled) {
        columns_.clear();
    }
}

void RisingSmoke::save(FilmWriter& writer)
{
    for (const auto& column : columns_) {
        const auto numbers = [&](bool are_quantities) {
            if (!column->fluid) {
                return are_quantities ? column->recalled.quantities : column->recalled.velocity;
            }
            gpu::Graph graph;
            const fluid::FluidFields fields = column->add(graph);
            return fluid::run_and_read(writer.device(), writer.executor(), graph,
                                       are_quantities ? fields.quantities.value() : fields.velocity);
        };
        writer.value(column->number);
        writer.value(column->cells);
        writer.value(column->cell_m);
        writer.value(column->fluid ? column->fluid->channels() : column->recalled.channels);
        writer.value(column->time_s);
        writer.value(column->behind_s);
        writer.floats(numbers(false));
        writer.floats(numbers(true));
        const std::vector<float> mass =
            column->fluid ? fluid::run_and_read_mass(writer.device(), writer.executor(), *column->fluid)
                          : column->recalled.mass;
        writer.flag(!mass.empty());
        writer.floats(mass);
    }
}

void RisingSmoke::load(FilmReader& reader)
{
    columns_.clear();
    while (!reader.is_at_end()) {
        Kept kept{.number = reader.value<uint32_t>(),
                  .cells = reader.value<glm::uvec3>(),
                  .cell_m = reader.value<float>()};
        kept.channels = reader.value<uint32_t>();
        kept.time_s = reader.value<double>();
        kept.behind_s = reader.value<double>();
        const uint64_t cells = checked_cell_count(kept.cells, kept.cell_m, kept.channels);
        kept.velocity = reader.floats(3 * cells);
        kept.quantities = reader.floats(kept.channels * cells);
        kept.mass = reader.floats(reader.flag() ? cells : 0);
        auto column = std::make_unique<Column>(Column{.number = kept.number,
                                                      .cells = kept.cells,
                                                      .cell_m = kept.cell_m,
                                                      .time_s = kept.time_s,
                                                      .behind_s = kept.behind_s,
                                                      .recalled = {},
                                                      .fluid = nullptr});
        column->recalled = std::move(kept);
        columns_.push_back(std::move(column));
    }
}

std::unique_ptr<RisingSmoke::Column> RisingSmoke::started(gpu::Device& device, gpu::Executor& executor,
                                                          const smoke::Box& box, const SmokeInputs& in)
{
    const smoke::SmokeStyle& style = in.style.smoke;
    const uint32_t channels = smoke_channels(style);
    const auto found = std::ranges::find_if(
        columns_, [&](const auto& column) { return column && column->is_of(box, channels); });
    const bool goes_on = in.settings.continuity == Continuity::follows;
    const auto age_s = static_cast<double>(style.age_s);
    std::unique_ptr<Column> column =
        found != columns_.end()
            ? std::move(*found)
            : std::make_unique<Column>(Column{.number = box.number,
                                              .cells = box.cells,
                                              .cell_m = box.cell_m,
                                              .time_s = in.settings.time_s - age_s,
                                              .behind_s = goes_on ? age_s : 0.0,
                                              .recalled = {.channels = channels,
                                                           .velocity = stirred_air(box, style),
                                                           .quantities = clean_air(box, style)},
                                              .fluid = nullptr});
    if (!column->fluid) {
        const Kept start = std::exchange(column->recalled, {});
        column->fluid =
            std::make_unique<fluid::Fluid>(device, grid_of(box), channels, start.velocity, start.quantities);
        if (!start.mass.empty()) {
            column->fluid->set_mass(device, start.mass);
        }
        if (style.obstacles) {
            column->fluid->set_standing(device, standing_cells(in.scene, in.pose, in.layout.anchor, box));
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
    if (style.enabled) {
        boxes = smoke_boxes(in.scene, in.pose, in.layout.anchor, style.objects, std::bit_floor(style.cells));
    }
    if (style.enabled && boxes.empty()) {
        notes.push_back(
            fmt::format("smoke.objects speaks of objects without a mesh {}, of which the scene has none",
                        style::in_quotes(style.objects)));
    }
    if (boxes.empty()) {
        columns_.clear();
        return {};
    }
    if (style.blast_at_s >= 0.0F && !smoke::is_blasting(style)) {
        notes.emplace_back(smoke::is_explosive(style)
                               ? "smoke.blast_at_s gives no explosion, because smoke.blast_heat is not above "
                                 "smoke.explodes_above"
                               : "smoke.blast_at_s gives no blast, because smoke.explodes_above is 0");
    }
    if (boxes.size() > shared::smoke_most_boxes) {
        notes.push_back(fmt::format("smoke rises from the first {} of {} objects", shared::smoke_most_boxes,
                                    boxes.size()));
        boxes.resize(shared::smoke_most_boxes);
    }
    const double time_s = in.settings.time_s;
    std::erase_if(columns_, [&](const auto& column) {
        const double before_s = column->time_s + column->behind_s;
        return in.settings.continuity != Continuity::follows || time_s < before_s - 1e-6 ||
               time_s - before_s > longest_gap_s;
    });
    std::vector<std::unique_ptr<Column>> columns;
    for (smoke::Box& box : boxes) {
        columns.push_back(started(device, executor, box, in));
        Column& column = *columns.back();
        column.catch_up(executor);
        column.behind_s = std::max(column.behind_s - caught_up_s, 0.0);
        const double risen_s = time_s - column.behind_s;
        Risen risen =
            let_rise(*column.fluid, device, SolverMeter(device, executor, in.settings.measure_solvers),
                     {.box = box,
                      .style = style,
                      .from_s = column.time_s,
                      .gap_s = risen_s - column.time_s,
                      .boxes = static_cast<uint32_t>(boxes.size()),
                      .is_measured = in.settings.measure_solvers});
        column.left = risen.left;
        if (risen.report || !in.settings.measure_solvers) {
            column.solver_report = std::move(risen.report);
        }
        column.time_s = risen_s;
        carry_along(box, style, time_s);
    }
    columns_ = std::move(columns);
    return boxes;
}

gpu::ImageId RisingSmoke::velocity(gpu::Graph& graph, size_t box)
{
    return columns_.at(box)->add(graph).velocity;
}

std::optional<SmokePlan> RisingSmoke::ensure(gpu::Device& device, gpu::Executor& executor,
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
    volume_.ensure(device, globals);
    return plan;
}

smoke::Volume RisingSmoke::record(gpu::Graph& graph, const smoke::SmokeStyle& style, gpu::BufferId frame,
                                  const light::ShadowMaps& maps)
{
    smoke::Fields fields{
        .globals = gpu::import_whole(graph, "smoke", globals_), .densities = {}, .ignition = smoke_ignition};
    for (const auto& column : columns_) {
        fields.densities.push_back(column->add(graph).quantities.value());
    }
    if (style.shaded) {
        fields.shadows = {.frame = frame,
                          .sun_map = maps.sun,
                          .sun_shadow = maps.sun_globals,
                          .local_shadows = maps.local_shadows,
                          .local_maps = maps.local,
                          .variant = maps.variant};
    }
    return smoke::add_volume(graph, volume_, style, fields);
}

smoke::ViewInputs RisingSmoke::view(gpu::Graph& graph, gpu::BufferId frame, gpu::ImageId depth,
                                    glm::uvec2 size_px)
{
    return {.frame = frame,
            .globals = gpu::import_whole(graph, "smoke", globals_),
            .depth = depth,
            .size_px = size_px};
}

} // namespace estampe::features
