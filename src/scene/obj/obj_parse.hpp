// SPDX-License-Identifier: MIT
#pragma once

// The content of an OBJ file before conversion to a scene, and its parser.

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

/// A corner of a face, as indices into the lists of positions, texture coordinates and normals. The index
/// `no_index` means that the corner lacks the attribute.
struct Corner {
    uint32_t position = no_index;
    uint32_t uv = no_index;
    uint32_t normal = no_index;

    bool operator==(const Corner&) const = default;
};

/// Smoothing group of faces that come before any `s` statement. Between such faces, an edge is smooth or
/// sharp depending on the crease angle.
inline constexpr uint32_t no_smoothing_group = no_index;

/// Elements of one topology, one object and one material. Each piece of a mesh becomes a primitive.
struct Piece {
    uint32_t object = 0;
    uint32_t material = no_index; ///< index of the material; no_index if the file has not named one
    Topology topology = Topology::triangles;
    bool has_normals = false; ///< either all corners have a normal, or no corner has one
    std::vector<Corner> vertices;
    std::vector<uint32_t> indices;
    /// Smoothing group of each triangle; may be empty; group 0 is flat.
    std::vector<uint32_t> smoothing_groups;
};

/// An object or a group of an OBJ file, named by an `o` or `g` statement.
struct Object {
    std::string name;
    uint32_t parent = no_index; ///< for a group: the last object before it in the file
};

/// Counts of elements that could not be read exactly as written.
struct Losses {
    uint64_t faces_of_missing_vertices = 0;
    uint64_t short_faces = 0; ///< number of faces with fewer than three corners
    uint64_t unclean_polygons = 0;
    uint64_t corners_of_missing_attributes = 0;
    uint64_t curves = 0;
    uint64_t unread_lines = 0;
    uint64_t first_unread_line = 0;
    bool is_cut_off = false;    ///< the last line has no line end and cannot be parsed
    uint64_t said_vertices = 0; ///< vertex count in a comment written by MeshLab; 0 if there is none
    uint64_t said_faces = 0;
    uint64_t faces = 0; ///< number of all faces of the file, valid and invalid
};

/// The content of an OBJ file. Every index of a corner is in range.
struct Data {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec4> colors; ///< linear colours of the positions; may be empty
    std::vector<glm::vec2> uvs;    ///< texture coordinates; v points up, as in the OBJ format
    std::vector<glm::vec3> normals;
    std::vector<Object> objects;
    std::vector<std::string> materials; ///< names of materials in `usemtl` statements
    std::vector<std::string> libraries; ///< the arguments of each `mtllib` line
    std::vector<Piece> pieces;
    Losses losses;
};

/// Sorts faces, lines and points into pieces, triangulates polygons, and merges equal corners into one
/// vertex.
class PieceBuilder {
public:
    explicit PieceBuilder(Data& data) : data_(data) {}

    /// Sets the object of the elements that are added next.
    void set_object(uint32_t object);
    void set_material(uint32_t material);

    void set_smoothing_group(uint32_t group) { smoothing_group_ = group; }

    /// Adds a polygon. Its corners may refer to positions that come later in the file.
    void add_face(std::span<const Corner> corners);
    void add_line(std::span<const Corner> corners);
    void add_points(std::span<const Corner> corners);

    /// Triangulates the polygons whose positions came later in the file, and drops elements whose positions
    /// are missing.
    void finish();

private:
    /// A vertex of a piece, as an entry in the linked list of all vertices at one position.
    struct Entry {
        uint32_t next = no_index;
        uint32_t piece = 0;
        uint32_t vertex = 0;
    };

    /// A polygon that refers to positions that come later in the file. finish() triangulates it.
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
    std::vector<uint32_t> first_entries_; ///< for each position: first entry of its linked list
    std::vector<Entry> entries_;
    Triangulation triangulation_;
    std::vector<glm::dvec3> polygon_;
    std::vector<uint32_t> triangles_;
    std::vector<Waiting> waiting_;
    std::vector<Corner> waiting_corners_;
};

/// Parses all lines of an OBJ file. In the result all indices of corners are in range. Data::losses counts
/// what could not be read. Memory: all numbers of the file, and twelve bytes for each corner of a triangle.
/// Cost: about 0.4 s for a million triangles.
[[nodiscard]] Data parse(Input& input);

} // namespace estampe::obj
