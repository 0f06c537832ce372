// SPDX-License-Identifier: MIT
// One thread per pixel composites the transparent surfaces in front of the solid one, nearest first, into one
// colour and coverage.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_vote : require

#include "shaders/barycentric.glsl"
#include "shaders/camera.glsl"
#include "shaders/color.glsl"
#include "shaders/hash.glsl"
#include "shaders/scene.glsl.h"
#include "techniques/transparency/transparency_variant.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar, binding = 0) uniform Frame
{
    FrameGlobals frame;
};

#define VISIBILITY_BINDING 1
#include "shaders/visibility_texels.glsl"

#define MESH_TEXELS_BINDING 2
#include "shaders/mesh_texels.glsl"

#define DRAW_TEXELS_BINDING 4
#include "shaders/draw_texels.glsl"

#define REST_TEXELS_BINDING 5
#include "shaders/rest_texels.glsl"

#define MATERIAL_TEXELS_BINDING 6
#include "shaders/material_texels.glsl"

layout(binding = 7) uniform sampler2DArray texture_class_0;
layout(binding = 8) uniform sampler2DArray texture_class_1;
layout(binding = 9) uniform sampler2DArray texture_class_2;
layout(binding = 10) uniform sampler2DArray texture_class_3;
layout(binding = 11) uniform sampler2DArray texture_class_4;

// Visibility buffers of transparent layers in depth order, nearest first. For a missing layer, the buffer of
// another layer is bound.
layout(binding = 12) uniform usamplerBuffer layer_0;
layout(binding = 13) uniform usamplerBuffer layer_1;
layout(binding = 14) uniform usamplerBuffer layer_2;
layout(binding = 15) uniform usamplerBuffer layer_3;
layout(binding = 16, r32ui) writeonly uniform uimage2D out_draw; // draw call + 1; 0: no transparent surface
// Square root of linear colour in rgb; coverage in alpha.
layout(binding = 17, rgba8) writeonly uniform image2D out_color;

#define TILE_LIST_BINDING 18
#include "shaders/tile_list.glsl"

layout(constant_id = 0) const uint variant = 31u;
const bool has_tiles = (variant & screen_has_tiles) != 0u;
#define TEXTURE_CLASSES (variant & texture_class_mask)
const int LAYERS = int((variant >> screen_layers_shift) & 3u) + 1;

#include "techniques/transparency/transparency_layer.glsl"

uvec2 seen_in(int layer, int index)
{
    return layer == 0   ? texelFetch(layer_0, index).xy
           : layer == 1 ? texelFetch(layer_1, index).xy
           : layer == 2 ? texelFetch(layer_2, index).xy
                        : texelFetch(layer_3, index).xy;
}

// Whether two layers at equal depth, sorted by index, must be swapped. Sorting by colour makes the picture
// independent of the order in the scene.
bool is_out_of_order(Layer a, Layer b)
{
    uint of_a = packUnorm4x8(a.color);
    uint of_b = packUnorm4x8(b.color);
    return a.depth_bits == b.depth_bits && of_a < of_b;
}

void sort_ties(inout Layer layers[LAYERS])
{
    for (int last = LAYERS - 1; last > 0; --last) {
        for (int i = 0; i < last; ++i) {
            if (is_out_of_order(layers[i], layers[i + 1])) {
                Layer nearer = layers[i];
                layers[i] = layers[i + 1];
                layers[i + 1] = nearer;
            }
        }
    }
}

// An identifier of all layers' draw calls in depth order, each draw call once. Borders between the layers'
// objects then appear as changes of the identifier. A single draw call is its own identifier.
uint name_of(Layer layers[LAYERS])
{
    uint name = 0u;
    for (int i = 0; i < LAYERS; ++i) {
        bool is_new = layers[i].draw != 0u;
        for (int k = 0; k < i; ++k) {
            is_new = is_new && layers[k].draw != layers[i].draw;
        }
        name = !is_new ? name : name == 0u ? layers[i].draw : hash(name, layers[i].draw);
    }
    return name;
}

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (has_tiles) {
        pixel = ivec2(listed_from_px() + gl_LocalInvocationID.xy);
    }
    if (any(greaterThanEqual(uvec2(pixel), frame.size_px))) {
        return;
    }
    int index = pixel.y * int(frame.size_px.x) + pixel.x;
    float solid_depth = seen_depth(visibility_at(pixel));
    uvec2 seen[LAYERS];
    int there = 0;
    for (int i = 0; i < LAYERS; ++i) {
        seen[i] = seen_in(i, index);
        bool is_there = sees_triangle(seen[i]) && seen_depth(seen[i]) > solid_depth;
        there += is_there && there == i ? 1 : 0;
    }
    Layer layers[LAYERS];
    for (int i = 0; i < LAYERS; ++i) {
        layers[i] = Layer(0u, 0u, vec4(0.0));
    }
    // On CPUs, the fastest loop is one with a single body for all layers, which all lanes leave together.
    int round_index = 0;
    do {
        uvec2 word = seen[0];
        for (int i = 1; i < LAYERS; ++i) {
            word = i == round_index ? seen[i] : word;
        }
        Layer found = layer_at(word, pixel);
        for (int i = 0; i < LAYERS; ++i) {
            if (i == round_index && i < there) {
                layers[i] = found;
            }
        }
        ++round_index;
    } while (subgroupAny(round_index < there));
    sort_ties(layers);
    vec3 color = vec3(0.0); // colour multiplied by coverage (premultiplied)
    float through = 1.0;
    for (int i = 0; i < LAYERS; ++i) {
        color += through * layers[i].color.a * layers[i].color.rgb;
        through *= 1.0 - layers[i].color.a;
    }
    float cover = 1.0 - through;
    imageStore(out_draw, pixel, uvec4(name_of(layers)));
    imageStore(out_color, pixel, vec4(sqrt(color / max(cover, 1e-6)), cover));
}
