// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe {

/// Finds the files that a scene file names: its pictures and material libraries.
///
/// Scene files come from other machines, so a name is only a hint. Backslashes are slashes, quotes and blanks
/// around it do not count, and neither does the case of letters, in any folder of the path. Each folder of
/// the list is searched for the path as it is given, then for shorter and shorter ends of it, down to the
/// file name alone. Of an absolute path only such ends are looked for: the path itself is never opened. Only
/// regular files that are not empty are found: a pipe or a device could be waited for without end, and the
/// files of /proc have no size.
///
/// Folders are listed once and remembered, so that a thousand names cost no more than a few. Not safe for
/// several threads at once.
class FileFinder {
public:
    /// `folders` are searched in this order; an empty path is the current folder.
    explicit FileFinder(const std::vector<std::filesystem::path>& folders);

    /// Where the file is; nothing when it is in none of the folders.
    [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view name);

    /// Searches this folder too, after the others; does nothing when it is in the list already.
    void add_folder(const std::filesystem::path& folder);

private:
    using Names = std::vector<std::string>;

    [[nodiscard]] std::optional<std::filesystem::path> find_spelled(std::string_view name);
    [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& folder,
                                                               const Names& parts, size_t first);
    [[nodiscard]] std::optional<std::string> actual_name(const std::filesystem::path& folder,
                                                         const std::string& name);

    std::vector<std::filesystem::path> folders_;
    std::map<std::filesystem::path, std::map<std::string, std::string>> listings_;
};

/// Where the picture of a texture comes from: a file, or the bytes of one inside the scene's own file.
struct ImageSource {
    std::string file;
    std::vector<std::byte> bytes;
};

/// Reads the pictures of the scene's textures, one source per texture; textures that have a picture keep it.
/// A picture that cannot be found or read becomes one white pixel, with a warning that names it. A file that
/// several textures name is decoded once.
void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, FileFinder& finder);

} // namespace estampe
