// SPDX-License-Identifier: MIT
#include "features/ink/flowing_ink.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "features/common/solver_meter.hpp"
#include "features/common/style_tables.hpp"
#include "features/ink/ink_zones.hpp"
#include "style/names.hpp"
#include "style/parameter.hpp"
#include "style/toml.hpp"
#include "techniques/fluid/fluid.hpp"
#include "techniques/ink/flow/flow.hpp"

namespace estampe::features {

std::vector<uint32_t> ink_mask(const pose::MeshData& meshes, const Scene& scene, std::string_view patterns,
                               std::vector<std::string>& notes)
{
    const std::vector<std::string> parts = style::between_commas(patterns);
    if (std::ranges::find(parts, "*") != parts.end()) {
        return {};
    }
    for (const std::string& pattern : parts) {
        const auto is_meant = [&](const Node& node) { return style::matches(pattern, node.name); };
        if (std::ranges::none_of(scene.nodes, is_meant)) {
            notes.push_back(fmt::format("ink.objects speaks of objects {}, of which the scene has none",
                                        style::in_quotes(pattern)));
        }
    }
    std::vector<uint32_t> mask(std::max<size_t>(meshes.draws.size(), 1), 0);
    for (size_t draw = 0; draw < meshes.sources.size(); ++draw) {
        mask[draw] = std::ranges::any_of(parts, [&](const std::string& pattern) {
            return is_named(scene, meshes.sources[draw].node, pattern);
        });
    }
    return mask;
}

namespace {

constexpr double steps_per_s = 24.0; ///< Smallest number of simulation steps per second
/// Time in which the water is accelerated from rest when its simulation starts.
constexpr double spin_up_s = 3.0;
constexpr float metres_per_mm = 1e-3F;

/// Returns a grid that covers exactly the page, with walls, and with 64 cells along the longer side. y points
/// down.
fluid::Grid grid_of(glm::vec2 page_mm)
{
    constexpr float most = 64.0F;
    constexpr float fewest = 8.0F;
    const float cell_mm = std::max(page_mm.x, page_mm.y) / most;
    const glm::uvec2 cells(glm::clamp(glm::round(page_mm / cell_mm), fewest, most));
    constexpr fluid::Edge wall = fluid::Edge::free_slip;
    return {.cells = {cells, 1}, .cell_m = metres_per_mm * cell_mm, .edges = {wall, wall, wall}};
}

/// The places where a force moves the ink's water: the style's ink zones, and discs on a lattice with a
/// spacing of half a swirl.
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
        // Factor on the force with which the water reaches about the speed of the swirls.
        constexpr float stronger = 2.0F;
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
            const glm::vec2 swirl_mm_per_s(slope({0.0F, 0.5F}), -slope({0.5F, 0.0F}));
            sources.push_back(spoon(place_mm, radius_mm_, stronger * swirl_mm_per_s));
        }
        for (const shared::InkZone& zone : zones_) {
            sources.push_back(spoon(zone.middle_mm, 0.5F * zone.radius_mm, zone.velocity_mm_per_s));
            sources.back().shape.spin_rad_s = zone.turn_rad_s;
        }
        return sources;
    }

private:
    static fluid::Source spoon(glm::vec2 place_mm, float radius_mm, glm::vec2 velocity_mm_per_s)
    {
        constexpr float push_per_s = 6.0F;
        fluid::Source source{
            .shape = fluid::disc(metres_per_mm * glm::vec3(place_mm, 0.0F), metres_per_mm * radius_mm),
            .push_per_s = push_per_s};
        source.shape.velocity_m_per_s = metres_per_mm * glm::vec3(velocity_mm_per_s, 0.0F);
        return source;
    }

    ink::Waves waves_;
    glm::vec2 page_mm_;
    const std::vector<shared::InkZone>& zones_;
    glm::uvec2 counts_{1};
    float radius_mm_ = 1.0F;
};

/// The stream function of the water's flow at the corners of cells, in mm²/s; 0 along the walls. The
/// difference of the stream function's values at the two ends of a cell's face is the flow through the face,
/// to the right.
class Corners {
public:
    Corners(const fluid::Grid& grid, const std::vector<float>& velocity)
        : counts_(grid.cells + 1U), psi_(size_t{counts_.x} * counts_.y)
    {
        const double mm_2 = flow_per_speed(grid);
        for (uint32_t x = 1; x < grid.cells.x; ++x) {
            double psi = 0.0;
            for (uint32_t y = 0; y < grid.cells.y; ++y) {
                psi += mm_2 * static_cast<double>(velocity[size_t{y} * grid.cells.x + x]);
                psi_[size_t{y + 1} * counts_.x + x] = static_cast<float>(psi);
            }
        }
    }

    /// Changes the stream function to the one whose flow through all faces is nearest to that of `velocity`,
    /// in the sense of least squares, and 0 along the walls. Needed if the velocity has divergence: a sum
    /// over the faces of a column then ends at the lower wall with a number other than 0. Cost: some 100
    /// operations per cell.
    void fit(const fluid::Grid& grid, const std::vector<float>& velocity)
    {
        constexpr int sweeps = 100;
        constexpr float over_relaxation = 1.9F;
        const auto mm_2 = static_cast<float>(flow_per_speed(grid));
        const glm::uvec3 cells = grid.cells;
        const auto across = [&](uint32_t x, uint32_t y) { return velocity[size_t{y} * cells.x + x]; };
        const auto down = [&](uint32_t x, uint32_t y) {
            return velocity[(size_t{cells.y} + y) * cells.x + x];
        };
        for (uint32_t x = 0; x < counts_.x; ++x) {
            psi_[size_t{cells.y} * counts_.x + x] = 0.0F;
        }
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            for (uint32_t y = 1; y < cells.y; ++y) {
                for (uint32_t x = 1; x < cells.x; ++x) {
                    float& psi = psi_[size_t{y} * counts_.x + x];
                    const float* const here = &psi;
                    const float turn = across(x, y - 1) - across(x, y) + down(x, y) - down(x - 1, y);
                    const float mean = 0.25F * (*(here - 1) + *(here + 1) + *(here - counts_.x) +
                                                *(here + counts_.x) + mm_2 * turn);
                    psi += over_relaxation * (mean - psi);
                }
            }
        }
    }

    /// Interpolates the stream function at `place`, from 0 to 1 across the page.
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
    /// The flow in mm²/s through a face at which water moves at 1 m/s.
    static double flow_per_speed(const fluid::Grid& grid)
    {
        const auto cell_mm = static_cast<double>(grid.cell_m / metres_per_mm);
        return cell_mm / static_cast<double>(metres_per_mm);
    }

    glm::uvec3 counts_;
    std::vector<float> psi_;
};

std::vector<float> velocity_of(gpu::Device& device, gpu::Executor& executor, fluid::Fluid& fluid)
{
    gpu::Graph graph;
    const gpu::ImageId velocity = fluid.add_steps(graph, {}, 0).velocity;
    return fluid::run_and_read(device, executor, graph, velocity);
}

fluid::Solver solver_of(const ink::InkStyle& style)
{
    switch (style.solver) {
    case ink::Solver::multigrid:
        return fluid::Solver::multigrid;
    case ink::Solver::jacobi:
        return fluid::Solver::jacobi;
    case ink::Solver::mass:
        return fluid::Solver::mass;
    case ink::Solver::automatic:
        break;
    }
    return fluid::Solver::automatic;
}

/// Simulates the ink's water from one time to another. Returns the report of the pressure solver; none if no
/// step was needed.
std::optional<SolverReport> pass(fluid::Fluid& fluid, gpu::Device& device, SolverMeter meter,
                                 const ink::InkStyle& ink, const Spoons& spoons, double from_s, double to_s)
{
    const auto count = static_cast<uint32_t>(std::ceil((to_s - from_s) * steps_per_s - 1e-6));
    const double step_s = count > 0 ? (to_s - from_s) / count : 0.0;
    const fluid::FluidStyle style{
        .step_s = static_cast<float>(step_s),
        .stepping = fluid::Stepping::project,
        // MacCormack advection distributes the water's motion over the page. With cubic interpolation, the
        // motion would stay in narrow jets.
        .velocity_advection = fluid::Advection::maccormack,
        .projection = {.solver = solver_of(ink), .jacobi_rounds = ink.jacobi_passes},
        .forces = {.friction_per_s = 0.1F}};
    fluid.ensure_mass(device, style);
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
    return KeptWater{.time_s = time_s_,
                     .velocity = velocity_of(device, executor, *fluid_),
                     .mass = fluid::run_and_read_mass(device, executor, *fluid_)};
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
        if (!recalled_->mass.empty()) {
            fluid_->set_mass(device, recalled_->mass);
        }
        time_s_ = recalled_->time_s;
    }
    recalled_.reset();
    if (time.is_fresh || !fluid_ || fluid_->grid() != grid || std::abs(time_s_ - time.from_s) > 1e-6) {
        fluid_ = std::make_unique<fluid::Fluid>(device, grid);
        time_s_ = time.from_s - spin_up_s;
    }
    auto found = pass(*fluid_, device, SolverMeter(device, executor, is_measured), style,
                      Spoons(style, page.size_mm(), zones), time_s_, time.to_s);
    if (found || !is_measured) {
        solver_report_ = std::move(found);
    }
    time_s_ = time.to_s;
    const std::vector<float> velocity = velocity_of(device, executor, *fluid_);
    Corners corners(grid, velocity);
    if (style.solver == ink::Solver::mass) {
        corners.fit(grid, velocity);
    }
    std::vector<float> stream;
    constexpr uint32_t side = shared::ink_map_side;
    for (uint32_t i = 0; i < side * side; ++i) {
        stream.push_back(style.solved *
                         corners.at(glm::vec2(i % side, i / side) / static_cast<float>(side - 1)));
    }
    return stream;
}

namespace {

shared::FrameGlobals page_seen_by(const FlowingInkInputs& in, const Camera& camera)
{
    return frame_globals(
        camera, in.layout.bounds, in.layout.anchor,
        {.size_px = {in.settings.width, in.settings.height}, .page_height_mm = in.style.paper.height_mm});
}

ink::Page page_of(const FlowingInkInputs& in)
{
    const glm::uvec2 size_px(in.settings.width, in.settings.height);
    const float px_per_mm = pixels_per_mm(size_px.y, in.style.paper.height_mm);
    const paper::Window window = paper::window_of(in.style.paper, static_cast<float>(size_px.x) / px_per_mm);
    const PixelSize pixel = pixel_size(in.camera, size_px.y);
    return {.size_px = size_px,
            .pixels_per_mm = px_per_mm,
            .window_min_mm = window.min_mm,
            .window_max_mm = window.max_mm,
            .rad_per_mm = pixel.is_parallel ? 0.0F : pixel.at_one_m * px_per_mm};
}

ink::View view_of(const FlowingInkInputs& in, const MotionPlan& moved)
{
    const glm::mat4& now = moved.clip_from_anchor;
    const glm::mat4& before = moved.clip_from_anchor_before;
    const glm::dvec3 forward = glm::normalize(in.camera.target - in.camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, in.camera.up));
    const auto near_m = static_cast<float>(in.camera.near_m);
    return {.before_from_clip = glm::mat4(glm::dmat4(before) * glm::inverse(glm::dmat4(now))),
            .is_moved = before != now,
            .has_motion = moved.pose_moved,
            .plane_depth = std::min(near_m / std::max(in.nearby_m, near_m), 1.0F),
            .forward = glm::vec3(forward),
            .up = glm::vec3(glm::cross(right, forward))};
}

void save_camera(FilmWriter& writer, const Camera& camera)
{
    writer.value(camera.eye);
    writer.value(camera.target);
    writer.value(camera.up);
    writer.value(camera.vertical_fov_rad);
    writer.value(camera.near_m);
    writer.value(camera.shift);
    // The value -1 is written for a perspective camera.
    writer.value(camera.orthographic_half_height_m.value_or(-1.0));
}

Camera load_camera(FilmReader& reader)
{
    Camera camera{.eye = reader.value<glm::dvec3>(),
                  .target = reader.value<glm::dvec3>(),
                  .up = reader.value<glm::dvec3>()};
    camera.vertical_fov_rad = reader.value<double>();
    camera.near_m = reader.value<double>();
    camera.shift = reader.value<glm::dvec2>();
    const auto half_height_m = reader.value<double>();
    if (half_height_m >= 0.0) {
        camera.orthographic_half_height_m = half_height_m;
    }
    return camera;
}

} // namespace

void FlowingInk::invalidate(Event event)
{
    if (event == Event::scene_replaced || event == Event::anchor_moved || event == Event::film_recalled) {
        forget();
    }
}

void FlowingInk::forget()
{
    memory_.forget();
    water_.forget();
}

void FlowingInk::save(FilmWriter& writer)
{
    const std::optional<ink::Memory::Kept> kept = memory_.kept();
    const std::optional<KeptWater> water = water_.kept(writer.device(), writer.executor());
    if (!kept && !water) {
        return;
    }
    writer.flag(kept.has_value());
    if (kept) {
        writer.value(kept->grid.size);
        writer.value(kept->grid.margin_cells);
        writer.value(kept->grid.cells_per_px);
        writer.value(kept->grid.mm_per_cell);
        writer.value(kept->grid.face_side);
        writer.value(kept->time_s);
        writer.value(kept->sum_now);
        save_camera(writer, camera_before_);
        writer.buffers(memory_.kept_buffers());
    }
    writer.flag(water.has_value());
    if (water) {
        writer.value(water->time_s);
        writer.value(uint64_t{water->velocity.size()});
        writer.floats(water->velocity);
        writer.value(uint64_t{water->mass.size()});
        writer.floats(water->mass);
    }
}

void FlowingInk::load(FilmReader& reader)
{
    forget();
    if (reader.flag()) {
        ink::Memory::Kept kept;
        kept.grid.size = reader.value<glm::uvec2>();
        kept.grid.margin_cells = reader.value<glm::vec2>();
        kept.grid.cells_per_px = reader.value<float>();
        kept.grid.mm_per_cell = reader.value<float>();
        kept.grid.face_side = reader.value<uint32_t>();
        kept.time_s = reader.value<double>();
        kept.sum_now = reader.value<uint32_t>() & 1U;
        camera_before_ = load_camera(reader);
        const std::array<uint64_t, 3> bytes = ink::Memory::kept_bytes(kept.grid);
        std::array<gpu::Buffer, 3> buffers;
        for (size_t i = 0; i < bytes.size(); ++i) {
            buffers.at(i) = reader.buffer("ink", bytes.at(i));
        }
        memory_.recall(reader.device(), kept, std::move(buffers));
    }
    if (reader.flag()) {
        const auto time_s = reader.value<double>();
        KeptWater kept{.time_s = time_s, .velocity = reader.floats(reader.value<uint64_t>())};
        kept.mass = reader.floats(reader.value<uint64_t>());
        if (!kept.mass.empty() && 2 * kept.mass.size() != kept.velocity.size()) {
            fail_damaged();
        }
        water_.recall(std::move(kept));
    }
}

std::optional<double> FlowingInk::before_s(const RenderSettings& settings, const ink::InkStyle& style) const
{
    const bool goes_on = style.enabled && settings.continuity == Continuity::follows;
    return goes_on ? memory_.time_s() : std::nullopt;
}

namespace {

/// Returns `ink` with the scene's wind as `camera` sees it on the page. A wind of 4 m/s across the view moves
/// ink at the default speed of ink.wind_mm_per_s.
ink::InkStyle blown_by(ink::InkStyle ink, const wind::WindStyle& wind, const Camera& camera)
{
    constexpr double mm_per_m = 4.5;
    const double bearing_rad = glm::radians(static_cast<double>(wind.towards_deg));
    const glm::dvec3 way(std::sin(bearing_rad), 0.0, std::cos(bearing_rad));
    const glm::dvec3 ahead = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const glm::dvec2 on_page(glm::dot(way, right), glm::dot(way, glm::cross(right, ahead)));
    ink.wind_mm_per_s =
        static_cast<float>(mm_per_m * static_cast<double>(wind.speed_m_per_s) * glm::length(on_page));
    ink.wind_deg = static_cast<float>(glm::degrees(std::atan2(on_page.y, on_page.x)));
    return ink;
}

/// Returns a blast as the page shows it; none if its centre is behind the eye.
std::optional<ink::PageBlast> page_blast(const Blast& blast, const FlowingInkInputs& in,
                                         const shared::FrameGlobals& page)
{
    const auto middle_mm = page_place_mm(page, in.layout.anchor, blast.centre);
    if (!middle_mm) {
        return std::nullopt;
    }
    const double away_m =
        glm::dot(blast.centre - in.camera.eye, glm::normalize(in.camera.target - in.camera.eye));
    const double mm_per_m = 1.0 / (pixel_size(in.camera, in.settings.height).at(away_m) *
                                   static_cast<double>(page.pixels_per_mm));
    return ink::PageBlast{
        .middle_mm = glm::vec2(*middle_mm), .cubed_radius_mm3 = [blast, mm_per_m](double time_s) {
            return static_cast<float>(std::pow(mm_per_m, 3.0) * blast.cubed_radius_m3(time_s));
        }};
}

} // namespace

std::optional<InkPlan> FlowingInk::ensure(gpu::Device& device, gpu::Executor& executor,
                                          const FlowingInkInputs& in, std::vector<std::string>& notes)
{
    if (!in.style.ink.enabled) {
        forget();
        return std::nullopt;
    }
    std::optional<ink::InkStyle> blown;
    if (in.style.ink.wind_mm_per_s < 0.0F) {
        blown = blown_by(in.style.ink, in.style.wind, in.camera);
    }
    const ink::InkStyle& style = blown ? *blown : in.style.ink;
    const ink::Page page = page_of(in);
    const bool is_there = memory_.holds(ink::grid_of(style, page));
    const std::optional<double> before = is_there ? before_s(in.settings, style) : std::nullopt;
    const ink::Time time = ink::time_of(style, in.settings.time_s, before);
    const shared::FrameGlobals seen = page_seen_by(in, in.camera);
    InkZones found =
        ink_zones({.scene = in.scene, .pose = in.pose, .anchor = in.layout.anchor, .page = seen}, in.style);
    const std::vector<shared::InkZone>& zones = found.zones;
    const Camera& before_camera = time.is_fresh ? in.camera : camera_before_;
    const MotionPlan moved{.clip_from_anchor = seen.clip_from_anchor,
                           .clip_from_anchor_before = page_seen_by(in, before_camera).clip_from_anchor,
                           .pose_moved = in.pose_moved};
    InkPlan plan{.ink = ink::plan_of(style, page, time, view_of(in, moved), zones), .motion = {}};
    plan.ink.zone_shapes = std::move(found.shapes);
    plan.ink.variant |= device.execution().looks_only_where_needed() ? uint32_t{shared::ink_in_strips} : 0U;
    if (style.solved > 0.0F && plan.ink.grid.face_side == 0) {
        ink::add_stream(plan.ink, water_.stirred(device, executor, style, page, time, zones,
                                                 in.settings.measure_solvers));
    } else {
        water_.forget();
    }
    for (const Blast& blast : in.blasts) {
        if (const auto on_page = page_blast(blast, in, seen)) {
            ink::add_blast(plan.ink, *on_page);
        }
    }
    if ((plan.ink.first_variant & shared::ink_has_motion) != 0) {
        plan.motion = moved;
    }
    plan.ink.mask = ink_mask(in.layout, in.scene, style.objects, notes);
    memory_.ensure(device, style, plan.ink);
    memory_.forget(); // Until drawn() is called, the state of the ink cannot be saved
    return plan;
}

InkPlan FlowingInk::shown_on(gpu::Device& device, const InkPlan& drawn, const FlowingInkInputs& in)
{
    InkPlan shown{.ink = ink::shown_on(drawn.ink, page_of(in)), .motion = {}};
    memory_.show(device, shown.ink);
    return shown;
}

gpu::ImageId FlowingInk::record(gpu::Graph& graph, const InkPlan& plan, const ink::Inputs& in, bool is_first,
                                glm::uvec2 size_px)
{
    const ink::Flowing flowing =
        is_first ? ink::add_steps(graph, memory_, plan.ink, in) : ink::add_standing(graph, memory_, plan.ink);
    return ink::add_layer(graph, flowing, in.frame, size_px);
}

void FlowingInk::drawn(const InkPlan& plan, const Camera& camera)
{
    memory_.end_picture(plan.ink);
    camera_before_ = camera;
}

} // namespace estampe::features
