// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::viewer {

/// A view that is kept.
struct Bookmark {
    std::string name;
    Camera camera;
    double time_s = 0.0;
    Index animation = 0;
};

/// Where the bookmarks of a scene lie: beside it, as "helmet.gltf.views.json".
[[nodiscard]] std::filesystem::path bookmarks_path(const std::filesystem::path& scene);

/// Those in a file; none where there is no such file. Throws Error when it is broken.
[[nodiscard]] std::vector<Bookmark> load_bookmarks(const std::filesystem::path& path);

/// Writes all of them, or nothing; without any the file goes. Throws Error when it cannot be written.
void save_bookmarks(const std::vector<Bookmark>& bookmarks, const std::filesystem::path& path);

} // namespace estampe::viewer
