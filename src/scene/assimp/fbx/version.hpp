// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace estampe::fbx {

/// Throws Error naming the file when it says that it is of a version before 7.1, which has another structure.
void check_version(const std::filesystem::path& path);

} // namespace estampe::fbx
