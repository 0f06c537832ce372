// SPDX-License-Identifier: MIT
#include "techniques/bake/surfaces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/srgb.hpp"

namespace estampe::bake {
namespace {

/// Column or row of a texture, by its wrap mode.
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

} // namespace estampe::bake
