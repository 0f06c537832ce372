// SPDX-License-Identifier: MIT
// What the renderer does for cloth: steps between pictures.
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "frame/renderer_impl.hpp"
#include "gpu/imports.hpp"
#include "gpu/read_back.hpp"
#include "gpu/upload.hpp"

namespace estampe {
namespace {

constexpr double usual_step_s = 1.0 / 120.0;
constexpr uint32_t steps_between_poses = 4; // in between all that is held goes straight

} // namespace

std::optional<std::vector<smoke::Box>> Renderer::Impl::blow_cloth(const ScenePose& pose,
                                                                  const frame::StyleTables& style,
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
    auto boxes = rising_smoke.rise(
        device, executor,
        {.loaded = *loaded, .pose = pose, .settings = settings, .style = style, .lamps = none}, notes);
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

void Renderer::Impl::update_cloth(const RenderSettings& settings, const frame::StyleTables& style)
{
    if (!loaded->cloth) {
        return;
    }
    const std::optional<double> before_s = moment_before(settings, style);
    const auto run = loaded->cloth->plan(settings, style, before_s);
    if (!run) {
        return;
    }
    if (run->starts_anew || run->is_taken_up) {
        start_cloth(*run, settings, style);
    }
    double from_s = run->from_s;
    if (run->snapshot_s) {
        step_cloth(from_s, *run->snapshot_s, settings, style);
        from_s = *run->snapshot_s;
        gpu::Graph graph;
        cloth::Cloths& sheets = loaded->cloth->sheets();
        sheets.add_snapshot(graph, sheets.import(graph));
        executor.run(graph);
    }
    step_cloth(from_s, run->to_s, settings, style);
    tear_cloth();
    loaded->cloth->done(settings, style);
    const std::vector<Bounds> swept =
        loaded->pose ? loaded->cloth->sweep(*loaded->pose) : std::vector{pose::everywhere()};
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
                                             const frame::StyleTables& style)
{
    const ScenePose pose = frame::pose_at(*loaded, std::max(time_s, 0.0), animation);
    update_pose(pose);
    loaded->cloth->place_solids(device, loaded->scene,
                                {.nodes = pose, .draws = *loaded->pose, .time_s = time_s}, loaded->layout,
                                style.cloth.bodies);
    return add_moved(graph);
}

void Renderer::Impl::start_cloth(const frame::ClothRun& run, const RenderSettings& settings,
                                 const frame::StyleTables& style)
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

void Renderer::Impl::step_cloth(double from_s, double to_s, const RenderSettings& settings,
                                const frame::StyleTables& style)
{
    frame::MovingCloth& cloth = *loaded->cloth;
    cloth::Cloths& sheets = cloth.sheets();
    const auto count = static_cast<uint32_t>(std::lround((to_s - from_s) / usual_step_s));
    if (!(to_s > from_s)) {
        return;
    }
    const uint32_t step_count = std::max(count, 1U);
    const double step_s = (to_s - from_s) / step_count;
    const bool is_animated = !loaded->scene.animations.empty();
    for (uint32_t done = 0; done < step_count;) {
        const double time_s = from_s + done * step_s;
        cloth::Surroundings surroundings =
            cloth.surroundings(loaded->scene, style, {time_s, settings.time_s}, loaded->layout.anchor);
        surroundings.step_s = static_cast<float>(step_s);
        const uint32_t most = sheets.most_steps(surroundings);
        const uint32_t now = std::min({step_count - done, most, is_animated ? steps_between_poses : most});
        done += now;
        gpu::Graph graph;
        const gpu::BufferId posed = pose_for_cloth(graph, from_s + done * step_s, settings.animation, style);
        const auto carries = cloth.carries(*loaded->pose, loaded->layout.anchor, now * step_s);
        if (!carries.empty()) {
            cloth.forget_before();
        }
        cloth::Cloths::Handles handles = sheets.import(graph);
        sheets.add_targets(graph, handles, posed);
        cloth.add_bodies(graph, handles, *loaded->pose, posed);
        if (!carries.empty()) {
            sheets.add_carry(graph, handles, carries);
        }
        sheets.add_steps(graph, handles, surroundings, now);
        executor.run(graph);
        pose::keep_posed(loaded->meshes);
    }
}

} // namespace estampe
