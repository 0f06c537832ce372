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

/// A picture that an OBJ material names, with the options in front of its file name.
struct MtlMap {
    std::string file; ///< file name of the picture; empty if the material names no picture
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};
    bool clamps = false; ///< the picture does not repeat
    double bump = 1.0;   ///< factor of the option -bm
};

/// A material as written in an MTL file. Values that the file does not specify are not set.
struct MtlMaterial {
    std::string name;
    std::optional<glm::vec3> diffuse;
    std::optional<glm::vec3> emissive;
    std::optional<double> dissolve;     ///< opacity from the statement `d`: 1 is opaque
    std::optional<double> transparency; ///< transparency from the statement `Tr`: 0 is opaque
    std::optional<double> roughness;
    std::optional<double> metallic;
    MtlMap diffuse_map;
    MtlMap emissive_map;
    MtlMap dissolve_map;
    MtlMap bump_map;   ///< height map or normal map; programs write both under the same name
    MtlMap normal_map; ///< normal map from the statement `norm`
};

/// Reads a material library (MTL). If a material occurs twice, its last statements apply. Unknown statements
/// are ignored, because they do not change a drawing.
[[nodiscard]] std::vector<MtlMaterial> parse_mtl(Input& input);

/// Reads the material libraries of an OBJ file into the materials and textures of the scene. The first
/// materials are those of `used`, in this order; all other materials of the libraries follow. If a library is
/// not found, a file with the name of the OBJ file and the ending .mtl is tried. Lines in Scene::warnings
/// name the missing files and materials. Missing materials are grey.
///
/// `libraries` are the arguments of the `mtllib` lines. Each argument is one file name with blanks, or
/// several names. `default_color` is the colour of materials that specify none. Throws OutsideScope
/// for a library or picture outside of `scope`.
void read_materials(const std::filesystem::path& file, const std::vector<std::string>& libraries,
                    const std::vector<std::string>& used, const glm::vec3& default_color,
                    const ReadScope& scope, Scene& scene);

} // namespace estampe::obj
