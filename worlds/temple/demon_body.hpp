// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/scene.hpp>

#include "dice.hpp"

namespace temple {

/// The joints of a demon's body: those of its strands one after the other, from the head down, then its two
/// eyes. As they are at rest, from the head.
[[nodiscard]] const std::vector<glm::vec3>& rest_joints();

/// The number of the first joint of a strand among them.
[[nodiscard]] size_t first_joint(int strand);

/// A hooded shape with a torn hem, sleeves and ribbons, of `ink`, and two eyes of `pale`, bent by those
/// joints. Its front is +z, and the head is at the origin.
[[nodiscard]] estampe::Mesh build_demon(Dice dice, estampe::Index ink, estampe::Index pale);

} // namespace temple
