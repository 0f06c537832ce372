// SPDX-License-Identifier: MIT
#pragma once

// Confinement of reading: limits the files that scenes, styles and terrains of strangers can name.

#include <filesystem>
#include <vector>

namespace estampe {

/// Folders below which files may be read.
///
/// A scene, a style or a terrain names further files, such as textures. Within a limited scope, a file is
/// only opened if it lies below one of the folders and the path from that folder to the file contains neither
/// ".." nor a symbolic link. The check and the opening are one step, so that a link that is placed meanwhile
/// is not followed either. Any other file is refused with an Error, also where a missing file is only a
/// warning. Folders are given by the program or its user, so their own paths may contain symbolic links.
struct ReadScope {
    std::vector<std::filesystem::path> folders; ///< Absolute or relative paths; empty: no limit

    /// Returns the scope of the folder that contains `file`.
    [[nodiscard]] static ReadScope beside(const std::filesystem::path& file)
    {
        return {{file.has_parent_path() ? file.parent_path() : std::filesystem::path(".")}};
    }

    [[nodiscard]] bool is_limited() const { return !folders.empty(); }

    bool operator==(const ReadScope&) const = default;
};

} // namespace estampe
