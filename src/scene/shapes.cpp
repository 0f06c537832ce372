// SPDX-License-Identifier: MIT
#include <estampe/shapes.hpp>

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_inverse.hpp>

#include "scene/mesh_building.hpp"

namespace estampe::shapes {
namespace {

void add_triangle(Primitive& mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// A rectangle from `corner` along `right` and `up`, facing cross(right, up).
void add_face(Primitive& mesh, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up)
{
    const glm::vec3 normal = glm::normalize(glm::cross(right, up));
    const float u = glm::length(right);
    const float v = glm::length(up);
    const uint32_t a = add_vertex(mesh, corner, normal, {0.0F, 0.0F});
    const uint32_t b = add_vertex(mesh, corner + right, normal, {u, 0.0F});
    const uint32_t c = add_vertex(mesh, corner + right + up, normal, {u, v});
    const uint32_t d = add_vertex(mesh, corner + up, normal, {0.0F, v});
    add_triangle(mesh, a, b, c);
    add_triangle(mesh, a, c, d);
}

/// Directions around the y axis, the last equal to the first bit for bit; from +z towards +x.
std::vector<glm::vec2> circle(uint32_t segments)
{
    std::vector<glm::vec2> directions;
    for (uint32_t i = 0; i < segments; ++i) {
        const float angle = turn_rad * static_cast<float>(i) / static_cast<float>(segments);
        directions.emplace_back(std::sin(angle), std::cos(angle));
    }
    directions.push_back(directions.front());
    return directions;
}

/// One straight piece of a profile with the normals (radial, height) at its two ends.
struct ProfilePiece {
    glm::vec2 from, to;
    glm::vec2 normal_from, normal_to;
    float start_m = 0.0F; ///< way along the profile to `from`
};

std::vector<ProfilePiece> profile_pieces(std::span<const glm::vec2> profile, float crease_rad)
{
    std::vector<ProfilePiece> pieces;
    float way_m = 0.0F;
    for (size_t i = 0; i + 1 < profile.size(); ++i) {
        const glm::vec2 step = profile[i + 1] - profile[i];
        const float length = glm::length(step);
        if (length == 0.0F)
            continue;
        const glm::vec2 normal = glm::vec2(step.y, -step.x) / length;
        pieces.push_back({profile[i], profile[i + 1], normal, normal, way_m});
        way_m += length;
    }
    const auto join = [crease_rad](ProfilePiece& before, ProfilePiece& after) {
        if (glm::dot(before.normal_to, after.normal_from) < std::cos(std::min(crease_rad, 0.5F * turn_rad)))
            return;
        const glm::vec2 middle = glm::normalize(before.normal_to + after.normal_from);
        before.normal_to = middle;
        after.normal_from = middle;
    };
    for (size_t i = 0; i + 1 < pieces.size(); ++i)
        join(pieces[i], pieces[i + 1]);
    if (pieces.size() > 2 && profile.front() == profile.back())
        join(pieces.back(), pieces.front());
    return pieces;
}

void add_lathe_piece(Primitive& mesh, const ProfilePiece& piece, std::span<const glm::vec2> around,
                     float radius)
{
    const auto count = static_cast<uint32_t>(around.size() - 1);
    const auto place = [](const glm::vec2& direction, const glm::vec2& point) {
        return glm::vec3(direction.x * point.x, point.y, direction.y * point.x);
    };
    const float end_m = piece.start_m + glm::length(piece.to - piece.from);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t i = 0; i <= count; ++i) {
        const float u = turn_rad * radius * static_cast<float>(i) / static_cast<float>(count);
        add_vertex(mesh, place(around[i], piece.from), place(around[i], piece.normal_from),
                   {u, piece.start_m});
        add_vertex(mesh, place(around[i], piece.to), place(around[i], piece.normal_to), {u, end_m});
    }
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t a = first + 2 * i;
        if (piece.from.x > 0.0F)
            add_triangle(mesh, a, a + 2, a + 3);
        if (piece.to.x > 0.0F)
            add_triangle(mesh, a, a + 3, a + 1);
    }
}

} // namespace

Primitive plane(float width, float depth, uint32_t cells)
{
    cells = std::max(cells, 1U);
    Primitive mesh;
    for (uint32_t row = 0; row <= cells; ++row)
        for (uint32_t column = 0; column <= cells; ++column) {
            const float u = width * static_cast<float>(column) / static_cast<float>(cells);
            const float v = depth * static_cast<float>(row) / static_cast<float>(cells);
            add_vertex(mesh, {u - 0.5F * width, 0.0F, 0.5F * depth - v}, {0.0F, 1.0F, 0.0F}, {u, v});
        }
    for (uint32_t row = 0; row < cells; ++row)
        for (uint32_t column = 0; column < cells; ++column) {
            const uint32_t a = row * (cells + 1) + column;
            add_triangle(mesh, a, a + 1, a + cells + 2);
            add_triangle(mesh, a, a + cells + 2, a + cells + 1);
        }
    return mesh;
}

Primitive quad(float width, float height)
{
    Primitive mesh;
    add_face(mesh, {-0.5F * width, 0.0F, 0.0F}, {width, 0.0F, 0.0F}, {0.0F, height, 0.0F});
    return mesh;
}

Primitive box(const glm::vec3& size)
{
    const glm::vec3 half = 0.5F * size;
    const glm::vec3 x{size.x, 0.0F, 0.0F};
    const glm::vec3 y{0.0F, size.y, 0.0F};
    const glm::vec3 z{0.0F, 0.0F, size.z};
    const glm::vec3 corner{-half.x, 0.0F, -half.z};
    Primitive mesh;
    add_face(mesh, corner + z, x, y);
    add_face(mesh, corner + x + z, -z, y);
    add_face(mesh, corner + x, -x, y);
    add_face(mesh, corner, z, y);
    add_face(mesh, corner + y + z, x, -z);
    add_face(mesh, corner, x, z);
    // A corner is reached by different sums of edges: make its coordinates one.
    for (glm::vec3& p : mesh.positions)
        p = {p.x < 0.0F ? -half.x : half.x, p.y < half.y ? 0.0F : size.y, p.z < 0.0F ? -half.z : half.z};
    return mesh;
}

Primitive lathe(std::span<const glm::vec2> profile, uint32_t segments, float crease_rad)
{
    const std::vector<glm::vec2> around = circle(std::max(segments, 3U));
    float radius = 0.0F;
    for (const glm::vec2& point : profile)
        radius = std::max(radius, point.x);
    Primitive mesh;
    for (const ProfilePiece& piece : profile_pieces(profile, crease_rad))
        add_lathe_piece(mesh, piece, around, radius);
    return mesh;
}

Primitive sphere(float radius, uint32_t segments, uint32_t rings)
{
    rings = std::max(rings, 2U);
    std::vector<glm::vec2> profile;
    for (uint32_t ring = 0; ring <= rings; ++ring) {
        const float angle = 0.5F * turn_rad * static_cast<float>(ring) / static_cast<float>(rings);
        const bool pole = ring == 0 || ring == rings;
        profile.emplace_back(pole ? 0.0F : radius * std::sin(angle), -radius * std::cos(angle));
    }
    Primitive mesh = lathe(profile, segments, turn_rad);
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        mesh.normals[i] = glm::normalize(mesh.positions[i]);
    return mesh;
}

Primitive torus(float radius, float tube_radius, uint32_t segments, uint32_t tube_segments)
{
    std::vector<glm::vec2> profile;
    for (const glm::vec2& direction : circle(std::max(tube_segments, 3U)))
        profile.emplace_back(radius - tube_radius * direction.y, -tube_radius * direction.x);
    return lathe(profile, segments, turn_rad);
}

Primitive cylinder(float radius, float height, uint32_t segments)
{
    const glm::vec2 profile[] = {{0.0F, 0.0F}, {radius, 0.0F}, {radius, height}, {0.0F, height}};
    return lathe(profile, segments);
}

Primitive cone(float radius, float height, uint32_t segments)
{
    const glm::vec2 profile[] = {{0.0F, 0.0F}, {radius, 0.0F}, {0.0F, height}};
    return lathe(profile, segments);
}

void append(Primitive& whole, const Primitive& part, const glm::mat4& to_from_part)
{
    const auto first = static_cast<uint32_t>(whole.positions.size());
    const glm::mat3 normal_matrix = glm::inverseTranspose(glm::mat3(to_from_part));
    const bool mirrored = glm::determinant(glm::mat3(to_from_part)) < 0.0F;
    for (size_t i = 0; i < part.positions.size(); ++i)
        add_vertex(whole, glm::vec3(to_from_part * glm::vec4(part.positions[i], 1.0F)),
                   glm::normalize(normal_matrix * part.normals[i]), part.uvs[0][i]);
    for (size_t i = 0; i + 2 < part.indices.size(); i += 3) {
        const uint32_t a = first + part.indices[i];
        const uint32_t b = first + part.indices[i + 1];
        const uint32_t c = first + part.indices[i + 2];
        add_triangle(whole, a, mirrored ? c : b, mirrored ? b : c);
    }
}

} // namespace estampe::shapes
