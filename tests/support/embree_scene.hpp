// SPDX-License-Identifier: MIT
#pragma once

// The triangles of a scene for rays: the ground truth of shadows, occlusion and light.

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/pose.hpp"

namespace estampe::test {

/// Rays against a scene at a moment, in world space, from either side of each triangle. May be asked from
/// many threads at once.
class EmbreeScene {
public:
    /// What a ray met first.
    struct Hit {
        double distance_m = 0.0; ///< along the unit direction
        glm::dvec3 normal{0.0};  ///< unit, of the triangle, on its counter-clockwise side
        Index node = no_index;
        const Primitive* primitive = nullptr;
        uint32_t triangle = 0;  ///< of the primitive
        glm::dvec2 weight{0.0}; ///< of its second and third corner
    };

    /// Takes the triangles of every primitive that `counts`, or of all. `scene` must outlive this.
    explicit EmbreeScene(const Scene& scene, double time_s = 0.0,
                         const std::function<bool(const PosedPrimitive&)>& counts = {});
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Whether anything lies on the ray before `far_m`. `direction` is a unit vector.
    [[nodiscard]] bool is_blocked(const glm::dvec3& from, const glm::dvec3& direction,
                                  double far_m = std::numeric_limits<double>::infinity()) const;
    /// Whether anything lies between two points, ends apart.
    [[nodiscard]] bool is_between(const glm::dvec3& from, const glm::dvec3& to) const;
    [[nodiscard]] std::optional<Hit> first_hit(const glm::dvec3& from, const glm::dvec3& direction,
                                               double far_m = std::numeric_limits<double>::infinity()) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe::test
