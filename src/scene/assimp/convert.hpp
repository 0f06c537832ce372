// SPDX-License-Identifier: MIT
#pragma once

// From Assimp's scene to ours: what runs in the child process, one function a subject.

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

/// The conversion under way: nodes by name, as Assimp refers to them.
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

/// Cameras of a COLLADA file, see dae::Document.
void convert_cameras(Conversion& conversion, const std::vector<SceneCamera>& lenses);

void convert_animations(Conversion& conversion);

/// Puts into the converted scene what Assimp leaves out of an FBX file: pivots and fixed turns of nodes, axes
/// and unit of the file, cameras and what cameras and lights look at, frame rate and length of animations.
/// The file must have been read with its pivots hidden, see fbx::hide_pivots().
void apply_fbx(Conversion& conversion, const fbx::Document& document);

} // namespace estampe
