// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PUFFS_OF_GROUP
#define ESTAMPE_PUFFS_OF_GROUP

// Finds the puffs of a layer that the 64 pixels of a workgroup see. The pixels find puffs together, which is
// faster on GPUs. Each thread scans one cell for puff centres near the group's rays, then tests one of the
// found puffs. The pixels then process only the remaining puffs. Define before inclusion: all that puffs.glsl
// needs, and `lowest_way`.

#include "techniques/sky/clouds/puffs.glsl"

const int group_threads = 64;

// Four directions that enclose the view directions of all pixels, in the wind's axes.
shared vec3 corner_ways[4];
// Normals of the planes between neighbouring corner_ways, in layer space, pointing inwards.
shared vec3 inward[4];
// For each subgroup of threads: the number of puffs, and 1 if any pixel still needs puffs. Two copies of the
// array are used in turn.
shared uvec2 subgroup_sums[2][group_threads];
shared ivec3 found[group_threads]; // index of a puff, and its cell
shared vec4 balls[group_threads];  // xyz: vector from the puff's centre to the eye; w: radius of the puff
shared vec4 leans[group_threads];  // xyz: direction that the cloud mass faces; w: random number of the puff
shared uint kept[2][2];            // one bit per puff that is near any ray; two copies are used in turn

// The region of cells that may hold centres of puffs near the group's rays. The region consists of rows of
// cells, the nearest row first.
struct PuffBand {
    bool is_turned; // True: the rows of cells run along the wind; false: across the wind.
    bool is_narrow; // all rays cross the rows of cells in the same direction
    int forth;      // direction across the rows of cells in which rays move away from the eye: -1 or 1
    int first_row;
    int row_count;
    int column_count; // largest number of cells in a row
    // Smallest and largest slope of the rays. The slope is the distance along a row of cells per distance
    // across the row.
    vec2 slopes;
    vec2 sides;   // smallest and largest extent along the rows of cells, relative to the eye
    float beyond; // Largest distance along a row of cells between a ray and the centre of a puff near it.
};

// Converts a place to the band's axes: across the rows, along the rows.
vec2 in_band(PuffBand band, vec2 place)
{
    return band.is_turned ? place.yx : place;
}

// Returns whether `is_one` is true for any thread of the workgroup. All threads of a workgroup must call this
// function together, after corner_ways is written.
bool any_of_group(bool is_one)
{
    bool is_any = subgroupAny(is_one);
    if (subgroupElect()) {
        subgroup_sums[0][gl_SubgroupID].y = uint(is_any);
    }
    barrier();
    for (uint i = 0u; i < gl_NumSubgroups; ++i) {
        is_any = is_any || subgroup_sums[0][i].y != 0u;
    }
    return is_any;
}

// Normal of the plane through the eye, a corner direction and the next corner direction; points inwards.
vec3 inward_of(PuffLayer layer, int corner)
{
    const ivec4 next = ivec4(1, 3, 0, 2);
    vec3 way = corner_ways[corner] * layer.per_m;
    vec3 middle = (corner_ways[0] + corner_ways[3]) * layer.per_m;
    vec3 normal = normalize(cross(way, corner_ways[next[corner]] * layer.per_m));
    return dot(normal, middle) < 0.0 ? -normal : normal;
}

PuffBand band_of(PuffLayer layer)
{
    PuffBand band;
    vec3 ways[4];
    vec3 middle = vec3(0.0);
    vec2 least = vec2(1e9);
    vec2 most = vec2(-1e9);
    float steepest = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec3 d = corner_ways[i];
        float rise = max(d.y, lowest_way);
        ways[i] = d * layer.per_m;
        vec2 enter = ways[i].xz * min(layer.base_m / rise, clouds.reach_m);
        vec2 leave = ways[i].xz * min((layer.base_m + layer.thick_m) / rise, clouds.reach_m);
        least = min(least, min(enter, leave));
        most = max(most, max(enter, leave));
        middle += ways[i];
        steepest = max(steepest, rise);
    }
    band.is_turned = abs(middle.z) > abs(middle.x);
    band.forth = in_band(band, middle.xz).x < 0.0 ? -1 : 1;
    band.is_narrow = true;
    band.slopes = vec2(1e9, -1e9);
    for (int i = 0; i < 4; ++i) {
        vec2 way = in_band(band, ways[i].xz);
        band.is_narrow = band.is_narrow && way.x * float(band.forth) > 0.25 * abs(way.y);
        float slope = way.y / way.x;
        band.slopes = vec2(min(band.slopes.x, slope), max(band.slopes.y, slope));
    }
    band.slopes = band.is_narrow ? band.slopes : vec2(0.0);
    float slope = max(abs(band.slopes.x), abs(band.slopes.y));
    band.beyond = band.is_narrow ? layer.reach * sqrt(1.0 + slope * slope) : 1e6;
    least = in_band(band, least);
    most = in_band(band, most);
    band.sides = vec2(least.y, most.y);
    float eye = in_band(band, layer.eye.xz).x;
    ivec2 rows = ivec2(floor(eye + vec2(least.x - layer.reach, most.x + layer.reach)));
    band.first_row = band.forth > 0 ? rows.x : rows.y;
    band.row_count = steepest * clouds.reach_m > layer.base_m ? rows.y - rows.x + 1 : 0;
    float farthest = max(abs(float(rows.x) - eye), abs(float(rows.y + 1) - eye));
    float broadest = min((band.slopes.y - band.slopes.x) * farthest + slope + 2.0 * band.beyond,
                         most.y - least.y + 2.0 * layer.reach);
    band.column_count = int(broadest) + 2;
    return band;
}

// Finds the cell with a given number in a band (rows of cells near the group's rays). Returns false if the
// band has no such cell.
bool cell_of(PuffBand band, PuffLayer layer, int number, out ivec2 cell)
{
    int row = number / band.column_count;
    int line = band.first_row + band.forth * row;
    vec2 eye = in_band(band, layer.eye.xz);
    vec2 along = vec2(line, line + 1) - eye.x;
    vec2 low = min(band.slopes.x * along, band.slopes.y * along);
    vec2 high = max(band.slopes.x * along, band.slopes.y * along);
    float from = max(min(low.x, low.y) - band.beyond, band.sides.x - layer.reach);
    float to = min(max(high.x, high.y) + band.beyond, band.sides.y + layer.reach);
    int column = int(floor(eye.y + from)) + number - row * band.column_count;
    cell = band.is_turned ? ivec2(column, line) : ivec2(line, column);
    return row < band.row_count && float(column) <= eye.y + to;
}

// Smallest distance along a ray at which the ray may come near a puff. Only cells of the band (rows of cells
// near the rays) from cell `number` on count.
float nearest_of(PuffBand band, PuffLayer layer, PuffRay ray, int number)
{
    int line = band.first_row + band.forth * (number / band.column_count) + (band.forth > 0 ? 0 : 1);
    float along = float(band.forth) * (float(line) - in_band(band, layer.eye.xz).x) - layer.reach;
    return band.is_narrow ? along / abs(in_band(band, ray.step.xz).x) : 0.0;
}

// Keeps the puff in slot `own` if some ray of the workgroup may pass near it.
void keep_puff(PuffLayer layer, int own, uint turn)
{
    CloudPuff puff = puff_at(found[own].x);
    vec3 from_centre = from_centre_of(layer, puff.centre, found[own].yz);
    float reach = puff_wavers * puff.radius;
    float beyond = dot(inward[0], from_centre);
    for (int i = 1; i < 4; ++i) {
        beyond = max(beyond, dot(inward[i], from_centre));
    }
    if (beyond < reach) {
        balls[own] = vec4(from_centre, puff.radius);
        leans[own] = vec4(puff.lean, puff.trait);
        atomicOr(kept[turn][own >> 5], 1u << (own & 31));
    }
}

// Adds the kept puffs, in their order, to what a pixel sees.
void see_kept(inout SeenPuffs seen, PuffLayer layer, PuffRay ray, uint turn)
{
    for (int word = 0; word < 2; ++word) {
        for (uint bits = kept[turn][word]; bits != 0u; bits &= bits - 1u) {
            int i = 32 * word + findLSB(bits);
            vec4 ball = balls[i];
            if (is_near(seen, ray, ball.xyz, ball.w)) {
                see_puff(seen, layer, ray, CloudPuff(vec3(0.0), ball.w, leans[i].xyz, leans[i].w), ball.xyz);
            }
        }
    }
}

// Three numbers of puffs: in the thread's cell, in the cells of threads with lower numbers, and in the cells
// of all threads.
struct CellPuffs {
    ivec2 cell;
    int start;
    int count;
    int before;
    int sum;
};

CellPuffs cell_puffs(PuffBand band, PuffLayer layer, int number)
{
    CellPuffs puffs;
    puffs.start = 0;
    puffs.count = 0;
    if (cell_of(band, layer, number, puffs.cell)) {
        ivec2 on_tile = puffs.cell & (int(layer.cells) - 1);
        int index = int(layer.first_home) + on_tile.y * int(layer.cells) + on_tile.x;
        puffs.start = int(texelFetch(start_texels, index).x);
        puffs.count = int(texelFetch(start_texels, index + 1).x) - puffs.start;
    }
    return puffs;
}

// Sums the numbers of puffs over all threads. Returns false if no pixel needs more puffs.
bool add_up(inout CellPuffs puffs, bool looks, uint turn)
{
    uint before = subgroupExclusiveAdd(uint(puffs.count));
    uvec2 sums = uvec2(subgroupAdd(uint(puffs.count)), uint(subgroupAny(looks)));
    if (subgroupElect()) {
        subgroup_sums[turn][gl_SubgroupID] = sums;
    }
    barrier();
    sums = uvec2(0u);
    for (uint i = 0u; i < gl_NumSubgroups; ++i) {
        before += i < gl_SubgroupID ? subgroup_sums[turn][i].x : 0u;
        sums += subgroup_sums[turn][i];
    }
    puffs.before = int(before);
    puffs.sum = int(sums.x);
    return sums.y != 0u;
}

// Finds puffs that some ray may pass near, from puff number `from` on, up to one per thread.
void find_kept(CellPuffs puffs, PuffLayer layer, int from, uint turn)
{
    int own = int(gl_LocalInvocationIndex);
    int last = min(puffs.count, from + group_threads - puffs.before);
    for (int i = max(from - puffs.before, 0); i < last; ++i) {
        found[puffs.before + i - from] = ivec3(puffs.start + i, puffs.cell);
    }
    if (own < 2) {
        kept[turn][own] = 0u;
    }
    barrier();
    if (from + own < puffs.sum) {
        keep_puff(layer, own, turn);
    }
    barrier();
}

// Returns the puffs that a pixel's ray sees, like puffs_along(). All threads of a workgroup must call
// puffs_of_group() together, including those whose pixel shows no clouds.
SeenPuffs puffs_of_group(PuffLayer layer, vec3 d, float pixel_rad, bool sees_any)
{
    barrier(); // no thread may write before all threads have finished the previous layer
    if (gl_LocalInvocationIndex < 4u) {
        inward[gl_LocalInvocationIndex] = inward_of(layer, int(gl_LocalInvocationIndex));
    }
    PuffRay ray = puff_ray(layer, d, pixel_rad);
    SeenPuffs seen = no_puffs();
    PuffBand band = band_of(layer);
    int cell_count = band.row_count * band.column_count;
    for (int first = 0; first < cell_count; first += group_threads) {
        CellPuffs puffs = cell_puffs(band, layer, first + int(gl_LocalInvocationIndex));
        bool looks = sees_any && ray.enter_m < ray.leave_m &&
                     nearest_of(band, layer, ray, first) <= min(seen.away_m, ray.leave_m);
        if (!add_up(puffs, looks, uint(first / group_threads) & 1u)) {
            break;
        }
        for (int from = 0; from < puffs.sum; from += group_threads) {
            uint turn = uint(from / group_threads) & 1u;
            find_kept(puffs, layer, from, turn);
            if (looks) {
                see_kept(seen, layer, ray, turn);
            }
        }
    }
    end_line(seen, ray);
    return seen;
}

#endif
