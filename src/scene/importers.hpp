// SPDX-License-Identifier: MIT
#pragma once

// The readers of all scene formats. Each reader of a file format has its own folder. load_scene() selects the
// reader, and runs it in a child process. The functions of this header run in the process that calls them.
// Readers of files throw Error for a file outside of `scope`, whichever file names it.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include <estampe/read_scope.hpp>
#include <estampe/scene.hpp>

namespace estampe {

/// Name of a material that OBJ and PLY files do not name.
inline constexpr const char* material_without_name = "DefaultMaterial";

/// Reads a glTF 2.0 file and its external buffers and images. The content of the file decides whether it is
/// read as text or as binary.
///
/// Throws Error with the place as `file#/json/pointer`, `file:line:column` or `file:byte N`. Repairs faults
/// such as missing or corrupt textures and bad normals, and lists the repairs in Scene::warnings. Allocates
/// at most a few hundred times the size of the files read, plus the decoded textures. Source: Khronos, "glTF
/// 2.0 Specification", 2021.
[[nodiscard]] Scene load_gltf(const std::filesystem::path& path, const ReadScope& scope = {});

/// Reads a glTF 2.0 file from memory. A reference to an external buffer throws Error; a reference to an
/// external image adds a warning. `name` is the name of the file in messages.
[[nodiscard]] Scene load_gltf_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a Wavefront OBJ file with its material libraries and their pictures.
///
/// Each object (`o`) becomes a node, each group (`g`) a child node of its object, and each material of a node
/// one primitive. Coordinates are read as doubles. If coordinates are far from zero, the mesh gets its own
/// origin, which becomes the translation of its node. Polygons are triangulated. If the file has no normals,
/// they are computed from smoothing groups; without smoothing groups, from the angles between faces. Vertex
/// colours are sRGB. All materials are double-sided, because the format does not specify sides. Warnings in
/// Scene::warnings count the elements that cannot be read. Throws Error naming the file when nothing is left
/// to draw. Cost: about 1 s for a million triangles.
[[nodiscard]] Scene load_obj(const std::filesystem::path& path, const ReadScope& scope = {});

/// Reads an OBJ file from memory, without its material libraries. `name` is the name of the file in messages.
[[nodiscard]] Scene load_obj_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads a PLY file, text or binary, with its faces, triangle strips and edges. A file without faces, strips
/// and edges is read as a point cloud.
///
/// Colours of vertices and faces are sRGB. Texture coordinates may belong to vertices or to corners of faces.
/// Comments that begin with TextureFile name the pictures. If coordinates are far from zero, the mesh gets
/// its own origin, which becomes the translation of its node. Unknown elements and properties are ignored. A
/// truncated file is read up to its end, and a line in Scene::warnings says how much is missing. Throws Error
/// naming the file when nothing is left to draw. Cost: about 0.5 s for a million triangles.
[[nodiscard]] Scene load_ply(const std::filesystem::path& path, const ReadScope& scope = {});

/// Reads a PLY file from memory, without its pictures. `name` is the name of the file in messages.
[[nodiscard]] Scene load_ply_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads an STL file, text or binary. Each solid of a text file becomes a node.
///
/// Normals are computed from the shape, because the normals of an STL file only repeat that facets are flat.
/// Colours of facets are sRGB, in the encodings of VisCAM and Materialise. If coordinates are far from zero,
/// the mesh gets its own origin, which becomes the translation of its node. A truncated file is read up to
/// its end, and a line in Scene::warnings says how much is missing. Throws Error naming the file when nothing
/// is left to draw. Cost: about 0.7 s for a million triangles.
[[nodiscard]] Scene load_stl(const std::filesystem::path& path, const ReadScope& scope = {});

/// Reads an STL file from memory. `name` is the name of the file in messages.
[[nodiscard]] Scene load_stl_bytes(std::span<const std::byte> bytes, const std::string& name);

/// Reads FBX and DAE (COLLADA) files with Assimp.
///
/// A malicious file can crash or hang Assimp, so only a child process calls this function. The indices,
/// numbers and node tree of the result are checked. Bad triangles, bad normals and closed parts of meshes
/// that are inside out are repaired, with a line in Scene::warnings. Smooth normals are computed if the file
/// has none. All materials are double-sided, because FBX and COLLADA do not specify sides. Throws Error
/// naming the file.
[[nodiscard]] Scene load_with_assimp(const std::filesystem::path& path, const ReadScope& scope = {});

} // namespace estampe
