// SPDX-License-Identifier: MIT
// One corner of a triangle of a cluster, in its view's square of the image. Each instance is one cluster in
// one view.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/raster/views/draw_views.glsl"

layout(location = 0) flat out uint triangle_drawn;
layout(location = 1) flat out uint view_drawn;

out float gl_ClipDistance[4];

void main()
{
    ClusterInView item = list[gl_InstanceIndex];
    uint triangle = item.cluster * cluster_triangles + uint(gl_VertexIndex) / 3u;
    triangle_drawn = triangle;
    view_drawn = item.view;
    if (triangle < constants.first_triangle ||
        triangle >= constants.first_triangle + constants.triangle_count) {
        // A corner outside the near plane, so that the triangle is not drawn.
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
        for (int i = 0; i < 4; ++i) {
            gl_ClipDistance[i] = -1.0;
        }
        return;
    }
    RasterView view = views[item.view];
    uvec4 corners = triangle_at(triangle);
    uint corner = uint(gl_VertexIndex) % 3u;
    uint vertex = corner == 0u ? corners.x : corner == 1u ? corners.y : corners.z;
    vec4 clip = view.clip_from_anchor * vec4(posed_vertex_at(vertex).position, 1.0);
    gl_ClipDistance[0] = clip.w + clip.x;
    gl_ClipDistance[1] = clip.w - clip.x;
    gl_ClipDistance[2] = clip.w + clip.y;
    gl_ClipDistance[3] = clip.w - clip.y;
    vec2 image_px = vec2(constants.image_px);
    vec2 scale = float(view.size_px) / image_px;
    vec2 middle = (2.0 * vec2(view.origin_px) + float(view.size_px)) / image_px - 1.0;
    gl_Position = vec4(clip.xy * scale + clip.w * middle, clip.zw);
}
