// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

namespace estampe {

/// Compares what the head of a PLY file promises with the file's size: Assimp believes any count and fills it
/// up. Throws Error naming file and line when an element cannot fit, or when there is no head at all.
void check_ply_header(const std::filesystem::path& path, uint64_t file_bytes);

} // namespace estampe
