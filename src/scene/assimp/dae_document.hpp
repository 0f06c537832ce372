// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::dae {

/// A COLLADA document as Assimp reads it best, and what Assimp would lose.
struct Document {
    std::string text;                ///< UTF-8
    std::vector<SceneCamera> lenses; ///< by lens_index() of the cameras that Assimp makes of `text`
    std::optional<double> frames_per_s;
    std::optional<double> unit_m; ///< metres per unit, if the file says so
    bool moved_vertices = false;  ///< to the origin, and their nodes the other way
    double start_s = 0.0;         ///< of the time range
};

/// Reads a .dae file in any encoding that XML allows, and rewrites it for Assimp: numbers are separated by
/// single blanks, vertices far from the origin are moved there and their nodes the other way, so that no
/// digit is lost where Assimp stores floats, and cameras are numbered. Throws Error without a place when it
/// is not XML.
[[nodiscard]] Document read_document(const std::filesystem::path& path);

/// Which of the lenses a camera has, by the far plane that Assimp found.
[[nodiscard]] size_t lens_index(double far_plane);

} // namespace estampe::dae
