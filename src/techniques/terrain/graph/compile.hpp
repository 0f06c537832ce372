// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/terrain.hpp>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

/// Turns the nodes of a terrain into a program for its node "height": every name is followed, coordinates are
/// folded into places, constants into numbers, and what is asked for twice is computed once. Throws Error as
/// Terrain's constructor does. Cost: linear in what is asked for; textures are read.
[[nodiscard]] Program compile_program(const TerrainDescription& terrain);

} // namespace estampe::terrain
