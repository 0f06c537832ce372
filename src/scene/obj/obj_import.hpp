// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads a Wavefront OBJ file with its material libraries and their pictures.
///
/// Each object (`o`) is a node, and each group (`g`) a node within its object; a primitive is what one of
/// them has of one material. Coordinates are read as doubles; those that lie far off get an origin of their
/// own, which becomes their node's translation. Polygons are cut into triangles. Normals that the file does
/// not give follow its smoothing groups, or the shape where it has none. Colours of vertices are sRGB. All
/// materials are double-sided, as the format does not tell. What cannot be read is counted in
/// Scene::warnings. Throws Error naming the file when nothing is left to draw. Cost: about 1 s for a million
/// triangles.
[[nodiscard]] Scene load_obj(const std::filesystem::path& path);

/// The same of a file in memory, without its libraries; `name` is for messages.
[[nodiscard]] Scene load_obj_bytes(std::span<const std::byte> bytes, const std::string& name);

} // namespace estampe
