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

/// A picture that a material names, with the options before its name.
struct MtlMap {
    std::string file; ///< empty: none
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};
    bool clamps = false; ///< does not repeat
    double bump = 1.0;   ///< -bm
};

/// A material as its file has it; what the file does not say is not set.
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
    MtlMap bump_map;   ///< of heights, or of normals: programs write both under this name
    MtlMap normal_map; ///< norm: of normals for certain
};

/// Reads a material library. A name that is given twice is one material, as the last statements have it.
/// Statements that are not known are passed over: they are many, and none of them changes a drawing.
[[nodiscard]] std::vector<MtlMaterial> parse_mtl(Input& input);

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
