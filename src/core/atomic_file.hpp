// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

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

} // namespace estampe
