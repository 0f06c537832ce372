// SPDX-License-Identifier: MIT
#include "scene/mending/turn_outside.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// Sets of places that triangles connect.
class Sets {
public:
    explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0U); }

    uint32_t find(uint32_t i)
    {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    void join(uint32_t a, uint32_t b) { parent_[find(a)] = find(b); }

private:
    std::vector<uint32_t> parent_;
};

/// Triangles that are connected by corners.
struct SurfacePiece {
    Bounds bounds;
    double volume_m3 = 0.0;
    bool is_inside_out = false;      ///< it is closed and wound one way, with its backs outside
    std::vector<uint32_t> triangles; ///< only of a piece that is inside out
};

/// The places of a primitive and the pieces that its triangles make of them.
class Pieces {
public:
    explicit Pieces(const Primitive& primitive)
        : primitive_(primitive), places_(places_of_vertices(primitive)), sets_(places_.size())
    {
        for (size_t t = 0; t < triangle_count(); ++t) {
            sets_.join(place(t, 0), place(t, 1));
            sets_.join(place(t, 0), place(t, 2));
        }
    }

    std::vector<SurfacePiece> run()
    {
        std::vector<uint32_t> piece_of_set(places_.size(), no_index);
        std::vector<uint32_t> piece_of_triangle(triangle_count());
        for (size_t t = 0; t < triangle_count(); ++t) {
            uint32_t& number = piece_of_set[sets_.find(place(t, 0))];
            if (number == no_index) {
                number = static_cast<uint32_t>(pieces_.size());
                pieces_.emplace_back();
            }
            piece_of_triangle[t] = number;
            SurfacePiece& piece = pieces_[number];
            std::array<glm::dvec3, 3> corners;
            for (size_t k = 0; k < 3; ++k) {
                corners[k] = primitive_.positions[primitive_.indices[3 * t + k]];
                piece.bounds.extend(corners[k]);
            }
            piece.volume_m3 += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
        }
        // Few pieces are inside out, and lists of their triangles are long.
        if (std::ranges::any_of(pieces_, [](const SurfacePiece& piece) { return piece.volume_m3 < 0.0; })) {
            for (uint32_t t = 0; t < triangle_count(); ++t)
                if (SurfacePiece& piece = pieces_[piece_of_triangle[t]]; piece.volume_m3 < 0.0)
                    piece.triangles.push_back(t);
        }
        for (SurfacePiece& piece : pieces_) {
            piece.is_inside_out = piece.volume_m3 < 0.0 && is_closed(piece);
            if (!piece.is_inside_out)
                std::vector<uint32_t>().swap(piece.triangles);
        }
        return std::move(pieces_);
    }

private:
    [[nodiscard]] size_t triangle_count() const { return primitive_.indices.size() / 3; }

    [[nodiscard]] uint32_t place(size_t t, size_t k) const { return places_[primitive_.indices[3 * t + k]]; }

    /// A triangle with two corners in one place, as at the poles of many a ball, is a side without
    /// neighbours.
    [[nodiscard]] bool has_collapsed(size_t t) const
    {
        return place(t, 0) == place(t, 1) || place(t, 1) == place(t, 2) || place(t, 2) == place(t, 0);
    }

    /// A side of a triangle as a number, and spread over all numbers.
    static uint64_t side(uint32_t from, uint32_t to) { return uint64_t{from} << 32U | to; }

    static uint64_t spread(uint64_t number)
    {
        number = (number ^ number >> 30U) * 0xBF58476D1CE4E5B9U;
        number = (number ^ number >> 27U) * 0x94D049BB133111EBU;
        return number ^ number >> 31U;
    }

    /// Calls `take(from, to)` for each side of the piece's triangles.
    template <typename Take>
    void for_sides(const SurfacePiece& piece, const Take& take) const
    {
        for (const uint32_t t : piece.triangles)
            for (size_t k = 0; k < 3 && !has_collapsed(t); ++k)
                take(place(t, k), place(t, (k + 1) % 3));
    }

    /// Whether each side of a triangle has one other beside it, that runs the other way.
    [[nodiscard]] bool is_closed(const SurfacePiece& piece) const
    {
        // An open piece has sides without another: sums over both ways tell almost all of them without a
        // sort.
        uint64_t difference = 0;
        for_sides(piece, [&](uint32_t from, uint32_t to) {
            difference += spread(side(from, to)) - spread(side(to, from));
        });
        if (difference != 0)
            return false;
        std::vector<uint64_t> ways;
        std::vector<uint64_t> back;
        for_sides(piece, [&](uint32_t from, uint32_t to) {
            ways.push_back(side(from, to));
            back.push_back(side(to, from));
        });
        std::sort(ways.begin(), ways.end());
        if (std::adjacent_find(ways.begin(), ways.end()) != ways.end())
            return false;
        std::sort(back.begin(), back.end());
        return ways == back;
    }

    const Primitive& primitive_;
    std::vector<uint32_t> places_;
    Sets sets_;
    std::vector<SurfacePiece> pieces_;
};

void turn_over(Primitive& primitive, const SurfacePiece& piece)
{
    double agreement = 0.0;
    std::vector<uint32_t> vertices;
    for (const uint32_t t : piece.triangles) {
        turn_triangle(primitive, t);
        const uint32_t* const corners = &primitive.indices[size_t{3} * t];
        const glm::dvec3 a = primitive.positions[corners[0]];
        const glm::dvec3 normal = glm::cross(glm::dvec3(primitive.positions[corners[1]]) - a,
                                             glm::dvec3(primitive.positions[corners[2]]) - a);
        for (size_t k = 0; k < 3; ++k) {
            agreement += glm::dot(normal, glm::dvec3(primitive.normals[corners[k]]));
            vertices.push_back(corners[k]);
        }
    }
    if (agreement >= 0.0) {
        return;
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const uint32_t vertex : vertices) {
        primitive.normals[vertex] = -primitive.normals[vertex];
        if (!primitive.tangents.empty()) {
            primitive.tangents[vertex].w = -primitive.tangents[vertex].w;
        }
        for (MorphTarget& target : primitive.morph_targets) {
            if (!target.normal_offsets.empty()) {
                target.normal_offsets[vertex] = -target.normal_offsets[vertex];
            }
        }
    }
}

/// A piece as it stands in the scene.
struct PlacedPiece {
    Primitive* primitive;
    SurfacePiece piece;
    Bounds world;
    Index mesh;
};

bool contains(const Bounds& outer, const Bounds& inner)
{
    return glm::all(glm::lessThan(outer.min, inner.min)) && glm::all(glm::lessThan(inner.max, outer.max));
}

std::vector<PlacedPiece> placed_pieces(Scene& scene)
{
    const ScenePose pose = pose_scene(scene, 0.0, no_index);
    std::vector<glm::dmat4> world_from_mesh(scene.meshes.size(), glm::dmat4(1.0));
    for (size_t node = 0; node < scene.nodes.size(); ++node) {
        if (scene.nodes[node].mesh != no_index) {
            world_from_mesh[scene.nodes[node].mesh] = pose.world_from_node[node];
        }
    }
    std::vector<PlacedPiece> placed;
    for (Index mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        for (Primitive& primitive : scene.meshes[mesh].primitives) {
            const bool is_one_sided = primitive.material < scene.materials.size() &&
                                      !scene.materials[primitive.material].double_sided;
            if (primitive.topology != Topology::triangles || is_one_sided) {
                continue;
            }
            for (SurfacePiece& piece : Pieces(primitive).run()) {
                Bounds world;
                for (int corner = 0; corner < 8; ++corner) {
                    const glm::dvec3 at((corner & 1) != 0 ? piece.bounds.max.x : piece.bounds.min.x,
                                        (corner & 2) != 0 ? piece.bounds.max.y : piece.bounds.min.y,
                                        (corner & 4) != 0 ? piece.bounds.max.z : piece.bounds.min.z);
                    world.extend(glm::dvec3(world_from_mesh[mesh] * glm::dvec4(at, 1.0)));
                }
                placed.push_back({&primitive, std::move(piece), world, mesh});
            }
        }
    }
    return placed;
}

} // namespace

void turn_outside(Scene& scene)
{
    const std::vector<PlacedPiece> placed = placed_pieces(scene);
    // What may stand in a room, from left to right, so that few are compared with each.
    std::vector<Bounds> furniture;
    if (std::ranges::any_of(placed, [](const PlacedPiece& piece) { return piece.piece.is_inside_out; }))
        for (const PlacedPiece& piece : placed)
            if (!piece.piece.is_inside_out)
                furniture.push_back(piece.world);
    const auto left_of = [](const Bounds& bounds) { return bounds.min.x; };
    std::ranges::sort(furniture, {}, left_of);
    std::vector<size_t> turned(scene.meshes.size(), 0);
    for (const PlacedPiece& piece : placed) {
        const bool is_room = piece.piece.is_inside_out &&
                             std::any_of(std::ranges::upper_bound(furniture, piece.world.min.x, {}, left_of),
                                         std::ranges::lower_bound(furniture, piece.world.max.x, {}, left_of),
                                         [&](const Bounds& other) { return contains(piece.world, other); });
        if (piece.piece.is_inside_out && !is_room) {
            turn_over(*piece.primitive, piece.piece);
            ++turned[piece.mesh];
        }
    }
    for (Index mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        if (turned[mesh] > 0) {
            scene.warnings.push_back(fmt::format("mesh \"{}\": {} closed piece{} inside out, turned over",
                                                 scene.meshes[mesh].name, turned[mesh],
                                                 turned[mesh] == 1 ? " was" : "s were"));
        }
    }
}

} // namespace estampe
