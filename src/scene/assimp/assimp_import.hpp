// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads FBX and DAE through Assimp.
///
/// Assimp runs in a child process with limits on time and memory, so that a file which crashes or hangs it is
/// an Error here. What comes back is checked: indices, finite numbers, node tree; single bad triangles and
/// normals are repaired and named in Scene::warnings, and so are closed pieces that are inside out. Normals
/// are computed, smooth, where the file has none. All materials are double-sided, as these formats do not
/// tell. Throws Error naming the file.
[[nodiscard]] Scene load_with_assimp(const std::filesystem::path& path);

} // namespace estampe
