// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "scene/mending/triangulate.hpp"
#include "scene/obj/obj_data.hpp"

namespace estampe::obj {

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

} // namespace estampe::obj
