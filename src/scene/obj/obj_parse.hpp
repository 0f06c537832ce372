// SPDX-License-Identifier: MIT
#pragma once

// What an OBJ file says, before it is a scene, and how it is read.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include <estampe/scene.hpp>

#include "scene/input/input.hpp"
#include "scene/mending/triangulate.hpp"

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

/// Sorts faces, lines and points into pieces, cuts polygons, and lets corners that name the same things share
/// a vertex.
class PieceBuilder {
public:
    explicit PieceBuilder(Data& data) : data_(data) {}

    /// What the next elements belong to.
    void set_object(uint32_t object);
    void set_material(uint32_t material);

    void set_smoothing_group(uint32_t group) { smoothing_group_ = group; }

    /// Adds a polygon. Its corners may name positions that the file has not listed yet.
    void add_face(std::span<const Corner> corners);
    void add_line(std::span<const Corner> corners);
    void add_points(std::span<const Corner> corners);

    /// Cuts the polygons that waited for their positions, and drops what names things that never came.
    void finish();

private:
    /// A vertex of a piece, in a list of those at one position.
    struct Entry {
        uint32_t next = no_index;
        uint32_t piece = 0;
        uint32_t vertex = 0;
    };

    /// A polygon with corners that the file had not listed yet.
    struct Waiting {
        uint32_t piece;
        uint32_t smoothing_group;
        size_t first;
        size_t count;
    };

    uint32_t piece_of(Topology topology, bool has_normals);
    uint32_t vertex_of(uint32_t piece, Corner corner);
    void add_triangle(uint32_t piece, const Corner& a, const Corner& b, const Corner& c, uint32_t group);
    void cut(uint32_t piece, std::span<const Corner> corners, uint32_t group);
    void drop_missing(Piece& piece);

    Data& data_;
    uint32_t object_ = 0;
    uint32_t material_ = no_index;
    uint32_t smoothing_group_ = no_smoothing_group;
    std::map<std::tuple<uint32_t, uint32_t, Topology, bool>, uint32_t> pieces_;
    std::array<uint32_t, 6> current_pieces_{no_index, no_index, no_index, no_index, no_index, no_index};
    std::vector<uint32_t> first_entries_; ///< for each position
    std::vector<Entry> entries_;
    Triangulation triangulation_;
    std::vector<glm::dvec3> polygon_;
    std::vector<uint32_t> triangles_;
    std::vector<Waiting> waiting_;
    std::vector<Corner> waiting_corners_;
};

/// Reads all lines of an OBJ file. Whatever they hold, corners of pieces are in range afterwards, and what
/// was not understood is counted. Memory: the arrays of the file's numbers, and twelve bytes for each corner
/// of a triangle. Cost: about 0.4 s for a million triangles.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::obj
