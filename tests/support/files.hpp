// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace estampe::test {

/// The root of the source tree.
[[nodiscard]] std::filesystem::path source_folder();

/// Where golden pictures lie.
[[nodiscard]] std::filesystem::path golden_folder();

/// The scene of the demo, as the build makes it.
[[nodiscard]] std::filesystem::path square_scene();

} // namespace estampe::test
