// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

/// Warns when nothing of the scene can be in the picture that `camera` takes of it, unless the program placed
/// it.
void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera);

} // namespace estampe::app
