// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_TRANSPARENCY_LAYER
#define ESTAMPE_TRANSPARENCY_LAYER

// A transparent surface at a pixel. Define before: `frame`, a FrameGlobals; texels of meshes, draws, rest
// vertices and materials; textures of all classes, and TEXTURE_CLASSES.

#include "shaders/texture.glsl"

struct Layer {
    uint draw; // draw call + 1; 0: the surface has almost no coverage here
    uint depth_bits;
    vec4 color; // linear colour in rgb; coverage in alpha
};

Layer layer_at(uvec2 seen, ivec2 pixel)
{
    uvec4 corners = triangle_at(seen_triangle(seen));
    uint draw_index = corners.w & triangle_draw_mask;
    DrawPart draw = draw_at(draw_index);
    Barycentric at = barycentric_at(frame.clip_from_anchor * vec4(posed_vertex_at(corners.x).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.y).position, 1.0),
                                    frame.clip_from_anchor * vec4(posed_vertex_at(corners.z).position, 1.0),
                                    page_place(frame, vec2(pixel) + 0.5), frame.page_px);
    uvec3 rest = corners.xyz - draw.first_posed_vertex + draw.first_rest_vertex;
    RestVertex a = rest_vertex_at(rest.x);
    RestVertex b = rest_vertex_at(rest.y);
    RestVertex c = rest_vertex_at(rest.z);
    mat3x4 vertex_colors = mat3x4(vertex_color(a.color), vertex_color(b.color), vertex_color(c.color));
    vec4 color = base_color_of(draw.material) * (vertex_colors * at.weight);
    TextureSlot slot = base_texture_of(draw.material);
    if (TEXTURE_CLASSES != 0u && slot.location != no_texture) {
        bool second = uv_set_of(slot) != 0u;
        mat3x2 uv = second ? mat3x2(a.uv_1, b.uv_1, c.uv_1) : mat3x2(a.uv_0, b.uv_0, c.uv_0);
        vec4 texel = sample_texture(slot, UvFootprint(uv * at.weight, uv * at.dx, uv * at.dy));
        color *= vec4(linear_from_srgb(texel.rgb), texel.a);
    }
    color = clamp(color, 0.0, 1.0);
    return Layer(color.a >= least_cover ? draw_index + 1u : 0u, seen.y, color);
}

#endif
