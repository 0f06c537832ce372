// SPDX-License-Identifier: MIT
// One thread tests 32 triangles and sets a bit for each triangle that may be visible. Rasterisers on CPU
// devices are slow to reject invisible triangles.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "shaders/loops.glsl"
#include "techniques/raster/hardware/draw.glsl"

layout(local_size_x = 64) in;

layout(scalar, binding = 2) writeonly buffer Kept
{
    uint kept[];
};

#include "techniques/raster/clusters/seen_clusters.glsl"

layout(constant_id = 0) const uint variant = 0u;

// Upper limit of the distance by which a hardware rasteriser moves a corner when it snaps the corner.
const float snapped_px = 1.0 / 64.0;

vec2 place_px(vec4 clip)
{
    return (0.5 * clip.xy / clip.w + 0.5) * vec2(constants.size_px);
}

// Minimum and maximum of twice a triangle's area on the page, over all positions to which the corners may be
// snapped. The area is positive if the corners run clockwise.
vec2 double_area(vec2 p, vec2 q, vec2 r)
{
    vec2 u = q - p;
    vec2 v = r - p;
    float moved = 4.0 * snapped_px * (abs(u.x) + abs(u.y) + abs(v.x) + abs(v.y) + snapped_px);
    return u.x * v.y - u.y * v.x + vec2(-moved, moved);
}

// Whether a triangle may be visible. False if all corners are outside one side of the page or the near plane,
// if no pixel centre is in the triangle's bounding box, or if the triangle is a culled back face.
bool may_be_seen(vec4 a, vec4 b, vec4 c, uint flags)
{
    vec3 x = vec3(a.x, b.x, c.x);
    vec3 y = vec3(a.y, b.y, c.y);
    vec3 z = vec3(a.z, b.z, c.z);
    vec3 w = vec3(a.w, b.w, c.w);
    if (all(greaterThan(x, w)) || all(lessThan(x, -w)) || all(greaterThan(y, w)) || all(lessThan(y, -w)) ||
        all(greaterThan(z, w))) {
        return false;
    }
    if (any(greaterThan(z, w)) || any(lessThanEqual(w, vec3(0.0)))) {
        return true; // the triangle crosses the near plane
    }
    vec2 p = place_px(a);
    vec2 q = place_px(b);
    vec2 r = place_px(c);
    vec2 low = min(p, min(q, r)) - snapped_px;
    vec2 high = max(p, max(q, r)) + snapped_px;
    vec2 area = double_area(p, q, r);
    bool is_turned = (flags & triangle_mirrored) != 0u ? area.y < 0.0 : area.x > 0.0;
    bool is_dropped = (variant & cull_drops_backs) != 0u && (flags & triangle_two_sided) == 0u && is_turned;
    return !is_dropped && all(lessThanEqual(ceil(low - 0.5), floor(high - 0.5)));
}

vec4 clip_of(uint vertex)
{
    return constants.clip_from_anchor * vec4(posed_vertex_at(vertex).position, 1.0);
}

void main()
{
    uint word = item_index();
    uint first = 32u * word;
    if (first >= constants.triangle_count) {
        return;
    }
    uint bits = 0u;
    for (uint i = 0u; i < 32u; ++i) {
        uint triangle = constants.first_triangle + min(first + i, constants.triangle_count - 1u);
        if (!is_in_sight(triangle / cluster_triangles)) {
            continue;
        }
        uvec4 corners = triangle_at(triangle);
        bool is_kept = first + i < constants.triangle_count &&
                       may_be_seen(clip_of(corners.x), clip_of(corners.y), clip_of(corners.z), corners.w);
        bits |= is_kept ? 1u << i : 0u;
    }
    kept[word] = bits;
}
