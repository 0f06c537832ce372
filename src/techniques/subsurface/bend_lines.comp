// SPDX-License-Identifier: MIT
// One thread per pixel of a clear body adds the lines behind the body, at the place where the bent view ray
// meets them.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D seen_image;
layout(binding = 1) uniform sampler2D lines_behind; // lines as they are drawn without clear bodies

// Lines in front of clear bodies and of the bodies themselves; square root of the ink's colour, and coverage.
layout(binding = 2, rgba8) uniform image2D lines;

void main()
{
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 size_px = imageSize(lines);
    if (any(greaterThanEqual(pixel, size_px))) {
        return;
    }
    vec4 seen = texelFetch(seen_image, pixel, 0);
    if (seen.z == 0.0) {
        return;
    }
    vec4 behind = textureLod(lines_behind, seen.xy / vec2(size_px), 0.0);
    vec4 front = imageLoad(lines, pixel);
    float added = behind.a * (1.0 - front.a);
    float cover = front.a + added;
    if (added > 0.0) {
        imageStore(lines, pixel, vec4(mix(front.rgb, behind.rgb, added / cover), cover));
    }
}
