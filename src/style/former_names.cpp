// SPDX-License-Identifier: MIT
#include "style/names.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace estampe::style {
namespace {

using Pair = std::pair<std::string_view, std::string_view>;

/// Former keys of parameters, sorted. They are not accepted as aliases: the error message for an old style
/// file names the new key.
constexpr std::array former_keys{Pair{"cloth.rest_mm_s", "cloth.rest_mm_per_s"},
                                 Pair{"clouds.seed", "drawing.seed"},
                                 Pair{"clouds.wind_deg", "wind.towards_deg"},
                                 Pair{"clouds.wind_mps", "clouds.wind_m_per_s"},
                                 Pair{"contour.boundary_brush", "contour.border.brush"},
                                 Pair{"contour.boundary_m", "contour.border.width_m"},
                                 Pair{"contour.boundary_mm", "contour.border.width_mm"},
                                 Pair{"contour.crease_brush", "contour.crease.brush"},
                                 Pair{"contour.crease_deg", "contour.crease.angle_deg"},
                                 Pair{"contour.crease_m", "contour.crease.width_m"},
                                 Pair{"contour.crease_mm", "contour.crease.width_mm"},
                                 Pair{"contour.crest_brush", "contour.crest.brush"},
                                 Pair{"contour.crest_deg", "contour.crest.angle_deg"},
                                 Pair{"contour.crest_m", "contour.crest.width_m"},
                                 Pair{"contour.crest_mm", "contour.crest.width_mm"},
                                 Pair{"contour.drawn", "contour.enabled"},
                                 Pair{"contour.hidden", "contour.hidden.enabled"},
                                 Pair{"contour.hidden_dash_mm", "contour.hidden.dash_mm"},
                                 Pair{"contour.hidden_gap_mm", "contour.hidden.gap_mm"},
                                 Pair{"contour.hidden_mm", "contour.hidden.width_mm"},
                                 Pair{"contour.intersection_brush", "contour.intersection.brush"},
                                 Pair{"contour.intersection_m", "contour.intersection.width_m"},
                                 Pair{"contour.intersection_mm", "contour.intersection.width_mm"},
                                 Pair{"contour.marked_brush", "contour.marked.brush"},
                                 Pair{"contour.marked_m", "contour.marked.width_m"},
                                 Pair{"contour.marked_mm", "contour.marked.width_mm"},
                                 Pair{"contour.outline_brush", "contour.outline.brush"},
                                 Pair{"contour.outline_m", "contour.outline.width_m"},
                                 Pair{"contour.outline_mm", "contour.outline.width_mm"},
                                 Pair{"contour.ridge_brush", "contour.ridge.brush"},
                                 Pair{"contour.ridge_deg", "contour.ridge.turn_deg"},
                                 Pair{"contour.ridge_m", "contour.ridge.width_m"},
                                 Pair{"contour.ridge_mm", "contour.ridge.width_mm"},
                                 Pair{"contour.seed", "drawing.seed"},
                                 Pair{"contour.shadow_brush", "contour.shadow_edge.brush"},
                                 Pair{"contour.shadow_m", "contour.shadow_edge.width_m"},
                                 Pair{"contour.shadow_mm", "contour.shadow_edge.width_mm"},
                                 Pair{"contour.suggestive_brush", "contour.suggestive.brush"},
                                 Pair{"contour.suggestive_deg", "contour.suggestive.angle_deg"},
                                 Pair{"contour.suggestive_growth", "contour.suggestive.growth"},
                                 Pair{"contour.suggestive_m", "contour.suggestive.width_m"},
                                 Pair{"contour.suggestive_mm", "contour.suggestive.width_mm"},
                                 Pair{"contour.valley_brush", "contour.valley.brush"},
                                 Pair{"contour.valley_m", "contour.valley.width_m"},
                                 Pair{"contour.valley_mm", "contour.valley.width_mm"},
                                 Pair{"drift.mode", "drift.enabled"},
                                 Pair{"focus.bundles", "focus_lines.bundles"},
                                 Pair{"focus.clear", "focus_lines.clear"},
                                 Pair{"focus.drawn", "focus_lines.enabled"},
                                 Pair{"focus.ink", "focus_lines.ink"},
                                 Pair{"focus.ragged", "focus_lines.ragged"},
                                 Pair{"focus.redraws_per_s", "focus_lines.redraws_per_s"},
                                 Pair{"focus.seed", "drawing.seed"},
                                 Pair{"focus.spacing_mm", "focus_lines.spacing_mm"},
                                 Pair{"focus.width_mm", "focus_lines.width_mm"},
                                 Pair{"focus.x", "focus_lines.x"},
                                 Pair{"focus.y", "focus_lines.y"},
                                 Pair{"focus_lines.seed", "drawing.seed"},
                                 Pair{"hatch.drawn", "hatch.enabled"},
                                 Pair{"hatch.fade", "haze.hatching"},
                                 Pair{"hatch.fade_distance_m", "haze.hatching_distance_m"},
                                 Pair{"hatch.materials", "hatch.coordinates"},
                                 Pair{"hatch.seed", "drawing.seed"},
                                 Pair{"haze.mode", "haze.enabled"},
                                 Pair{"ink.drawn", "ink.enabled"},
                                 Pair{"ink.flow_mm_s", "ink.flow_mm_per_s"},
                                 Pair{"ink.seed", "drawing.seed"},
                                 Pair{"ink.swirl_mm_s", "ink.swirl_mm_per_s"},
                                 Pair{"ink.wind_mm_s", "ink.wind_mm_per_s"},
                                 Pair{"motion_blur.lines", "motion_blur.speed_lines.enabled"},
                                 Pair{"motion_blur.lines_from_mm", "motion_blur.speed_lines.from_mm"},
                                 Pair{"motion_blur.lines_ink", "motion_blur.speed_lines.ink"},
                                 Pair{"motion_blur.lines_length", "motion_blur.speed_lines.length"},
                                 Pair{"motion_blur.lines_spacing_mm", "motion_blur.speed_lines.spacing_mm"},
                                 Pair{"motion_blur.lines_width_mm", "motion_blur.speed_lines.width_mm"},
                                 Pair{"motion_blur.seed", "drawing.seed"},
                                 Pair{"motion_blur.smear", "motion_blur.smear.enabled"},
                                 Pair{"motion_blur.smear_from_mm", "motion_blur.smear.from_mm"},
                                 Pair{"motion_blur.smear_ink", "motion_blur.smear.ink"},
                                 Pair{"motion_blur.smear_length", "motion_blur.smear.length"},
                                 Pair{"motion_blur.smear_spacing_mm", "motion_blur.smear.spacing_mm"},
                                 Pair{"motion_blur.smear_width_mm", "motion_blur.smear.width_mm"},
                                 Pair{"occlusion.drawn", "occlusion.enabled"},
                                 Pair{"paper.seed", "drawing.seed"},
                                 Pair{"particles.lift_mps2", "particles.lift_m_per_s2"},
                                 Pair{"particles.seed", "drawing.seed"},
                                 Pair{"particles.speed_mps", "particles.speed_m_per_s"},
                                 Pair{"particles.swirl_mps", "particles.swirl_m_per_s"},
                                 Pair{"particles.wind_deg", "wind.towards_deg"},
                                 Pair{"particles.wind_mps", "particles.wind_m_per_s"},
                                 Pair{"screen.layers", "transparency.layers"},
                                 Pair{"screen.mode", "transparency.mode"},
                                 Pair{"sky.mode", "sky.enabled"},
                                 Pair{"smoke.drawn", "smoke.enabled"},
                                 Pair{"smoke.seed", "drawing.seed"},
                                 Pair{"smoke.wind_deg", "wind.towards_deg"},
                                 Pair{"smoke.wind_m_s", "smoke.wind_m_per_s"},
                                 Pair{"subsurface.drawn", "subsurface.enabled"},
                                 Pair{"tam.seed", "drawing.seed"},
                                 Pair{"wash.air", "haze.tint"},
                                 Pair{"wash.air_color", "haze.tint_color"},
                                 Pair{"wash.air_distance_m", "haze.tint_distance_m"},
                                 Pair{"wind.speed_m_s", "wind.speed_m_per_s"}};

/// Former keys of parameters whose values are written differently today, sorted, each with advice on the new
/// form.
constexpr std::array changed_keys{
    Pair{"ink.zones",
         "name the object: put zone.blow_mm_per_s, zone.turn_deg_per_s, zone.give or zone.amount "
         "below a line [object.\"NAME\".ink]"},
    Pair{"light.lights", "name the light: put enabled, intensity, range_m, radius_m, shadows, attenuation, "
                         "spot_volume, groups or shadow_groups below a line [object.\"NAME\".light]"},
    Pair{"light.objects", "name the object: put shadows, receives_shadows, groups or shadow_groups below a "
                          "line [object.\"NAME\".light] or [material.\"NAME\".light]"},
    Pair{"wind.direction_deg",
         "write wind.towards_deg = 90 - direction_deg, which counts from +z like all bearings"}};

/// Words with which other programs name parameters, sorted. Each name in the list is compared with the last
/// word of an unknown key.
constexpr std::array foreign_words{Pair{"alpha", "paper.transparent"},
                                   Pair{"ambient_occlusion", "occlusion.enabled"},
                                   Pair{"ao", "occlusion.enabled"},
                                   Pair{"background", "paper.color"},
                                   Pair{"background_color", "paper.color"},
                                   Pair{"color", "wash.strength"},
                                   Pair{"crease_angle", "contour.crease.angle_deg"},
                                   Pair{"crosshatch", "hatch.layers"},
                                   Pair{"depth_of_field", "lens.enabled"},
                                   Pair{"dof", "lens.enabled"},
                                   Pair{"edges", "contour.enabled"},
                                   Pair{"exposure", "light.exposure_stops"},
                                   Pair{"fog", "haze.enabled"},
                                   Pair{"hatching", "hatch.enabled"},
                                   Pair{"line_color", "contour.ink"},
                                   Pair{"line_weight", "drawing.line_weight"},
                                   Pair{"line_width", "contour.outline.width_mm"},
                                   Pair{"lines", "contour.enabled"},
                                   Pair{"linewidth", "contour.outline.width_mm"},
                                   Pair{"outline", "contour.outline.enabled"},
                                   Pair{"outlines", "contour.outline.enabled"},
                                   Pair{"paper_color", "paper.color"},
                                   Pair{"saturation", "drawing.color"},
                                   Pair{"seed", "drawing.seed"},
                                   Pair{"shadows", "light.shadows"},
                                   Pair{"spacing", "drawing.hatch_spacing"},
                                   Pair{"stroke_color", "paper.ink"},
                                   Pair{"stroke_width", "hatch.width_mm"},
                                   Pair{"sun_azimuth", "light.sun_azimuth_deg"},
                                   Pair{"sun_elevation", "light.sun_elevation_deg"},
                                   Pair{"thickness", "drawing.line_weight"},
                                   Pair{"transparent", "paper.transparent"}};

static_assert(std::ranges::is_sorted(former_keys) && std::ranges::is_sorted(changed_keys) &&
              std::ranges::is_sorted(foreign_words));

template <typename Names>
std::string_view find_in(const Names& names, std::string_view word)
{
    const auto found = std::ranges::lower_bound(names, word, {}, &Pair::first);
    return found != names.end() && found->first == word ? found->second : std::string_view();
}

} // namespace

std::string_view name_today(std::string_view key)
{
    if (const std::string_view now = find_in(former_keys, key); !now.empty()) {
        return now;
    }
    return find_in(foreign_words, key.substr(key.rfind('.') + 1));
}

std::string_view advice_for(std::string_view key)
{
    return find_in(changed_keys, key);
}

std::vector<Pair> names_known_otherwise()
{
    std::vector<Pair> all(former_keys.begin(), former_keys.end());
    all.insert(all.end(), foreign_words.begin(), foreign_words.end());
    return all;
}

} // namespace estampe::style
