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

#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// Finds the pictures and material libraries that a scene file names.
///
/// Scene files come from other computers, so their paths are often not valid on this computer. Backslashes
/// count as slashes. Quotes and blanks around a path and the case of letters are ignored. Each folder is
/// searched for the whole path, then for shorter and shorter ends of the path, and at last for the file name
/// alone. An absolute path is never opened; only its ends are searched. Only regular files that are not empty
/// are found: reading a pipe or a device could wait forever, and files of /proc have no size.
///
/// The listing of each folder is cached, so that a thousand look-ups cost little more than a few. Not
/// thread-safe.
class FileFinder {
public:
    /// `folders` are searched in this order. An empty path means the current folder.
    explicit FileFinder(const std::vector<std::filesystem::path>& folders, ReadScope scope = {});

    /// Files outside of this scope are refused.
    [[nodiscard]] const ReadScope& scope() const { return scope_; }

    /// Returns the path of the file; nothing if no folder contains it. Throws OutsideScope if the scope is
    /// limited and the name leads out of it, by ".." or by a symbolic link.
    [[nodiscard]] std::optional<std::filesystem::path> find(std::string_view name);

    /// Appends `folder` to the folders that are searched. Does nothing if it is in the list already.
    void add_folder(const std::filesystem::path& folder);

private:
    using Names = std::vector<std::string>;

    [[nodiscard]] bool is_usable_file(const std::filesystem::path& path) const;

    [[nodiscard]] std::optional<std::filesystem::path> find_spelled(std::string_view name);
    [[nodiscard]] std::optional<std::filesystem::path> resolve(const std::filesystem::path& folder,
                                                               const Names& parts, size_t first);
    [[nodiscard]] std::optional<std::string> actual_name(const std::filesystem::path& folder,
                                                         const std::string& name);

    std::vector<std::filesystem::path> folders_;
    ReadScope scope_;
    std::map<std::filesystem::path, std::map<std::string, std::string>> listings_;
};

/// Source of a texture's picture: a file name, or the bytes of a picture embedded in the scene file.
struct ImageSource {
    std::string file;
    std::vector<std::byte> bytes;
};

/// Reads the pictures of all textures of the scene. `sources` has one entry per texture. A texture that
/// already has a picture is not changed. A picture that cannot be found or decoded becomes one white pixel,
/// and a warning names it. A file that several textures use is decoded once. Throws OutsideScope for a
/// picture outside of the scope of `finder`.
void load_pictures(Scene& scene, const std::vector<ImageSource>& sources, FileFinder& finder);

} // namespace estampe
