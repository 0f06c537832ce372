// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include <estampe/scene.hpp>

#include "scene/input/input.hpp"

namespace estampe::obj {

/// A picture that a material names, with the options in front of its name.
struct MtlMap {
    std::string file; ///< empty if the material names none
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};
    bool clamps = false; ///< the picture does not repeat
    double bump = 1.0;   ///< factor of the option -bm
};

/// A material as written in the file; members that the file does not give are not set.
struct MtlMaterial {
    std::string name;
    std::optional<glm::vec3> diffuse;
    std::optional<glm::vec3> emissive;
    std::optional<double> dissolve;     ///< d: 1 is opaque
    std::optional<double> transparency; ///< Tr: 0 is opaque
    std::optional<double> roughness;
    std::optional<double> metallic;
    MtlMap diffuse_map;
    MtlMap emissive_map;
    MtlMap dissolve_map;
    MtlMap bump_map;   ///< heights or normals, because programs write both under this name
    MtlMap normal_map; ///< from `norm`: always normals
};

/// Reads a material library. If a name is given twice, the last statements win. Unknown statements are
/// ignored: they are many, and none of them changes a drawing.
[[nodiscard]] std::vector<MtlMaterial> parse_mtl(Input& input);

/// Reads the libraries that an OBJ file names and fills the scene's materials and textures: first one
/// material for each of `used`, in this order, then all others of the libraries. If a library is not found
/// under its own name, the name of the OBJ file is tried. Names what cannot be found in Scene::warnings; such
/// materials are grey.
///
/// `libraries` are the arguments of `mtllib` lines: one file name with blanks, or several names.
/// `default_color` is the colour of materials without one.
void read_materials(const std::filesystem::path& file, const std::vector<std::string>& libraries,
                    const std::vector<std::string>& used, const glm::vec3& default_color, Scene& scene);

} // namespace estampe::obj
