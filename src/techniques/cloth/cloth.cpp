// SPDX-License-Identifier: MIT
// Runs of simulation steps of the cloth: their division into small steps, the solids that sheets may meet,
// and their passes.
#include "techniques/cloth/cloth.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"
#include "shaders/cloth_carry_comp.hpp"
#include "shaders/cloth_flow_comp.hpp"
#include "shaders/cloth_near_comp.hpp"
#include "shaders/cloth_push_comp.hpp"
#include "shaders/cloth_rest_comp.hpp"
#include "shaders/cloth_see_comp.hpp"
#include "shaders/cloth_seen_comp.hpp"
#include "shaders/cloth_small_comp.hpp"
#include "shaders/cloth_target_comp.hpp"
#include "shaders/cloth_tear_comp.hpp"
#include "shaders/cloth_vertices_comp.hpp"
#include "shaders/cloth_wide_comp.hpp"

namespace estampe::cloth {
namespace {

// Factor on the number of small steps for sheets that may tear, because sheets that may tear have no tethers
// (limits of the distance to held particles).
constexpr float tear_share = 4.0F;
constexpr float longest_step_s = 1.0F / 30.0F; // upper limit of a step of the simulation

/// Whether wind keeps all sheets awake. A very weak wind does not keep sheets awake, because the wind moves
/// nothing visibly.
bool blows(const Surroundings& now)
{
    return now.air_kg_m3 > 0.0F && now.wind.speed_m_per_s > shared::cloth_breath_m_per_s;
}

/// The kind of a solid, from the word that also stores the index of the solid's grid.
uint32_t kind_of(const shared::ClothCollider& solid)
{
    return solid.kind & ((1U << shared::cloth_kind_bits) - 1);
}

bool is_of_grid(const shared::ClothCollider& solid)
{
    return kind_of(solid) == shared::cloth_heights || kind_of(solid) == shared::cloth_distances;
}

bool is_seen(const shared::ClothCollider& solid)
{
    return kind_of(solid) == shared::cloth_seen;
}

/// Number of small steps per second: per sixtieth of a second, the number of particles along a sheet's side
/// divided by three. With default settings, cloth then stretches by one or two hundredths at most.
float small_steps_per_s(uint32_t particles)
{
    const float side = std::sqrt(static_cast<float>(particles));
    return 60.0F * std::clamp(0.31F * side, 8.0F, 40.0F);
}

glm::vec3 direction_of(const wind::WindStyle& wind)
{
    const float from_x_rad = wind::from_x_deg(wind.towards_deg) * std::numbers::pi_v<float> / 180.0F;
    return {std::cos(from_x_rad), 0.0F, std::sin(from_x_rad)};
}

/// Whether the surroundings changed from `before` to `now` so that resting sheets must move again. The wind
/// is not compared.
bool are_other(const Surroundings& now, const Surroundings& before)
{
    return before.gravity_m_s2 != now.gravity_m_s2 || before.effort != now.effort ||
           before.rest_m_per_s != now.rest_m_per_s;
}

} // namespace

uint32_t Cloths::small_steps(const Kind& kind, const Surroundings& surroundings) const
{
    const Solver& solver = *kind.solver;
    const bool tears = (kind.variant & shared::cloth_bit_tear) != 0;
    const float share = solver.relaxations > 0
                            // A solver by relaxations needs no extra small steps for sheets without tethers.
                            ? static_cast<float>(solver.relaxations)
                            : (tears ? tear_share : 1.0F) / static_cast<float>(std::max(solver.sweeps, 1U));
    const float wanted =
        share * small_steps_per_s(kind.most_particles) * surroundings.effort * surroundings.step_s;
    return static_cast<uint32_t>(std::clamp(std::ceil(wanted - 0.01F), 1.0F, 1000.0F));
}

uint32_t Cloths::most_steps(const Surroundings& surroundings) const
{
    // Largest number of cloth passes per graph; leaves room for the passes of techniques other than cloth.
    constexpr uint32_t most_passes = 240;
    constexpr uint32_t most_at_once = 120;
    uint32_t passes = 0;
    for (const Kind& kind : kinds_) {
        const auto sweeps = static_cast<uint32_t>(kind.solver->sweeps * kind.colours.size());
        const uint32_t searches = (kind.variant & shared::cloth_bit_self) != 0 ? 3 : 0;
        const uint32_t tears = (kind.variant & shared::cloth_bit_tear) != 0 ? 2 : 0;
        passes += kind.is_small ? 0 : 2 + searches + tears + small_steps(kind, surroundings) * (1 + sweeps);
    }
    return passes == 0 ? most_at_once : std::clamp(most_passes / passes, 1U, most_at_once);
}

void Cloths::find_met_solids()
{
    constexpr float spare_m = 0.1F; // margin around a sheet for the thickness of cloth
    met_before_.clear();
    met_.clear();
    for (size_t i = 0; i < solids_.size(); ++i) {
        const glm::vec3& centre_m = solids_[i].centre_m;
        const float reach_m =
            solids_[i].reach_m + glm::distance(solids_before_[i].centre_m, centre_m) + spare_m;
        const bool is_met =
            reach_.empty() || std::ranges::any_of(reach_, [&](const SheetReach& box) {
                return glm::distance(glm::clamp(centre_m, box.min_m, box.max_m), centre_m) <= reach_m;
            });
        if (is_met) {
            met_before_.push_back(solids_before_[i]);
            met_.push_back(solids_[i]);
            if (is_seen(solids_[i])) { // the body may have been larger at the beginning of the run of steps
                met_.back().reach_m = std::max(solids_before_[i].reach_m, solids_[i].reach_m);
            }
        }
    }
}

void Cloths::lower_rigidities(const Surroundings& surroundings)
{
    float longest_small_s = 0.0F;
    for (const Kind& kind : kinds_) {
        const float small_s = std::min(surroundings.step_s, longest_step_s) /
                              static_cast<float>(small_steps(kind, surroundings));
        longest_small_s = std::max(longest_small_s, kind.solver->lowers_rigidity ? small_s : 0.0F);
    }
    for (size_t i = 0; i < records_.size(); ++i) {
        const float most = 1.0F / std::max(bending_rates_s2_[i] * longest_small_s * longest_small_s, 1e-12F);
        const bool is_lowered = solver_of(i).lowers_rigidity;
        records_[i].bending_n_m = is_lowered ? std::min(rigidities_n_m_[i], most) : rigidities_n_m_[i];
    }
}

void Cloths::fill_runs(const Surroundings& surroundings, uint32_t count)
{
    const wind::WindStyle& wind = surroundings.wind;
    find_met_solids();
    const size_t size_bytes = met_.size() * sizeof(shared::ClothCollider);
    const bool moves = (bodies_move_ && std::ranges::any_of(met_, is_seen)) ||
                       (!met_.empty() && std::memcmp(met_before_.data(), met_.data(), size_bytes) != 0);
    const bool rouses = rouses_all_ || (surroundings_ && are_other(surroundings, *surroundings_));
    const uint32_t roused_steps = blows(surroundings) ? count : (rouses ? 1U : 0U);
    lower_rigidities(surroundings);
    for (Kind& kind : kinds_) {
        shared::ClothRun run{
            .gravity_m_s2 = surroundings.gravity_m_s2,
            .step_s = std::min(surroundings.step_s, longest_step_s),
            .step_count = count,
            .small_steps = kind.solver->relaxations > 0 ? 1U : small_steps(kind, surroundings),
            .collider_count = static_cast<uint32_t>(met_.size()),
            .collider_stride = moves ? static_cast<uint32_t>(met_.size()) : 0,
            .wind_m_per_s = wind.speed_m_per_s * direction_of(wind),
            .ahead_m = static_cast<float>(surroundings.ahead_m) * direction_of(wind),
            .gustiness = wind.gustiness,
            .gust_m = wind.gust_m,
            .turbulence = wind.turbulence,
            .eddy_m = wind.eddy_m,
            .time_s = static_cast<float>(surroundings.time_s),
            .air_kg_m3 = surroundings.air_kg_m3,
            .most_speed_m_per_s = 60.0F,
            .origin_m = glm::vec3(surroundings.origin_m),
            .rest_m_per_s = surroundings.rest_m_per_s > 0.0F ? surroundings.rest_m_per_s : -1.0F,
            .roused_steps = roused_steps,
            .bodies_move = bodies_move_ ? 1U : 0U,
            .flow_count = static_cast<uint32_t>(flows_.size()),
            .flows = {},
            .lone_sheet = {}};
        std::ranges::copy(flows_, std::begin(run.flows));
        run.lone_sheet = kind.lone ? records_[*kind.lone] : shared::ClothSheet{};
        std::memcpy(kind.run.mapped().data(), &run, sizeof run);
    }
    std::memcpy(sheets_.mapped().data(), records_.data(), records_.size() * sizeof(shared::ClothSheet));
    std::byte* const solids = colliders_.mapped().data();
    if (size_bytes > 0) {
        std::memcpy(solids, met_before_.data(), size_bytes);
        std::memcpy(solids + size_bytes, met_.data(), size_bytes);
    }
    solids_before_ = solids_;
    surroundings_ = surroundings;
    rouses_all_ = false;
}

Cloths::Handles Cloths::import(gpu::Graph& graph)
{
    return {.places = gpu::import_whole(graph, "cloth/places", places_),
            .places_before = gpu::import_whole(graph, "cloth/snapshot", places_before_),
            .speeds = gpu::import_whole(graph, "cloth/speeds", speeds_),
            .pushes = gpu::import_whole(graph, "cloth/pushes", pushes_),
            .near = gpu::import_whole(graph, "cloth/near", near_),
            .torn = gpu::import_whole(graph, "cloth/torn", torn_),
            .solids = gpu::import_whole(graph, "cloth/colliders", colliders_),
            .predicted = {gpu::import_whole(graph, "cloth/predicted", predicted_[0]),
                          gpu::import_whole(graph, "cloth/predicted", predicted_[1])},
            .targets = {gpu::import_whole(graph, "cloth/targets", targets_[0]),
                        gpu::import_whole(graph, "cloth/targets", targets_[1])},
            .seen = {gpu::import_whole(graph, "cloth/seen", seen_[0]),
                     gpu::import_whole(graph, "cloth/seen", seen_[1])}};
}

void Cloths::bind_common(gpu::Graph& graph, gpu::Pass& pass, const Handles& handles, gpu::Buffer& run,
                         gpu::Buffer& sheet_of_group, bool as_few_sheets)
{
    const gpu::BufferId sheets = gpu::import_whole(graph, "cloth/sheets", sheets_);
    (as_few_sheets ? pass.uniform(sheets) : pass.read(sheets))
        .uniform(gpu::import_whole(graph, "cloth/run", run))
        .sample(gpu::import_whole(graph, "cloth/links", links_))
        .sample(gpu::import_whole(graph, "cloth/faces", faces_), gpu::Format::rg32ui)
        .sample(gpu::import_whole(graph, "cloth/tethers", tethers_), gpu::Format::rg32ui)
        .sample(handles.solids)
        .sample(handles.targets[targets_move_ ? 0 : 1], gpu::Format::rgba32f)
        .sample(handles.targets[1], gpu::Format::rgba32f)
        .read(gpu::import_whole(graph, "cloth/groups", sheet_of_group))
        .sample(gpu::import_whole(graph, "cloth/grids", grids_), gpu::Format::r32f)
        .sample(handles.seen[bodies_move_ ? 0 : 1])
        .sample(handles.seen[1]);
}

void Cloths::add_targets(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices)
{
    const auto add = [&](gpu::BufferId& targets) {
        auto pass = graph.compute("cloth/targets", shaders::cloth_target_comp);
        pass.read(gpu::import_whole(graph, "cloth/holds", holds_)).read(posed_vertices);
        targets = pass.write(targets);
        pass.push(particle_count_).dispatch_items(particle_count_);
    };
    std::swap(targets_[0], targets_[1]);
    targets_move_ = has_targets_;
    has_targets_ = true;
    add(handles.targets[1]);
}

void Cloths::add_flow(gpu::Graph& graph, size_t flow, gpu::ImageId velocity)
{
    const shared::ClothFlow& box = flows_.at(flow);
    auto pass = graph.compute("cloth/flow", shaders::cloth_flow_comp);
    pass.sample(velocity);
    graph.export_buffer(pass.modify(gpu::import_whole(graph, "cloth/flows", flow_speeds_)));
    const glm::uvec3 groups = (box.cells + 3U) / 4U;
    pass.push(box).dispatch(groups.x, groups.y, groups.z);
}

void Cloths::add_carry(gpu::Graph& graph, Handles& handles, std::span<const glm::mat4> carries)
{
    std::memcpy(carries_.mapped().data(), carries.data(), carries.size_bytes());
    std::memcpy(sheets_.mapped().data(), records_.data(), records_.size() * sizeof(shared::ClothSheet));
    auto pass = graph.compute("cloth/carry", shaders::cloth_carry_comp);
    bind_common(graph, pass, handles, kinds_.front().run, sheet_of_group_);
    handles.places = pass.modify(handles.places);
    handles.speeds = pass.modify(handles.speeds);
    pass.read(gpu::import_whole(graph, "cloth/carries", carries_));
    handles.torn = pass.modify(handles.torn);
    pass.push(shared::ClothMoment{.first_group = 0}).dispatch(all_groups_);
}

void Cloths::add_small_sheets(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t count)
{
    const bool is_wide = is_wide_ && records_.size() <= shared::cloth_few_sheets;
    auto pass = graph.compute("cloth/small", is_wide ? shaders::cloth_wide_comp : shaders::cloth_small_comp);
    bind_common(graph, pass, handles, kind.run, sheet_of_group_, is_wide);
    handles.places = pass.modify(handles.places);
    handles.speeds = pass.modify(handles.speeds);
    pass.read(handles.pushes);
    pass.sample(gpu::import_whole(graph, "cloth/flows", flow_speeds_), gpu::Format::rgba32f);
    pass.variant(kind.variant).push(shared::ClothMoment{.first_group = kind.first_group});
    // Estimated time per step of one small sheet; small sheets run in parallel.
    constexpr uint32_t step_us = 20;
    pass.estimated_duration_us(count * step_us).dispatch(kind.group_count);
}

void Cloths::add_rest(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId& awake)
{
    auto pass = graph.compute("cloth/rest", shaders::cloth_rest_comp);
    bind_common(graph, pass, handles, kind.run, sheet_of_group_);
    pass.sample(handles.places, gpu::Format::rgba32f);
    handles.speeds = pass.modify(handles.speeds);
    awake = pass.modify(awake);
    pass.sample(gpu::import_whole(graph, "cloth/flows", flow_speeds_), gpu::Format::rgba32f);
    pass.variant(kind.variant).push(shared::ClothMoment{.step = step, .first_group = kind.first_group});
    pass.dispatch(kind.group_count);
}

void Cloths::add_near(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId awake)
{
    const uint32_t cells = std::bit_ceil(std::max(2 * particle_count_, 64U));
    gpu::BufferId first_in_cell = gpu::add_zeros(graph, "cloth/cells", sizeof(uint32_t) * cells);
    gpu::BufferId next_in_cell =
        graph.buffer("cloth/next in cell", {.size_bytes = sizeof(uint32_t) * particle_count_});
    for (const uint32_t is_search : {0U, 1U}) {
        auto pass = graph.compute(is_search != 0 ? "cloth/near" : "cloth/enter", shaders::cloth_near_comp);
        bind_common(graph, pass, handles, kind.run, sheet_of_group_);
        pass.sample(handles.places, gpu::Format::rgba32f)
            .sample(gpu::import_whole(graph, "cloth/rest", rest_), gpu::Format::rgba32f);
        first_in_cell = pass.modify(first_in_cell);
        next_in_cell = is_search != 0 ? pass.modify(next_in_cell) : pass.write(next_in_cell);
        handles.near = pass.modify(handles.near);
        pass.read(awake);
        pass.variant(kind.variant)
            .push(shared::ClothNearConstants{.first_group = kind.first_group,
                                             .cell_mask = cells - 1,
                                             .is_search = is_search,
                                             .step = step});
        pass.dispatch(kind.group_count);
    }
}

void Cloths::add_tears(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step, gpu::BufferId awake)
{
    for (const uint32_t last : {0U, uint32_t{shared::cloth_bit_last}}) {
        auto pass = graph.compute("cloth/tear", shaders::cloth_tear_comp);
        bind_common(graph, pass, handles, kind.run, sheet_of_group_);
        pass.sample(handles.places, gpu::Format::rgba32f);
        handles.torn = pass.modify(handles.torn);
        pass.read(awake);
        pass.variant(kind.variant | last)
            .push(shared::ClothMoment{.step = step, .first_group = kind.first_group});
        pass.dispatch(kind.group_count);
    }
}

uint64_t Cloths::met_bytes(const Kind& kind) const
{
    const auto words = static_cast<uint32_t>((met_.size() + 31) / 32);
    return sizeof(uint32_t) * kind.group_count *
           (shared::cloth_met_head + std::min(words, uint32_t{shared::cloth_met_words}));
}

void Cloths::add_large_sheets(gpu::Graph& graph, Handles& handles, Kind& kind, uint32_t step,
                              uint32_t small_steps, gpu::BufferId& awake)
{
    if ((kind.variant & shared::cloth_bit_roused) == 0) {
        add_rest(graph, handles, kind, step, awake);
    }
    if ((kind.variant & shared::cloth_bit_self) != 0) {
        add_near(graph, handles, kind, step, awake);
    }
    auto push = graph.compute("cloth/push", shaders::cloth_push_comp);
    bind_common(graph, push, handles, kind.run, sheet_of_group_);
    push.sample(handles.places, gpu::Format::rgba32f).read(handles.speeds);
    handles.pushes = push.modify(handles.pushes);
    handles.predicted[0] = push.modify(handles.predicted[0]);
    push.read(awake);
    const gpu::BufferId began =
        push.write(graph.buffer("cloth/began", {.size_bytes = sizeof(glm::vec4) * particle_count_}));
    push.sample(gpu::import_whole(graph, "cloth/flows", flow_speeds_), gpu::Format::rgba32f);
    const gpu::BufferId met = push.write(graph.buffer("cloth/met", {.size_bytes = met_bytes(kind)}));
    push.sample(handles.torn, gpu::Format::rg32ui);
    push.variant(kind.variant).push(shared::ClothMoment{.step = step, .first_group = kind.first_group});
    push.dispatch(kind.group_count);
    (this->*kind.solver->add_step)(
        graph, handles, kind,
        {.number = step, .small_steps = small_steps, .awake = awake, .began = began, .met = met});
    if ((kind.variant & shared::cloth_bit_tear) != 0) {
        add_tears(graph, handles, kind, step, awake);
    }
}

void Cloths::add_steps(gpu::Graph& graph, Handles& handles, const Surroundings& surroundings, uint32_t count)
{
    if (count == 0 || count > most_steps(surroundings) || !(surroundings.step_s > 0.0F)) {
        throw std::logic_error("a run of cloth has some steps, as many as one graph takes");
    }
    fill_runs(surroundings, count);
    if (!met_.empty()) {
        // Copies the buffers that the CPU writes to device memory. An imported buffer may be in host memory,
        // which is slow for the small steps that read them often.
        handles.solids = gpu::add_copy_of_start(graph, "cloth/solids", handles.solids,
                                                2 * met_.size() * sizeof(shared::ClothCollider));
    }
    const wind::WindStyle& wind = surroundings.wind;
    const uint32_t surrounded =
        (met_.empty() ? 0U : shared::cloth_bit_colliders) |
        (std::ranges::any_of(met_, is_of_grid) ? shared::cloth_bit_grids : 0U) |
        (std::ranges::any_of(met_, is_seen) ? shared::cloth_bit_seen : 0U) |
        (flows_.empty() ? 0U : shared::cloth_bit_flow) | (has_half_held_ ? shared::cloth_bit_half_held : 0U) |
        (wind.speed_m_per_s > 0.0F && (wind.gustiness > 0.0F || wind.turbulence > 0.0F)
             ? shared::cloth_bit_gusts
             : 0U);
    std::optional<gpu::BufferId> awake; // buffer that marks which large sheets are awake
    for (Kind& kind : kinds_) {
        constexpr uint32_t changing = shared::cloth_bit_colliders | shared::cloth_bit_grids |
                                      shared::cloth_bit_seen | shared::cloth_bit_flow |
                                      shared::cloth_bit_gusts | shared::cloth_bit_roused;
        kind.variant = (kind.variant & ~changing) | surrounded;
        if (kind.is_small) {
            add_small_sheets(graph, handles, kind, count);
        } else {
            if (!awake) {
                awake = gpu::add_zeros(graph, "cloth/awake",
                                       std::max<uint64_t>(sizeof(uint32_t) * records_.size(), 16));
            }
            kind.variant |= (blows(surroundings) ? shared::cloth_bit_roused : 0U) |
                            (kind.lone ? shared::cloth_bit_lone : 0U);
            for (uint32_t step = 0; step < count; ++step) {
                add_large_sheets(graph, handles, kind, step, small_steps(kind, surroundings), *awake);
            }
        }
    }
    graph.export_buffer(handles.places);
    graph.export_buffer(handles.speeds);
    if (may_tear_) {
        graph.export_buffer(handles.torn);
    }
    targets_move_ = false;
    bodies_move_ = false;
}

void Cloths::add_snapshot(gpu::Graph& graph, Handles& handles)
{
    handles.places_before = gpu::add_copy_out(graph, "cloth/snapshot", handles.places, places_before_);
}

gpu::BufferId Cloths::add_vertices(gpu::Graph& graph, const Handles& handles, gpu::BufferId posed_vertices)
{
    return add_vertices_at(graph, handles, handles.places, posed_vertices);
}

gpu::BufferId Cloths::add_vertices_before(gpu::Graph& graph, const Handles& handles,
                                          gpu::BufferId posed_vertices)
{
    return add_vertices_at(graph, handles, handles.places_before, posed_vertices);
}

gpu::BufferId Cloths::add_vertices_at(gpu::Graph& graph, const Handles& handles, gpu::BufferId places,
                                      gpu::BufferId posed_vertices)
{
    for (const Kind& kind : vertex_kinds_) {
        auto pass = graph.compute("cloth/vertices", shaders::cloth_vertices_comp);
        bind_common(graph, pass, handles, kinds_.front().run, sheet_of_vertex_group_);
        pass.sample(places, gpu::Format::rgba32f).read(gpu::import_whole(graph, "cloth/vertices", vertices_));
        posed_vertices = pass.modify(posed_vertices);
        pass.sample(handles.torn, gpu::Format::rg32ui);
        pass.variant(kind.variant).push(shared::ClothMoment{.first_group = kind.first_group});
        pass.dispatch(kind.group_count);
    }
    return posed_vertices;
}

void Cloths::set_bodies(gpu::Device& device, std::span<const Body> bodies)
{
    std::vector<glm::uvec4> triangles;
    uint32_t texel_count = 0;
    bodies_.clear();
    for (const Body& body : bodies) {
        bodies_.push_back({.first_triangle = static_cast<uint32_t>(triangles.size()),
                           .triangle_count = static_cast<uint32_t>(body.triangles.size()),
                           .nodes = body.nodes,
                           .first = texel_count});
        for (const glm::uvec3& triangle : body.triangles) {
            triangles.emplace_back(triangle, 0U);
        }
        texel_count += shared::cloth_seen_head + body.nodes.x * body.nodes.y;
    }
    triangles.resize(std::max<size_t>(triangles.size(), 1));
    body_triangles_ = gpu::upload_buffer(device, "cloth body triangles", triangles);
    for (gpu::Buffer& seen : seen_) {
        seen = gpu::upload_buffer(device, "cloth seen", std::vector<glm::vec4>(std::max(texel_count, 1U)));
    }
    has_seen_ = false;
    bodies_move_ = false;
}

void Cloths::add_bodies(gpu::Graph& graph, Handles& handles, gpu::BufferId posed_vertices)
{
    std::swap(seen_[0], seen_[1]);
    bodies_move_ = has_seen_;
    has_seen_ = true;
    const gpu::BufferId triangles = gpu::import_whole(graph, "cloth/body triangles", body_triangles_);
    for (shared::ClothBody body : bodies_) {
        const auto solid = std::ranges::find_if(solids_, [&](const shared::ClothCollider& other) {
            return other.kind == (shared::cloth_seen | body.first << shared::cloth_kind_bits);
        });
        if (solid == solids_.end()) {
            continue;
        }
        body.rotation = solid->rotation;
        body.centre_m = solid->centre_m;
        body.half_m = solid->half_m;
        const uint32_t node_count = body.nodes.x * body.nodes.y;
        gpu::BufferId ends = gpu::add_zeros(graph, "cloth/ends", 2 * sizeof(uint32_t) * node_count);
        auto see = graph.compute("cloth/see", shaders::cloth_see_comp);
        see.sample(triangles).read(posed_vertices);
        ends = see.modify(ends);
        see.push(body).dispatch_items(body.triangle_count);
        auto keep = graph.compute("cloth/seen", shaders::cloth_seen_comp);
        keep.read(ends);
        handles.seen[1] = keep.modify(handles.seen[1]);
        keep.push(body).dispatch_items(node_count);
    }
    graph.export_buffer(handles.seen[1]);
}

} // namespace estampe::cloth
