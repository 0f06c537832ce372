// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <vector>

namespace estampe::viewer {

/// Files that may change. Asked from time to time, it says which did, by their times and sizes; one that is
/// still being written counts once it has stood still for a look.
class FileWatch {
public:
    /// In place of those watched before.
    void watch(const std::vector<std::filesystem::path>& files);

    /// Those that changed since; files that are gone count when they come back. Cost: about 2 us a file.
    [[nodiscard]] std::vector<std::filesystem::path> changed();

private:
    struct State {
        std::filesystem::file_time_type time;
        uintmax_t size_bytes = 0;
        bool operator==(const State&) const = default;
    };

    struct Watched {
        State known; ///< that was told
        State seen;  ///< by the last look
    };

    [[nodiscard]] static State state_of(const std::filesystem::path& file);

    std::map<std::filesystem::path, Watched> files_;
};

/// A scene's file and what lies beside it that scenes are made of: buffers, textures, material files; one
/// folder deep, and no more than some hundreds.
[[nodiscard]] std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene);

} // namespace estampe::viewer
