// SPDX-License-Identifier: MIT
#pragma once

// The temple in the sand: a half-buried prison in a desert of dunes, generated procedurally from one seed.

#include <cstdint>

#include <estampe/scene.hpp>

namespace temple {

/// Builds the whole scene: desert, stones, lights, flags, and a camera for each viewpoint. The same seed
/// gives the same scene. Cost: about a second.
[[nodiscard]] estampe::Scene build_temple(uint64_t seed);

} // namespace temple
