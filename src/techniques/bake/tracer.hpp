// SPDX-License-Identifier: MIT
#pragma once

// Path tracing through static triangles, and the properties of the surfaces that rays hit.

#include <memory>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "core/hash.hpp"
#include "scene/charts/charts.hpp"
#include "scene/static_triangles.hpp"
#include "techniques/bake/bake.hpp"

namespace estampe::bake {

/// The triangles of a scene with their materials, for ray hits. Scene and triangles must outlive this
/// `Surfaces` object.
class Surfaces {
public:
    Surfaces(const Scene& scene, const StaticTriangles& triangles);

    [[nodiscard]] size_t count() const { return material_of_.size(); }

    [[nodiscard]] glm::vec3 place(uint32_t triangle, const glm::vec2& weights) const;

    /// Unit normal of the triangle's plane, on the side to which the vertex normals point.
    [[nodiscard]] glm::vec3 plane_normal(uint32_t triangle) const { return plane_normals_[triangle]; }

    /// Unit normal, interpolated between the triangle's vertices.
    [[nodiscard]] glm::vec3 smooth_normal(uint32_t triangle, const glm::vec2& weights) const;

    [[nodiscard]] float area_m2(uint32_t triangle) const { return areas_m2_[triangle]; }

    [[nodiscard]] const Material& material(uint32_t triangle) const
    {
        return scene_.materials[material_of_[triangle]];
    }

    /// Share of light that the surface reflects, per colour channel.
    [[nodiscard]] glm::vec3 albedo(uint32_t triangle, const glm::vec2& weights) const;

    /// Radiance that the triangle's front face emits.
    [[nodiscard]] glm::vec3 glow(uint32_t triangle, const glm::vec2& weights) const;

    /// Opacity of the surface: from the texture for masked and transparent materials, else 1.
    [[nodiscard]] float cover(uint32_t triangle, const glm::vec2& weights) const;

    /// Whether any triangle is masked or transparent, so that rays may pass through the triangle.
    [[nodiscard]] bool lets_rays_pass() const { return lets_rays_pass_; }

    /// Whether a triangle takes light from a lightmap; transparent and unlit triangles do not.
    [[nodiscard]] bool receives(uint32_t triangle) const
    {
        return material(triangle).alpha_mode != AlphaMode::blend && !material(triangle).unlit;
    }

    /// Light links of a triangle: the intersection of the links of its node and of its material.
    [[nodiscard]] const LightLinks& links(uint32_t triangle) const { return links_of_[triangle]; }

    /// Whether any triangle has light links other than the default.
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

/// Random numbers from 0 to below 1. Each path has its own sequence: Steele, Lea and Flood, "Fast Splittable
/// Pseudorandom Number Generators", 2014.
class Random {
public:
    explicit Random(uint64_t seed) : state_(seed) {}

    float next()
    {
        state_ += 0x9E3779B97F4A7C15ULL;
        return static_cast<float>(Hash::mixed(state_) >> 40U) * 0x1p-24F;
    }

private:
    uint64_t state_;
};

/// The light that one path contributes to its texel.
struct Arrival {
    glm::vec3 light{0.0F};   ///< estimate of the irradiance over pi
    bool saw_a_back = false; ///< the path first hit a back face, as happens inside a closed object
};

/// Traces light paths. The tracer's functions change no state, so any number of threads may call them.
class Tracer {
public:
    /// `surfaces` and `settings` must outlive the tracer.
    Tracer(const StaticTriangles& triangles, const Surfaces& surfaces, const BakeSettings& settings);

    /// Traces one path from a lightmap texel and returns its light. `first` chooses the path's first
    /// direction and should be spread evenly over the paths of a texel.
    [[nodiscard]] Arrival follow(const charts::Texel& texel, const glm::vec2& first, Random& random) const;

private:
    struct Hit {
        uint32_t triangle = 0;
        glm::vec2 weights{0.0F};
        float distance_m = 0.0F;
    };

    /// A point where a light path meets a surface.
    struct Vertex {
        glm::vec3 place;
        glm::vec3 normal; ///< shading normal, for the cosine of incidence
        glm::vec3 plane;  ///< normal of the triangle's plane on the visible side
        LightLinks links;
    };

    /// Finds the nearest hit of a ray among the triangles that cast shadows for the groups `casters`; without
    /// `casters`, among all triangles.
    [[nodiscard]] std::optional<Hit> nearest(const glm::vec3& from, const glm::vec3& direction, float reach_m,
                                             Random& random,
                                             std::optional<Groups> casters = std::nullopt) const;
    [[nodiscard]] bool blocked(const glm::vec3& from, const glm::vec3& direction, float reach_m,
                               Random& random, std::optional<Groups> casters = std::nullopt) const;
    [[nodiscard]] glm::vec3 from_lamps(const Vertex& vertex, bool baked_alone, Random& random) const;
    [[nodiscard]] glm::vec3 from_glow(const Vertex& vertex, Random& random) const;
    [[nodiscard]] float glow_density(uint32_t triangle, const glm::vec3& direction, float distance_m) const;
    [[nodiscard]] glm::vec3 glow_towards(const Hit& hit, const glm::vec3& direction) const;

    const Surfaces& surfaces_;
    const BakeSettings& settings_;
    std::shared_ptr<void> rays_; ///< the Embree scene with all triangles
    std::vector<uint32_t> glowing_;
    /// Cumulative power of the triangles in `glowing_`, for choosing a glowing triangle by its power.
    std::vector<float> glow_sums_;
    /// Emitted brightness per square metre of each triangle; empty if nothing glows.
    std::vector<float> glow_of_triangle_;
    float lift_m_ = 0.0F; ///< distance from a surface at which rays start, against self-intersection
};

} // namespace estampe::bake
