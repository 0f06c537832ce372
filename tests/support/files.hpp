// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace estampe::test {

/// The root of the source tree.
[[nodiscard]] std::filesystem::path source_folder();

/// The folder of the golden pictures.
[[nodiscard]] std::filesystem::path golden_folder();

/// The scene of the demo, which the build generates.
[[nodiscard]] std::filesystem::path square_scene();

} // namespace estampe::test
