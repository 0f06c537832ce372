// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads an STL file, text or binary. Each solid of a text is a node.
///
/// Normals are computed from the shape: those of the file only say that facets are flat. Colours of facets
/// are read as VisCAM and Materialise write them, and are sRGB. Coordinates that lie far off get an origin of
/// their own, the node's translation. A file that ends early is drawn as far as it goes, with a line in
/// Scene::warnings that says how much is missing. Throws Error naming the file when nothing is left to draw.
/// Cost: about 0.7 s for a million triangles.
[[nodiscard]] Scene load_stl(const std::filesystem::path& path);

/// The same of a file in memory; `name` is for messages.
[[nodiscard]] Scene load_stl_bytes(std::span<const std::byte> bytes, const std::string& name);

} // namespace estampe
