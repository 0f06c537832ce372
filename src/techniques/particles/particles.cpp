// SPDX-License-Identifier: MIT
// The birth, flight and drawing of particles.
#include "techniques/particles/particles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <estampe/error.hpp>
#include <estampe/image.hpp>

#include "core/hash.hpp"
#include "gpu/transfers.hpp"
#include "shaders/particle_tiles_comp.hpp"
#include "shaders/particles_comp.hpp"

namespace estampe::particles {
namespace {

double hashed(uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    return static_cast<double>(hash(a ^ hash(b ^ hash(c ^ hash(d)))) >> 8U) * 0x1p-24;
}

uint32_t lattice(double coordinate)
{
    return static_cast<uint32_t>(static_cast<int64_t>(coordinate));
}

/// Gradient of value noise in [0, 1]. The noise has continuous second derivatives, so its gradient has no
/// kinks.
glm::dvec3 noise_gradient(const glm::dvec3& place, uint32_t seed)
{
    const glm::dvec3 cell = glm::floor(place);
    const glm::dvec3 f = place - cell;
    const glm::dvec3 s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    const glm::dvec3 slope = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    glm::dvec3 gradient(0.0);
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at((corner & 1U) != 0 ? 1.0 : 0.0, (corner & 2U) != 0 ? 1.0 : 0.0,
                            (corner & 4U) != 0 ? 1.0 : 0.0);
        const double value =
            hashed(lattice(cell.x + at.x), lattice(cell.y + at.y), lattice(cell.z + at.z), seed);
        const glm::dvec3 weight = glm::mix(1.0 - s, s, at);
        const glm::dvec3 change = slope * (2.0 * at - 1.0);
        gradient += value * glm::dvec3(change.x * weight.y * weight.z, weight.x * change.y * weight.z,
                                       weight.x * weight.y * change.z);
    }
    return gradient;
}

/// A random unit vector within `spread_rad` of `direction`, with uniform density; `a` and `b` are random
/// numbers.
glm::dvec3 scattered(const glm::dvec3& direction, double spread_rad, double a, double b)
{
    const double up = 1.0 - a * (1.0 - std::cos(spread_rad));
    const double level = std::sqrt(std::max(1.0 - up * up, 0.0));
    const double turn = 2.0 * std::numbers::pi * b;
    const glm::dvec3 other =
        std::abs(direction.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(direction, other));
    return up * direction + level * (std::cos(turn) * right + std::sin(turn) * glm::cross(direction, right));
}

Particle fly(const ParticleStyle& style, const Emitter& emitter, uint32_t number, uint32_t emitter_number,
             double age_s)
{
    constexpr double longest_step_s = 0.35;
    constexpr double drag_s = 0.8; // time constant with which air drag slows particles down
    const auto seed = static_cast<uint32_t>(style.seed);
    const auto trait = [&](uint32_t which) { return hashed(number, emitter_number, which, seed); };
    const double bearing = glm::radians(static_cast<double>(style.wind.towards_deg));
    const glm::dvec3 wind = static_cast<double>(wind::speed_m_per_s(style.wind, style.wind_m_per_s)) *
                            glm::dvec3(std::sin(bearing), 0.0, std::cos(bearing));
    const double spread_rad = glm::radians(static_cast<double>(style.spread_deg));
    const double speed = static_cast<double>(style.speed_m_per_s) * (0.7 + 0.6 * trait(2));
    glm::dvec3 own = speed * scattered(emitter.direction, spread_rad, trait(3), trait(4));
    const auto gains = static_cast<double>(style.lift_m_per_s2);
    const auto swirls = static_cast<double>(style.swirl_m_per_s);
    const auto swirl_m = static_cast<double>(style.swirl_m);
    Particle particle{.place = emitter.place,
                      .velocity = own,
                      .age = static_cast<float>(age_s / static_cast<double>(style.life_s)),
                      .size = static_cast<float>(emitter.size),
                      .trait = static_cast<float>(trait(0)),
                      .trait_b = static_cast<float>(trait(1))};
    const auto steps = static_cast<int>(std::ceil(age_s / longest_step_s));
    const double step_s = steps > 0 ? age_s / steps : 0.0;
    for (int i = 0; i < steps; ++i) {
        const double at_s = (i + 0.5) * step_s;
        const double taken = 1.0 - std::exp(-at_s / drag_s);
        const auto velocity_at = [&](const glm::dvec3& place) {
            const glm::dvec3 turned = swirls * taken * swirl(place / swirl_m, seed);
            return own * (1.0 - 0.6 * taken) + wind * taken + glm::dvec3(0.0, gains * at_s, 0.0) + turned;
        };
        const glm::dvec3 middle = particle.place + 0.5 * step_s * velocity_at(particle.place);
        particle.velocity = velocity_at(middle);
        particle.place += step_s * particle.velocity;
    }
    return particle;
}

/// The state of an emitter `ago_s` seconds ago, interpolated linearly between known states. For times before
/// the oldest known state, returns the oldest state.
Emitter stood(const Emitter& emitter, double ago_s)
{
    if (emitter.before.empty() || emitter.step_s <= 0.0) {
        return {.place = emitter.place, .direction = emitter.direction, .size = emitter.size};
    }
    const auto at = [&](size_t i) -> const Emitter& {
        return i == 0 ? emitter : emitter.before[std::min(i, emitter.before.size()) - 1];
    };
    const double steps = ago_s / emitter.step_s;
    const auto whole = static_cast<size_t>(steps);
    const Emitter& late = at(whole);
    const Emitter& early = at(whole + 1);
    const double part = steps - static_cast<double>(whole);
    const glm::dvec3 direction = glm::mix(late.direction, early.direction, part);
    const bool gives = late.direction != glm::dvec3(0.0) && early.direction != glm::dvec3(0.0) &&
                       glm::length(direction) > 0.0;
    return {.place = glm::mix(late.place, early.place, part),
            .direction = gives ? glm::normalize(direction) : glm::dvec3(0.0),
            .size = glm::mix(late.size, early.size, part)};
}

} // namespace

glm::dvec3 swirl(const glm::dvec3& place, uint32_t seed)
{
    const glm::dvec3 x = noise_gradient(place, 3U * seed);
    const glm::dvec3 y = noise_gradient(place + 19.1, 3U * seed + 1U);
    const glm::dvec3 z = noise_gradient(place - 27.7, 3U * seed + 2U);
    return {z.y - y.z, x.z - z.x, y.x - x.y};
}

std::vector<Particle> particles_at(const ParticleStyle& style, std::span<const Emitter> emitters,
                                   double time_s)
{
    std::vector<Particle> particles;
    const auto per_s = static_cast<double>(style.per_s);
    const auto life_s = static_cast<double>(style.life_s);
    if (per_s <= 0.0) {
        return particles;
    }
    const auto newest = static_cast<int64_t>(std::floor(time_s * per_s));
    const auto oldest = static_cast<int64_t>(std::ceil((time_s - life_s) * per_s)) - 1;
    for (uint32_t emitter = 0; emitter < emitters.size(); ++emitter) {
        for (int64_t i = oldest; i <= newest; ++i) {
            const auto number = static_cast<uint32_t>(i);
            const double born =
                (static_cast<double>(i) + hashed(number, emitter, 9U, static_cast<uint32_t>(style.seed))) /
                per_s;
            const double age_s = time_s - born;
            if (age_s < 0.0 || age_s >= life_s) {
                continue;
            }
            const Emitter then = stood(emitters[emitter], age_s);
            if (then.direction != glm::dvec3(0.0)) {
                particles.push_back(fly(style, then, number, emitter, age_s));
            }
        }
    }
    return particles;
}

namespace {

glm::dvec2 projected_px(const ParticleView& view, const glm::dvec3& place, double& away_m)
{
    const glm::dvec4 clip = glm::dmat4(view.clip_from_anchor) * glm::dvec4(place - view.anchor, 1.0);
    away_m = clip.w;
    return (0.5 * glm::dvec2(clip) / clip.w + 0.5) * glm::dvec2(view.page_px);
}

/// Opacity of a particle by its age: it fades in quickly and out slowly.
float density_at(float age)
{
    return glm::smoothstep(0.0F, 0.12F, age) * (1.0F - glm::smoothstep(0.45F, 1.0F, age));
}

glm::vec2 turn_by(float angle)
{
    return {std::cos(angle), std::sin(angle)};
}

/// For each tile of the page, lists the sprites that touch it, in the order of the sprites.
void list_sprites(ParticlePlan& plan, glm::uvec2 tiles)
{
    constexpr float beyond_px = 2.0F; // margin of sprites in pixels, for soft edges and sample jitter
    const auto for_tiles = [&](const shared::Sprite& sprite, const auto& visit) {
        const float reach = sprite.radius_px * sprite.stretch + beyond_px;
        const glm::vec2 side(shared::particle_tile_px);
        const glm::ivec2 last_tile = glm::ivec2(tiles) - 1;
        const glm::ivec2 first(glm::max(glm::floor((sprite.centre_px - reach) / side), glm::vec2(0.0F)));
        const glm::ivec2 last = glm::min(
            glm::ivec2(glm::floor(glm::max((sprite.centre_px + reach) / side, glm::vec2(-1.0F)))), last_tile);
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                visit(static_cast<size_t>(y) * tiles.x + static_cast<size_t>(x));
            }
        }
    };
    plan.starts.assign(size_t{tiles.x} * tiles.y + 1, 0);
    for (const shared::Sprite& sprite : plan.sprites) {
        for_tiles(sprite, [&](size_t tile) { ++plan.starts[tile + 1]; });
    }
    std::partial_sum(plan.starts.begin(), plan.starts.end(), plan.starts.begin());
    plan.listed.resize(plan.starts.back());
    std::vector<uint32_t> next = plan.starts;
    for (uint32_t i = 0; i < plan.sprites.size(); ++i) {
        for_tiles(plan.sprites[i], [&](size_t tile) { plan.listed[next[tile]++] = i; });
    }
}

SheetImage read_sheet(const std::string& path, glm::uvec2 frames, const ReadScope& scope)
{
    const Image picture = load_image(path, scope);
    SheetImage sheet{.size_px = {picture.width, picture.height}, .frames = frames, .brightness = {}};
    if (glm::any(glm::lessThan(sheet.size_px, frames))) {
        throw Error(fmt::format("a sheet of {} x {} pixels cannot have {} columns and {} rows",
                                sheet.size_px.x, sheet.size_px.y, frames.x, frames.y),
                    path, "set particles.columns and particles.rows to those of the picture");
    }
    sheet.brightness.reserve(picture.rgba.size() / 4);
    for (size_t i = 0; i < picture.rgba.size(); i += 4) {
        const glm::vec3 color(picture.rgba[i], picture.rgba[i + 1], picture.rgba[i + 2]);
        sheet.brightness.push_back(glm::dot(color, glm::vec3(1.0F / 3.0F)) / 255.0F *
                                   (static_cast<float>(picture.rgba[i + 3]) / 255.0F));
    }
    return sheet;
}

} // namespace

ParticlePlan plan_particles(const ParticleStyle& style, std::span<const Particle> particles,
                            const ParticleView& view)
{
    constexpr double nearest_m = 0.05;
    constexpr float widest_px = 16384.0F;
    ParticlePlan plan;
    const auto frames = static_cast<float>(view.sheet_frames.x * view.sheet_frames.y);
    for (const Particle& particle : particles) {
        double away_m = 0.0;
        const glm::dvec2 centre = projected_px(view, particle.place, away_m);
        if (!view.is_parallel && away_m < nearest_m) {
            continue;
        }
        const double pixel_m = static_cast<double>(view.pixel_m) * (view.is_parallel ? 1.0 : away_m);
        const float width_m = glm::mix(style.size_m, style.grown_m, std::sqrt(particle.age)) *
                              (0.7F + 0.6F * particle.trait) * particle.size;
        const float radius = 0.5F * width_m / static_cast<float>(pixel_m);
        const glm::vec2 centre_px(centre);
        const glm::vec2 page(view.page_px);
        if (radius < 0.2F || radius > widest_px ||
            glm::any(glm::lessThan(centre_px + 8.0F * radius, glm::vec2(0.0F))) ||
            glm::any(glm::greaterThan(centre_px - 8.0F * radius, page))) {
            continue;
        }
        glm::vec2 turn = turn_by(2.0F * std::numbers::pi_v<float> * particle.trait_b +
                                 (particle.trait - 0.5F) * 2.0F * particle.age);
        float length = 1.0F;
        if (style.look == Look::strokes) {
            double ahead_m = 0.0;
            const glm::vec2 ahead(projected_px(view, particle.place + 0.02 * particle.velocity, ahead_m) -
                                  centre);
            turn = glm::length(ahead) > 1e-4F ? glm::normalize(ahead) : turn;
            length = 6.0F;
        }
        plan.sprites.push_back({.centre_px = centre_px,
                                .radius_px = style.look == Look::strokes ? 0.25F * radius : radius,
                                .away_m = static_cast<float>(away_m),
                                .turn = turn,
                                .stretch = length,
                                .opacity = style.opacity * density_at(particle.age),
                                .trait = particle.trait,
                                .frame = particle.age * std::max(frames - 1.0F, 0.0F)});
    }
    std::ranges::stable_sort(plan.sprites, std::greater(), &shared::Sprite::away_m);
    const glm::uvec2 tiles = (view.page_px + (shared::particle_tile_px - 1)) / shared::particle_tile_px;
    list_sprites(plan, tiles);
    plan.constants = {.color = style.color,
                      .outline_px = style.outline_mm * view.pixels_per_mm,
                      .ink = style.ink,
                      .soft_m = style.soft_m,
                      .look = static_cast<uint32_t>(style.look),
                      .tiles_across = tiles.x,
                      .frames = view.sheet_frames,
                      .sheet_px = view.sheet_px,
                      .haze_start_m = 0.0F,
                      .haze_halves_per_m = 0.0F,
                      .haze_ink = 0.0F};
    return plan;
}

void Sheet::ensure(gpu::Device& device, const ParticleStyle& style,
                   const std::function<SheetImage()>& simulate)
{
    const glm::uvec2 asked_frames(style.columns, style.rows);
    if (!texels_.empty() && name_ == style.sheet && asked_frames_ == asked_frames) {
        return;
    }
    const SheetImage image = style.sheet.empty()      ? SheetImage()
                             : style.sheet == "smoke" ? simulate()
                                                      : read_sheet(style.sheet, asked_frames, style.scope);
    texels_ = gpu::Buffer(device, "particle sheet", sizeof(float) * image.brightness.size(),
                          gpu::MemoryUse::upload);
    std::ranges::copy(std::as_bytes(std::span(image.brightness)), texels_.mapped().begin());
    size_px_ = image.size_px;
    frames_ = image.frames;
    name_ = style.sheet;
    asked_frames_ = asked_frames;
}

namespace {

/// Adds a pass that lists the tiles of 8 x 8 pixels that have sprites.
gpu::BufferId add_tiles(gpu::Graph& graph, const ParticleInputs& in, gpu::BufferId starts,
                        uint32_t tiles_across)
{
    const glm::uvec2 tiles = (in.size_px + 7U) / 8U;
    const gpu::BufferId none = gpu::add_empty_tile_list(graph, "sprites' pixels", in.size_px);
    auto pass = graph.compute("particles/tiles", shaders::particle_tiles_comp);
    pass.uniform(in.frame).sample(starts, gpu::Format::r32ui);
    const gpu::BufferId listed = pass.modify(none);
    pass.push(shared::ParticleTiles{.tiles_across = tiles_across}).dispatch_over(tiles.x, tiles.y);
    return listed;
}

} // namespace

ParticleLayers add_particles(gpu::Graph& graph, const ParticleInputs& in, const SpriteLists& lists,
                             const shared::ParticleConstants& constants, const ParticleLayers& layers)
{
    const gpu::BufferId tiles = add_tiles(graph, in, lists.starts, constants.tiles_across);
    auto pass = graph.compute("particles", shaders::particles_comp);
    pass.uniform(in.frame).sample(lists.sprites, gpu::Format::rgba32f);
    pass.sample(lists.starts, gpu::Format::r32ui).sample(lists.listed, gpu::Format::r32ui);
    pass.sample(lists.sheet, gpu::Format::r32f).sample(in.depth).sample(in.sky);
    const gpu::ImageId wash = pass.modify(layers.wash);
    const gpu::ImageId hatch = pass.modify(layers.hatch);
    const gpu::ImageId lines = pass.modify(layers.lines);
    pass.variant(in.by_groups ? shared::particles_by_groups : 0U);
    pass.read(tiles).push(constants).dispatch_indirect(tiles);
    return {.wash = wash, .hatch = hatch, .lines = lines};
}

} // namespace estampe::particles
