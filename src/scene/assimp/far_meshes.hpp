// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// Adds a warning when meshes lie so far from their origin that the floats which their vertices have been
/// read as coarsen their shape.
void warn_of_far_meshes(Scene& scene);

/// Adds a warning when nodes are moved so far, in floats, that they stand imprecisely beside each other.
/// `scene` is one whose nodes have been read as floats.
void warn_of_far_nodes(Scene& scene);

} // namespace estampe
