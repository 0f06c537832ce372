// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::dae {

/// A COLLADA document rewritten for Assimp, and the data that Assimp would lose.
struct Document {
    std::string text;                ///< UTF-8
    std::vector<SceneCamera> lenses; ///< by lens_index() of the cameras that Assimp reads from `text`
    std::optional<double> frames_per_s;
    std::optional<double> unit_m; ///< metres per unit, if the file says so
    bool moved_vertices = false;  ///< vertices to the origin, their nodes by the opposite offset
    double start_s = 0.0;         ///< start of the document's time range
};

/// Reads a .dae file in any encoding that XML allows, and rewrites it for Assimp: numbers are separated by
/// single blanks and cameras are numbered. Vertices far from the origin are moved to it, and their nodes by
/// the opposite offset, because Assimp stores floats and would lose digits. Throws Error without a place when
/// the file is not XML.
[[nodiscard]] Document read_document(const std::filesystem::path& path);

/// Index into Document::lenses of a camera, which read_document() stored in the camera's far plane.
[[nodiscard]] size_t lens_index(double far_plane);

} // namespace estampe::dae
