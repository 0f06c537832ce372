// SPDX-License-Identifier: MIT
// The shapes of builders: outlines pushed into depth, arches, columns, stairs.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/mesh_building.hpp"
#include <estampe/shapes.hpp>

namespace estampe::shapes {
namespace {

double cross_2d(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c)
{
    const glm::dvec2 ab = glm::dvec2(b) - glm::dvec2(a);
    const glm::dvec2 ac = glm::dvec2(c) - glm::dvec2(a);
    return ab.x * ac.y - ab.y * ac.x;
}

bool is_ear(std::span<const glm::vec2> outline, const std::vector<uint32_t>& ring, size_t at)
{
    const size_t count = ring.size();
    const glm::vec2& a = outline[ring[(at + count - 1) % count]];
    const glm::vec2& b = outline[ring[at]];
    const glm::vec2& c = outline[ring[(at + 1) % count]];
    if (cross_2d(a, b, c) <= 0.0)
        return false;
    return std::none_of(ring.begin(), ring.end(), [&](uint32_t index) {
        const glm::vec2& p = outline[index];
        if (p == a || p == b || p == c)
            return false;
        return cross_2d(a, b, p) >= 0.0 && cross_2d(b, c, p) >= 0.0 && cross_2d(c, a, p) >= 0.0;
    });
}

/// Ear clipping: cuts off one convex corner after another. Straight corners wait until a neighbour takes them
/// along.
std::vector<glm::uvec3> triangulate(std::span<const glm::vec2> outline)
{
    std::vector<uint32_t> ring(outline.size());
    for (uint32_t i = 0; i < ring.size(); ++i)
        ring[i] = i;
    std::vector<glm::uvec3> triangles;
    size_t at = 0;
    for (size_t misses = 0; ring.size() > 3 && misses < ring.size();) {
        at %= ring.size();
        if (!is_ear(outline, ring, at)) {
            ++at;
            ++misses;
            continue;
        }
        const size_t count = ring.size();
        triangles.emplace_back(ring[(at + count - 1) % count], ring[at], ring[(at + 1) % count]);
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
        ++at;
        misses = 0;
    }
    if (ring.size() == 3)
        triangles.emplace_back(ring[0], ring[1], ring[2]);
    return triangles;
}

void add_extruded_sides(Primitive& mesh, std::span<const glm::vec2> outline, float depth, float crease_rad)
{
    const size_t count = outline.size();
    const auto edge_normal = [&](size_t edge) {
        const glm::vec2 step = outline[(edge + 1) % count] - outline[edge % count];
        return glm::normalize(glm::vec2(step.y, -step.x));
    };
    const auto corner_normal = [&](size_t edge, size_t other) {
        const glm::vec2 own = edge_normal(edge);
        const glm::vec2 next = edge_normal(other);
        return glm::dot(own, next) < std::cos(crease_rad) ? own : glm::normalize(own + next);
    };
    float way_m = 0.0F;
    for (size_t edge = 0; edge < count; ++edge) {
        const glm::vec2& a = outline[edge];
        const glm::vec2& b = outline[(edge + 1) % count];
        const glm::vec3 normal_a{corner_normal(edge, edge + count - 1), 0.0F};
        const glm::vec3 normal_b{corner_normal(edge, edge + 1), 0.0F};
        const float end_m = way_m + glm::length(b - a);
        const float z = 0.5F * depth;
        const uint32_t first = add_vertex(mesh, {a, z}, normal_a, {0.0F, way_m});
        add_vertex(mesh, {a, -z}, normal_a, {depth, way_m});
        add_vertex(mesh, {b, -z}, normal_b, {depth, end_m});
        add_vertex(mesh, {b, z}, normal_b, {0.0F, end_m});
        for (const uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
            mesh.indices.push_back(first + corner);
        way_m = end_m;
    }
}

/// Where the rim of a broken top lies below the full height: a slanted plane with notches, the same on every
/// machine.
float broken_off(const FlutedColumn& column, float around)
{
    const float angle = turn_rad * around;
    const float slope = 0.5F + 0.34F * std::cos(angle - 0.7F);
    const float notches = 0.1F * std::sin(5.0F * angle + 1.3F) + 0.06F * std::sin(11.0F * angle);
    return column.break_height * (slope + notches);
}

/// One vertex column of the shaft: direction, radius factor and normal about the axis.
struct Rib {
    float around = 0.0F; ///< part of a turn
    glm::vec2 direction;
    float radius = 1.0F;
    glm::vec2 normal;
};

/// Both sides of one flute's arrises keep their own normals, so the flutes do not share ribs.
std::vector<Rib> flute_ribs(const FlutedColumn& column, uint32_t flute, uint32_t flutes, uint32_t parts)
{
    std::vector<Rib> ribs;
    for (uint32_t part = 0; part <= parts; ++part) {
        const uint32_t step = (flute * parts + part) % (flutes * parts);
        const float around = static_cast<float>(step) / static_cast<float>(flutes * parts);
        const float across = static_cast<float>(part) / static_cast<float>(parts);
        const float angle = turn_rad * around;
        const glm::vec2 outwards{std::sin(angle), std::cos(angle)};
        const glm::vec2 sideways{std::cos(angle), -std::sin(angle)};
        const bool arris = part == 0 || part == parts;
        const float radius = arris ? 1.0F : 1.0F - column.flute_depth * std::sin(0.5F * turn_rad * across);
        const float slope =
            -column.flute_depth * 0.5F * static_cast<float>(flutes) * std::cos(0.5F * turn_rad * across);
        ribs.push_back({static_cast<float>(flute * parts + part) / static_cast<float>(flutes * parts),
                        outwards, radius, glm::normalize(radius * outwards - slope * sideways)});
    }
    return ribs;
}

float shaft_radius(const FlutedColumn& column, float part)
{
    const float swell = 0.02F * column.radius_bottom * std::sin(0.5F * turn_rad * part);
    return column.radius_bottom + (column.radius_top - column.radius_bottom) * part + swell;
}

void add_column_cap(Primitive& mesh, const std::vector<glm::vec3>& rim, bool top)
{
    float height = 0.0F;
    for (const glm::vec3& p : rim)
        height += p.y / static_cast<float>(rim.size());
    const glm::vec3 centre{0.0F, top ? height : 0.0F, 0.0F};
    for (size_t i = 0; i < rim.size(); ++i) {
        const glm::vec3& a = top ? rim[i] : rim[(i + 1) % rim.size()];
        const glm::vec3& b = top ? rim[(i + 1) % rim.size()] : rim[i];
        const glm::vec3 normal = glm::normalize(glm::cross(a - centre, b - centre));
        for (const glm::vec3& p : {centre, a, b})
            mesh.indices.push_back(add_vertex(mesh, p, normal, {p.x, p.z}));
    }
}

} // namespace

Primitive extrude(std::span<const glm::vec2> outline, float depth, float crease_rad)
{
    Primitive mesh;
    if (outline.size() < 3)
        return mesh;
    const std::vector<glm::uvec3> triangles = triangulate(outline);
    for (const float side : {1.0F, -1.0F}) {
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const glm::vec2& point : outline)
            add_vertex(mesh, {point, 0.5F * side * depth}, {0.0F, 0.0F, side}, point);
        for (const glm::uvec3& t : triangles)
            for (const uint32_t corner : {t.x, side > 0.0F ? t.y : t.z, side > 0.0F ? t.z : t.y})
                mesh.indices.push_back(first + corner);
    }
    add_extruded_sides(mesh, outline, depth, crease_rad);
    return mesh;
}

float arch_wall_length(const ArchWall& wall)
{
    const auto arches = static_cast<float>(wall.arches);
    return arches * wall.opening + (arches + 1.0F) * wall.pier;
}

Primitive arch_wall(const ArchWall& wall)
{
    const float radius = 0.5F * wall.opening;
    const float height = std::max(wall.height, wall.springing + 1.02F * radius);
    const uint32_t segments = std::max(wall.arch_segments, 3U);
    const float left = -0.5F * arch_wall_length(wall);
    std::vector<glm::vec2> outline{{left, 0.0F}};
    for (uint32_t arch = 0; arch < wall.arches; ++arch) {
        const float start = left + wall.pier + static_cast<float>(arch) * (wall.opening + wall.pier);
        outline.emplace_back(start, 0.0F);
        for (uint32_t i = 0; i <= segments; ++i) {
            const float angle = 0.5F * turn_rad * static_cast<float>(i) / static_cast<float>(segments);
            outline.emplace_back(start + radius * (1.0F - std::cos(angle)),
                                 wall.springing + (i == segments ? 0.0F : radius * std::sin(angle)));
        }
        outline.emplace_back(start + wall.opening, 0.0F);
    }
    outline.insert(outline.end(), {{-left, 0.0F}, {-left, height}, {left, height}});
    return extrude(outline, wall.thickness);
}

Primitive fluted_column(const FlutedColumn& column)
{
    const uint32_t flutes = std::max(column.flutes, 3U);
    const uint32_t parts = std::max(column.flute_segments, 2U);
    const uint32_t rings = std::max(column.rings, 1U);
    Primitive mesh;
    std::vector<glm::vec3> foot, head;
    for (uint32_t flute = 0; flute < flutes; ++flute) {
        const std::vector<Rib> ribs = flute_ribs(column, flute, flutes, parts);
        const auto first = static_cast<uint32_t>(mesh.positions.size());
        for (const Rib& rib : ribs) {
            const float around = rib.around == 1.0F ? 0.0F : rib.around;
            const float top = column.height - broken_off(column, around);
            for (uint32_t ring = 0; ring <= rings; ++ring) {
                const float y = top * static_cast<float>(ring) / static_cast<float>(rings);
                const float radius = shaft_radius(column, y / column.height);
                const glm::vec2 xz = radius * rib.radius * rib.direction;
                const glm::vec3 normal{
                    rib.normal.x, (column.radius_bottom - column.radius_top) / column.height, rib.normal.y};
                add_vertex(mesh, {xz.x, y, xz.y}, glm::normalize(normal),
                           {y, turn_rad * column.radius_bottom * rib.around});
            }
        }
        for (uint32_t part = 0; part < parts; ++part) {
            foot.push_back(mesh.positions[first + part * (rings + 1)]);
            head.push_back(mesh.positions[first + part * (rings + 1) + rings]);
            for (uint32_t ring = 0; ring < rings; ++ring) {
                const uint32_t a = first + part * (rings + 1) + ring;
                const uint32_t b = a + rings + 1;
                for (const uint32_t index : {a, b, b + 1, a, b + 1, a + 1})
                    mesh.indices.push_back(index);
            }
        }
    }
    add_column_cap(mesh, foot, false);
    add_column_cap(mesh, head, true);
    return mesh;
}

Primitive stairs(float width, float rise, float run, uint32_t steps)
{
    steps = std::max(steps, 1U);
    const auto count = static_cast<float>(steps);
    // In the outline x is the way back, away from the viewer, and the wall behind the last step closes it.
    std::vector<glm::vec2> outline{{0.0F, 0.0F}, {count * run, 0.0F}};
    for (uint32_t step = steps; step > 0; --step) {
        const auto at = static_cast<float>(step);
        outline.emplace_back(at * run, at * rise);
        outline.emplace_back((at - 1.0F) * run, at * rise);
    }
    const glm::mat4 centred = glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 0.5F * count * run});
    Primitive mesh;
    append(mesh, extrude(outline, width), glm::rotate(centred, 0.25F * turn_rad, {0.0F, 1.0F, 0.0F}));
    return mesh;
}

} // namespace estampe::shapes
