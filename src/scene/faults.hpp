// SPDX-License-Identifier: MIT
#pragma once

// Checks of scenes that did not come from a reader of this library: that a program made, or that another
// process sent.

#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Returns those of the faults(scene) that would make code which draws the scene read outside of an array or
/// run forever: indices out of range, arrays whose lengths disagree, and nodes that form no forest. Cost:
/// linear in indices and nodes, about 1 ms for a million triangles.
[[nodiscard]] std::vector<std::string> structural_faults(const Scene& scene);

/// Throws Error that names the first of the faults(scene), if there is one. `where` is the place of the
/// Error.
void require_no_faults(const Scene& scene, const std::string& where);

} // namespace estampe
