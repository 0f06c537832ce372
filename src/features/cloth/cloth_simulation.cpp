// SPDX-License-Identifier: MIT
#include "features/cloth/cloth_simulation.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include <estampe/error.hpp>

#include "gpu/resources.hpp"
#include "gpu/transfers.hpp"

namespace estampe::features {

void ClothSimulation::invalidate(Event event)
{
    if (event == Event::scene_replaced) {
        sheets_.reset();
        steps_left_.reset();
    }
    if (event == Event::film_recalled && sheets_) {
        sheets_->forget();
    }
}

void ClothSimulation::save(FilmWriter& writer)
{
    if (sheets_ && sheets_->time_s()) {
        writer.value(*sheets_->time_s());
        writer.buffers(sheets_->sheets().state());
    }
}

void ClothSimulation::load(FilmReader& reader)
{
    if (!sheets_) {
        throw Error("the memory of a film's frame has cloth, and the scene has none", "",
                    "draw the film's frames from one scene");
    }
    const auto time_s = reader.value<double>();
    std::vector<gpu::Buffer> state;
    for (const gpu::Buffer* const buffer : sheets_->sheets().state()) {
        state.push_back(reader.buffer("cloth state", buffer->size_bytes()));
    }
    sheets_->recall(time_s, std::move(state));
}

void ClothSimulation::cut(gpu::Device& device, const Scene& scene, const pose::MeshData& layout)
{
    const std::unique_ptr<MovingCloth> before = std::move(sheets_);
    const std::optional<glm::dvec3> anchor_before = std::exchange(cut_about_, layout.anchor);
    if (MovingCloth::is_in(scene)) {
        sheets_ = std::make_unique<MovingCloth>(device, scene, layout);
    }
    if (sheets_ && before && anchor_before == layout.anchor) {
        sheets_->go_on_from(*before);
    }
}

std::span<const uint32_t> ClothSimulation::draws() const
{
    return sheets_ ? sheets_->draws() : std::span<const uint32_t>();
}

ClothAdvance ClothSimulation::advance(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in)
{
    steps_left_.reset();
    if (!sheets_) {
        return {};
    }
    const auto run = sheets_->plan(in.settings, in.style, in.before_s);
    if (!run) {
        return {};
    }
    const auto steps_between = [&](double from_s, double to_s) {
        return sheets_->steps_between(from_s, to_s, in.scene, in.style, in.settings, in.layout.anchor);
    };
    const bool starts = run->starts_anew || run->is_taken_up;
    if (starts) {
        start(device, executor, in, *run);
    }
    std::vector<ClothSteps> all = steps_between(run->from_s, run->snapshot_s.value_or(run->from_s));
    std::vector<ClothSteps> rest = steps_between(run->snapshot_s.value_or(run->from_s), run->to_s);
    const bool ends_in_snapshot = run->snapshot_s && rest.empty();
    if (!rest.empty()) {
        rest.front().takes_snapshot = run->snapshot_s.has_value();
        std::ranges::copy(rest, std::back_inserter(all));
    }
    const bool is_last_put_off =
        !all.empty() && !ends_in_snapshot && in.settings.time_s >= 0.0 && !sheets_->sheets().may_tear();
    if (is_last_put_off) {
        steps_left_ = all.back();
        all.pop_back();
    }
    for (const ClothSteps& steps : all) {
        step(device, executor, in, steps);
    }
    if (ends_in_snapshot) {
        gpu::Graph graph;
        cloth::Cloths& sheets = sheets_->sheets();
        cloth::Cloths::Handles handles = sheets.import(graph);
        sheets.add_snapshot(graph, handles);
        executor.run(graph);
    }
    const bool tore = tear(device, executor, in);
    sheets_->done(in.settings, in.style, steps_left_ ? steps_left_->from_s : run->to_s);
    return {.posed_scene = starts || !all.empty(), .tore = tore};
}

bool ClothSimulation::tear(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in)
{
    if (!sheets_->sheets().may_tear()) {
        return false;
    }
    cloth::Cloths& sheets = sheets_->sheets();
    gpu::Buffer copy(device, "cloth torn", sheets.torn().size_bytes(), gpu::MemoryUse::readback);
    gpu::Graph graph;
    gpu::add_read_back(graph, "cloth/read torn", sheets.import(graph).torn, copy);
    executor.run(graph);
    const bool is_otherwise = sheets_->tear_triangles(in.layout, gpu::items_of<glm::uvec2>(copy));
    if (is_otherwise) {
        in.meshes.triangles = gpu::upload_buffer(device, "triangles", in.layout.triangles);
    }
    return is_otherwise;
}

std::vector<Bounds> ClothSimulation::place(gpu::Device& device, const ClothInputs& in, const ScenePose& pose)
{
    if (steps_left_) {
        place_solids(device, in, pose, in.settings.time_s);
    }
    return sheets_->sweep(*in.posed);
}

void ClothSimulation::record(gpu::Graph& graph, const pose::PoseData& pose, const glm::dvec3& anchor,
                             gpu::BufferId& posed_vertices, gpu::BufferId& vertices_before)
{
    if (!sheets_) {
        return;
    }
    cloth::Cloths& sheets = sheets_->sheets();
    cloth::Cloths::Handles handles = sheets.import(graph);
    if (steps_left_) {
        sheets_->add_steps(graph, handles, *steps_left_, pose, anchor, posed_vertices);
    }
    posed_vertices = sheets.add_vertices(graph, handles, posed_vertices);
    vertices_before = sheets.add_vertices_before(graph, handles, vertices_before);
    if (steps_left_) {
        sheets_->forget();
    }
}

void ClothSimulation::drawn()
{
    if (!sheets_) {
        return;
    }
    sheets_->has_moved = false;
    if (steps_left_) {
        sheets_->stands_at(steps_left_->to_s);
        steps_left_.reset();
    }
}

void ClothSimulation::place_solids(gpu::Device& device, const ClothInputs& in, const ScenePose& pose,
                                   double time_s)
{
    sheets_->place_solids(device, in.scene, {.nodes = pose, .draws = *in.posed, .time_s = time_s}, in.layout,
                          in.style.cloth.bodies);
}

gpu::BufferId ClothSimulation::pose_for(gpu::Device& device, gpu::Graph& graph, const ClothInputs& in,
                                        double time_s)
{
    const ScenePose pose = in.pose_at(std::max(time_s, 0.0));
    place_solids(device, in, pose, time_s);
    return in.add_posed(graph);
}

void ClothSimulation::start(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in,
                            const ClothRun& run)
{
    cloth::Cloths& sheets = sheets_->sheets();
    gpu::Graph graph;
    const gpu::BufferId posed = pose_for(device, graph, in, run.from_s);
    sheets_->forget_before();
    cloth::Cloths::Handles handles = sheets.import(graph);
    sheets.add_targets(graph, handles, posed);
    sheets_->add_bodies(graph, handles, *in.posed, posed);
    if (run.starts_anew) {
        const std::vector<glm::mat4> anew(sheets.sheet_count(), glm::mat4(0.0F));
        sheets.add_carry(graph, handles, anew);
    }
    sheets.add_snapshot(graph, handles);
    std::ignore = sheets_->carries(*in.posed, in.layout.anchor, 0.0);
    executor.run(graph);
    pose::keep_posed(in.meshes);
}

void ClothSimulation::step(gpu::Device& device, gpu::Executor& executor, const ClothInputs& in,
                           const ClothSteps& steps)
{
    gpu::Graph graph;
    const gpu::BufferId posed = pose_for(device, graph, in, steps.to_s);
    cloth::Cloths::Handles handles = sheets_->sheets().import(graph);
    sheets_->add_steps(graph, handles, steps, *in.posed, in.layout.anchor, posed);
    executor.run(graph);
    pose::keep_posed(in.meshes);
}

} // namespace estampe::features
