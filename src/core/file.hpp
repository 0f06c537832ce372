// SPDX-License-Identifier: MIT
#pragma once

// Whole files in, and files and folders that appear all at once.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace estampe {

/// A file or a folder that is being made beside `target` under a name of its own. publish() gives it the name
/// that is meant, so that readers see what was there before or the whole new one; without that it goes with
/// the object.
class AtomicFile {
public:
    /// An empty file. Throws Error naming `target` when it is a folder, or its folder does not exist or
    /// cannot be written.
    [[nodiscard]] static AtomicFile file(const std::filesystem::path& target);

    /// A file of these bytes. Throws Error as well when the disk is full.
    [[nodiscard]] static AtomicFile file(const std::filesystem::path& target,
                                         std::span<const std::byte> bytes);

    /// An empty folder.
    [[nodiscard]] static AtomicFile folder(const std::filesystem::path& target);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    /// Where it lies until it is published.
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Throws Error when it cannot take the place of what is at `target`.
    void publish();

private:
    AtomicFile(std::filesystem::path target, std::filesystem::path path);

    std::filesystem::path target_;
    std::filesystem::path path_; ///< empty: published, or moved from
};

/// Removes all that is pending, in whichever thread, and lets nothing new begin: for a program that is about
/// to end.
void remove_all_pending() noexcept;

/// The extension of a file's name in small letters, with its dot; empty when it has none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// Reads a whole regular file. Throws Error naming it when it is missing, is a folder, pipe or device, cannot
/// be read, or is longer than `max_bytes`.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               uint64_t max_bytes = std::numeric_limits<uint64_t>::max());

/// Reads the first `most_bytes` of a regular file, or all of it where it is shorter. Throws Error naming it
/// when it is missing, is a folder, pipe or device, or cannot be read.
[[nodiscard]] std::vector<std::byte> read_file_start(const std::filesystem::path& path, uint64_t most_bytes);

/// Writes beside `path` first and renames, so that readers see the old file or the whole new one, see
/// AtomicFile. Throws Error when the folder does not exist or cannot be written, or the disk is full.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Throws Error when a file cannot be written to `output`: no such folder, no right to write there, a folder
/// in its place, or when it is one of the `inputs`. Nothing at `output` is touched.
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

/// The folder in which programs keep what they can make again: $XDG_CACHE_HOME, or ~/.cache. Empty when
/// neither is an absolute path.
[[nodiscard]] std::filesystem::path user_cache_folder();

} // namespace estampe
