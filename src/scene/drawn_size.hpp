// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// What a scene comes to when every mesh is put everywhere it is shown.
struct DrawnSize {
    uint64_t vertices = 0;
    uint64_t triangles = 0; ///< lines and points count as many as they are drawn with
};

[[nodiscard]] DrawnSize drawn_size(const Scene& scene);

/// Throws Error when drawing the scene takes more memory than there is, or more vertices than 31 bits number:
/// a small file can show one mesh any number of times. `where` stands in the message, else the scene's name.
/// Cost: linear in nodes and primitives.
void check_drawn_size(const Scene& scene, const std::string& where = {});

} // namespace estampe
