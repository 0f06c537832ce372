// SPDX-License-Identifier: MIT
#pragma once

// Paths of light through still triangles.

#include <memory>
#include <optional>
#include <vector>

#include "core/hash.hpp"
#include "scene/charts/charts.hpp"
#include "techniques/bake/bake.hpp"
#include "techniques/bake/surfaces.hpp"

namespace estampe::bake {

/// Numbers from 0 to below 1, in a row of their own for each path: Steele, Lea and Flood, "Fast Splittable
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

/// What arrives along one path.
struct Arrival {
    glm::vec3 light{0.0F};   ///< an estimate of irradiance over pi
    bool saw_a_back = false; ///< the first surface turned its back, as those around an enclosed place do
};

/// Stateless but for what it is built of, so any number of threads may trace.
class Tracer {
public:
    /// `surfaces` and `settings` must outlive it.
    Tracer(const StaticTriangles& triangles, const Surfaces& surfaces, const BakeSettings& settings);

    /// One path from a texel. `first` chooses its first direction and should spread evenly over the paths of
    /// a texel.
    [[nodiscard]] Arrival follow(const charts::Texel& texel, const glm::vec2& first, Random& random) const;

private:
    struct Hit {
        uint32_t triangle = 0;
        glm::vec2 weights{0.0F};
        float distance_m = 0.0F;
    };

    /// A place on a surface and the side of it that is looked at.
    struct Vertex {
        glm::vec3 place;
        glm::vec3 normal; ///< of the cosine
        glm::vec3 plane;  ///< of what may be seen
        LightLinks links;
    };

    /// Of the triangles that throw shadows for one of `casters`, or of all.
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
    std::shared_ptr<void> rays_; ///< the scene as Embree has it
    std::vector<uint32_t> glowing_;
    std::vector<float> glow_sums_;        ///< running sum of the power of `glowing_`
    std::vector<float> glow_of_triangle_; ///< brightness a square metre; empty where nothing glows
    float lift_m_ = 0.0F;                 ///< how far rays start from a surface
};

} // namespace estampe::bake
