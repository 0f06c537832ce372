// SPDX-License-Identifier: MIT
#include "features/particles/particles.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

#include "features/common/style_tables.hpp"
#include "features/common/view.hpp"
#include "gpu/resources.hpp"
#include "scene/static_triangles.hpp"
#include "style/names.hpp"
#include "style/parameter.hpp"
#include "techniques/fluid/fluid.hpp"

namespace estampe::features {
namespace {

constexpr uint32_t cells_a_side = 64;
constexpr uint32_t frames_a_side = 6;
constexpr float lasts_s = 4.0F;
constexpr uint32_t step_count = 240;

/// Density and temperature of the smoke at the first frame: one puff with a lobed outline, in the lower
/// middle of the frame.
std::vector<float> first_puff()
{
    std::vector<float> density;
    for (uint32_t i = 0; i < cells_a_side * cells_a_side; ++i) {
        const glm::vec2 at =
            (glm::vec2(i % cells_a_side, i / cells_a_side) + 0.5F) / static_cast<float>(cells_a_side);
        const glm::vec2 away = at - glm::vec2(0.5F, 0.36F);
        const float angle = std::atan2(away.y, away.x);
        const float radius =
            0.25F * (1.0F + 0.15F * std::sin(3.0F * angle + 1.0F) + 0.1F * std::sin(5.0F * angle));
        density.push_back(1.0F - glm::smoothstep(0.75F, 1.1F, glm::length(away) / radius));
    }
    std::vector<float> both = density;
    both.insert(both.end(), density.begin(), density.end());
    return both;
}

fluid::FluidStyle smoke_style()
{
    fluid::FluidStyle style;
    style.step_s = lasts_s / step_count;
    style.forces.lift_m_s2 = 0.12F;
    style.forces.confinement_per_s = 0.5F;
    style.matter.cooling_per_s = 0.5F;
    style.matter.fading_per_s = 0.08F;
    return style;
}

/// Copies one frame of the simulated smoke to its place on the sprite sheet, with y upward.
void copy_frame(const std::vector<float>& quantities, uint32_t frame, particles::SheetImage& sheet)
{
    const glm::uvec2 from = cells_a_side * glm::uvec2(frame % frames_a_side, frame / frames_a_side);
    for (uint32_t y = 0; y < cells_a_side; ++y) {
        for (uint32_t x = 0; x < cells_a_side; ++x) {
            const size_t place = size_t{from.y + cells_a_side - 1 - y} * sheet.size_px.x + from.x + x;
            sheet.brightness[place] = std::clamp(quantities[size_t{y} * cells_a_side + x], 0.0F, 1.0F);
        }
    }
}

} // namespace

particles::SheetImage smoke_sheet(gpu::Device& device, gpu::Executor& executor)
{
    constexpr uint32_t frame_count = frames_a_side * frames_a_side;
    constexpr uint32_t sheet_px = frames_a_side * cells_a_side;
    particles::SheetImage sheet{.size_px = glm::uvec2(sheet_px),
                                .frames = glm::uvec2(frames_a_side),
                                .brightness = std::vector<float>(size_t{sheet_px} * sheet_px)};
    const fluid::Grid grid{.cells = {cells_a_side, cells_a_side, 1},
                           .cell_m = 1.0F / cells_a_side,
                           .edges = {fluid::Edge::free_slip, fluid::Edge::free_slip, fluid::Edge::free_slip}};
    const std::vector<float> puff = first_puff();
    fluid::Fluid air(device, grid, 2, {}, puff);
    const fluid::FluidStyle style = smoke_style();
    copy_frame(puff, 0, sheet);
    uint32_t done = 0;
    for (uint32_t frame = 1; frame < frame_count; ++frame) {
        std::vector<float> quantities;
        for (const uint32_t until = step_count * frame / (frame_count - 1); done < until;) {
            const uint32_t now = std::min(until - done, air.most_steps(style));
            gpu::Graph graph;
            const fluid::FluidFields fields = air.add_steps(graph, style, now);
            quantities = fluid::run_and_read(device, executor, graph, *fields.quantities);
            done += now;
        }
        copy_frame(quantities, frame, sheet);
    }
    return sheet;
}

namespace {

particles::Emitter emitter_at(const glm::dmat4& world_from_node)
{
    const glm::dvec3 up(world_from_node[1]);
    return {.place = glm::dvec3(world_from_node[3]),
            .direction = glm::length(up) > 0.0 ? glm::normalize(up) : glm::dvec3(0.0),
            .size = glm::length(up)};
}

/// Poses of the scene at earlier times. Each pose is computed only once and used by all particle emitters.
class Past {
public:
    static constexpr double step_s = 0.15;

    explicit Past(const ParticlePlanInputs& in) : in_(in) {}

    [[nodiscard]] const ScenePose& before(size_t steps)
    {
        while (poses_.size() < steps) {
            // Animations have no time before 0, but placed nodes may have transforms that were recorded for
            // earlier times.
            const double then_s = in_.settings.time_s - static_cast<double>(poses_.size() + 1) * step_s;
            poses_.push_back(in_.pose_at(!in_.are_nodes_placed ? std::max(then_s, 0.0) : then_s));
        }
        return poses_[steps - 1];
    }

private:
    const ParticlePlanInputs& in_;
    std::deque<ScenePose> poses_;
};

/// Adds earlier positions to moving emitters, as far back as the lifetime of their particles.
void look_back(std::vector<particles::Emitter>& emitters, const std::vector<size_t>& nodes, Past& past,
               double life_s)
{
    const auto steps = static_cast<size_t>(std::ceil(life_s / Past::step_s));
    for (size_t i = 1; i <= steps; ++i) {
        const ScenePose& then = past.before(i);
        for (size_t k = 0; k < emitters.size(); ++k) {
            emitters[k].before.push_back(emitter_at(then.world_from_node[nodes[k]]));
        }
    }
    for (particles::Emitter& emitter : emitters) {
        emitter.step_s = Past::step_s;
        const auto stands = [&](const particles::Emitter& then) {
            return then.place == emitter.place && then.direction == emitter.direction &&
                   then.size == emitter.size;
        };
        if (std::ranges::all_of(emitter.before, stands)) {
            emitter.before.clear();
        }
    }
}

/// Particle emitters that have the same style variant.
struct EmitterGroup {
    const particles::ParticleStyle* style = nullptr;
    std::vector<size_t> nodes;
    std::vector<particles::Emitter> emitters;
};

std::vector<EmitterGroup> groups_of(const std::vector<size_t>& nodes, const ScenePose& pose,
                                    const StyleVariants& variants)
{
    std::vector<EmitterGroup> groups(variants.styles.size());
    for (const size_t node : nodes) {
        EmitterGroup& group = groups[variants.variant_of_draw[node]];
        group.nodes.push_back(node);
        group.emitters.push_back(emitter_at(pose.world_from_node[node]));
    }
    for (size_t i = 0; i < groups.size(); ++i) {
        groups[i].style = &variants.styles[i].particles;
    }
    std::erase_if(groups, [](const EmitterGroup& group) {
        return group.emitters.empty() || group.style->per_s <= 0.0F;
    });
    return groups;
}

double mean_distance_m(const EmitterGroup& group, const glm::dvec3& eye)
{
    double sum = 0.0;
    for (const particles::Emitter& emitter : group.emitters) {
        sum += glm::distance(emitter.place, eye);
    }
    return sum / static_cast<double>(group.emitters.size());
}

} // namespace

std::vector<size_t> emitting_nodes(const Scene& scene, const std::string& patterns)
{
    const std::vector<std::string> parts = style::between_commas(patterns);
    std::vector<size_t> nodes;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.visible && node.mesh == no_index &&
            std::ranges::any_of(
                parts, [&](const std::string& pattern) { return style::matches(pattern, node.name); })) {
            nodes.push_back(i);
        }
    }
    return nodes;
}

void push_away(std::span<particles::Particle> alive, const particles::ParticleStyle& style,
               std::span<const Blast> blasts, double time_s)
{
    constexpr double moment_s = 0.01; // time over which the velocity of the push is measured
    for (const Blast& blast : blasts) {
        for (particles::Particle& particle : alive) {
            const double born_s = time_s - static_cast<double>(particle.age * style.life_s);
            const glm::dvec3 place = particle.place;
            particle.place = blast.pushed(place, born_s, time_s);
            particle.velocity += (particle.place - blast.pushed(place, born_s, time_s - moment_s)) / moment_s;
        }
    }
}

void Particles::invalidate(Event event)
{
    if (event == Event::scene_replaced) {
        patterns_.clear();
        emitting_.clear();
    }
}

std::vector<particles::ParticlePlan> Particles::plan(gpu::Device& device, gpu::Executor& executor,
                                                     const ParticlePlanInputs& in)
{
    if (patterns_ != in.style.particles.emitters) {
        patterns_ = in.style.particles.emitters;
        emitting_ = emitting_nodes(in.scene, patterns_);
    }
    const std::vector<size_t>& nodes = emitting_;
    if (nodes.empty()) {
        return {};
    }
    const StyleVariants variants = style_variants_of_nodes(in.scene, in.style);
    std::vector<EmitterGroup> groups = groups_of(nodes, in.pose, variants);
    const std::vector<bool> moves = moving_nodes(in.scene);
    Past past(in);
    std::ranges::stable_sort(groups, std::greater(), [&](const EmitterGroup& group) {
        return mean_distance_m(group, in.camera.eye);
    });
    const glm::uvec2 page_px(in.settings.width, in.settings.height);
    const shared::FrameGlobals page =
        frame_globals(in.camera, in.layout.bounds, in.layout.anchor,
                      {.size_px = page_px, .page_height_mm = in.style.paper.height_mm});
    const PixelSize pixel = pixel_size(in.camera, page_px.y);
    std::vector<particles::ParticlePlan> plans;
    buffers_.resize(std::max(buffers_.size(), groups.size()));
    for (EmitterGroup& group : groups) {
        const particles::ParticleStyle& style = *group.style;
        if (std::ranges::any_of(group.nodes, [&](size_t node) { return moves[node]; })) {
            look_back(group.emitters, group.nodes, past, static_cast<double>(style.life_s));
        }
        auto alive = particles::particles_at(style, group.emitters, in.settings.time_s);
        push_away(alive, style, in.blasts, in.settings.time_s);
        ParticleBuffers& room = buffers_[plans.size()];
        room.sheet.ensure(device, style, [&] { return smoke_sheet(device, executor); });
        particles::ParticlePlan& plan =
            plans.emplace_back(particles::plan_particles(style, alive,
                                                         {.clip_from_anchor = page.clip_from_anchor,
                                                          .anchor = in.layout.anchor,
                                                          .page_px = page_px,
                                                          .pixels_per_mm = page.pixels_per_mm,
                                                          .pixel_m = pixel.at_one_m,
                                                          .is_parallel = pixel.is_parallel,
                                                          .sheet_px = room.sheet.size_px(),
                                                          .sheet_frames = room.sheet.frames()}));
        if (plan.sprites.empty()) {
            plans.pop_back();
            continue;
        }
        if (in.has_haze) {
            plan.constants.haze_start_m = in.style.haze.start_m;
            plan.constants.haze_halves_per_m = 1.0F / in.style.haze.reach_m;
            plan.constants.haze_ink = in.style.haze.ink;
        }
        room.sprites = gpu::mapped_buffer(device, "sprites", plan.sprites);
        room.starts = gpu::mapped_buffer(device, "sprite tiles", plan.starts);
        room.listed = gpu::mapped_buffer(device, "listed sprites", plan.listed);
    }
    return plans;
}

particles::ParticleLayers Particles::record(gpu::Graph& graph, std::span<const particles::ParticlePlan> plans,
                                            const particles::ParticleInputs& in,
                                            particles::ParticleLayers layers)
{
    for (size_t i = 0; i < plans.size(); ++i) {
        ParticleBuffers& buffers = buffers_[i];
        const particles::SpriteLists lists{
            .sprites = gpu::import_whole(graph, "sprites", buffers.sprites),
            .starts = gpu::import_whole(graph, "sprite tiles", buffers.starts),
            .listed = gpu::import_whole(graph, "listed sprites", buffers.listed),
            .sheet = gpu::import_whole(graph, "particle sheet", buffers.sheet.texels())};
        layers = particles::add_particles(graph, in, lists, plans[i].constants, layers);
    }
    return layers;
}

} // namespace estampe::features
