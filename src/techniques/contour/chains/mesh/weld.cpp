// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/mesh/weld.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "techniques/contour/chains/mesh/edge_mesh.hpp"

namespace estampe::contour {
namespace {

// Size of a search cell, in multiples of the welding tolerance. With cells of 64 tolerances, few vertices
// need a search in a second cell, and few vertices share a cell.
constexpr float cell_tolerances = 64.0F;
// Two vertices at one position are not welded if joints move the two vertices further apart than most_apart,
// a share of the body's size.
constexpr float most_apart = 1e-3F;
constexpr float share_of_edge = 0.1F;

struct Box {
    glm::vec3 min{std::numeric_limits<float>::infinity()};
    glm::vec3 max{-std::numeric_limits<float>::infinity()};

    void extend(const glm::vec3& point)
    {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    [[nodiscard]] float size() const { return min.x <= max.x ? glm::length(max - min) : 0.0F; }
};

struct Body {
    Box mesh, placed;
    float tolerance = 0.0F; ///< largest distance between welded vertices, in the mesh's own space
    float apart = 0.0F;     ///< largest distance between welded vertices in the scene's rest pose
};

class Welder {
public:
    explicit Welder(const WeldInput& input) : in_(input) {}

    std::vector<uint32_t> run()
    {
        measure_bodies();
        measure_edges();
        const auto count = static_cast<uint32_t>(in_.mesh_positions.size());
        slots_.assign(std::bit_ceil(size_t{2} * count + 2), no_side);
        std::vector<uint32_t> points(count, no_side);
        for (uint32_t v = 0; v < count; ++v) {
            if (in_.body_of_vertex[v] != no_side) {
                points[v] = point_of(v);
            }
        }
        return points;
    }

private:
    void measure_bodies()
    {
        uint32_t last = 0;
        for (const uint32_t body : in_.body_of_vertex) {
            last = body != no_side ? std::max(last, body) : last;
        }
        bodies_.resize(size_t{last} + 1);
        for (size_t v = 0; v < in_.mesh_positions.size(); ++v) {
            if (in_.body_of_vertex[v] != no_side) {
                bodies_[in_.body_of_vertex[v]].mesh.extend(in_.mesh_positions[v]);
                bodies_[in_.body_of_vertex[v]].placed.extend(in_.positions[v]);
            }
        }
        for (Body& body : bodies_) {
            body.tolerance = weld_tolerance * body.mesh.size();
            body.apart = most_apart * body.placed.size();
        }
    }

    /// Finds the squared length of the shortest edge at each vertex. Edges of zero length do not count.
    void measure_edges()
    {
        shortest_squared_.assign(in_.mesh_positions.size(), std::numeric_limits<float>::infinity());
        for (size_t t = 0; t < in_.triangles.size(); ++t) {
            for (int k = 0; k < 3 && in_.bodies[t] != no_side; ++k) {
                const uint32_t a = in_.triangles[t][k];
                const uint32_t b = in_.triangles[t][(k + 1) % 3];
                const float squared = distance_squared(in_.mesh_positions, a, b);
                if (squared > 0.0F) {
                    shortest_squared_[a] = std::min(shortest_squared_[a], squared);
                    shortest_squared_[b] = std::min(shortest_squared_[b], squared);
                }
            }
        }
    }

    static float distance_squared(std::span<const glm::vec3> positions, uint32_t a, uint32_t b)
    {
        const glm::vec3 way = positions[a] - positions[b];
        return glm::dot(way, way);
    }

    [[nodiscard]] bool is_same_place(uint32_t a, uint32_t b, const Body& body) const
    {
        if (in_.body_of_vertex[a] != in_.body_of_vertex[b]) {
            return false;
        }
        const float mesh = distance_squared(in_.mesh_positions, a, b);
        const float edge = std::min(shortest_squared_[a], shortest_squared_[b]);
        return mesh <= body.tolerance * body.tolerance && mesh <= share_of_edge * share_of_edge * edge &&
               distance_squared(in_.positions, a, b) <= body.apart * body.apart;
    }

    [[nodiscard]] size_t slot_of(uint32_t body, const glm::ivec3& cell) const
    {
        uint32_t h = body * 0x85ebca77U;
        for (int axis = 0; axis < 3; ++axis) {
            h = (h ^ static_cast<uint32_t>(cell[axis])) * 0x9e3779b1U;
            h ^= h >> 15U;
        }
        return h & (slots_.size() - 1);
    }

    /// Returns a vertex of the cell at the same position as `v`, or no_side. If the cell has no such vertex,
    /// `slot` becomes the first free slot of the hash table.
    [[nodiscard]] uint32_t look_in(const glm::ivec3& cell, uint32_t v, const Body& body, size_t& slot) const
    {
        for (slot = slot_of(in_.body_of_vertex[v], cell); slots_[slot] != no_side;
             slot = (slot + 1) & (slots_.size() - 1)) {
            if (is_same_place(slots_[slot], v, body)) {
                return slots_[slot];
            }
        }
        return no_side;
    }

    uint32_t point_of(uint32_t v)
    {
        const Body& body = bodies_[in_.body_of_vertex[v]];
        const float cell_size = std::max(cell_tolerances * body.tolerance, std::numeric_limits<float>::min());
        const glm::vec3 place = (in_.mesh_positions[v] - body.mesh.min) / cell_size;
        const glm::ivec3 cell(place);
        size_t free_slot = 0;
        uint32_t found = look_in(cell, v, body, free_slot);
        // On each axis: the neighbouring cell (-1 or 1) that may also contain a vertex at the position of
        // `v`, or 0.
        glm::ivec3 beside(0);
        const glm::vec3 within = place - glm::vec3(cell);
        constexpr float margin = 1.0F / cell_tolerances;
        for (int axis = 0; axis < 3; ++axis) {
            beside[axis] = within[axis] < margin ? -1 : within[axis] > 1.0F - margin ? 1 : 0;
        }
        for (uint32_t way = 1; way < 8 && found == no_side; ++way) {
            const glm::ivec3 taken(way & 1U, way >> 1U & 1U, way >> 2U);
            if (taken * glm::abs(beside) == taken) {
                size_t unused = 0;
                found = look_in(cell + taken * beside, v, body, unused);
            }
        }
        if (found == no_side) {
            slots_[free_slot] = v;
            found = v;
        }
        return found;
    }

    const WeldInput& in_;
    std::vector<Body> bodies_;
    /// For each vertex: squared length of the shortest edge at the vertex.
    std::vector<float> shortest_squared_;
    std::vector<uint32_t> slots_;
};

} // namespace

std::vector<uint32_t> weld_vertices(const WeldInput& input)
{
    return Welder(input).run();
}

} // namespace estampe::contour
