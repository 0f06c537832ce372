// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_PUFFS_OF_GROUP
#define ESTAMPE_PUFFS_OF_GROUP

// What the 64 pixels of a group see of a layer of puffs, found together, as suits a GPU: threads look each
// into another cell that has the middles of puffs near the group's rays, then each at another of these puffs,
// and pixels see those alone that are left. The includer has what puffs.glsl wants, and `lowest_way`.

#include "techniques/sky/clouds/puffs.glsl"

const int group_threads = 64;

shared vec3 corner_ways[4];                   // directions about those of all pixels, as puff_ray() has them
shared vec3 inward[4];                        // normals of the planes between, in the layer's space
shared uvec2 subgroup_sums[2][group_threads]; // puffs, and whether any pixel looks for some; in turns
shared ivec3 found[group_threads];            // a puff, and the cell it is from
shared vec4 balls[group_threads];             // from its middle to the eye; its radius
shared vec4 leans[group_threads];             // and the rest of it
shared uint kept[2][2];                       // a bit for each that some ray comes near; in turns

// Where the middles of puffs lie that the group's rays may come near: rows of cells, the nearest first.
struct PuffBand {
    bool is_turned; // rows lie along the wind
    bool is_narrow; // all rays go from row to row
    int forth;      // -1 or 1
    int first_row;
    int row_count;
    int column_count; // of no row more
    vec2 slopes;      // least and most that rays go along a row, for what they go across it
    vec2 sides;       // least and most that they reach along rows, from the eye
    float beyond;     // the most along a row from a ray to the middle of a puff that it comes near
};

// Across rows, and along them.
vec2 in_band(PuffBand band, vec2 place)
{
    return band.is_turned ? place.yx : place;
}

// All of a group come here together, after corner_ways are given.
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

// Of the plane through the eye, a corner and the next one.
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

// A cell of a band by its number; false where that is none.
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

// How far the ray is where it may first come near a puff of the band's cells from that number on.
float nearest_of(PuffBand band, PuffLayer layer, PuffRay ray, int number)
{
    int line = band.first_row + band.forth * (number / band.column_count) + (band.forth > 0 ? 0 : 1);
    float along = float(band.forth) * (float(line) - in_band(band, layer.eye.xz).x) - layer.reach;
    return band.is_narrow ? along / abs(in_band(band, ray.step.xz).x) : 0.0;
}

// Keeps what is found as the group's `own` where some ray may come near.
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

// Adds those that are kept, in order, to what a pixel sees.
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

// The puffs of a cell; how many those of the threads before have, and of all.
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

// Adds up what all threads have; false where no pixel looks for puffs any more.
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

// Finds those from number `from` on that some ray may come near: as many as there are threads.
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

// As puffs_along(); all of a group come here together, also those whose pixels see none.
SeenPuffs puffs_of_group(PuffLayer layer, vec3 d, float pixel_rad, bool sees_any)
{
    barrier(); // those of the layer before are through
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
