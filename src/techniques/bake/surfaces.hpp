// SPDX-License-Identifier: MIT
#pragma once

// What rays find: places, normals and colours of the still triangles.

#include <vector>

#include <estampe/scene.hpp>

#include "scene/static_triangles.hpp"

namespace estampe::bake {

/// The triangles of a scene with the materials they wear. Scene and triangles must outlive it.
class Surfaces {
public:
    Surfaces(const Scene& scene, const StaticTriangles& triangles);

    [[nodiscard]] size_t count() const { return material_of_.size(); }

    [[nodiscard]] glm::vec3 place(uint32_t triangle, const glm::vec2& weights) const;

    /// Unit normal of the plane, on the side that the vertices' normals point to.
    [[nodiscard]] glm::vec3 plane_normal(uint32_t triangle) const { return plane_normals_[triangle]; }

    /// Unit normal between those of the vertices.
    [[nodiscard]] glm::vec3 smooth_normal(uint32_t triangle, const glm::vec2& weights) const;

    [[nodiscard]] float area_m2(uint32_t triangle) const { return areas_m2_[triangle]; }

    [[nodiscard]] const Material& material(uint32_t triangle) const
    {
        return scene_.materials[material_of_[triangle]];
    }

    /// Share of light that is thrown back, by channel.
    [[nodiscard]] glm::vec3 albedo(uint32_t triangle, const glm::vec2& weights) const;

    /// Radiance that the front gives off.
    [[nodiscard]] glm::vec3 glow(uint32_t triangle, const glm::vec2& weights) const;

    /// Cover of masked and see-through materials, 1 of all others.
    [[nodiscard]] float cover(uint32_t triangle, const glm::vec2& weights) const;

    /// Whether rays may pass some triangle.
    [[nodiscard]] bool lets_rays_pass() const { return lets_rays_pass_; }

    /// Whether a triangle takes light from a map: what is looked through, and what is unlit, does not.
    [[nodiscard]] bool receives(uint32_t triangle) const
    {
        return material(triangle).alpha_mode != AlphaMode::blend && !material(triangle).unlit;
    }

    /// How a triangle stands to lamps: its node's word and its material's, whichever allows less.
    [[nodiscard]] const LightLinks& links(uint32_t triangle) const { return links_of_[triangle]; }

    /// Whether some triangle does not stand to all lamps as all others do.
    [[nodiscard]] bool has_links() const { return has_links_; }

private:
    [[nodiscard]] glm::vec4 texel(const TextureRef& reference, uint32_t triangle,
                                  const glm::vec2& weights) const;

    const Scene& scene_;
    const StaticTriangles& triangles_;
    std::vector<Index> material_of_;
    std::vector<LightLinks> links_of_;
    std::vector<glm::vec3> plane_normals_;
    std::vector<float> areas_m2_;
    bool lets_rays_pass_ = false;
    bool has_links_ = false;
};

} // namespace estampe::bake
