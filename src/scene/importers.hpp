// SPDX-License-Identifier: MIT
#pragma once

// The readers of all formats, each in a folder of its own. load_scene() chooses among them.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads a glTF 2.0 file, text or binary (told apart by content), with the buffers and images it names beside
/// it.
///
/// Throws Error with the place as `file#/json/pointer`, `file:line:column` or `file:byte N`. Missing or
/// corrupt textures, bad normals and the like are repaired and listed in Scene::warnings. Allocates at most a
/// few hundred times the size of the files read, plus the decoded textures. Source: Khronos, "glTF 2.0
/// Specification", 2021.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path);

/// The same from memory. Buffers and images in other files are an Error, respectively a warning. `name`
/// stands for the file in messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a Wavefront OBJ file with its material libraries and their pictures.
///
/// Each object (`o`) is a node, and each group (`g`) a node within its object; a primitive is what one of
/// them has of one material. Coordinates are read as doubles; those that lie far off get an origin of their
/// own, which becomes their node's translation. Polygons are cut into triangles. Normals that the file does
/// not give follow its smoothing groups, or the shape where it has none. Colours of vertices are sRGB. All
/// materials are double-sided, as the format does not tell. What cannot be read is counted in
/// Scene::warnings. Throws Error naming the file when nothing is left to draw. Cost: about 1 s for a million
/// triangles.
[[nodiscard]] Scene load_obj(const std::filesystem::path& path);

/// The same of a file in memory, without its libraries; `name` is for messages.
[[nodiscard]] Scene load_obj_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a PLY file, text or binary: faces, triangle strips and edges, or else its vertices as points.
///
/// Colours of vertices and faces are sRGB. Texture coordinates may belong to vertices or to corners of faces;
/// pictures are those that comments name as TextureFile. Coordinates that lie far off get an origin of their
/// own, the node's translation. What other elements and properties hold is passed over. A file that ends
/// early is drawn as far as it goes, with a line in Scene::warnings that says how much is missing. Throws
/// Error naming the file when nothing is left to draw. Cost: about 0.5 s for a million triangles.
[[nodiscard]] Scene load_ply(const std::filesystem::path& path);

/// The same of a file in memory, without its pictures; `name` is for messages.
[[nodiscard]] Scene load_ply_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads an STL file, text or binary. Each solid of a text is a node.
///
/// Normals are computed from the shape: those of the file only say that facets are flat. Colours of facets
/// are read as VisCAM and Materialise write them, and are sRGB. Coordinates that lie far off get an origin of
/// their own, the node's translation. A file that ends early is drawn as far as it goes, with a line in
/// Scene::warnings that says how much is missing. Throws Error naming the file when nothing is left to draw.
/// Cost: about 0.7 s for a million triangles.
[[nodiscard]] Scene load_stl(const std::filesystem::path& path);

/// The same of a file in memory; `name` is for messages.
[[nodiscard]] Scene load_stl_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads FBX and DAE through Assimp.
///
/// Assimp runs in a child process with limits on time and memory, so that a file which crashes or hangs it is
/// an Error here. What comes back is checked: indices, finite numbers, node tree; single bad triangles and
/// normals are repaired and named in Scene::warnings, and so are closed pieces that are inside out. Normals
/// are computed, smooth, where the file has none. All materials are double-sided, as these formats do not
/// tell. Throws Error naming the file.
[[nodiscard]] Scene load_with_assimp(const std::filesystem::path& path);

} // namespace estampe
