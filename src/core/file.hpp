// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace estampe {

/// The extension of a file's name in small letters, with its dot; empty when it has none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// Reads a whole regular file. Throws Error naming it when it is missing, is a folder, pipe or device, cannot
/// be read, or is longer than `max_bytes`.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               uint64_t max_bytes = std::numeric_limits<uint64_t>::max());

/// Gives `write` the name of a new, empty file beside `path`, then renames it to `path`, so that readers see
/// the old file or the whole new one. When `write` throws, the new file is removed and the exception goes on.
/// Throws Error when the folder does not exist or cannot be written.
void write_file_atomically(const std::filesystem::path& path,
                           const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same, for bytes at hand.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

} // namespace estampe
