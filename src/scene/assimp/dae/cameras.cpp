// SPDX-License-Identifier: MIT
#include "scene/assimp/dae/cameras.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scene/assimp/dae/dae_text.hpp"

namespace estampe::dae {
namespace {

constexpr double usual_aspect = 16.0 / 9.0; ///< where a camera has only a width: the page is not known yet

double unit_m(const pugi::xml_node& collada)
{
    const double metres = collada.child("asset").child("unit").attribute("meter").as_double(1.0);
    return metres > 0.0 && std::isfinite(metres) ? metres : 1.0;
}

std::optional<double> positive(const pugi::xml_node& optics, const char* name)
{
    const double number = optics.child(name).text().as_double(0.0);
    return number > 0.0 && std::isfinite(number) ? std::optional(number) : std::nullopt;
}

/// Of a width and a height, or one of them and the aspect ratio, the height; `widths` are to be proportional.
std::optional<double> height_of(const std::optional<double>& width, const std::optional<double>& height,
                                const std::optional<double>& aspect)
{
    if (height)
        return height;
    if (width)
        return *width / aspect.value_or(usual_aspect);
    return std::nullopt;
}

std::optional<double> half_tangent(const std::optional<double>& degrees)
{
    return degrees && *degrees < 179.0 ? std::optional(std::tan(0.5 * glm::radians(*degrees))) : std::nullopt;
}

SceneCamera lens_of(const pugi::xml_node& common, double metres)
{
    constexpr double nearest_m = 1e-4;
    SceneCamera lens;
    const pugi::xml_node parallel = common.child("orthographic");
    const pugi::xml_node optics = parallel ? parallel : common.child("perspective");
    const std::optional<double> aspect = positive(optics, "aspect_ratio");
    if (parallel) {
        lens.orthographic = true;
        lens.half_height_m =
            metres * height_of(positive(optics, "xmag"), positive(optics, "ymag"), aspect).value_or(1.0);
    } else if (const std::optional<double> height = height_of(
                   half_tangent(positive(optics, "xfov")), half_tangent(positive(optics, "yfov")), aspect)) {
        const double fov_rad = 2.0 * std::atan(*height);
        if (fov_rad > 0.02 && fov_rad < 3.0)
            lens.vertical_fov_rad = fov_rad;
    }
    if (const std::optional<double> near_units = positive(optics, "znear"))
        lens.near_m = std::max(*near_units * metres, nearest_m);
    return lens;
}

void add_number(pugi::xml_node parent, const char* name, double value)
{
    parent.append_child(name).text().set(value);
}

} // namespace

std::vector<SceneCamera> number_cameras(const pugi::xml_node& collada)
{
    const double metres = unit_m(collada);
    std::vector<SceneCamera> lenses;
    for (pugi::xml_node library : collada.children("library_cameras")) {
        for (pugi::xml_node camera : library.children("camera")) {
            pugi::xml_node optics = camera.child("optics");
            lenses.push_back(lens_of(optics.child("technique_common"), metres));
            const pugi::char_t* const name = camera.attribute("name").value();
            lenses.back().name = *name != '\0' ? name : camera.attribute("id").value();
            // Assimp finds cameras by their name, which COLLADA leaves optional.
            if (*name == '\0') {
                camera.remove_attribute("name");
                camera.append_attribute("name").set_value(lenses.back().name.c_str());
            }
            camera.remove_child(optics);
            pugi::xml_node lens =
                camera.append_child("optics").append_child("technique_common").append_child("perspective");
            add_number(lens, "xfov", 45.0);
            add_number(lens, "aspect_ratio", 1.0);
            add_number(lens, "znear", 0.5);
            add_number(lens, "zfar", static_cast<double>(lenses.size()));
        }
    }
    return lenses;
}

size_t lens_index(double far_plane)
{
    return far_plane >= 1.0 && far_plane < 1e7 ? static_cast<size_t>(std::lround(far_plane)) - 1 : 0;
}

} // namespace estampe::dae
