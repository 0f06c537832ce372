// SPDX-License-Identifier: MIT
#include "techniques/bake/normals/detail.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "techniques/bake/embree.hpp"

namespace estampe::bake {
namespace {

/// Index of a texel along one side of a texture, for an index that may lie beyond the edges.
uint32_t wrapped(int64_t at, uint32_t side, Wrap wrap)
{
    const auto count = static_cast<int64_t>(side);
    if (wrap == Wrap::clamp) {
        return static_cast<uint32_t>(std::clamp<int64_t>(at, 0, count - 1));
    }
    const int64_t period = wrap == Wrap::mirror ? 2 * count : count;
    const int64_t inside = (at % period + period) % period;
    return static_cast<uint32_t>(inside < count ? inside : period - 1 - inside);
}

/// Value of a normal map at a point, as a vector in its tangent frame; filtered between four texels.
glm::dvec3 mapped_normal(const Scene& scene, const Material& material, const glm::dvec2& uv)
{
    const TextureRef& reference = material.normal_texture;
    const Texture& texture = scene.textures[reference.texture];
    const glm::dvec2 size(texture.image.width, texture.image.height);
    const glm::dvec2 at = glm::dvec2(glm::dmat3(reference.uv_transform) * glm::dvec3(uv, 1.0)) * size - 0.5;
    if (!(std::abs(at.x) < 1e9 && std::abs(at.y) < 1e9)) {
        return {0.0, 0.0, 1.0};
    }
    const glm::dvec2 first = glm::floor(at);
    const glm::dvec2 share = at - first;
    glm::dvec3 sum(0.0);
    for (int64_t k = 0; k < 4; ++k) {
        const uint32_t x =
            wrapped(static_cast<int64_t>(first.x) + k % 2, texture.image.width, texture.wrap_u);
        const uint32_t y =
            wrapped(static_cast<int64_t>(first.y) + k / 2, texture.image.height, texture.wrap_v);
        const double weight = (k % 2 == 0 ? 1.0 - share.x : share.x) * (k / 2 == 0 ? 1.0 - share.y : share.y);
        const uint8_t* texel = &texture.image.rgba[4 * (static_cast<size_t>(y) * texture.image.width + x)];
        sum += weight * (glm::dvec3(texel[0], texel[1], texel[2]) / 127.5 - 1.0);
    }
    const auto scale = static_cast<double>(material.normal_scale);
    return {scale * sum.x, scale * sum.y, sum.z};
}

} // namespace

Detail::Detail(const Scene& scene, Corners corners)
    : scene_(scene), corners_(std::move(corners)), rays_(build_rays(corners_.positions))
{
}

std::optional<glm::dvec3> Detail::normal_along(const glm::vec3& from, const glm::vec3& direction,
                                               float reach_m) const
{
    constexpr int most_passed = 64;
    constexpr float step_on = 1.0F + 1e-6F;
    RTCRayHit found{};
    found.ray = ray_of(from, direction, reach_m);
    std::optional<glm::dvec3> back;
    for (int passed = 0; passed < most_passed; ++passed) {
        found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        intersect(static_cast<RTCScene>(rays_.get()), found);
        if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            break;
        }
        const glm::vec3* corner = &corners_.positions[3 * static_cast<size_t>(found.hit.primID)];
        const glm::vec3 plane = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const glm::dvec3 weights(1.0F - found.hit.u - found.hit.v, found.hit.u, found.hit.v);
        if (glm::dot(plane, direction) < 0.0F) {
            return normal_at(found.hit.primID, weights);
        }
        if (!back && scene_.materials[corners_.materials[found.hit.primID]].double_sided) {
            back = -normal_at(found.hit.primID, weights);
        }
        found.ray.tnear = found.ray.tfar * step_on + 1e-6F * reach_m;
        found.ray.tfar = reach_m;
    }
    return back;
}

glm::dvec3 Detail::normal_at(uint32_t triangle, const glm::dvec3& weights) const
{
    const glm::dvec3 sum = between(corners_.normals, triangle, weights);
    const glm::dvec3 normal = glm::dot(sum, sum) > 0.0 ? glm::normalize(sum) : sum;
    const Material& material = scene_.materials[corners_.materials[triangle]];
    if (material.normal_texture.texture == no_index) {
        return normal;
    }
    const glm::dvec3 bent = triangle_frame(corners_, triangle, normal) *
                            mapped_normal(scene_, material, between(corners_.uvs, triangle, weights));
    return glm::dot(bent, bent) > 0.0 ? glm::normalize(bent) : normal;
}

} // namespace estampe::bake
