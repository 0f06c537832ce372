// SPDX-License-Identifier: MIT
#pragma once

// What a PLY file says, before it is a scene.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/input/input.hpp"

namespace estampe::ply {

/// Attributes of vertices are empty or one for each vertex. Indices are in range.
struct Data {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;    ///< v runs up, as in the file
    std::vector<glm::vec4> colors; ///< linear
    std::vector<uint32_t> triangles;
    std::vector<glm::vec2> corner_uvs;   ///< empty, or one for each entry of `triangles`
    std::vector<glm::vec4> face_colors;  ///< empty, or one for each triangle; linear
    std::vector<uint32_t> face_textures; ///< empty, or a place in `texture_files` for each triangle
    std::vector<uint32_t> lines;
    std::vector<std::string> texture_files;
    bool promises_faces = false; ///< the header has faces, strips or edges, whether they came or not
    std::vector<std::string> warnings;
};

/// Reads a whole file. Throws Error naming file and line when its header is none or has no vertices. What is
/// cut off, and elements that name vertices which are not there, are counted in the warnings. Memory: about
/// twice the arrays of the result. Cost: about 0.15 s for a million triangles in binary, 0.4 s as text.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::ply
