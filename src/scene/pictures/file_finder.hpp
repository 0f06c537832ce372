// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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

} // namespace estampe
