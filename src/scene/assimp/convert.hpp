// SPDX-License-Identifier: MIT
#pragma once

// Converts Assimp's scene to Estampe's, with one function per subject. Runs in the child process.

#include <filesystem>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include <assimp/scene.h>

#include <estampe/scene.hpp>

#include "scene/assimp/fbx/document.hpp"
#include "scene/assimp/transfer.hpp"

namespace estampe {

/// State of the conversion. Assimp refers to nodes by name, hence the map.
struct Conversion {
    const aiScene& source;
    TransferScene transfer;
    std::map<std::string, Index> node_of_name;
    std::unordered_map<const aiNode*, Index> node_of_source;

    [[nodiscard]] Scene& scene() { return transfer.scene; }

    [[nodiscard]] Index find_node(const aiString& name) const;
};

[[nodiscard]] glm::dmat4 matrix_of(const aiMatrix4x4& matrix);
[[nodiscard]] std::string name_of(const aiString& name);

void convert_materials(Conversion& conversion);
[[nodiscard]] Primitive convert_primitive(const aiMesh& mesh);

/// Fills joints and weights of `primitive` from the mesh's bones and returns the skin they belong to.
[[nodiscard]] Index convert_skin(Conversion& conversion, const aiMesh& mesh, Primitive& primitive);

void convert_lights(Conversion& conversion);

/// Adds the cameras of a COLLADA file; `lenses` are those of dae::Document.
void convert_cameras(Conversion& conversion, const std::vector<SceneCamera>& lenses);

void convert_animations(Conversion& conversion);

/// Adds to the converted scene what Assimp leaves out of an FBX file: pivots and fixed rotations of nodes,
/// axes and unit of the file, cameras and the targets of cameras and lights, frame rate and length of
/// animations. The file must have been read after fbx::hide_pivots() changed it.
void apply_fbx(Conversion& conversion, const fbx::Document& document);

} // namespace estampe
