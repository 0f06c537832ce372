// SPDX-License-Identifier: MIT
// What the renderer does for cloth: steps between pictures.
#include <algorithm>
#include <iterator>
#include <tuple>

#include "frame/renderer_impl.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "gpu/upload.hpp"

namespace estampe {

std::optional<std::vector<smoke::Box>> Renderer::Impl::blow_cloth(const ScenePose& pose,
                                                                  const features::StyleTables& style,
                                                                  const RenderSettings& settings)
{
    if (!loaded->cloth) {
        return std::nullopt;
    }
    cloth::Cloths& sheets = loaded->cloth->sheets();
    if (style.wind.from != cloth::WindSource::smoke) {
        sheets.set_flows(device, {});
        return std::nullopt;
    }
    const std::vector<smoke::Lamp> none;
    auto boxes = rising_smoke.rise(device, executor,
                                   {.scene = loaded->scene,
                                    .layout = loaded->layout,
                                    .pose = pose,
                                    .settings = settings,
                                    .style = style,
                                    .lamps = none},
                                   notes);
    if (boxes.empty()) {
        notes.emplace_back("wind.from is smoke, of which there is none");
    }
    std::vector<cloth::Flow> flows;
    flows.reserve(boxes.size());
    for (const smoke::Box& box : boxes) {
        flows.push_back({.cells = box.cells, .cells_from_place = box.grid_from_anchor});
    }
    sheets.set_flows(device, flows);
    for (size_t i = 0; i < flows.size(); ++i) {
        gpu::Graph graph;
        sheets.add_flow(graph, i, rising_smoke.velocity(graph, i));
        executor.run(graph);
    }
    return boxes;
}

bool Renderer::Impl::update_cloth(const RenderSettings& settings, const features::StyleTables& style)
{
    last_of_cloth.reset();
    if (!loaded->cloth) {
        return false;
    }
    const std::optional<double> before_s = moment_before(settings, style);
    const auto run = loaded->cloth->plan(settings, style, before_s);
    if (!run) {
        return false;
    }
    const auto steps_between = [&](double from_s, double to_s) {
        return loaded->cloth->steps_between(from_s, to_s, loaded->scene, style, settings,
                                            loaded->layout.anchor);
    };
    const bool starts = run->starts_anew || run->is_taken_up;
    if (starts) {
        start_cloth(*run, settings, style);
    }
    std::vector<features::ClothSteps> all = steps_between(run->from_s, run->snapshot_s.value_or(run->from_s));
    std::vector<features::ClothSteps> rest = steps_between(run->snapshot_s.value_or(run->from_s), run->to_s);
    const bool ends_in_snapshot = run->snapshot_s && rest.empty();
    if (!rest.empty()) {
        rest.front().takes_snapshot = run->snapshot_s.has_value();
        std::ranges::copy(rest, std::back_inserter(all));
    }
    // The last are taken within the picture's own graph, beside what does not hang on cloth.
    const bool is_last_put_off =
        !all.empty() && !ends_in_snapshot && settings.time_s >= 0.0 && !loaded->cloth->sheets().may_tear();
    if (is_last_put_off) {
        last_of_cloth = all.back();
        all.pop_back();
    }
    for (const features::ClothSteps& steps : all) {
        step_cloth(steps, settings, style);
    }
    if (ends_in_snapshot) {
        gpu::Graph graph;
        cloth::Cloths& sheets = loaded->cloth->sheets();
        cloth::Cloths::Handles handles = sheets.import(graph);
        sheets.add_snapshot(graph, handles);
        executor.run(graph);
    }
    tear_cloth();
    loaded->cloth->done(settings, style, last_of_cloth ? last_of_cloth->from_s : run->to_s);
    return starts || !all.empty();
}

void Renderer::Impl::place_cloth(const ScenePose& pose, const RenderSettings& settings,
                                 const features::StyleTables& style)
{
    if (last_of_cloth) {
        loaded->cloth->place_solids(device, loaded->scene,
                                    {.nodes = pose, .draws = *loaded->pose, .time_s = settings.time_s},
                                    loaded->layout, style.cloth.bodies);
    }
    const std::vector<Bounds> swept = loaded->cloth->sweep(*loaded->pose);
    sun_map.move(swept);
    moved.insert(moved.end(), swept.begin(), swept.end());
}

void Renderer::Impl::tear_cloth()
{
    cloth::Cloths& sheets = loaded->cloth->sheets();
    if (!sheets.may_tear()) {
        return;
    }
    gpu::Buffer copy(device, "cloth torn", sheets.torn().size_bytes(), gpu::MemoryUse::readback);
    gpu::Graph graph;
    gpu::add_read_back(graph, "cloth/read torn", sheets.import(graph).torn, copy);
    executor.run(graph);
    if (loaded->cloth->tear_triangles(loaded->layout, gpu::items_of<glm::uvec2>(copy))) {
        loaded->meshes.triangles = gpu::upload_buffer(device, "triangles", loaded->layout.triangles);
        loaded->line_meshes.forget();
    }
}

gpu::BufferId Renderer::Impl::pose_for_cloth(gpu::Graph& graph, double time_s, Index animation,
                                             const features::StyleTables& style)
{
    const ScenePose pose = frame::pose_at(*loaded, std::max(time_s, 0.0), animation);
    update_pose(pose);
    loaded->cloth->place_solids(device, loaded->scene,
                                {.nodes = pose, .draws = *loaded->pose, .time_s = time_s}, loaded->layout,
                                style.cloth.bodies);
    return add_moved(graph);
}

void Renderer::Impl::start_cloth(const features::ClothRun& run, const RenderSettings& settings,
                                 const features::StyleTables& style)
{
    cloth::Cloths& sheets = loaded->cloth->sheets();
    gpu::Graph graph;
    const gpu::BufferId posed = pose_for_cloth(graph, run.from_s, settings.animation, style);
    loaded->cloth->forget_before();
    cloth::Cloths::Handles handles = sheets.import(graph);
    sheets.add_targets(graph, handles, posed);
    loaded->cloth->add_bodies(graph, handles, *loaded->pose, posed);
    if (run.starts_anew) {
        const std::vector<glm::mat4> anew(sheets.sheet_count(), glm::mat4(0.0F));
        sheets.add_carry(graph, handles, anew);
    }
    sheets.add_snapshot(graph, handles);
    std::ignore = loaded->cloth->carries(*loaded->pose, loaded->layout.anchor, 0.0);
    executor.run(graph);
    pose::keep_posed(loaded->meshes);
}

void Renderer::Impl::step_cloth(const features::ClothSteps& steps, const RenderSettings& settings,
                                const features::StyleTables& style)
{
    gpu::Graph graph;
    const gpu::BufferId posed = pose_for_cloth(graph, steps.to_s, settings.animation, style);
    cloth::Cloths::Handles handles = loaded->cloth->sheets().import(graph);
    loaded->cloth->add_steps(graph, handles, steps, *loaded->pose, loaded->layout.anchor, posed);
    executor.run(graph);
    pose::keep_posed(loaded->meshes);
}

} // namespace estampe
