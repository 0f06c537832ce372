// SPDX-License-Identifier: MIT
#pragma once

#include <pugixml.hpp>

namespace estampe::dae {

/// Moves vertices that lie far from their origin to it, and the nodes that show them the other way by as
/// much. The distance is one that a float holds exactly. What bends with a skeleton stays where it is.
/// Returns whether anything was moved.
bool move_to_origin(const pugi::xml_node& collada);

} // namespace estampe::dae
