// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace estampe {

/// Throws Error when a file cannot be written to `output`: no such folder, no right to write there, a folder
/// in its place, or when it is one of the `inputs`. Nothing at `output` is touched.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

} // namespace estampe
