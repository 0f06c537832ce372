// SPDX-License-Identifier: MIT
#pragma once

// How the temple's things are put together: shapes, each of one stuff, gathered into meshes.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

namespace temple {

enum class Stuff : estampe::Index { stone, paving, marble, dark, iron, flame, red };

/// The materials, in the order of Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

/// The way strokes run over a flat face: along `along`, with `up` to their left, both unit.
struct Grain {
    glm::vec3 along{1.0F, 0.0F, 0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    glm::vec2 offset_m{0.0F}; ///< strokes of two stones begin at two places
};

/// Gathers shapes of one thing. Of some faces it says which edges a pen would draw.
class Kit {
public:
    /// A shape whose folds are drawn where they are sharp.
    void add(Stuff stuff, const estampe::Primitive& shape, const glm::mat4& placed = glm::mat4(1.0F));

    /// Adds all of `other`, placed.
    void add(const Kit& other, const glm::mat4& placed = glm::mat4(1.0F));

    /// A convex flat face, counter-clockwise from outside, of which the edges from corner k to the next are
    /// drawn where bit k of `drawn` is set, and no others. Its shading may lean away from its plane.
    void add_face(Stuff stuff, std::span<const glm::vec3> corners, const glm::vec3& normal,
                  const Grain& grain, uint32_t drawn);

    [[nodiscard]] estampe::Mesh mesh(const std::string& name) const;
    [[nodiscard]] size_t triangles() const;

private:
    /// Of one stuff, apart where edges are marked: there no others are drawn.
    std::map<std::pair<Stuff, bool>, estampe::Primitive> parts_;
};

/// Moves to a place after a turn about the y axis, counter-clockwise from above.
[[nodiscard]] glm::mat4 at(const glm::vec3& place, float turn_deg = 0.0F);

/// A rod with round ends from `a` to `b`, as limbs and poles are.
[[nodiscard]] estampe::Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b,
                                     uint32_t segments = 12);

/// A block whose strokes run level, with all its edges drawn, or only those on which the light breaks.
void add_block(Kit& kit, Stuff stuff, const glm::vec3& low, const glm::vec3& high);

} // namespace temple
