// SPDX-License-Identifier: MIT
#pragma once

// Converts an Assimp scene to an Estampe scene, with one function for each kind of data.

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include <assimp/scene.h>

#include <estampe/scene.hpp>

#include "scene/assimp/fbx/document.hpp"
#include "scene/pictures/picture_files.hpp"

namespace estampe {

/// A scene whose textures are not decoded yet. `images` has one entry per texture.
struct UndecodedScene {
    Scene scene;
    std::vector<ImageSource> images;
};

/// State of the conversion from Assimp. Assimp refers to nodes by name, so a map finds the node of a name.
struct Conversion {
    const aiScene& source;
    UndecodedScene result;
    std::map<std::string, Index> node_of_name;
    std::unordered_map<const aiNode*, Index> node_of_source;

    [[nodiscard]] Scene& scene() { return result.scene; }

    [[nodiscard]] Index find_node(const aiString& name) const;
};

[[nodiscard]] glm::dmat4 matrix_of(const aiMatrix4x4& matrix);
[[nodiscard]] std::string name_of(const aiString& name);

void convert_materials(Conversion& conversion);
[[nodiscard]] Primitive convert_primitive(const aiMesh& mesh);

/// Fills joints and weights of `primitive` from the bones of `mesh`. Returns the index of the skin that the
/// joints belong to.
[[nodiscard]] Index convert_skin(Conversion& conversion, const aiMesh& mesh, Primitive& primitive);

void convert_lights(Conversion& conversion);

/// Adds the cameras of a COLLADA file to the scene. `lenses` is Document::lenses of dae_document.hpp.
void convert_cameras(Conversion& conversion, const std::vector<SceneCamera>& lenses);

void convert_animations(Conversion& conversion);

/// Adds to the converted scene what Assimp leaves out of an FBX file: pivots and fixed rotations of nodes,
/// axes and unit of the file, cameras and the targets of cameras and lights, frame rate and length of
/// animations. The file must have been read after fbx::hide_pivots() changed it.
void apply_fbx(Conversion& conversion, const fbx::Document& document);

} // namespace estampe
