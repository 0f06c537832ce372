// SPDX-License-Identifier: MIT
#pragma once

// The detailed mesh of a normal map, which rays hit.

#include <cstdint>
#include <memory>
#include <optional>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "techniques/bake/normals/corners.hpp"

namespace estampe::bake {

/// Triangles with materials, for rays. Any number of threads may send rays.
class Detail {
public:
    /// Builds the tree of the triangles; `scene` has their materials and must outlive this object. Throws
    /// Error as build_rays() does.
    Detail(const Scene& scene, Corners corners);

    /// Returns the shading normal, a unit vector, of the first front face on a ray; without a front face, the
    /// reversed normal of the first back face of a two-sided material. The normal map of the material is
    /// included. `direction` is a unit vector.
    [[nodiscard]] std::optional<glm::dvec3> normal_along(const glm::vec3& from, const glm::vec3& direction,
                                                         float reach_m) const;

private:
    [[nodiscard]] glm::dvec3 normal_at(uint32_t triangle, const glm::dvec3& weights) const;

    const Scene& scene_;
    Corners corners_;
    std::shared_ptr<void> rays_; ///< the Embree scene of all triangles
};

} // namespace estampe::bake
