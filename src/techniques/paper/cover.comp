// SPDX-License-Identifier: MIT
// One thread per pixel copies the objects' coverage from the wash's alpha into a new wash, and copies the
// ink. Depth of field or motion blur then blurs the coverage like the picture.
#version 460

layout(local_size_x = 8, local_size_y = 32) in;

layout(binding = 0) uniform sampler2D wash_image;
layout(binding = 1) uniform sampler2D hatch_image;
layout(binding = 2) uniform sampler2D line_image;
layout(binding = 3, rgba16f) writeonly uniform image2D out_wash;
layout(binding = 4, r16f) writeonly uniform image2D out_hatch;
layout(binding = 5, rgba8) writeonly uniform image2D out_lines;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(out_wash)))) {
        return;
    }
    imageStore(out_wash, pixel, vec4(texelFetch(wash_image, pixel, 0).a));
    imageStore(out_hatch, pixel, texelFetch(hatch_image, pixel, 0));
    imageStore(out_lines, pixel, texelFetch(line_image, pixel, 0));
}
