// SPDX-License-Identifier: MIT
#pragma once

// How the square's things are put together: shapes, each of one stuff, gathered into meshes.

#include <vector>

#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>

namespace square {

using Kit = estampe::shapes::MeshBuilder;
using estampe::shapes::at;
using estampe::shapes::rod;

enum class Stuff : estampe::Index { sand, stone, plaster, marble, shutter, red, iron, brick, steam };

/// The materials, in the order of Stuff.
[[nodiscard]] std::vector<estampe::Material> materials();

} // namespace square
