// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe::dae {

/// A COLLADA document rewritten for Assimp, and the data that Assimp would lose.
struct Document {
    std::string text; ///< text of the document in UTF-8
    /// Lenses of all cameras; the index is lens_index() of a camera that Assimp reads from `text`.
    std::vector<SceneCamera> lenses;
    std::optional<double> frames_per_s;
    std::optional<double> unit_m; ///< metres per unit of length; not set if the file does not give it
    bool moved_vertices = false;  ///< vertices were moved to the origin, and nodes by the opposite offset
    double start_s = 0.0;         ///< start of the document's time range
};

/// Reads a .dae file in any encoding that XML allows, and rewrites it for Assimp: numbers are separated by
/// single blanks, and cameras are numbered. Assimp stores coordinates as floats, which are imprecise far from
/// the origin. Therefore vertices far from the origin are moved to the origin, and their nodes by the
/// opposite offset. Throws Error without a place when the file is not XML.
[[nodiscard]] Document read_document(const std::filesystem::path& path, const ReadScope& scope);

/// Returns the index of a camera in Document::lenses. read_document() has stored this index as the far plane
/// of the camera.
[[nodiscard]] size_t lens_index(double far_plane);

} // namespace estampe::dae
