// SPDX-License-Identifier: MIT
#pragma once

// Readers of all scene formats, each in its own folder. load_scene() selects one.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/scene.hpp>

namespace estampe {

/// Reads a glTF 2.0 file, text or binary (detected by content), with the external buffers and images that it
/// names.
///
/// Throws Error with the place as `file#/json/pointer`, `file:line:column` or `file:byte N`. Repairs missing
/// or corrupt textures, bad normals and the like, and lists the repairs in Scene::warnings. Allocates at most
/// a few hundred times the size of the files read, plus the decoded textures. Source: Khronos, "glTF 2.0
/// Specification", 2021.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path);

/// Reads a glTF 2.0 file from memory. An external buffer is an Error, an external image a warning. `name`
/// stands for the file in messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a Wavefront OBJ file with its material libraries and their pictures.
///
/// Each object (`o`) becomes a node, each group (`g`) a node within its object, and each material of a node
/// one primitive. Coordinates are read as doubles; coordinates far from zero get their own origin, which
/// becomes the node's translation. Polygons are triangulated. Normals that the file does not give follow its
/// smoothing groups, or the shape if it has none. Vertex colours are sRGB. All materials are double-sided,
/// because the format does not say. What cannot be read is counted in Scene::warnings. Throws Error naming
/// the file when nothing is left to draw. Cost: about 1 s for a million triangles.
[[nodiscard]] Scene load_obj(const std::filesystem::path& path);

/// Reads an OBJ file from memory, without its material libraries; `name` is for messages.
[[nodiscard]] Scene load_obj_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a PLY file, text or binary: faces, triangle strips and edges, or the vertices as points if there are
/// none.
///
/// Colours of vertices and faces are sRGB. Texture coordinates may belong to vertices or to corners of faces;
/// comments named TextureFile give the pictures. Coordinates far from zero get their own origin, which
/// becomes the node's translation. Other elements and properties are ignored. A truncated file is drawn as
/// far as it goes, with a line in Scene::warnings that says how much is missing. Throws Error naming the file
/// when nothing is left to draw. Cost: about 0.5 s for a million triangles.
[[nodiscard]] Scene load_ply(const std::filesystem::path& path);

/// Reads a PLY file from memory, without its pictures; `name` is for messages.
[[nodiscard]] Scene load_ply_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads an STL file, text or binary. Each solid of a text file becomes a node.
///
/// Normals are computed from the shape, because those of the file only say that facets are flat. Colours of
/// facets are sRGB and are read in the encodings of VisCAM and Materialise. Coordinates far from zero get
/// their own origin, which becomes the node's translation. A truncated file is drawn as far as it goes, with
/// a line in Scene::warnings that says how much is missing. Throws Error naming the file when nothing is left
/// to draw. Cost: about 0.7 s for a million triangles.
[[nodiscard]] Scene load_stl(const std::filesystem::path& path);

/// Reads an STL file from memory; `name` is for messages.
[[nodiscard]] Scene load_stl_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads FBX and DAE through Assimp.
///
/// Assimp runs in a child process with limits on time and memory, so that a file which crashes or hangs it
/// only causes an Error here. Indices, finite numbers and the node tree of the result are checked. Single bad
/// triangles and normals, and closed pieces that are inside out, are repaired and named in Scene::warnings.
/// Smooth normals are computed if the file has none. All materials are double-sided, because these formats do
/// not say. Throws Error naming the file.
[[nodiscard]] Scene load_with_assimp(const std::filesystem::path& path);

} // namespace estampe
