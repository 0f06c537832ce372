// SPDX-License-Identifier: MIT
#pragma once

#include <estampe/scene.hpp>

namespace estampe {

/// The point that is subtracted from the coordinates of a whole file before they become floats: zero, but a
/// whole number near the centre when they lie more than sixteen times their extent away from zero. Floats
/// hold less than a millionth of the extent there.
[[nodiscard]] glm::dvec3 file_origin(const Bounds& bounds);

/// The same for one object of a file whose own origin is `file`: an object that is tiny beside its distance
/// has an origin of its own.
[[nodiscard]] glm::dvec3 object_origin(const Bounds& bounds, const glm::dvec3& file);

/// Whether a coordinate can be drawn: finite, and its square within the range of floats.
[[nodiscard]] bool is_usable(const glm::dvec3& position);

} // namespace estampe
