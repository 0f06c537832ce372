// SPDX-License-Identifier: MIT
#pragma once

// Shapes and materials of the objects on the square. Each shape has one material and is added to a mesh.

#include <vector>

#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>

namespace square {

using Kit = estampe::shapes::MeshBuilder;
using estampe::shapes::at;
using estampe::shapes::rod;

enum class Stuff : estampe::Index { sand, stone, plaster, marble, shutter, red, iron, brick, steam };

/// The materials, in the order of the enum Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

} // namespace square
