// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads a PLY file, text or binary: faces, triangle strips and edges, or else its vertices as points.
///
/// Colours of vertices and faces are sRGB. Texture coordinates may belong to vertices or to corners of faces;
/// pictures are those that comments name as TextureFile. Coordinates that lie far off get an origin of their
/// own, the node's translation. What other elements and properties hold is passed over. A file that ends
/// early is drawn as far as it goes, with a line in Scene::warnings that says how much is missing. Throws
/// Error naming the file when nothing is left to draw. Cost: about 0.5 s for a million triangles.
[[nodiscard]] Scene load_ply(const std::filesystem::path& path);

/// The same of a file in memory, without its pictures; `name` is for messages.
[[nodiscard]] Scene load_ply_bytes(std::span<const std::byte> bytes, const std::string& name);

} // namespace estampe
