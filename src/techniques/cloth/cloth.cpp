// SPDX-License-Identifier: MIT
#include "techniques/cloth/cloth.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "gpu/fills.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "shaders/cloth_carry_comp.hpp"
#include "shaders/cloth_descend_comp.hpp"
#include "shaders/cloth_flow_comp.hpp"
#include "shaders/cloth_near_comp.hpp"
#include "shaders/cloth_push_comp.hpp"
#include "shaders/cloth_rest_comp.hpp"
#include "shaders/cloth_small_comp.hpp"
#include "shaders/cloth_step_comp.hpp"
#include "shaders/cloth_target_comp.hpp"
#include "shaders/cloth_tear_comp.hpp"
#include "shaders/cloth_vertices_comp.hpp"
#include "shaders/cloth_wide_comp.hpp"
#include "techniques/cloth/runs.hpp"

namespace estampe::cloth {

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
    constexpr uint32_t step_us = 20; // of each group, however many there are
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

void Cloths::add_descent(gpu::Graph& graph, Handles& handles, Kind& kind, const shared::ClothMoment& moment,
                         uint32_t predicted, gpu::BufferId awake)
{
    for (uint32_t sweep = 0; sweep < sweeps_of_descent; ++sweep) {
        for (const glm::uvec2& colour : kind.colours) {
            auto pass = graph.compute("cloth/descend", shaders::cloth_descend_comp);
            bind_common(graph, pass, handles, kind.run, sheet_of_group_);
            pass.read(handles.places).read(handles.speeds).read(handles.pushes);
            handles.predicted.at(predicted) = pass.modify(handles.predicted.at(predicted));
            pass.sample(gpu::import_whole(graph, "cloth/by colour", by_colour_), gpu::Format::r32ui)
                .read(awake)
                .sample(handles.torn, gpu::Format::rg32ui);
            shared::ClothMoment own = moment;
            own.first_group = colour.x;
            pass.variant(kind.variant).push(own).dispatch(colour.y);
        }
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
    for (uint32_t i = 0; i < small_steps; ++i) {
        add_descent(graph, handles, kind, {.step = step, .small_step = i}, i % 2, awake);
        auto pass = graph.compute("cloth/step", shaders::cloth_step_comp);
        bind_common(graph, pass, handles, kind.run, sheet_of_group_);
        handles.places = pass.modify(handles.places);
        handles.speeds = pass.modify(handles.speeds);
        pass.read(handles.pushes).sample(handles.predicted[i % 2], gpu::Format::rgba32f);
        handles.predicted[1 - i % 2] = pass.modify(handles.predicted[1 - i % 2]);
        pass.sample(handles.near).read(awake).read(began).read(met);
        pass.sample(handles.torn, gpu::Format::rg32ui);
        const bool is_last = i + 1 == small_steps;
        pass.variant(kind.variant | (is_last ? shared::cloth_bit_last : 0U))
            .push(shared::ClothMoment{.step = step, .small_step = i, .first_group = kind.first_group});
        pass.dispatch(kind.group_count);
    }
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
        // What the processor writes may lie in its own memory, far from small steps that ask it over and
        // over.
        handles.solids = gpu::add_copy_of_start(graph, "cloth/solids", handles.solids,
                                                2 * met_.size() * sizeof(shared::ClothCollider));
    }
    const WindStyle& wind = surroundings.wind;
    const uint32_t surrounded =
        (met_.empty() ? 0U : shared::cloth_bit_colliders) |
        (std::ranges::any_of(met_, is_of_grid) ? shared::cloth_bit_grids : 0U) |
        (std::ranges::any_of(met_, is_seen) ? shared::cloth_bit_seen : 0U) |
        (flows_.empty() ? 0U : shared::cloth_bit_flow) | (has_half_held_ ? shared::cloth_bit_half_held : 0U) |
        (wind.speed_m_s > 0.0F && (wind.gustiness > 0.0F || wind.turbulence > 0.0F) ? shared::cloth_bit_gusts
                                                                                    : 0U);
    std::optional<gpu::BufferId> awake; // of large sheets
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

} // namespace estampe::cloth
