// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Turns over what a file has inside out: two-sided pieces of meshes that are closed and wound one way all
/// over, with their backs to the outside. What is one-sided stays, since its winding says what may be seen. A
/// piece with other things inside, but for such as it is itself, is a room and stays. Adds a line to
/// Scene::warnings for each mesh. Cost: about 0.01 s for 70,000 triangles that are all right.
void turn_outside(Scene& scene);

} // namespace estampe
