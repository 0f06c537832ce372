// SPDX-License-Identifier: MIT
#include "techniques/shadow/ground/ground_shadow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_access.hpp>

#include "shaders/ground_keep_comp.hpp"
#include "shaders/ground_share_comp.hpp"
#include "techniques/shadow/heightfield/height_shadow.hpp"

namespace estampe::shadow {
namespace {

constexpr double texels_beside = 3.0; // margin in texels around lookups, for interpolation and rounding

} // namespace

GroundLevels ground_levels_about(const glm::dvec2& eye_m, const glm::dvec2& anchor_m,
                                 const glm::dvec3& towards_sun, uint32_t size, double texel_m)
{
    const glm::dvec2 level_sun(towards_sun.x, towards_sun.z);
    const double length = glm::length(level_sun);
    const glm::dvec2 sunwards = length > 1e-9 ? level_sun / length : glm::dvec2(0.0);
    GroundLevels levels;
    for (uint32_t i = 0; i < levels.size(); ++i) {
        const double own_texel_m = texel_m * std::pow(4.0, i);
        const double extent_m = own_texel_m * size;
        const double step_m = 16.0 * own_texel_m;
        const glm::dvec2 middle = eye_m + 0.25 * extent_m * sunwards;
        const glm::dvec2 corner = step_m * glm::floor((middle - 0.5 * extent_m) / step_m);
        levels[i] = {.origin_m = glm::vec2(corner - anchor_m), .texel_m = static_cast<float>(own_texel_m)};
    }
    return levels;
}

shared::FieldSector seen_sector(const GroundSight& sight, const GroundLevels& levels,
                                const LevelNumbers& numbers)
{
    const glm::dmat4 clip(sight.clip_from_anchor);
    if (glm::dvec3(glm::row(clip, 3)) == glm::dvec3(0.0)) {
        return {};
    }
    const glm::dmat4 anchor_from_clip = glm::inverse(clip);
    const glm::dvec4 apex = anchor_from_clip * glm::dvec4(0, 0, 1, 0);
    const glm::dvec3 eye = glm::dvec3(apex) / apex.w;
    const auto way_to = [&](double x, double y) {
        const glm::dvec4 far = anchor_from_clip * glm::dvec4(x, y, 0, 1);
        const glm::dvec3 way = glm::dvec3(far) - far.w * eye;
        return glm::dvec2(way.x, way.z) / glm::length(way);
    };
    constexpr double beside = 1.01; // margin around the page, as a factor
    const glm::dvec2 middle = way_to(0, 0);
    const double level = glm::length(middle);
    if (level < 0.1) {
        return {};
    }
    // Directions from the eye to the page's corners, as lateral distance per unit of distance ahead.
    const glm::dvec2 ahead = middle / level;
    const glm::dvec2 aside(-ahead.y, ahead.x);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        const glm::dvec2 way = way_to(beside * corner.x, beside * corner.y);
        if (glm::dot(way, ahead) < 0.1) {
            return {};
        }
        const double share = glm::dot(way, aside) / glm::dot(way, ahead);
        least = std::min(least, share);
        most = std::max(most, share);
    }
    // For a point above the ground, the height field is read at the place where the point's shadow falls, on
    // the side away from the sun.
    const glm::dvec2 shadow_m = -sight.relief_m / std::max(sight.towards_sun.y, 0.01) *
                                glm::dvec2(sight.towards_sun.x, sight.towards_sun.z);
    shared::FieldSector sector{};
    const glm::dvec2 sides[2]{aside - least * ahead, most * ahead - aside};
    for (int line = 0; line < 2; ++line) {
        const glm::dvec2 side = glm::normalize(sides[line]);
        sector.sides[line] = glm::vec2(side);
        for (size_t i = 0; i < numbers.size(); ++i) {
            const shared::GroundLevel& field = levels[numbers[i]];
            const double from_eye_m = glm::dot(side, glm::dvec2(field.origin_m) - glm::dvec2(eye.x, eye.z));
            const double further_m = std::max(-glm::dot(side, shadow_m), 0.0);
            sector.offsets[i][line] = static_cast<float>(
                (from_eye_m + further_m) / static_cast<double>(field.texel_m) + texels_beside);
        }
    }
    return sector;
}

shared::FieldSector sunward_of(const shared::FieldSector& sector, const glm::dvec3& towards_sun)
{
    shared::FieldSector sunward = sector;
    for (int line = 0; line < 2; ++line) {
        // Texels towards the sun lie beyond the sector's sunward side, so that side does not limit the
        // texels.
        const bool leaves = glm::dot(sector.sides[line], glm::vec2(towards_sun.x, towards_sun.z)) < 0.0F;
        sunward.sides[line] = leaves ? glm::vec2(0.0F) : sector.sides[line];
        for (glm::vec2& offset : sunward.offsets) {
            offset[line] = leaves ? 0.0F : offset[line] + static_cast<float>(texels_beside);
        }
    }
    return sunward;
}

gpu::BufferId add_ground_fields(gpu::Graph& graph, const GroundFields& fields, const glm::dvec3& towards_sun,
                                gpu::BufferId kept)
{
    FieldTexels texel_m;
    for (const uint32_t number : fields.numbers) {
        texel_m.push_back(fields.levels[number].texel_m);
    }
    const HeightShadowInputs inputs{.height = fields.height,
                                    .texel_m = texel_m,
                                    .towards_sun = towards_sun,
                                    .sun_radius_rad =
                                        std::max(static_cast<double>(fields.sun_radius_rad), 1e-4),
                                    .wanted = fields.wanted};
    const gpu::ImageId horizon = blurs(fields.style.method) ? add_height_shadow(graph, inputs, fields.style)
                                                            : add_height_horizon(graph, inputs, fields.style);
    auto pass = graph.compute("ground/keep", shaders::ground_keep_comp);
    pass.sample(fields.height).sample(horizon);
    const gpu::BufferId result = pass.modify(kept);
    shared::GroundKeepConstants constants{.size = fields.size, .wanted = fields.wanted};
    std::ranges::copy(fields.numbers, constants.level);
    pass.push(constants).dispatch_over_page(fields.size, fields.size,
                                            static_cast<uint32_t>(fields.numbers.size()));
    return result;
}

gpu::ImageId add_ground_share(gpu::Graph& graph, const GroundShareInputs& in)
{
    shared::GroundShareConstants constants{.towards_sun = glm::vec3(in.towards_sun),
                                           .radius_rad = std::max(in.sun_radius_rad, 1e-4F),
                                           .size = in.size};
    std::ranges::copy(in.levels, constants.levels);
    auto pass = graph.compute("ground/share", shaders::ground_share_comp);
    pass.uniform(in.frame).sample(in.depth).sample(in.kept, gpu::Format::r32ui);
    const gpu::ImageId share = pass.write(graph.image(
        "ground/share", {.width = in.size_px.x, .height = in.size_px.y, .format = gpu::Format::r16f}));
    pass.variant(blurs(in.method) ? shared::ground_keeps_shares : 0U);
    pass.push(constants).dispatch_over_page(in.size_px.x, in.size_px.y);
    return share;
}

} // namespace estampe::shadow
