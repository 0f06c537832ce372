// SPDX-License-Identifier: MIT
#include "scene/assimp/fbx/lens.hpp"

#include <algorithm>
#include <cmath>

#include "scene/assimp/fbx/transform.hpp"

namespace estampe::fbx {
namespace {

constexpr double inch_mm = 25.4;

// Values of the enumerations in FBX files.
enum class ApertureMode { both, horizontal, vertical, focal_length };
enum class GateFit { none, vertical, horizontal, fill, overscan, stretch };
enum class AspectMode { window, fixed_ratio, fixed_resolution, fixed_width, fixed_height };

template <typename Enum>
Enum enum_of(const Properties& camera, const char* name, Enum fallback, Enum last)
{
    const double value = camera.number(name).value_or(static_cast<double>(fallback));
    return value >= 0.0 && value <= static_cast<double>(last) ? static_cast<Enum>(static_cast<int>(value))
                                                              : fallback;
}

double positive(const Properties& camera, const char* name, double fallback)
{
    const double value = camera.number(name).value_or(fallback);
    return value > 0.0 ? value : fallback;
}

/// Width by height of the picture. 320 by 200 is what FBX takes where a file says nothing.
double picture_aspect(const Properties& camera)
{
    const double width = positive(camera, "AspectWidth", positive(camera, "AspectW", 320.0));
    const double height = positive(camera, "AspectHeight", positive(camera, "AspectH", 200.0));
    const double pixel = positive(camera, "PixelAspectRatio", 1.0);
    switch (enum_of(camera, "AspectRatioMode", AspectMode::window, AspectMode::fixed_height)) {
    case AspectMode::fixed_width:
        return pixel / height;
    case AspectMode::fixed_height:
        return pixel * width;
    default:
        return pixel * width / height;
    }
}

/// How the film's gate is fitted to the picture where the two have different proportions.
GateFit fit_of(const Properties& camera, double aspect, double film_aspect)
{
    const GateFit fit = enum_of(camera, "GateFit", GateFit::none, GateFit::stretch);
    if (fit == GateFit::fill)
        return aspect > film_aspect ? GateFit::horizontal : GateFit::vertical;
    if (fit == GateFit::overscan)
        return aspect < film_aspect ? GateFit::horizontal : GateFit::vertical;
    return fit;
}

double vertical_of(double horizontal_deg, double aspect)
{
    return 2.0 * std::atan(std::tan(0.5 * glm::radians(horizontal_deg)) / aspect);
}

/// Radians from top to bottom, or nothing sensible where the file says nothing sensible.
double vertical_fov(const Properties& camera, double aspect)
{
    // 0.816 by 0.612 inches is the film of 35 mm television, FBX's default.
    const double film_width = positive(camera, "FilmWidth", 0.816);
    const double film_height =
        positive(camera, "FilmHeight", 0.612) * positive(camera, "FilmSqueezeRatio", 1.0);
    const double focal_mm = camera.number("FocalLength").value_or(0.0);
    const double fov_deg = camera.number("FieldOfView").value_or(0.0);
    ApertureMode mode = enum_of(camera, "ApertureMode", ApertureMode::vertical, ApertureMode::focal_length);
    const bool has_focal = focal_mm > 0.0 && (camera.sets("FocalLength") || !(fov_deg > 0.0));
    if (mode == ApertureMode::focal_length && !has_focal)
        mode = ApertureMode::horizontal;
    else if (mode != ApertureMode::focal_length && !(fov_deg > 0.0) && !camera.number("FieldOfViewY"))
        mode = ApertureMode::focal_length;
    switch (mode) {
    case ApertureMode::both:
        if (const double fov_y_deg = camera.number("FieldOfViewY").value_or(0.0); fov_y_deg > 0.0)
            return glm::radians(fov_y_deg);
        return vertical_of(fov_deg, aspect);
    case ApertureMode::horizontal:
        return vertical_of(fov_deg, aspect);
    case ApertureMode::vertical:
        return glm::radians(fov_deg);
    case ApertureMode::focal_length:
        break;
    }
    const bool by_width = fit_of(camera, aspect, film_width / film_height) == GateFit::horizontal;
    const double height_mm = inch_mm * (by_width ? film_width / aspect : film_height);
    return 2.0 * std::atan2(0.5 * height_mm, focal_mm);
}

/// A zoom of 1 spans 30 units of the file; Blender writes metres.
double orthographic_half_height_m(const Properties& camera, const Document& document, double aspect)
{
    constexpr double units_at_zoom_1 = 30.0;
    const bool blender = document.creator.starts_with("Blender");
    const double span_m =
        positive(camera, "OrthoZoom", 1.0) * (blender ? 1.0 : units_at_zoom_1 * unit_m(document.settings));
    const double film_aspect = positive(camera, "FilmWidth", 0.816) / positive(camera, "FilmHeight", 0.612);
    const bool by_width = fit_of(camera, aspect, film_aspect) == GateFit::horizontal;
    return 0.5 * (by_width ? span_m / aspect : span_m);
}

} // namespace

SceneCamera lens_of(const Properties& camera, const Document& document)
{
    constexpr double nearest_m = 1e-4;
    SceneCamera lens;
    const double aspect = std::clamp(picture_aspect(camera), 0.01, 100.0);
    const double fov_rad = vertical_fov(camera, aspect);
    if (fov_rad > 0.02 && fov_rad < 3.0)
        lens.vertical_fov_rad = fov_rad;
    lens.orthographic = camera.number("CameraProjectionType").value_or(0.0) == 1.0;
    if (lens.orthographic)
        lens.half_height_m = orthographic_half_height_m(camera, document, aspect);
    if (const std::optional<double> near_units = camera.number("NearPlane"))
        lens.near_m = std::max(*near_units * unit_m(document.settings), nearest_m);
    return lens;
}

} // namespace estampe::fbx
