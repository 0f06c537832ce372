// SPDX-License-Identifier: MIT
#pragma once

#include <map>

#include <estampe/scene.hpp>

#include "scene/gltf/data.hpp"

// The parts of the importer, in the order they run. Each fills its part of the scene and throws Error with a
// pointer.

namespace estampe::gltf {

/// Materials, and the textures they use, decoded on up to four threads. The last one is the default, when a
/// mesh needs it. Returns the scene's textures that say how cloth is held, by the file's;
/// `no_index` for one that is missing.
std::map<Index, Index> import_materials(Data& data, Scene& scene);

/// Meshes, decompressed, as plain lists, with normals and tangents.
void import_meshes(Data& data, Scene& scene);

/// Nodes, lights, cameras, skins, and which of them belong to the file's scene.
void import_nodes(Data& data, Scene& scene);

/// What is cloth: by the names of nodes and materials, or their extras. The red of its vertices' colours says
/// how much they are held, and colours nothing.
void import_cloth(Data& data, const std::map<Index, Index>& held_textures, Scene& scene);

void import_animations(Data& data, Scene& scene);

} // namespace estampe::gltf
