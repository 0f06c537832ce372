// SPDX-License-Identifier: MIT
#include "frame/particles.hpp"

#include <algorithm>

#include "frame/between_commas.hpp"
#include "frame/mapped_buffer.hpp"
#include "frame/smoke_sheet.hpp"
#include "frame/view.hpp"
#include "style/surfaces.hpp"

namespace estampe::frame {
namespace {

bool is_named(const std::string& name, const std::string& patterns)
{
    return std::ranges::any_of(between_commas(patterns),
                               [&](const std::string& pattern) { return style::matches(pattern, name); });
}

} // namespace

std::vector<particles::Emitter> emitters_of(const Scene& scene, const ScenePose& pose,
                                            const std::string& patterns)
{
    std::vector<particles::Emitter> emitters;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        const glm::dvec3 up(pose.world_from_node[i][1]);
        if (node.mesh == no_index && glm::length(up) > 0.0 && is_named(node.name, patterns)) {
            emitters.push_back(
                {.place = glm::dvec3(pose.world_from_node[i][3]), .direction = glm::normalize(up)});
        }
    }
    return emitters;
}

std::optional<particles::ParticlePlan> provide_particles(gpu::Device& device, gpu::Executor& executor,
                                                         ParticleBuffers& buffers,
                                                         const ParticlePlanInputs& in)
{
    const particles::ParticleStyle& style = in.style.particles;
    const auto emitters = emitters_of(in.loaded.scene, in.pose, style.emitters);
    if (emitters.empty() || style.per_s <= 0.0F) {
        return std::nullopt;
    }
    const glm::uvec2 page_px(in.settings.width, in.settings.height);
    const shared::FrameGlobals page =
        frame_globals(in.camera, in.loaded.layout.bounds, in.loaded.layout.anchor,
                      {.size_px = page_px, .page_height_mm = in.style.paper.height_mm});
    const PixelSize pixel = pixel_size(in.camera, page_px.y);
    const auto alive = particles::particles_at(style, emitters, in.settings.time_s);
    buffers.sheet.provide(device, style, [&] { return smoke_sheet(device, executor); });
    particles::ParticlePlan plan = particles::plan_particles(style, alive,
                                                             {.clip_from_anchor = page.clip_from_anchor,
                                                              .anchor = in.loaded.layout.anchor,
                                                              .page_px = page_px,
                                                              .pixels_per_mm = page.pixels_per_mm,
                                                              .pixel_m = pixel.at_one_m,
                                                              .is_parallel = pixel.is_parallel,
                                                              .sheet_px = buffers.sheet.size_px(),
                                                              .sheet_frames = buffers.sheet.frames()});
    buffers.sprites = mapped_buffer(device, "sprites", plan.sprites);
    buffers.starts = mapped_buffer(device, "sprite tiles", plan.starts);
    buffers.listed = mapped_buffer(device, "listed sprites", plan.listed);
    return plan;
}

} // namespace estampe::frame
