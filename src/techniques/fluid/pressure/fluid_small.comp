// SPDX-License-Identifier: MIT
// One workgroup: all remaining coarse levels in shared memory, down to a handful of cells and up again.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require

#include "techniques/fluid/fluid.glsl.h"

layout(local_size_x = 256) in;

layout(constant_id = 0) const uint variant = 0u;

layout(binding = 0) uniform samplerBuffer divergence;
layout(binding = 1) uniform usamplerBuffer weights;

layout(scalar, binding = 2) writeonly buffer Pressure
{
    float out_pressure[];
};

layout(push_constant, scalar) uniform Constants
{
    FluidSmall small;
};

// Cells of all multigrid levels together, for any shape of grid.
const int all_cells = 2 * int(fluid_small_cells);
const int thread_count = 256;

shared float cell_pressure[all_cells];
shared float cell_divergence[all_cells];
shared uint cell_weights[all_cells];
shared vec2 sums[thread_count]; // sums per thread of divergence, and of the number of cells with an open face

#include "techniques/fluid/pressure/fluid_extent.glsl"

struct Level {
    ivec2 size;
    int first;
    int number; // number of the multigrid level; 0 is the grid itself
};

Level level_of(int number)
{
    Level level = Level(ivec2(small.level.width, small.level.height), 0, int(small.level_number));
    for (int i = 0; i < number; ++i) {
        level = Level((level.size + 1) / 2, level.first + level.size.x * level.size.y, level.number + 1);
    }
    return level;
}

bool wraps(int axis)
{
    return (variant & (fluid_bit_periodic << axis)) != 0u;
}

// Index of a cell's neighbour. A missing neighbour gets the last index, whose cell has a closed face.
int neighbour(Level level, ivec2 cell)
{
    bool is_outside_x = cell.x < 0 || cell.x >= level.size.x;
    bool is_outside_y = cell.y < 0 || cell.y >= level.size.y;
    if (is_outside_x && !wraps(0) || is_outside_y && !wraps(1)) {
        return all_cells - 1;
    }
    cell = ivec2(cell.x < 0               ? level.size.x - 1
                 : cell.x == level.size.x ? 0
                                          : cell.x,
                 cell.y < 0               ? level.size.y - 1
                 : cell.y == level.size.y ? 0
                                          : cell.y);
    return level.first + cell.y * level.size.x + cell.x;
}

// Openings of a cell's faces, and pressures of the cell's neighbours, in the order lower x, lower y, higher
// x, higher y.
void look_around(Level level, ivec2 cell, out vec4 open, out vec4 pressures)
{
    int right = neighbour(level, cell + ivec2(1, 0));
    int above = neighbour(level, cell + ivec2(0, 1));
    open = vec4(unpackHalf2x16(cell_weights[level.first + cell.y * level.size.x + cell.x]),
                unpackHalf2x16(cell_weights[right]).x, unpackHalf2x16(cell_weights[above]).y);
    pressures =
        vec4(cell_pressure[neighbour(level, cell - ivec2(1, 0))],
             cell_pressure[neighbour(level, cell - ivec2(0, 1))], cell_pressure[right], cell_pressure[above]);
}

// Whether a cell is the last before a periodic edge across which colours do not alternate.
int is_at_seam(Level level, ivec2 cell, int axis)
{
    return wraps(axis) && (level.size[axis] & 1) == 1 && cell[axis] == level.size[axis] - 1 ? 1 : 0;
}

// Colour of a cell for Gauss-Seidel sweeps; no two neighbours have equal colours. Red and black alternate,
// and cells at periodic edges with an odd number of cells have extra colours.
int color_of(Level level, ivec2 cell)
{
    return ((cell.x + cell.y) & 1) + 2 * (is_at_seam(level, cell, 0) + is_at_seam(level, cell, 1));
}

int color_count(Level level)
{
    return 2 + 2 * (is_at_seam(level, level.size - 1, 0) + is_at_seam(level, level.size - 1, 1));
}

void relax_color(Level level, int color)
{
    for (int k = int(gl_LocalInvocationIndex); k < level.size.x * level.size.y; k += thread_count) {
        ivec2 cell = ivec2(k % level.size.x, k / level.size.x);
        if (color_of(level, cell) == color) {
            vec4 open;
            vec4 pressures;
            look_around(level, cell, open, pressures);
            float all_open = dot(open, vec4(1.0));
            int i = level.first + k;
            cell_pressure[i] = all_open > 0.0 ? (dot(open, pressures) - cell_divergence[i]) / all_open : 0.0;
        }
    }
    barrier();
}

void sweep(Level level, int count)
{
    for (int i = 0; i < count; ++i) {
        for (int color = 0; color < color_count(level); ++color) {
            relax_color(level, color);
        }
    }
}

vec2 nearness_at(Level level, ivec2 cell)
{
    return vec2(nearness(cell.x, level.size.x, level.number, int(small.width)),
                nearness(cell.y, level.size.y, level.number, int(small.height)));
}

// Computes the face weights and the summed residuals of the next coarser multigrid level.
void restrict_to(Level coarse, Level level)
{
    for (int k = int(gl_LocalInvocationIndex); k < coarse.size.x * coarse.size.y; k += thread_count) {
        ivec2 coarse_cell = ivec2(k % coarse.size.x, k / coarse.size.x);
        float sum = 0.0;
        vec2 faces = vec2(0.0);
        for (int j = 0; j < 4; ++j) {
            ivec2 cell = 2 * coarse_cell + ivec2(j & 1, j >> 1);
            if (all(lessThan(cell, level.size))) {
                int i = level.first + cell.y * level.size.x + cell.x;
                vec4 open;
                vec4 pressures;
                look_around(level, cell, open, pressures);
                sum += cell_divergence[i] - dot(open, pressures - cell_pressure[i]);
                faces += vec2((j & 1) == 0 ? open.x : 0.0, j < 2 ? open.y : 0.0) / nearness_at(level, cell);
            }
        }
        cell_divergence[coarse.first + k] = sum;
        cell_weights[coarse.first + k] = packHalf2x16(0.5 * faces * nearness_at(coarse, coarse_cell));
        cell_pressure[coarse.first + k] = 0.0;
    }
    barrier();
}

void prolong_from(Level coarse, Level level)
{
    for (int k = int(gl_LocalInvocationIndex); k < level.size.x * level.size.y; k += thread_count) {
        ivec2 cell = ivec2(k % level.size.x, k / level.size.x) / 2;
        cell_pressure[level.first + k] += cell_pressure[coarse.first + cell.y * coarse.size.x + cell.x];
    }
    barrier();
}

bool is_closed_in(Level level, int k)
{
    vec4 open;
    vec4 pressures;
    look_around(level, ivec2(k % level.size.x, k / level.size.x), open, pressures);
    return dot(open, vec4(1.0)) == 0.0;
}

// Subtracts the mean divergence of all cells, because no pressure could remove the mean.
void level_out(Level level)
{
    int cell_count = level.size.x * level.size.y;
    vec2 own = vec2(0.0);
    for (int k = int(gl_LocalInvocationIndex); k < cell_count; k += thread_count) {
        own += is_closed_in(level, k) ? vec2(0.0) : vec2(cell_divergence[k], 1.0);
    }
    sums[gl_LocalInvocationIndex] = own;
    barrier();
    for (uint span = thread_count / 2; span > 0u; span /= 2u) {
        if (gl_LocalInvocationIndex < span) {
            sums[gl_LocalInvocationIndex] += sums[gl_LocalInvocationIndex + span];
        }
        barrier();
    }
    float mean = sums[0].x / max(sums[0].y, 1.0);
    for (int k = int(gl_LocalInvocationIndex); k < cell_count; k += thread_count) {
        cell_divergence[k] -= mean;
    }
    barrier();
}

void main()
{
    Level finest = level_of(0);
    int cell_count = finest.size.x * finest.size.y;
    for (int k = int(gl_LocalInvocationIndex); k < cell_count; k += thread_count) {
        cell_divergence[k] = texelFetch(divergence, k).x;
        cell_weights[k] = texelFetch(weights, int(small.level.first) + k).x;
        cell_pressure[k] = 0.0;
    }
    if (gl_LocalInvocationIndex == 0u) {
        cell_weights[all_cells - 1] = 0u;
        cell_pressure[all_cells - 1] = 0.0;
    }
    barrier();
    level_out(finest);
    int last = int(small.level_count) - 1;
    for (int i = 0; i < last; ++i) {
        Level level = level_of(i);
        sweep(level, 2);
        restrict_to(level_of(i + 1), level);
    }
    sweep(level_of(last), 8);
    for (int i = last - 1; i >= 0; --i) {
        Level level = level_of(i);
        prolong_from(level_of(i + 1), level);
        sweep(level, 2);
    }
    for (int k = int(gl_LocalInvocationIndex); k < cell_count; k += thread_count) {
        out_pressure[k] = cell_pressure[k];
    }
}
