// SPDX-License-Identifier: MIT
#pragma once

// Ray queries against the triangles of a scene: the ground truth of shadows, occlusion and light.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/pose.hpp"

namespace estampe::test {

/// Rays against a scene at one time, in world space. Rays hit both sides of each triangle. Thread-safe.
class EmbreeScene {
public:
    /// The first triangle that a ray hits.
    struct Hit {
        double distance_m = 0.0; ///< along the unit direction
        glm::dvec3 normal{0.0};  ///< unit normal of the triangle, on its counter-clockwise side
        Index node = no_index;
        const Primitive* primitive = nullptr;
        uint32_t triangle = 0;  ///< index in the primitive
        glm::dvec2 weight{0.0}; ///< barycentric weights of the triangle's second and third corner
    };

    /// Takes the triangles of every primitive for which `counts` returns true; of all primitives if `counts`
    /// is empty. `scene` must outlive this object.
    explicit EmbreeScene(const Scene& scene, double time_s = 0.0,
                         const std::function<bool(const PosedPrimitive&)>& counts = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Whether a triangle is on the ray nearer than `far_m`. `direction` is a unit vector.
    [[nodiscard]] bool is_blocked(const glm::dvec3& from, const glm::dvec3& direction,
                                  double far_m = std::numeric_limits<double>::infinity()) const;
    /// Whether a triangle is between two points. Triangles at the end points do not count.
    [[nodiscard]] bool is_between(const glm::dvec3& from, const glm::dvec3& to) const;
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& from, const glm::dvec3& direction,
                                               double far_m = std::numeric_limits<double>::infinity()) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe::test
