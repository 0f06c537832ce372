// SPDX-License-Identifier: MIT
#include "features/common/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace estampe::features {
namespace {

glm::dmat4 perspective(const Camera& camera, double aspect)
{
    const double f = 1.0 / std::tan(0.5 * camera.vertical_fov_rad);
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = f / aspect;
    clip_from_view[1][1] = -f;
    clip_from_view[2][3] = -1.0;
    clip_from_view[3][2] = camera.near_m;
    return clip_from_view;
}

glm::dmat4 parallel(const Camera& camera, double aspect, const Bounds& bounds)
{
    const double half_height = *camera.orthographic_half_height_m;
    const double radius = std::max(bounds.radius(), 1e-6) * 64.0;
    const double middle = glm::dot(bounds.center() - camera.eye, glm::normalize(camera.target - camera.eye));
    const double nearest = middle - radius;
    const double farthest = middle + radius;
    glm::dmat4 clip_from_view(0.0);
    clip_from_view[0][0] = 1.0 / (half_height * aspect);
    clip_from_view[1][1] = -1.0 / half_height;
    clip_from_view[2][2] = 1.0 / (farthest - nearest);
    clip_from_view[3][2] = farthest / (farthest - nearest);
    clip_from_view[3][3] = 1.0;
    return clip_from_view;
}

double halton(uint32_t index, uint32_t base)
{
    double result = 0.0;
    double digit = 1.0;
    for (; index > 0; index /= base) {
        digit /= base;
        result += digit * (index % base);
    }
    return result;
}

} // namespace

shared::FrameGlobals frame_globals(const Camera& camera, const Bounds& bounds, const glm::dvec3& anchor,
                                   const ViewSettings& settings)
{
    const double aspect = static_cast<double>(settings.size_px.x) / settings.size_px.y;
    const bool is_parallel = camera.orthographic_half_height_m.has_value();
    const glm::dmat4 clip_from_view =
        is_parallel ? parallel(camera, aspect, bounds) : perspective(camera, aspect);
    const glm::dmat4 view_from_anchor = glm::lookAt(camera.eye - anchor, camera.target - anchor, camera.up);
    // In clip space x points right, y points down, and the page is 2 wide and high.
    const glm::dvec2 lens_shift(-2.0 * camera.shift.x, 2.0 * camera.shift.y);
    const glm::dvec3 shift(lens_shift + 2.0 * settings.jitter_px / glm::dvec2(settings.size_px), 0.0);
    const Survey page = settings.survey.value_or(Survey{.part = {.size_px = settings.size_px}});
    const PixelRect tile = settings.tile.value_or(PixelRect{.size_px = page.size_px()});
    const glm::dmat4 clip_from_anchor = crop_of(page.part, settings.size_px) *
                                        glm::translate(glm::dmat4(1.0), shift) * clip_from_view *
                                        view_from_anchor;
    const auto shrink = static_cast<float>(page.shrink);
    return {.clip_from_anchor = glm::mat4(clip_from_anchor),
            .anchor_from_clip = glm::mat4(glm::inverse(clip_from_anchor)),
            .eye_anchor = glm::vec3(camera.eye - anchor),
            .pixels_per_mm = pixels_per_mm(settings.size_px.y, settings.page_height_mm) / shrink,
            .view_forward = glm::vec3(glm::normalize(camera.target - camera.eye)),
            .is_orthographic = is_parallel ? 1U : 0U,
            .size_px = tile.size_px,
            .near_m = is_parallel ? 0.0F : static_cast<float>(camera.near_m),
            .scene_radius_m = static_cast<float>(std::max(bounds.radius(), 1e-9)),
            .nearby_m = settings.nearby_m,
            .pixel_m = pixel_size(camera, settings.size_px.y).at_one_m * shrink,
            .page_px = page.size_px(),
            .tile_from_px = tile.from_px};
}

glm::mat4 drawn_clip(const shared::FrameGlobals& globals)
{
    const PixelRect drawn{.from_px = globals.tile_from_px, .size_px = globals.size_px};
    return {crop_of(drawn, globals.page_px) * glm::dmat4(globals.clip_from_anchor)};
}

shared::FrameGlobals every_second(shared::FrameGlobals globals)
{
    // The camera is shifted so that page pixels at even coordinates are sampled. The centre of the small
    // picture's pixel number i is the centre of page pixel number 2 i.
    const glm::dvec2 page_px(globals.page_px);
    const glm::uvec2 half_page_px = (globals.page_px + 1U) / 2U;
    const glm::dvec2 scale = 2.0 * glm::dvec2(half_page_px) / page_px;
    const glm::dvec2 offset = scale - 1.0 / page_px - 1.0;
    glm::dmat4 page_from_half(1.0);
    page_from_half[0][0] = scale.x;
    page_from_half[1][1] = scale.y;
    page_from_half[3][0] = offset.x;
    page_from_half[3][1] = offset.y;
    const glm::uvec2 from_px = globals.tile_from_px;
    globals.clip_from_anchor = glm::mat4(glm::inverse(page_from_half) * glm::dmat4(globals.clip_from_anchor));
    globals.anchor_from_clip = glm::mat4(glm::dmat4(globals.anchor_from_clip) * page_from_half);
    globals.pixels_per_mm *= 0.5F;
    globals.pixel_m *= 2.0F;
    globals.page_px = half_page_px;
    globals.tile_from_px = (from_px + 1U) / 2U;
    globals.size_px = glm::max((globals.size_px + 1U - (from_px & 1U)) / 2U, glm::uvec2(1));
    return globals;
}

float nearby(std::span<const glm::vec3> places, const glm::vec3& eye)
{
    constexpr size_t most = 4096;
    std::array<float, most> away2; // NOLINT(cppcoreguidelines-pro-type-member-init): as far as it is filled
    size_t count = 0;
    for (size_t i = 0; i < places.size(); i += 1 + places.size() / most) {
        const glm::vec3 from_eye = eye - places[i];
        away2[count++] = glm::dot(from_eye, from_eye);
    }
    if (count == 0) {
        return 0.0F;
    }
    const auto end = away2.begin() + static_cast<std::ptrdiff_t>(count);
    const auto fifth = away2.begin() + static_cast<std::ptrdiff_t>(count / 5);
    std::nth_element(away2.begin(), fifth, end);
    return std::sqrt(*fifth);
}

float pixels_per_mm(uint32_t height_px, double page_height_mm)
{
    return static_cast<float>(height_px / page_height_mm);
}

Camera seen_within(const Camera& camera, const glm::dvec2& share)
{
    Camera whole = camera;
    whole.vertical_fov_rad = 2.0 * std::atan(std::tan(0.5 * camera.vertical_fov_rad) / share.y);
    if (whole.orthographic_half_height_m) {
        *whole.orthographic_half_height_m /= share.y;
    }
    whole.shift *= share;
    return whole;
}

PixelSize pixel_size(const Camera& camera, uint32_t height_px)
{
    const bool is_parallel = camera.orthographic_half_height_m.has_value();
    const double half_height_m =
        is_parallel ? *camera.orthographic_half_height_m : std::tan(0.5 * camera.vertical_fov_rad);
    return {.at_one_m = static_cast<float>(2.0 * half_height_m / height_px), .is_parallel = is_parallel};
}

glm::dvec2 jitter(uint32_t index, uint32_t count)
{
    return count <= 1 ? glm::dvec2(0.0) : glm::dvec2(halton(index + 1, 2), halton(index + 1, 3)) - 0.5;
}

glm::dmat4 crop_of(const PixelRect& part, glm::uvec2 page_px)
{
    const glm::dvec2 scale = glm::dvec2(page_px) / glm::dvec2(part.size_px);
    const glm::dvec2 middle_px = glm::dvec2(part.from_px) + 0.5 * glm::dvec2(part.size_px);
    const glm::dvec2 middle = 2.0 * middle_px / glm::dvec2(page_px) - 1.0;
    const glm::dmat4 scaled = glm::scale(glm::dmat4(1.0), glm::dvec3(scale, 1.0));
    return glm::translate(scaled, glm::dvec3(-middle, 0.0));
}

} // namespace estampe::features
