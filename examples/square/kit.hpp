// SPDX-License-Identifier: MIT
#pragma once

// How the square's things are put together: shapes, each of one stuff, gathered into meshes.

#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace square {

enum class Stuff : estampe::Index { sand, stone, plaster, marble, shutter, red, iron, brick, steam };

/// The materials, in the order of Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

/// Gathers shapes of one thing, one primitive per stuff.
class Kit {
public:
    void add(Stuff stuff, const estampe::Primitive& shape, const glm::mat4& placed = glm::mat4(1.0F));

    /// Adds all of `other`, placed.
    void add(const Kit& other, const glm::mat4& placed);

    [[nodiscard]] estampe::Mesh mesh(const std::string& name) const;

private:
    std::map<Stuff, estampe::Primitive> parts_;
};

/// Moves to a place after a turn about the y axis, counter-clockwise from above.
[[nodiscard]] glm::mat4 at(const glm::vec3& place, float turn_degrees = 0.0F);

/// A rod with round ends from `a` to `b`, as limbs, poles and axles are.
[[nodiscard]] estampe::Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b,
                                     uint32_t segments = 16);

} // namespace square
