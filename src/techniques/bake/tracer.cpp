// SPDX-License-Identifier: MIT
#include "techniques/bake/tracer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/color.hpp"
#include "scene/light_sources.hpp"
#include "techniques/bake/embree.hpp"

namespace estampe::bake {
namespace {

/// Column or row of a texture at coordinate `x`, according to the wrap mode.
uint32_t wrapped(float x, uint32_t side, Wrap wrap)
{
    if (!std::isfinite(x)) {
        return 0;
    }
    float inside = x;
    if (wrap == Wrap::repeat) {
        inside = x - std::floor(x);
    } else if (wrap == Wrap::mirror) {
        const float half = 0.5F * x;
        inside = 1.0F - std::abs(1.0F - 2.0F * (half - std::floor(half)));
    }
    const float last = static_cast<float>(side) - 1.0F;
    return static_cast<uint32_t>(std::clamp(std::floor(inside * static_cast<float>(side)), 0.0F, last));
}

template <class T>
T between(const std::vector<T>& corners, uint32_t triangle, const glm::vec2& weights)
{
    const T* corner = &corners[3 * static_cast<size_t>(triangle)];
    return (1.0F - weights.x - weights.y) * corner[0] + weights.x * corner[1] + weights.y * corner[2];
}

LightLinks both(const LightLinks& a, const LightLinks& b)
{
    return {.lit_by = static_cast<Groups>(a.lit_by & b.lit_by),
            .casts_for = static_cast<Groups>(a.casts_for & b.casts_for),
            .receives_shadows = a.receives_shadows && b.receives_shadows};
}

} // namespace

Surfaces::Surfaces(const Scene& scene, const StaticTriangles& triangles)
    : scene_(scene), triangles_(triangles)
{
    material_of_.reserve(triangles.count());
    for (const StaticDraw& draw : triangles.draws) {
        material_of_.insert(material_of_.end(), draw.triangle_count, draw.material);
        const LightLinks links = both(scene.nodes[draw.node].links, scene.materials[draw.material].links);
        links_of_.insert(links_of_.end(), draw.triangle_count, links);
        has_links_ |= links != LightLinks{};
        lets_rays_pass_ |= scene.materials[draw.material].alpha_mode != AlphaMode::opaque;
    }
    for (size_t i = 0; i < triangles.count(); ++i) {
        const glm::vec3* corner = &triangles.positions[3 * i];
        const glm::vec3* normal = &triangles.normals[3 * i];
        const glm::vec3 twice = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const float length = glm::length(twice);
        const glm::vec3 outward = normal[0] + normal[1] + normal[2];
        const float side = glm::dot(twice, outward) < 0.0F ? -1.0F : 1.0F;
        plane_normals_.push_back(length > 0.0F ? twice * (side / length) : glm::vec3(0, 1, 0));
        areas_m2_.push_back(0.5F * length);
    }
}

glm::vec3 Surfaces::place(uint32_t triangle, const glm::vec2& weights) const
{
    return between(triangles_.positions, triangle, weights);
}

glm::vec3 Surfaces::smooth_normal(uint32_t triangle, const glm::vec2& weights) const
{
    const glm::vec3 sum = between(triangles_.normals, triangle, weights);
    const float length = glm::length(sum);
    const glm::vec3 plane = plane_normals_[triangle];
    return length > 1e-3F && glm::dot(sum, plane) > 0.0F ? sum / length : plane;
}

glm::vec4 Surfaces::texel(const TextureRef& reference, uint32_t triangle, const glm::vec2& weights) const
{
    static const std::array<float, 256> linear = linear_of_srgb_bytes<float>();
    if (reference.texture == no_index) {
        return glm::vec4(1.0F);
    }
    const Texture& texture = scene_.textures[reference.texture];
    const glm::vec2 uv = between(triangles_.uvs[std::min(reference.uv_set, 1U)], triangle, weights);
    const glm::vec2 place = glm::vec2(reference.uv_transform * glm::vec3(uv, 1.0F));
    const uint32_t x = wrapped(place.x, texture.image.width, texture.wrap_u);
    const uint32_t y = wrapped(place.y, texture.image.height, texture.wrap_v);
    const uint8_t* bytes = &texture.image.rgba[4 * (static_cast<size_t>(y) * texture.image.width + x)];
    return {linear[bytes[0]], linear[bytes[1]], linear[bytes[2]], static_cast<float>(bytes[3]) / 255.0F};
}

glm::vec3 Surfaces::albedo(uint32_t triangle, const glm::vec2& weights) const
{
    const Material& worn = material(triangle);
    glm::vec3 color =
        glm::vec3(worn.base_color) * glm::vec3(texel(worn.base_color_texture, triangle, weights));
    if (!triangles_.colors.empty()) {
        color *= between(triangles_.colors, triangle, weights);
    }
    return glm::clamp(color, 0.0F, 1.0F);
}

glm::vec3 Surfaces::glow(uint32_t triangle, const glm::vec2& weights) const
{
    const Material& worn = material(triangle);
    return worn.emissive == glm::vec3(0.0F)
               ? glm::vec3(0.0F)
               : worn.emissive * glm::vec3(texel(worn.emissive_texture, triangle, weights));
}

float Surfaces::cover(uint32_t triangle, const glm::vec2& weights) const
{
    const Material& worn = material(triangle);
    if (worn.alpha_mode == AlphaMode::opaque) {
        return 1.0F;
    }
    const float alpha = worn.base_color.w * texel(worn.base_color_texture, triangle, weights).w;
    return worn.alpha_mode == AlphaMode::blend ? alpha : (alpha >= worn.alpha_cutoff ? 1.0F : 0.0F);
}

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A cosine-weighted direction about `normal`: Malley's method, in a frame after Duff et al., "Building an
/// Orthonormal Basis, Revisited", 2017.
glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& square)
{
    const float sign = std::copysign(1.0F, normal.z);
    const float a = -1.0F / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 right(1.0F + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 up(b, sign + normal.y * normal.y * a, -normal.y);
    const float radius = std::sqrt(square.x);
    const float angle = 2.0F * pi * square.y;
    const float height = std::sqrt(std::max(1e-6F, 1.0F - square.x));
    return glm::normalize(right * (radius * std::cos(angle)) + up * (radius * std::sin(angle)) +
                          normal * height);
}

/// The light of a lamp at a place without shadows, and the direction from the place to the lamp.
struct Beam {
    glm::vec3 light{0.0F};
    glm::vec3 direction{0.0F};
    float distance_m = INFINITY;
    Groups casters = all_groups;
};

/// Share of a lamp's light that leaves along the unit vector `along`, because of its cone or pyramid.
float share_along(const Lamp& lamp, const glm::vec3& along)
{
    if (lamp.kind != LampKind::spot && lamp.kind != LampKind::pyramid) {
        return 1.0F;
    }
    return estampe::share_along(
        {.shape = lamp.kind == LampKind::pyramid ? SpotShape::pyramid : SpotShape::cone,
         .direction = lamp.direction,
         .side = lamp.side,
         .cone_scale = lamp.cone_scale,
         .cone_offset = lamp.cone_offset},
        along);
}

Beam beam_of(const Lamp& lamp, const glm::vec3& place, const glm::vec3& normal)
{
    if (lamp.kind == LampKind::directional) {
        return {lamp.color * std::max(glm::dot(normal, lamp.direction), 0.0F), lamp.direction, INFINITY,
                lamp.casters};
    }
    const glm::vec3 way = lamp.position - place;
    const float distance_2 = std::max(glm::dot(way, way), 1e-6F);
    const float distance_m = std::sqrt(distance_2);
    const glm::vec3 direction = way / distance_m;
    const LightFalloff falloff = lamp.unit_volume ? LightFalloff::unit_volume : LightFalloff::inverse_square;
    const float strength = std::max(glm::dot(normal, direction), 0.0F) *
                           weakened(falloff, lamp.range_m, distance_2) * share_along(lamp, -direction);
    return {lamp.color * strength, direction, distance_m, lamp.casters};
}

} // namespace

Tracer::Tracer(const StaticTriangles& triangles, const Surfaces& surfaces, const BakeSettings& settings)
    : surfaces_(surfaces), settings_(settings), rays_(build_rays(triangles.positions))
{
    constexpr float lift_share = 2e-5F;
    float radius_m = 0.0F;
    for (const glm::vec3& place : triangles.positions) {
        radius_m = std::max(radius_m, glm::length(place));
    }
    lift_m_ = lift_share * radius_m;
    float sum = 0.0F;
    for (uint32_t i = 0; i < surfaces.count(); ++i) {
        const float glow = luminance(surfaces.material(i).emissive);
        const float power = glow * surfaces.area_m2(i);
        if (power > 0.0F && surfaces.material(i).alpha_mode != AlphaMode::blend) {
            glow_of_triangle_.resize(surfaces.count());
            glow_of_triangle_[i] = glow;
            sum += power;
            glowing_.push_back(i);
            glow_sums_.push_back(sum);
        }
    }
}

std::optional<Tracer::Hit> Tracer::nearest(const glm::vec3& from, const glm::vec3& direction, float reach_m,
                                           Random& random, std::optional<Groups> casters) const
{
    constexpr int most_passed = 64;
    constexpr float step_on = 1.0F + 1e-6F;
    RTCRayHit found{};
    found.ray = ray_of(from, direction, reach_m);
    for (int passed = 0; passed < most_passed; ++passed) {
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        intersect(static_cast<RTCScene>(rays_.get()), found);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return std::nullopt;
        }
        const Hit hit{found.hit.primID, {found.hit.u, found.hit.v}, found.ray.tfar};
        const bool counts = !casters || (surfaces_.links(hit.triangle).casts_for & *casters) != 0;
        if (counts &&
            (!surfaces_.lets_rays_pass() || random.next() < surfaces_.cover(hit.triangle, hit.weights))) {
            return hit;
        }
        found.ray.tnear = found.ray.tfar * step_on + 0.1F * lift_m_;
        found.ray.tfar = reach_m;
    }
    return std::nullopt;
}

bool Tracer::blocked(const glm::vec3& from, const glm::vec3& direction, float reach_m, Random& random,
                     std::optional<Groups> casters) const
{
    if (casters && *casters == 0) {
        return false;
    }
    if (surfaces_.lets_rays_pass() || (casters && surfaces_.has_links())) {
        return nearest(from, direction, reach_m, random, casters).has_value();
    }
    RTCRay ray = ray_of(from, direction, reach_m);
    occlude(static_cast<RTCScene>(rays_.get()), ray);
    return ray.tfar < 0.0F;
}

glm::vec3 Tracer::from_lamps(const Vertex& vertex, bool baked_alone, Random& random) const
{
    // A single lamp is sampled. The probability of choosing a lamp is proportional to the lamp's brightness
    // at the point, so the lamp's light is scaled to the sum of all lamps.
    Beam chosen;
    float chosen_brightness = 0.0F;
    float sum = 0.0F;
    for (const Lamp& lamp : settings_.lamps) {
        if ((baked_alone && !lamp.baked) || (lamp.groups & vertex.links.lit_by) == 0) {
            continue;
        }
        const Beam beam = beam_of(lamp, vertex.place, vertex.normal);
        const float own = luminance(beam.light);
        if (own <= 0.0F || glm::dot(beam.direction, vertex.plane) <= 0.0F) {
            continue;
        }
        sum += own;
        if (random.next() * sum < own) {
            chosen = beam;
            chosen_brightness = own;
        }
    }
    if (chosen_brightness <= 0.0F || (vertex.links.receives_shadows &&
                                      blocked(vertex.place, chosen.direction,
                                              chosen.distance_m * (1.0F - 1e-4F), random, chosen.casters))) {
        return glm::vec3(0.0F);
    }
    return chosen.light * (sum / chosen_brightness);
}

glm::vec3 Tracer::glow_towards(const Hit& hit, const glm::vec3& direction) const
{
    const bool sees_front = glm::dot(direction, surfaces_.plane_normal(hit.triangle)) < 0.0F;
    return sees_front || surfaces_.material(hit.triangle).double_sided
               ? surfaces_.glow(hit.triangle, hit.weights)
               : glm::vec3(0.0F);
}

/// Probability density, per steradian, with which from_glow() samples the direction from a point to a glowing
/// triangle.
float Tracer::glow_density(uint32_t triangle, const glm::vec3& direction, float distance_m) const
{
    if (glowing_.empty()) {
        return 0.0F;
    }
    const float cosine = std::abs(glm::dot(direction, surfaces_.plane_normal(triangle)));
    return glow_of_triangle_[triangle] / glow_sums_.back() * distance_m * distance_m /
           std::max(cosine, 1e-6F);
}

glm::vec3 Tracer::from_glow(const Vertex& vertex, Random& random) const
{
    if (glowing_.empty()) {
        return glm::vec3(0.0F);
    }
    const float pick = random.next() * glow_sums_.back();
    const auto found = std::upper_bound(glow_sums_.begin(), glow_sums_.end() - 1, pick);
    Hit target{.triangle = glowing_[static_cast<size_t>(found - glow_sums_.begin())]};
    const float root = std::sqrt(random.next());
    target.weights = {root * (1.0F - random.next()), 0.0F};
    target.weights.y = root - target.weights.x;
    const glm::vec3 way = surfaces_.place(target.triangle, target.weights) - vertex.place;
    const float distance_m = glm::length(way);
    const glm::vec3 direction = way / std::max(distance_m, 1e-12F);
    const float cosine = glm::dot(direction, vertex.normal);
    if (cosine <= 0.0F || glm::dot(direction, vertex.plane) <= 0.0F) {
        return glm::vec3(0.0F);
    }
    const glm::vec3 glow = glow_towards(target, direction);
    const float own = glow_density(target.triangle, direction, distance_m);
    if (glow == glm::vec3(0.0F) ||
        blocked(vertex.place, direction, distance_m * (1.0F - 1e-4F) - lift_m_, random)) {
        return glm::vec3(0.0F);
    }
    // Multiple importance sampling with the balance heuristic.
    return glow * (cosine / pi / (own + cosine / pi));
}

Arrival Tracer::follow(const charts::Texel& texel, const glm::vec2& first, Random& random) const
{
    const glm::vec3 plane = surfaces_.plane_normal(texel.triangle);
    Vertex vertex{.place = surfaces_.place(texel.triangle, texel.weights) + lift_m_ * plane,
                  .normal = surfaces_.smooth_normal(texel.triangle, texel.weights),
                  .plane = plane,
                  .links = surfaces_.links(texel.triangle)};
    Arrival arrival{.light = from_lamps(vertex, true, random)};
    glm::vec3 share(1.0F); // weight in the path of the light that leaves the next surface
    for (uint32_t bounce = 0;; ++bounce) {
        arrival.light += share * from_glow(vertex, random);
        const glm::vec2 square = bounce == 0 ? first : glm::vec2(random.next(), random.next());
        glm::vec3 direction = cosine_direction(vertex.normal, square);
        const float below = glm::dot(direction, vertex.plane);
        direction = below < 0.0F ? direction - 2.0F * below * vertex.plane : direction;
        const std::optional<Hit> hit = nearest(vertex.place, direction, INFINITY, random);
        if (!hit) {
            arrival.light += share * (direction.y > 0.0F ? settings_.sky : settings_.ground);
            break;
        }
        const glm::vec3 front = surfaces_.plane_normal(hit->triangle);
        const bool from_behind = glm::dot(direction, front) > 0.0F;
        const Material& material = surfaces_.material(hit->triangle);
        arrival.saw_a_back |= bounce == 0 && from_behind && !material.double_sided;
        const glm::vec3 glow = glow_towards(*hit, direction);
        if (glow != glm::vec3(0.0F)) {
            const float cosine = std::max(glm::dot(direction, vertex.normal), 0.0F) / pi;
            const float other = glow_density(hit->triangle, direction, hit->distance_m);
            arrival.light += share * glow * (cosine / std::max(cosine + other, 1e-12F));
        }
        if (bounce == settings_.bounces) {
            break;
        }
        share *= surfaces_.albedo(hit->triangle, hit->weights);
        vertex.plane = from_behind ? -front : front;
        vertex.normal = vertex.plane;
        vertex.links = surfaces_.links(hit->triangle);
        vertex.place = surfaces_.place(hit->triangle, hit->weights) + lift_m_ * vertex.plane;
        arrival.light += share * from_lamps(vertex, false, random);
    }
    return arrival;
}

} // namespace estampe::bake
