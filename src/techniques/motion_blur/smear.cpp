// SPDX-License-Identifier: MIT
// Strokes are kept as in a hard-core process: Matérn, "Spatial Variation", 1960, the second of his ways to
// thin out points, which asks each point for those about it alone.
#include "techniques/motion_blur/smear.hpp"

#include <algorithm>
#include <map>

#include "core/pcg.hpp"
#include "gpu/imports.hpp"
#include "gpu/upload.hpp"
#include "shaders/mesh.glsl.h"
#include "shaders/smear_lists_comp.hpp"
#include "shaders/smear_seeds_comp.hpp"
#include "shaders/smear_strokes_comp.hpp"
#include "shaders/smear_thin_comp.hpp"

namespace estampe::motion_blur {
namespace {

constexpr uint32_t least_of_draw = 4;
constexpr uint32_t most_of_scene = 4 * smear_seed_count;

float unit_float(uint32_t bits)
{
    return static_cast<float>(bits >> 8U) / 16777216.0F;
}

/// One seed in each part of the area of `of_draw`, which are numbers of triangles.
void spread_over(std::span<const uint32_t> of_draw, std::span<const glm::uvec4> triangles,
                 std::span<const glm::vec3> places, uint32_t count, std::vector<shared::SmearSeed>& seeds)
{
    std::vector<float> area_up_to;
    float area = 0.0F;
    for (const uint32_t number : of_draw) {
        const glm::uvec4& corners = triangles[number];
        const glm::vec3 a = places[corners.x];
        area += glm::length(glm::cross(places[corners.y] - a, places[corners.z] - a));
        area_up_to.push_back(area);
    }
    for (uint32_t i = 0; i < count && area > 0.0F; ++i) {
        const auto number = static_cast<uint32_t>(seeds.size());
        const uint32_t random = hash(number + 1U);
        const float wanted = area * (static_cast<float>(i) + unit_float(random)) / static_cast<float>(count);
        const auto found = std::ranges::upper_bound(area_up_to, wanted);
        const auto at = std::min(static_cast<size_t>(found - area_up_to.begin()), of_draw.size() - 1);
        glm::vec2 weight(unit_float(hash(random)), unit_float(hash(random + 1U)));
        weight = weight.x + weight.y > 1.0F ? 1.0F - weight : weight;
        seeds.push_back({.triangle = of_draw[at], .weight = weight, .number = number});
    }
}

} // namespace

std::vector<shared::SmearSeed> spread_seeds(std::span<const uint32_t> of,
                                            std::span<const glm::uvec4> triangles,
                                            std::span<const glm::vec3> places)
{
    std::map<uint32_t, std::vector<uint32_t>> draws;
    for (const uint32_t number : of) {
        draws[triangles[number].w & shared::triangle_draw_mask].push_back(number);
    }
    const auto draw_count = std::max(static_cast<uint32_t>(draws.size()), 1U);
    const uint32_t count = std::max(smear_seed_count / draw_count, least_of_draw);
    std::vector<shared::SmearSeed> seeds;
    for (const auto& [draw, of_draw] : draws) {
        if (seeds.size() + count <= most_of_scene) {
            spread_over(of_draw, triangles, places, count, seeds);
        }
    }
    return seeds;
}

SmearSeeds upload_seeds(gpu::Device& device, const std::vector<shared::SmearSeed>& seeds)
{
    SmearSeeds made{.count = static_cast<uint32_t>(seeds.size()), .is_made = true};
    if (!seeds.empty()) {
        made.places = gpu::upload_buffer(device, "smear seeds", seeds);
    }
    return made;
}

shared::SmearConstants smear_constants_of(const MotionBlurStyle& style, float scale, float most_px,
                                          float pixels_per_mm)
{
    return {.scale = scale,
            .most_px = most_px,
            .length_share = 2.0F * style.smear_length,
            .spacing_px = style.smear_spacing_mm * pixels_per_mm,
            .width_px = style.smear_width_mm * pixels_per_mm,
            .from_px = 0.5F * style.smear_from_mm * pixels_per_mm,
            .seed = static_cast<uint32_t>(style.seed),
            .ink = style.smear_ink};
}

gpu::ImageId add_smear(gpu::Graph& graph, const SmearScene& scene, const SmearPage& page, gpu::ImageId lines,
                       shared::SmearConstants constants)
{
    if (scene.seeds->count == 0) {
        return lines;
    }
    constants.clip_from_anchor_before = scene.clip_from_anchor_before;
    constants.size_px = page.size_px;
    constants.count = scene.seeds->count;
    const gpu::BufferDesc strokes_desc{.size_bytes = sizeof(shared::SmearStroke) * constants.count};
    auto find = graph.compute("smear/seeds", shaders::smear_seeds_comp);
    find.uniform(scene.frame).sample(gpu::import_whole(graph, "smear seeds", scene.seeds->places));
    find.sample(scene.triangles).sample(scene.posed_vertices).sample(scene.posed_vertices_before);
    find.sample(page.page).sample(page.owner_depth);
    const gpu::BufferId found = find.write(graph.buffer("smear/found", strokes_desc));
    find.push(constants).dispatch_items(constants.count);

    auto thin = graph.compute("smear/thin", shaders::smear_thin_comp);
    thin.sample(found);
    const gpu::BufferId kept = thin.write(graph.buffer("smear/kept", strokes_desc));
    thin.push(constants).dispatch_items(constants.count);

    const glm::uvec2 blocks = (page.size_px + shared::smear_block_px - 1U) / shared::smear_block_px;
    const uint32_t block_count = blocks.x * blocks.y;
    auto list = graph.compute("smear/lists", shaders::smear_lists_comp);
    list.sample(kept);
    const gpu::BufferId lists = list.write(graph.buffer(
        "smear/lists",
        {.size_bytes = sizeof(uint32_t) * (shared::most_smear_strokes + 1U) * uint64_t{block_count}}));
    list.push(constants).dispatch_items(block_count);

    auto draw = graph.compute("smear", shaders::smear_strokes_comp);
    draw.sample(kept).sample(lists, gpu::Format::r32ui);
    draw.sample(page.page).sample(page.owner_depth).sample(page.depth);
    const gpu::ImageId drawn = draw.modify(lines);
    draw.push(constants).dispatch_over(page.size_px.x, page.size_px.y);
    return drawn;
}

} // namespace estampe::motion_blur
