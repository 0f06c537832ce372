// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "scene/assimp/transfer.hpp"

namespace estampe {

/// Reads `path` with Assimp and puts what it found into our terms. Runs in the child process: it may crash or
/// hang on a hostile file. Geometry is passed on as it is, vertices of a face unshared, normals only where
/// the file has them. Throws Error or std::bad_alloc.
[[nodiscard]] TransferScene read_with_assimp(const std::filesystem::path& path);

} // namespace estampe
