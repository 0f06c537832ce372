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
/// Scene files come from other machines, so a name is only a hint. Backslashes count as slashes; quotes and
/// blanks around the name are ignored, and so is the case of letters in the whole path. Each folder of the
/// list is searched for the given path, then for ever shorter ends of it, down to the file name alone. For an
/// absolute path only such ends are tried: the path itself is never opened. Only regular files that are not
/// empty are found, because reading a pipe or a device could wait forever, and files of /proc have no size.
///
/// Folders are listed once and remembered, so that a thousand names cost little more than a few. Not
/// thread-safe.
class FileFinder {
public:
    /// `folders` are searched in this order; an empty path is the current folder.
    explicit FileFinder(const std::vector<std::filesystem::path>& folders);

    /// Path of the file; nothing when it is in none of the folders.
    [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view name);

    /// Also searches `folder`, after the others; does nothing if the folder is in the list already.
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

/// Source of a texture's picture: the name of a file, or the bytes of a picture inside the scene's own file.
struct ImageSource {
    std::string file;
    std::vector<std::byte> bytes;
};

/// Reads the pictures of the scene's textures, with one source per texture; textures that have a picture keep
/// it. A picture that cannot be found or read becomes one white pixel, with a warning that names it. A file
/// that several textures name is decoded once.
void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, FileFinder& finder);

} // namespace estampe
