// SPDX-License-Identifier: MIT
// Builds basic geometric shapes, and architectural shapes: extruded outlines, arches, columns and stairs.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <estampe/scene.hpp>
#include <estampe/shapes.hpp>

namespace estampe::shapes {
namespace {

constexpr float turn_rad = 2.0F * std::numbers::pi_v<float>;

/// Adds a vertex and returns its index.
uint32_t add_vertex(Primitive& mesh, const glm::vec3& position, const glm::vec3& normal, const glm::vec2& uv)
{
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs[0].push_back(uv);
    return static_cast<uint32_t>(mesh.positions.size() - 1);
}

void add_triangle(Primitive& mesh, uint32_t a, uint32_t b, uint32_t c)
{
    mesh.indices.insert(mesh.indices.end(), {a, b, c});
}

/// Adds a rectangle that starts at `corner` and extends along `right` and `up`. The rectangle faces the
/// direction cross(right, up).
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

/// Returns unit directions around the y axis, from +z towards +x. The last direction is bitwise equal to the
/// first.
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

/// A straight segment of the profile of a turned shape, with the normals (radial, height) at its two ends.
struct ProfilePiece {
    glm::vec2 from, to;
    glm::vec2 normal_from, normal_to;
    float start_m = 0.0F; ///< distance along the profile from its beginning to `from`
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
    // Different sums of edges give slightly different coordinates for the same corner. Rounding makes the
    // coordinates of one corner identical.
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
    if (whole.edge_marks.empty() && part.edge_marks.empty())
        return;
    whole.edge_marks.resize((whole.indices.size() - part.indices.size()) / 3);
    for (const uint32_t marks : part.edge_marks) {
        const uint32_t turned = (marks & 1U) << 2U | (marks & 2U) | marks >> 2U;
        whole.edge_marks.push_back(static_cast<uint8_t>(mirrored ? turned : marks));
    }
    whole.edge_marks.resize(whole.indices.size() / 3);
}

glm::mat4 at(const glm::vec3& place, float turn_deg)
{
    return glm::rotate(glm::translate(glm::mat4(1.0F), place), glm::radians(turn_deg), {0.0F, 1.0F, 0.0F});
}

Primitive rod(const glm::vec3& a, const glm::vec3& b, float radius_a, float radius_b, uint32_t segments,
              uint32_t rings)
{
    const float length = glm::distance(a, b);
    const uint32_t steps = std::max(rings, 1U);
    std::vector<glm::vec2> profile;
    for (int end = 0; end < 2; ++end)
        for (uint32_t i = 0; i <= steps; ++i) {
            const uint32_t step = end == 0 ? i : steps - i;
            const float angle =
                0.5F * std::numbers::pi_v<float> * static_cast<float>(step) / static_cast<float>(steps);
            const float radius = end == 0 ? radius_a : radius_b;
            const float out = step == 0 ? 0.0F : radius * std::sin(angle);
            const float along = radius * std::cos(angle);
            profile.emplace_back(out, end == 0 ? -along : length + along);
        }
    const glm::vec3 y = (b - a) / length;
    const glm::vec3 x =
        glm::normalize(glm::cross(std::abs(y.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1), y));
    const glm::mat4 placed(glm::vec4(x, 0.0F), glm::vec4(y, 0.0F), glm::vec4(glm::cross(x, y), 0.0F),
                           glm::vec4(a, 1.0F));
    Primitive mesh;
    append(mesh, lathe(profile, segments), placed);
    return mesh;
}

void MeshBuilder::add(const MeshBuilder& other, const glm::mat4& placed)
{
    for (const auto& [key, primitive] : other.parts_)
        append(part(key.first, key.second), primitive, placed);
}

Primitive& MeshBuilder::part(Index material, bool has_edge_marks)
{
    Primitive& primitive = parts_[{material, has_edge_marks}];
    primitive.material = material;
    return primitive;
}

Mesh MeshBuilder::mesh(const std::string& name) const
{
    Mesh mesh{.name = name};
    for (const auto& [key, primitive] : parts_)
        mesh.primitives.push_back(primitive);
    return mesh;
}

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

/// Triangulates a polygon by ear clipping. A straight corner cannot be clipped alone; it is clipped together
/// with a neighbour.
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

/// Returns how far the rim of a broken column is below the column's full height. The rim is a slanted plane
/// with notches. The result is identical on every machine.
float broken_off(const FlutedColumn& column, float around)
{
    const float angle = turn_rad * around;
    const float slope = 0.5F + 0.34F * std::cos(angle - 0.7F);
    const float notches = 0.1F * std::sin(5.0F * angle + 1.3F) + 0.06F * std::sin(11.0F * angle);
    return column.break_height * (slope + notches);
}

/// One vertical line of vertices on the shaft of a column: direction from the axis, radius factor and normal.
struct Rib {
    float around = 0.0F; ///< angle as a share of a full turn
    glm::vec2 direction;
    float radius = 1.0F;
    glm::vec2 normal;
};

/// Returns the vertical lines of vertices of one flute of a column. Adjacent flutes share no vertices,
/// because the two sides of the ridge between them have different normals.
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
    // The outline of the stairs: x points back, away from the viewer. A vertical wall behind the last step
    // closes the outline.
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
