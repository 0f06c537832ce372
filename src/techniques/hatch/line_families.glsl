// SPDX-License-Identifier: MIT
#ifndef ESTAMPE_LINE_FAMILIES
#define ESTAMPE_LINE_FAMILIES

// The families (sets of parallel strokes) that cross at a pixel. Requires before inclusion: `constants`, a
// LineConstants in push constants.

layout(constant_id = 0) const uint variant = 0u;
const bool has_growth = (variant & lines_has_growth) != 0u;
const bool has_overrun = (variant & lines_has_overrun) != 0u;
const bool has_all_tiles = (variant & lines_has_all_tiles) != 0u;
const bool marks_solid = (variant & lines_marks_solid) != 0u;
const bool has_loose_ends = (variant & lines_has_loose_ends) != 0u;
const bool has_local_light = (variant & lines_has_local_light) != 0u;
const uint kinds = variant >> lines_kinds_shift;
const uint directed_kinds =
    1u << strokes_height | 1u << strokes_wind | 1u << strokes_light | 1u << strokes_slope;
const uint flat_kinds = 1u << strokes_uv | 1u << strokes_form | 1u << strokes_page;
const bool has_form = (kinds & (1u << strokes_form)) != 0u;
const bool has_flat = (kinds & flat_kinds) != 0u;
const bool has_directions = (kinds & directed_kinds) != 0u;
const bool has_slices = (kinds & (directed_kinds | 1u << strokes_solid)) != 0u;

// Direction towards the light at the pixel that is being drawn.
vec3 towards_light = vec3(0.0, 1.0, 0.0);

// Rounds a direction to the nearest of 26 fixed directions. The direction of a local light changes from place
// to place, but strokes need fixed planes. With rounding, the page is divided into patches of straight
// strokes, as in hand drawing.
vec3 settled(vec3 direction)
{
    vec3 largest = vec3(max(abs(direction.x), max(abs(direction.y), abs(direction.z))));
    return normalize(round(direction / largest));
}

// Direction towards the strongest local light, from the packed value of the lighting pass. If the value is 0,
// returns the scene's constant light direction.
vec3 towards_light_of(uint strongest)
{
    return strongest != 0u ? settled(unpack_normal(strongest)) : constants.towards_light;
}

StrokeAxes stroke_axes()
{
    return StrokeAxes(constants.flat_axis_0, constants.flat_axis_1, constants.flat_axis_2, constants.wind,
                      constants.ground_wind, towards_light, has_directions);
}

bool lies_flat(uint kind)
{
    return has_flat && (!has_slices || is_flat(kind));
}

// State of the loop over the families of strokes: two per layer, each with the darkness that the family must
// draw. The share of white paper that the wanted darkness leaves is the product of the shares that the
// families leave. In each layer, the family that draws more comes first. A layer's second family is skipped
// if that family draws nothing.
struct Families {
    uint layer;
    bool is_second;
    float remaining; // darkness that the current layer and all later layers must draw
};

// Share of the remaining darkness that a layer draws. The last layer draws all of the remaining darkness.
float layer_share(uint layer, float remaining)
{
    float most = layer == 0u ? FIRST_LAYER_SHARE : NEXT_LAYER_SHARE;
    return layer + 1u >= constants.layers ? remaining : min(remaining, most);
}

// Share of a layer's strokes that its first family draws: parallel planes across an axis cut the surface, and
// strokes follow the cuts. The layer's second family (level lines) draws the rest.
float slice_share(uint layer, vec3 normal, uint kind)
{
    return !has_slices || lies_flat(kind)
               ? 1.0
               : smoothstep(0.50, 0.68, size_of(cross(solid_axis(stroke_axes(), kind, 2u * layer), normal)));
}

bool is_any_left(Families families)
{
    return families.layer < constants.layers && families.remaining > 1e-4;
}

// Advances to the next family of strokes. Returns the darkness that the next family of strokes must draw; 0
// if there is no further family.
float next_family(inout Families families, vec3 normal, uint kind, out uint family)
{
    family = 0u;
    if (!is_any_left(families)) {
        return 0.0;
    }
    float share = layer_share(families.layer, families.remaining);
    float slices = slice_share(families.layer, normal, kind);
    bool takes_level = (slices < 0.5) != families.is_second;
    family = 2u * families.layer + (takes_level ? 1u : 0u);
    float dark = has_slices ? 1.0 - pow(1.0 - share, takes_level ? 1.0 - slices : slices) : share;
    families.is_second = has_slices && !families.is_second && slices > 0.0 && slices < 1.0;
    if (!families.is_second) {
        families.remaining = 1.0 - (1.0 - families.remaining) / max(1.0 - share, 1e-6);
        ++families.layer;
    }
    return dark < 0.002 ? 0.0 : dark;
}

HatchLineStyle line_style()
{
    return HatchLineStyle(constants.width_px, constants.wobble_px, constants.gap_px, constants.taper_px,
                          constants.cell_px, constants.pressure, has_growth ? constants.growth : 0.0);
}

uint family_seed(uint family)
{
    return hash(constants.seed * 64u + family);
}

// Direction across the strokes of a family, in stroke coordinates.
vec3 family_axis(uint kind, uint family)
{
    return lies_flat(kind) ? flat_axis(stroke_axes(), kind, family >> 1)
                           : solid_axis(stroke_axes(), kind, family);
}

// The coordinate that the lines of a family follow at a place of the surface, and the coordinate's change per
// pixel.
LineField family_field(vec3 p, Footprint f, uint kind, uint family)
{
    bool flat_here = lies_flat(kind);
    bool form_here = has_form && kind == strokes_form;
    vec3 axis = family_axis(kind, family);
    vec3 side = flat_here ? vec3(axis.y, -axis.x, 0.0)
                          : unit(cross(axis, abs(axis.y) < 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
    LineField field = field_along(axis, side, cross(axis, side), p, f);
    field.wraps = form_here;
    field.wander = form_here ? vec2(0.0) : field.wander;
    return field;
}

#endif
