// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::viewer {

/// What one can stand on in a scene: the upper sides of what never moves.
class Ground {
public:
    /// Cost: linear in triangles.
    explicit Ground(const Scene& scene);

    /// Height of the first surface straight below a place; nothing where there is none. Cost: linear in
    /// triangles that are not upright, about a millisecond for half a million.
    [[nodiscard]] std::optional<double> height_under(const glm::dvec3& place) const;

private:
    glm::dvec3 anchor_{0.0};
    std::vector<std::array<glm::vec3, 3>> triangles_;
};

} // namespace estampe::viewer
