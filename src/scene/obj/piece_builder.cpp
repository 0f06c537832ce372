// SPDX-License-Identifier: MIT
#include "scene/obj/piece_builder.hpp"

#include <algorithm>

namespace estampe::obj {
namespace {

/// How many vertices at one position are compared with a new one. A file may name any number of texture
/// coordinates with one position; what is not found here is shared when the mesh is mended.
constexpr int most_compared = 32;

size_t corners_of(Topology topology)
{
    return topology == Topology::triangles ? 3 : topology == Topology::lines ? 2 : 1;
}

} // namespace

void PieceBuilder::set_object(uint32_t object)
{
    object_ = object;
    current_pieces_.fill(no_index);
}

void PieceBuilder::set_material(uint32_t material)
{
    material_ = material;
    current_pieces_.fill(no_index);
}

uint32_t PieceBuilder::piece_of(Topology topology, bool has_normals)
{
    uint32_t& current = current_pieces_[2 * static_cast<size_t>(topology) + (has_normals ? 1 : 0)];
    if (current != no_index)
        return current;
    const auto count = static_cast<uint32_t>(data_.pieces.size());
    const auto [found, is_new] = pieces_.try_emplace({object_, material_, topology, has_normals}, count);
    if (is_new)
        data_.pieces.push_back({.object = object_,
                                .material = material_,
                                .topology = topology,
                                .has_normals = has_normals,
                                .vertices = {},
                                .indices = {},
                                .smoothing_groups = {}});
    current = found->second;
    return current;
}

uint32_t PieceBuilder::vertex_of(uint32_t piece, Corner corner)
{
    std::vector<Corner>& vertices = data_.pieces[piece].vertices;
    const auto vertex = static_cast<uint32_t>(vertices.size());
    if (corner.position >= data_.positions.size()) { // not listed yet
        vertices.push_back(corner);
        return vertex;
    }
    if (corner.position >= first_entries_.size()) {
        first_entries_.reserve(data_.positions.capacity());
        first_entries_.resize(data_.positions.size(), no_index);
    }
    uint32_t& first = first_entries_[corner.position];
    int compared = 0;
    for (uint32_t i = first; i != no_index && compared < most_compared; i = entries_[i].next, ++compared)
        if (entries_[i].piece == piece && vertices[entries_[i].vertex] == corner)
            return entries_[i].vertex;
    entries_.push_back({.next = first, .piece = piece, .vertex = vertex});
    first = static_cast<uint32_t>(entries_.size() - 1);
    vertices.push_back(corner);
    return vertex;
}

void PieceBuilder::add_triangle(uint32_t piece, const Corner& a, const Corner& b, const Corner& c,
                                uint32_t group)
{
    const uint32_t corners[3] = {vertex_of(piece, a), vertex_of(piece, b), vertex_of(piece, c)};
    Piece& target = data_.pieces[piece];
    if (group != no_smoothing_group || !target.smoothing_groups.empty()) {
        target.smoothing_groups.resize(target.indices.size() / 3, no_smoothing_group);
        target.smoothing_groups.push_back(group);
    }
    target.indices.insert(target.indices.end(), corners, corners + 3);
}

void PieceBuilder::cut(uint32_t piece, std::span<const Corner> corners, uint32_t group)
{
    polygon_.clear();
    for (const Corner& corner : corners)
        polygon_.push_back(data_.positions[corner.position]);
    triangles_.clear();
    triangulation_.cut(polygon_, triangles_);
    for (size_t i = 0; i + 2 < triangles_.size(); i += 3)
        add_triangle(piece, corners[triangles_[i]], corners[triangles_[i + 1]], corners[triangles_[i + 2]],
                     group);
}

void PieceBuilder::add_face(std::span<const Corner> corners)
{
    const bool has_normals = std::all_of(corners.begin(), corners.end(),
                                         [](const Corner& corner) { return corner.normal != no_index; });
    const uint32_t piece = piece_of(Topology::triangles, has_normals);
    if (corners.size() == 3) {
        add_triangle(piece, corners[0], corners[1], corners[2], smoothing_group_);
        return;
    }
    if (std::all_of(corners.begin(), corners.end(),
                    [this](const Corner& corner) { return corner.position < data_.positions.size(); })) {
        cut(piece, corners, smoothing_group_);
        return;
    }
    waiting_.push_back({.piece = piece,
                        .smoothing_group = smoothing_group_,
                        .first = waiting_corners_.size(),
                        .count = corners.size()});
    waiting_corners_.insert(waiting_corners_.end(), corners.begin(), corners.end());
}

void PieceBuilder::add_line(std::span<const Corner> corners)
{
    const uint32_t piece = piece_of(Topology::lines, false);
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
        const uint32_t ends[2] = {vertex_of(piece, corners[i]), vertex_of(piece, corners[i + 1])};
        data_.pieces[piece].indices.insert(data_.pieces[piece].indices.end(), ends, ends + 2);
    }
}

void PieceBuilder::add_points(std::span<const Corner> corners)
{
    const uint32_t piece = piece_of(Topology::points, false);
    for (const Corner& corner : corners)
        data_.pieces[piece].indices.push_back(vertex_of(piece, corner));
}

void PieceBuilder::drop_missing(Piece& piece)
{
    const auto is_missing = [this](const Corner& corner) {
        return corner.position >= data_.positions.size();
    };
    for (Corner& corner : piece.vertices) {
        const bool lacks_uv = corner.uv != no_index && corner.uv >= data_.uvs.size();
        const bool lacks_normal = corner.normal != no_index && corner.normal >= data_.normals.size();
        if (lacks_uv)
            corner.uv = no_index;
        if (lacks_normal)
            corner.normal = no_index;
        data_.losses.corners_of_missing_attributes += lacks_uv || lacks_normal ? 1 : 0;
    }
    if (std::none_of(piece.vertices.begin(), piece.vertices.end(), is_missing))
        return;
    const size_t corners = corners_of(piece.topology);
    size_t kept = 0;
    for (size_t i = 0; i < piece.indices.size() / corners; ++i) {
        const auto first = piece.indices.begin() + static_cast<std::ptrdiff_t>(i * corners);
        if (std::any_of(first, first + static_cast<std::ptrdiff_t>(corners),
                        [&](uint32_t vertex) { return is_missing(piece.vertices[vertex]); })) {
            ++data_.losses.faces_of_missing_vertices;
            continue;
        }
        std::copy_n(first, corners, piece.indices.begin() + static_cast<std::ptrdiff_t>(kept * corners));
        if (!piece.smoothing_groups.empty())
            piece.smoothing_groups[kept] = piece.smoothing_groups[i];
        ++kept;
    }
    piece.indices.resize(kept * corners);
    if (!piece.smoothing_groups.empty())
        piece.smoothing_groups.resize(kept);
    if (kept == 0)
        piece.vertices.clear();
    for (Corner& corner : piece.vertices)
        if (is_missing(corner))
            corner = {.position = 0, .uv = no_index, .normal = no_index}; // no element uses it
}

void PieceBuilder::finish()
{
    for (const Waiting& face : waiting_) {
        const std::span<const Corner> corners(waiting_corners_.data() + face.first, face.count);
        if (std::all_of(corners.begin(), corners.end(),
                        [this](const Corner& corner) { return corner.position < data_.positions.size(); }))
            cut(face.piece, corners, face.smoothing_group);
        else
            ++data_.losses.faces_of_missing_vertices;
    }
    data_.losses.unclean_polygons = triangulation_.unclean();
    for (Piece& piece : data_.pieces) {
        if (!piece.smoothing_groups.empty())
            piece.smoothing_groups.resize(piece.indices.size() / 3, no_smoothing_group);
        drop_missing(piece);
    }
}

} // namespace estampe::obj
