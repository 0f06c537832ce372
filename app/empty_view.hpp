// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include <estampe/renderer.hpp>

#include "options.hpp"

namespace estampe::app {

/// Warns when nothing of the scene can be in the picture that `camera` takes of it: nothing is in view, or
/// only backs of one-sided surfaces are, as from inside a solid. Does nothing when the program placed the
/// camera.
void warn_of_empty_view(const DrawOptions& draw, const Scene& scene, Index animation, const Camera& camera);

/// Warns when nothing of the scene can be in the picture at any of these moments of a film.
void warn_of_empty_film(const DrawOptions& draw, const Scene& scene, Index animation,
                        std::span<const Moment> moments);

} // namespace estampe::app
