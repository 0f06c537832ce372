// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/assimp/fbx/document.hpp"

namespace estampe::fbx {

/// The parts of a node's place, in the order in which they are multiplied:
/// translation, before_rotation, rotation, before_scale, scale, after_scale. Animations move the translation,
/// rotation and scale; the others hold pivots and fixed turns.
struct Parts {
    glm::dvec3 translation{0.0};
    glm::dmat4 before_rotation{1.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dmat4 before_scale{1.0};
    glm::dvec3 scale{1.0};
    glm::dmat4 after_scale{1.0};
    glm::dmat4 geometry{1.0}; ///< places what the node shows, but not its children

    [[nodiscard]] glm::dmat4 matrix() const;

    /// Whether translation, rotation and scale say it all.
    [[nodiscard]] bool is_plain() const;
};

[[nodiscard]] Parts parts_of(const Properties& model);

/// From the axes and the unit of the file to right-handed metres with y up.
[[nodiscard]] glm::dmat4 world_from_file(const Properties& settings);

/// Upward direction in the file's own axes.
[[nodiscard]] glm::dvec3 up_of_file(const Properties& settings);

/// How many metres a unit of the file is.
[[nodiscard]] double unit_m(const Properties& settings);

} // namespace estampe::fbx
