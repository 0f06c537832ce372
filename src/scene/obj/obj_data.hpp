// SPDX-License-Identifier: MIT
#pragma once

// What an OBJ file says, before it is a scene.

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/scene.hpp>

namespace estampe::obj {

/// A vertex of a face: which position, texture coordinate and normal of the file; `no_index` for none.
struct Corner {
    uint32_t position = no_index;
    uint32_t uv = no_index;
    uint32_t normal = no_index;

    bool operator==(const Corner&) const = default;
};

/// No `s` statement was in force: the shape decides where a surface is smooth.
inline constexpr uint32_t no_smoothing_group = no_index;

/// Elements of one kind, one object and one material: what becomes a primitive.
struct Piece {
    uint32_t object = 0;
    uint32_t material = no_index; ///< no_index: the file has named none
    Topology topology = Topology::triangles;
    bool has_normals = false; ///< all corners name a normal, or none does
    std::vector<Corner> vertices;
    std::vector<uint32_t> indices;
    std::vector<uint32_t> smoothing_groups; ///< empty, or one for each triangle; 0: flat
};

/// Something named by `o` or `g`.
struct Object {
    std::string name;
    uint32_t parent = no_index; ///< a group lies in the object that the file has named before it
};

/// Elements that could not be read as they stand.
struct Losses {
    uint64_t faces_of_missing_vertices = 0;
    uint64_t short_faces = 0; ///< with fewer than three corners
    uint64_t unclean_polygons = 0;
    uint64_t corners_of_missing_attributes = 0;
    uint64_t curves = 0;
    uint64_t unread_lines = 0;
    uint64_t first_unread_line = 0;
    bool is_cut_off = false;    ///< the last line has no end and makes no sense
    uint64_t said_vertices = 0; ///< by a comment, as MeshLab writes it; 0: none says
    uint64_t said_faces = 0;
    uint64_t faces = 0; ///< all that the file has, good and bad
};

/// All of a file. Corners of pieces are in range.
struct Data {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec4> colors; ///< linear; empty, or one for each position
    std::vector<glm::vec2> uvs;    ///< v runs up, as in the file
    std::vector<glm::vec3> normals;
    std::vector<Object> objects;
    std::vector<std::string> materials; ///< as `usemtl` names them
    std::vector<std::string> libraries; ///< the rest of each `mtllib` line
    std::vector<Piece> pieces;
    Losses losses;
};

} // namespace estampe::obj
