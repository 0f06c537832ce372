// SPDX-License-Identifier: MIT
#pragma once

// Reads whole files, and writes files and folders that appear only when they are complete.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <unistd.h>

#include <estampe/read_scope.hpp>

namespace estampe {

/// A file or folder that is written under a temporary name beside `target`. publish() renames it, so readers
/// see either the old content or the complete new one. Without publish() the destructor deletes it.
///
/// If `target` is a symbolic link, the file that it refers to is replaced and the link stays. A file that
/// replaces another has its permissions and, if the user may set them, its owner and group. The temporary
/// file is locked (flock) while this object exists, so that remove_left_parts() can tell it from those of
/// programs that were killed.
class AtomicFile {
public:
    /// Creates an empty temporary file. Throws Error that names `target` if it is a folder or a
    /// write-protected file, or if its folder does not exist or is not writable.
    [[nodiscard]] static AtomicFile file(const std::filesystem::path& target);

    /// Creates a temporary file with the given bytes. Throws Error as the overload without bytes does, and if
    /// the disk is full.
    [[nodiscard]] static AtomicFile file(const std::filesystem::path& target,
                                         std::span<const std::byte> bytes);

    /// Creates an empty temporary folder.
    [[nodiscard]] static AtomicFile folder(const std::filesystem::path& target);

    AtomicFile(AtomicFile&& other) noexcept;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    AtomicFile& operator=(AtomicFile&&) = delete;
    ~AtomicFile();

    /// Temporary path of the file or folder, valid until publish().
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

    /// Renames the temporary file or folder to `target`. Throws Error if the existing file or folder at
    /// `target` cannot be replaced.
    void publish();

    /// Publishes several files and folders: all of them, or none. If one cannot be renamed, those renamed
    /// before are put back as they were, and Error is thrown. On file systems that cannot exchange two names,
    /// a file that already replaced another one stays.
    static void publish_all(std::span<AtomicFile> files);

private:
    AtomicFile(std::filesystem::path target, std::filesystem::path path, int lock);

    /// Takes over the temporary file or folder `name`. If memory runs out, deletes `name`, closes `lock`, and
    /// throws std::bad_alloc. The caller holds the lock of the list of temporary files.
    [[nodiscard]] static AtomicFile taken(std::filesystem::path target, const std::string& name, int lock);

    std::filesystem::path target_;
    std::filesystem::path path_; ///< Temporary path; empty after publish() or after a move
    int lock_;                   ///< File descriptor that holds the lock; -1 after a move
};

/// Deletes the temporary files and folders that earlier programs left in `folder` because they were killed,
/// if `is_wanted` returns true for the name of the file that they were to become. Those of running programs
/// stay, and those younger than a few seconds.
void remove_left_parts(const std::filesystem::path& folder,
                       const std::function<bool(const std::string&)>& is_wanted);

/// Deletes the temporary files and folders of all threads, and blocks the creation of new ones. Only for a
/// program that is about to end.
void remove_all_pending() noexcept;

/// Returns the extension of a file name in lower case, with its dot; empty if there is none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// Limit for read_file() that allows files of any length.
inline constexpr uint64_t any_length = std::numeric_limits<uint64_t>::max();

/// Reads a whole regular file. Throws Error that names the file if it is missing, is a folder, pipe or
/// device, is unreadable, is longer than `max_bytes`, or lies outside of `scope`.
[[nodiscard]] std::vector<std::byte> read_file(const std::filesystem::path& path,
                                               uint64_t max_bytes = any_length, const ReadScope& scope = {});

/// Reads at most the first `most_bytes` of a regular file. Throws Error that names the file if it is missing,
/// is a folder, pipe or device, is unreadable, or lies outside of `scope`.
[[nodiscard]] std::vector<std::byte> read_file_start(const std::filesystem::path& path, uint64_t most_bytes,
                                                     const ReadScope& scope = {});

/// Writes a file: writes a temporary file beside `path` and renames it, so readers see the old file or the
/// complete new one; see AtomicFile. Throws Error if the folder does not exist or is not writable, or the
/// disk is full.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

/// Checks that a file can be written to `output`. Throws Error if the folder of `output` is missing or not
/// writable, if `output` is a folder itself, or if `output` is one of the `inputs`. Changes nothing at
/// `output`, but deletes what killed programs left beside it; see remove_left_parts().
void check_output(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

/// The user's cache folder: $XDG_CACHE_HOME, or ~/.cache. Empty if neither is an absolute path.
[[nodiscard]] std::filesystem::path user_cache_folder();

/// Creates the folder, and the folders above it, unless they exist. New folders are for the user alone,
/// whatever the user's umask. Throws std::filesystem::filesystem_error.
void make_private_folder(const std::filesystem::path& folder);

/// Returns why files in the folder cannot be trusted: the folder is a link, belongs to another user than
/// `user`, or is writable by other users. Empty if the files can be trusted, and if there is no such folder.
[[nodiscard]] std::string fault_of_private_folder(const std::filesystem::path& folder,
                                                  uid_t user = geteuid());

} // namespace estampe
