// SPDX-License-Identifier: MIT
#include "techniques/shadow/local/local_view.hpp"

#include <cmath>

namespace estampe::shadow {
namespace {

// Wider than this a single map would spend most of its texels on its border.
constexpr float widest_map_rad = 1.1F;
// Near planes lie so close because reversed floats keep their precision at any distance.
constexpr float near_share = 1e-4F;

struct Axes {
    glm::vec3 right, down, along;
};

/// Of a cube's face, as local_shadow.glsl has them: which of them points which way does not matter, as
/// triangles count from either side.
Axes face_axes(uint32_t face)
{
    const auto axis = static_cast<int>(face / 2);
    Axes axes{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    axes.along[axis] = face % 2 == 0 ? 1.0F : -1.0F;
    axes.right[axis == 0 ? 2 : 0] = 1.0F;
    axes.down[axis == 1 ? 2 : 1] = 1.0F;
    return axes;
}

glm::mat4 clip_matrix(const glm::vec3& position, const Axes& axes, float scale, float near_m)
{
    const auto row = [&](const glm::vec3& axis, float factor) {
        return glm::dvec4(glm::dvec3(axis), -glm::dot(glm::dvec3(axis), glm::dvec3(position))) *
               static_cast<double>(factor);
    };
    const glm::dmat4 rows(row(axes.right, scale), row(axes.down, scale),
                          glm::dvec4(0, 0, 0, static_cast<double>(near_m)), row(axes.along, 1.0F));
    return {glm::transpose(rows)};
}

} // namespace

bool LocalLight::is_cube() const
{
    return half_angle_rad <= 0.0F || half_angle_rad > widest_map_rad;
}

shared::LocalShadow local_shadow(const LocalLight& light, uint32_t size, uint32_t first_texel, float radius_m)
{
    const bool is_cube = light.is_cube();
    const auto texels = static_cast<float>(size);
    const float inner_share = (texels - 2.0F * static_cast<float>(rim_texels)) / texels;
    shared::LocalShadow shadow{};
    shadow.right = light.side;
    shadow.down = glm::cross(light.beam, light.side);
    shadow.along = light.beam;
    shadow.scale = is_cube ? inner_share : inner_share / std::tan(light.half_angle_rad);
    shadow.first_texel = first_texel;
    shadow.size = size;
    shadow.near_m = near_share * light.range_m;
    shadow.is_cube = is_cube ? 1U : 0U;
    shadow.radius_m = radius_m;
    return shadow;
}

std::vector<LocalView> local_views(const LocalLight& light, const shared::LocalShadow& shadow)
{
    std::vector<LocalView> views;
    for (uint32_t face = 0; face < light.map_count(); ++face) {
        const Axes axes = light.is_cube() ? face_axes(face) : Axes{shadow.right, shadow.down, shadow.along};
        views.push_back({.clip_from_anchor = clip_matrix(light.position, axes, shadow.scale, shadow.near_m),
                         .first_texel = shadow.first_texel + face * shadow.size * shadow.size});
    }
    return views;
}

} // namespace estampe::shadow
