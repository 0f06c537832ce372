// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <pugixml.hpp>

#include <estampe/scene.hpp>

namespace estampe::dae {

/// Reads the lenses of all cameras, in metres and radians, and puts in place of each a perspective one whose
/// far plane is its number, see lens_index(): Assimp knows no parallel projections, and makes a wrong angle
/// of a camera that has only a vertical one.
[[nodiscard]] std::vector<SceneCamera> number_cameras(const pugi::xml_node& collada);

} // namespace estampe::dae
