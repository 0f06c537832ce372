// SPDX-License-Identifier: MIT
// Draws pages in tiles, see docs/decisions/0016.
#include "frame/renderer_impl.hpp"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include <estampe/error.hpp>

#include "core/free_memory.hpp"
#include "core/job_limits.hpp"
#include "frame/page.hpp"

namespace estampe {
namespace {

constexpr uint32_t usual_tile_px = 2048;
constexpr uint64_t most_survey_pixels = uint64_t{1} << 27U;

/// Largest number of pixels of the survey, which draws the whole page at a lower resolution. The survey may
/// use half of the device's memory. Data that all tiles share needs the remaining half.
uint64_t survey_pixels(const gpu::Device& device, const frame::PageLimits& limits)
{
    return std::min(
        {limits.pixels, most_survey_pixels, device.memory().whole_bytes() / (2 * frame::bytes_a_pixel)});
}

uint32_t automatic_tile_px(const frame::PageLimits& limits, uint32_t overlap)
{
    // If the side of a tile is at least 7 times the overlap, half or more of the drawn pixels are kept.
    return std::min(std::max(usual_tile_px, 7 * overlap), limits.side_px);
}

/// Copies the kept rectangle of a tile to its place in a band of pixel rows.
void copy_kept(const gpu::Buffer& pixels, const frame::Tile& tile, Image& band)
{
    const glm::uvec2 skipped = tile.kept.from_px - tile.drawn.from_px;
    const auto* const source = reinterpret_cast<const uint8_t*>(pixels.mapped().data());
    for (uint32_t y = 0; y < tile.kept.size_px.y; ++y) {
        const size_t from = size_t{skipped.y + y} * tile.drawn.size_px.x + skipped.x;
        const size_t to = size_t{y} * band.width + tile.kept.from_px.x;
        std::memcpy(band.rgba.data() + 4 * to, source + 4 * from, size_t{4} * tile.kept.size_px.x);
    }
}

} // namespace

bool Renderer::Impl::is_tiled(const RenderSettings& settings) const
{
    frame::check_page(settings);
    const frame::PageLimits limits = frame::page_limits(device);
    const uint32_t longest_px = std::max(settings.width, settings.height);
    const uint64_t pixels = uint64_t{settings.width} * settings.height;
    const bool is_wanted = settings.tile_px > 0 && longest_px > settings.tile_px;
    const bool fits = longest_px <= limits.side_px && pixels <= limits.pixels &&
                      frame::bytes_a_pixel * pixels <= device.memory().whole_bytes();
    const bool is_alone = settings.continuity == Continuity::still && !settings.motion_since;
    if (!is_alone && !fits) {
        frame::check_size(device, settings);
    }
    return is_alone && (is_wanted || !fits);
}

std::vector<contour::LinkedLines>
Renderer::Impl::survey_page(const Camera& camera, const features::StyleTables& style,
                            const frame::FramePlan& plan, const features::Survey& survey, uint32_t samples)
{
    const bool has_chains =
        features.lines.meshes().ensure(device, loaded->layout, plan.variants.lines) != nullptr;
    const uint32_t survey_count = has_chains ? samples : plan.light.meters_page ? 1 : 0;
    const frame::FramePlan survey_plan = frame::shrunk_plan(plan, survey.shrink, survey.size_px(), style);
    upload_pixel_sizes(survey_plan, style);
    std::vector<contour::LinkedLines> lines;
    for (uint32_t sample = 0; sample < survey_count; ++sample) {
        contour::LinkedLines found;
        draw_frame(camera, style, survey_plan,
                   {.accumulation = {.sample_index = sample, .sample_count = samples},
                    .is_first = sample == 0,
                    .survey = survey,
                    .linked_out = &found});
        if (has_chains) {
            lines.push_back(contour::shrunk(device, executor, std::move(found)));
        }
    }
    upload_pixel_sizes(plan, style);
    return lines;
}

features::InkPlan Renderer::Impl::let_ink_flow(const Camera& camera, const features::StyleTables& tables,
                                               const RenderSettings& settings)
{
    frame::FramePlan plan = prepare(camera, tables, settings);
    plan.ink = features.ink.ensure(device, executor, ink_inputs(camera, tables, settings), notes);
    plan.smoke = plan_smoke(plan, tables, settings);
    frame::ensure_page(device, buffers.page, plan.page_px, settings.samples);
    draw_frame(camera, tables, plan, {.accumulation = {.sample_index = 0, .sample_count = settings.samples}});
    features.ink.drawn(*plan.ink, camera);
    return *plan.ink;
}

void Renderer::Impl::draw_tiles(const Camera& camera, const Style& style, const RenderSettings& settings,
                                const BandSink& sink)
{
    const JobLimits job_limits(settings.limits);
    const features::StyleTables& tables = tables_of(style);
    const Camera seen_by = page_camera(camera, tables.paper, settings);
    const frame::PageLimits limits = frame::page_limits(device);
    const features::Survey survey =
        frame::survey_of({settings.width, settings.height}, limits.side_px, survey_pixels(device, limits));
    std::optional<features::InkPlan> flowed;
    std::vector<std::string> notes_of_ink;
    if (tables.ink.enabled) {
        RenderSettings surveyed = settings;
        surveyed.width = survey.size_px().x;
        surveyed.height = survey.size_px().y;
        flowed = let_ink_flow(seen_by, tables, surveyed);
        notes_of_ink = std::move(notes);
    }
    frame::FramePlan plan = prepare(seen_by, tables, settings);
    plan.smoke = plan_smoke(plan, tables, settings);
    if (flowed) {
        plan.ink = features.ink.shown_on(device, *flowed, ink_inputs(seen_by, tables, settings));
        notes = std::move(notes_of_ink);
    }
    if (plan.motion_blur) {
        notes.emplace_back("a page that is drawn in tiles has no motion blur, no speed lines and no smear");
        plan.motion_blur.reset();
    }
    uint32_t overlap = 0;
    for (const features::StyleTables& variant : plan.variants.styles) {
        overlap = std::max(overlap, frame::overlap_px(variant, plan.page.pixels_per_mm));
    }
    const uint32_t tile_px = settings.tile_px > 0 ? std::min(settings.tile_px, limits.side_px)
                                                  : automatic_tile_px(limits, overlap);
    const std::vector<frame::Tile> tiles = frame::tiles_of(plan.page_px, tile_px, overlap);
    frame::check_page_memory(tiles.front().drawn.size_px);
    std::vector<contour::LinkedLines> lines = survey_page(seen_by, tables, plan, survey, settings.samples);
    bool is_first = lines.empty() && !plan.light.meters_page;
    frame::ensure_page(device, buffers.page, tiles.front().drawn.size_px, settings.samples);
    Image band{.width = settings.width};
    double drawn_pixels = 0.0;
    for (const frame::Tile& tile : tiles) {
        if (sink.progress) {
            sink.progress(drawn_pixels / (static_cast<double>(settings.width) * settings.height));
        }
        for (uint32_t sample = 0; sample < settings.samples; ++sample) {
            FrameJob job{.accumulation = {.sample_index = sample, .sample_count = settings.samples},
                         .is_first = is_first,
                         .tile = tile.drawn};
            if (!lines.empty()) {
                job.linked = {.lines = &lines.at(sample),
                              .part = {.from_px = glm::vec2(tile.drawn.from_px),
                                       .scale = static_cast<float>(survey.shrink)}};
            }
            draw_frame(seen_by, tables, plan, job);
            is_first = false;
        }
        band.height = tile.kept.size_px.y;
        band.rgba.resize(size_t{4} * band.width * band.height);
        copy_kept(buffers.page.pixels, tile, band);
        drawn_pixels += static_cast<double>(tile.kept.size_px.x) * tile.kept.size_px.y;
        if (tile.kept.from_px.x + tile.kept.size_px.x == settings.width) {
            sink.take(band);
        }
    }
}

} // namespace estampe
