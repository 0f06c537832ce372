// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/pictures/file_finder.hpp"

namespace estampe {

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
