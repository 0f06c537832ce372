// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::obj {

/// Reads the libraries that an OBJ file names and fills the scene's materials and textures: one material for
/// each of `used`, in this order, and then those that the libraries have besides. A library that is not found
/// under its own name is looked for under the name of the OBJ file. What cannot be found is named in
/// Scene::warnings, and its materials are grey.
///
/// `libraries` are the ends of `mtllib` lines: one file name with blanks, or several names. `default_color`
/// is that of materials without a colour.
void read_materials(const std::filesystem::path& file, const std::vector<std::string>& libraries,
                    const std::vector<std::string>& used, const glm::vec3& default_color, Scene& scene);

} // namespace estampe::obj
