// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_KIND_NOW
#define ESTAMPE_KIND_NOW

// The kind of a line as the eye sees it. Requires before inclusion: `neighbor_texels` and facing.glsl.

// The kind of a line in the current view: a fold or boundary counts as an outline if the surface behind it
// faces away from the eye. `source` is LineSample::source.
uint kind_now(uint source)
{
    uint kind = source >> 28;
    uint side = source & 0x0fffffffu;
    if (kind == line_silhouette || kind == line_border || (side & 3u) == 3u) {
        return kind;
    }
    uint beyond = texelFetch(neighbor_texels, int(side >> 2))[side & 3u];
    return beyond != no_side && is_front(side >> 2) != is_front(beyond >> 2) ? line_silhouette : kind;
}

// Whether a line follows an edge across which the shading is smooth. Where the surface turns away there, the
// outline of the smooth surface runs beside the edge.
bool is_shaded_over(uint source)
{
    uint side = source & 0x0fffffffu;
    uint flags = texelFetch(neighbor_texels, int(side >> 2)).w;
    return (side & 3u) != 3u && (flags >> (neighbor_smooth_shift + (side & 3u)) & 1u) != 0u;
}

// The number of the shell (connected surface) that a line runs along, from 1. `source` is LineSample::source.
uint shell_of_line(uint source)
{
    return texelFetch(neighbor_texels, int((source & 0x0fffffffu) >> 2)).w >> neighbor_shell_shift;
}

#endif
