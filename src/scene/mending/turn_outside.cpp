// SPDX-License-Identifier: MIT
#include "scene/mending/turn_outside.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include "scene/mending/mend.hpp"

namespace estampe {
namespace {

/// Numbers vertices by their place.
std::vector<uint32_t> places_of(const Primitive& primitive)
{
    std::vector<uint32_t> order(primitive.positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](uint32_t i) {
        const glm::vec3& p = primitive.positions[i];
        return std::array{p.x, p.y, p.z};
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    std::vector<uint32_t> places(order.size());
    uint32_t place = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        place += i > 0 && key(order[i]) != key(order[i - 1]) ? 1U : 0U;
        places[order[i]] = place;
    }
    return places;
}

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

/// What hangs together by corners.
struct Piece {
    std::vector<uint32_t> triangles;
    Bounds bounds;
    double volume_m3 = 0.0;
    bool is_inside_out = false; ///< it is closed and wound one way, with its backs outside
};

/// The places of a primitive and what its triangles make of them.
class Pieces {
public:
    explicit Pieces(const Primitive& primitive)
        : primitive_(primitive), places_(places_of(primitive)), sets_(places_.size())
    {
        for (size_t t = 0; t < triangle_count(); ++t) {
            sets_.join(place(t, 0), place(t, 1));
            sets_.join(place(t, 0), place(t, 2));
        }
    }

    std::vector<Piece> run()
    {
        for (size_t t = 0; t < triangle_count(); ++t) {
            Piece& piece = piece_of(t);
            piece.triangles.push_back(static_cast<uint32_t>(t));
            std::array<glm::dvec3, 3> corners;
            for (size_t k = 0; k < 3; ++k) {
                corners[k] = primitive_.positions[primitive_.indices[3 * t + k]];
                piece.bounds.extend(corners[k]);
            }
            piece.volume_m3 += glm::dot(corners[0], glm::cross(corners[1], corners[2])) / 6.0;
        }
        for (Piece& piece : pieces_) {
            piece.is_inside_out = piece.volume_m3 < 0.0 && is_closed(piece);
        }
        return std::move(pieces_);
    }

private:
    [[nodiscard]] size_t triangle_count() const { return primitive_.indices.size() / 3; }

    [[nodiscard]] uint32_t place(size_t t, size_t k) const { return places_[primitive_.indices[3 * t + k]]; }

    Piece& piece_of(size_t t)
    {
        const auto [found, is_new] = piece_of_set_.try_emplace(sets_.find(place(t, 0)), pieces_.size());
        if (is_new) {
            pieces_.emplace_back();
        }
        return pieces_[found->second];
    }

    /// A triangle with two corners in one place, as at the poles of many a ball, is a side without
    /// neighbours.
    [[nodiscard]] bool has_collapsed(size_t t) const
    {
        return place(t, 0) == place(t, 1) || place(t, 1) == place(t, 2) || place(t, 2) == place(t, 0);
    }

    /// Whether each side of a triangle has one other beside it, that runs the other way.
    [[nodiscard]] bool is_closed(const Piece& piece) const
    {
        std::vector<std::pair<uint32_t, uint32_t>> ways;
        std::vector<std::pair<uint32_t, uint32_t>> back;
        for (const uint32_t t : piece.triangles) {
            for (size_t k = 0; k < 3 && !has_collapsed(t); ++k) {
                ways.emplace_back(place(t, k), place(t, (k + 1) % 3));
                back.emplace_back(ways.back().second, ways.back().first);
            }
        }
        std::sort(ways.begin(), ways.end());
        std::sort(back.begin(), back.end());
        return ways == back && std::adjacent_find(ways.begin(), ways.end()) == ways.end();
    }

    const Primitive& primitive_;
    std::vector<uint32_t> places_;
    Sets sets_;
    std::unordered_map<uint32_t, size_t> piece_of_set_;
    std::vector<Piece> pieces_;
};

void turn_over(Primitive& primitive, const Piece& piece)
{
    double agreement = 0.0;
    std::vector<uint32_t> vertices;
    for (const uint32_t t : piece.triangles) {
        uint32_t* corners = &primitive.indices[size_t{3} * t];
        std::swap(corners[1], corners[2]);
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
    Piece piece;
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
            if (primitive.topology != Topology::triangles) {
                continue;
            }
            for (Piece& piece : Pieces(primitive).run()) {
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
    std::vector<size_t> turned(scene.meshes.size(), 0);
    for (const PlacedPiece& piece : placed) {
        const bool is_room =
            piece.piece.is_inside_out && std::ranges::any_of(placed, [&](const PlacedPiece& other) {
                return !other.piece.is_inside_out && contains(piece.world, other.world);
            });
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

void make_sound(Scene& scene, const std::string& where)
{
    check_structure(scene, where); // only what is a tree can be posed
    turn_outside(scene);
}

} // namespace estampe
