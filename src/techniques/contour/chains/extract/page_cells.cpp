// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/extract/page_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "gpu/transfers.hpp"
#include "shaders/clump_foliage_comp.hpp"
#include "shaders/cross_clumps_comp.hpp"
#include "shaders/cross_meetings_comp.hpp"
#include "shaders/cross_shadows_comp.hpp"
#include "shaders/emit_cells_comp.hpp"
#include "shaders/light_foliage_comp.hpp"
#include "shaders/list_meetings_comp.hpp"
#include "shaders/mark_cells_comp.hpp"
#include "shaders/see_foliage_comp.hpp"
#include "techniques/contour/chains/chains.hpp"
#include "techniques/contour/chains/scan/scan.hpp"

namespace estampe::contour {
namespace {

/// Size of the page lattice (the grid in which lines are found on the page), in points.
glm::uvec2 lattice(glm::uvec2 size_px)
{
    return (size_px + (shared::cell_px - 1)) / shared::cell_px;
}

uint32_t point_count(glm::uvec2 size_px)
{
    return lattice(size_px).x * lattice(size_px).y;
}

shared::CellConstants cell_constants(glm::uvec2 size_px, uint32_t kind, uint32_t first_word,
                                     uint32_t word_count = 0)
{
    return {.columns = lattice(size_px).x,
            .rows = lattice(size_px).y,
            .first_word = first_word,
            .word_count = word_count,
            .kind = kind,
            .point_px = kind == shared::line_shadow ? 0.0F : 0.5F};
}

PageLines add_meetings(gpu::Graph& graph, const ChainInputs& in, uint32_t first_word)
{
    const shared::CellConstants constants = cell_constants(in.size_px, shared::line_intersection, first_word);
    const uint64_t points = point_count(in.size_px);
    const gpu::BufferId none =
        gpu::add_empty_list(graph, "contour/meetings", 16 + 2 * sizeof(uint32_t) * points);
    auto list = graph.compute("contour/list meetings", shaders::list_meetings_comp);
    list.uniform(in.frame).sample(in.visibility, gpu::Format::rg32ui).sample(in.neighbors);
    const gpu::BufferId meetings = list.modify(none);
    gpu::BufferId crossings =
        list.write(graph.buffer("contour/meeting crossings", list_of(points, sizeof(glm::uvec2))));
    list.push(constants).dispatch_over(constants.columns, constants.rows);

    auto cross = graph.compute("contour/cross meetings", shaders::cross_meetings_comp);
    cross.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
    cross.sample(in.visibility, gpu::Format::rg32ui).sample(in.neighbors);
    cross.read(meetings);
    crossings = cross.modify(crossings);
    cross.push(constants).dispatch_indirect(meetings);
    return {
        .crossings = crossings, .kind = shared::line_intersection, .first_word = first_word, .foliage = {}};
}

PageLines add_shadow_edges(gpu::Graph& graph, const ChainInputs& in, const SunPixels& sun,
                           uint32_t first_word)
{
    const shared::CellConstants constants = cell_constants(in.size_px, shared::line_shadow, first_word);
    auto cross = graph.compute("contour/cross shadows", shaders::cross_shadows_comp);
    cross.uniform(in.frame).sample(sun.share).sample(sun.draw).sample(sun.depth).sample(sun.normal);
    const gpu::BufferId crossings = cross.write(
        graph.buffer("contour/shadow crossings", list_of(point_count(in.size_px), sizeof(glm::uvec2))));
    cross.push(constants).dispatch_over(constants.columns, constants.rows);
    return {.crossings = crossings, .kind = shared::line_shadow, .first_word = first_word, .foliage = {}};
}

/// Binds the images that foliage.glsl reads at FOLIAGE_PIXELS_BINDING.
void sample_pixels(gpu::Pass& pass, const FoliagePixels& pixels)
{
    pass.sample(pixels.draws).sample(pixels.draw).sample(pixels.depth);
}

/// Finds clumps of foliage on the page lattice.
class FoliagePasses {
public:
    FoliagePasses(gpu::Graph& graph, const ChainInputs& in)
        : graph_(graph), in_(in), lattice_(lattice(in.size_px))
    {
    }

    [[nodiscard]] gpu::BufferId see()
    {
        auto see = graph_.compute("contour/see foliage", shaders::see_foliage_comp);
        sample_pixels(see, *in_.foliage);
        see.sample(in_.foliage->light);
        return written(see, "contour/foliage", sizeof(glm::uvec2), {.tone = in_.foliage->tone});
    }

    /// Grows or shrinks clumps by `radius` points of the lattice. What was grown and is shrunk by the same
    /// radius keeps its outline, except in gaps.
    [[nodiscard]] gpu::BufferId resized(gpu::BufferId foliage, uint32_t radius, bool shrinks)
    {
        bool is_turned = false;
        for (uint32_t left = radius; left > 0; left /= 2) {
            const uint32_t ring = (left + 1) / 2;
            shared::FoliageConstants constants{.shrinks = shrinks ? 1U : 0U};
            for (int i = 0; i < 8; ++i) {
                // Rings that are turned against each other by a sixteenth make a rounder circle.
                const float angle =
                    std::numbers::pi_v<float> / 4.0F * (static_cast<float>(i) + (is_turned ? 0.5F : 0.0F));
                constants.ring[i] =
                    glm::round(static_cast<float>(ring) * glm::vec2(std::cos(angle), std::sin(angle)));
            }
            auto clump = graph_.compute("contour/clump foliage", shaders::clump_foliage_comp);
            clump.sample(foliage, gpu::Format::rg32ui);
            foliage = written(clump, "contour/clumps", sizeof(glm::uvec2), constants);
            is_turned = !is_turned;
        }
        return foliage;
    }

    /// Sums the lightness of foliage over squares that reach `reach` points to either side.
    [[nodiscard]] gpu::BufferId light(gpu::BufferId foliage, uint32_t reach)
    {
        gpu::BufferId sums = foliage;
        for (const uint32_t variant : {0U, shared::light_foliage_adds_rows}) {
            auto add = graph_.compute("contour/light foliage", shaders::light_foliage_comp);
            add.sample(foliage, gpu::Format::rg32ui);
            add.sample(sums, variant == 0 ? gpu::Format::rg32ui : gpu::Format::r32ui).variant(variant);
            sums = written(add, "contour/foliage light", sizeof(uint32_t), {.reach = reach});
        }
        return sums;
    }

private:
    gpu::BufferId written(gpu::Pass& pass, const char* name, uint32_t bytes_a_point,
                          shared::FoliageConstants constants)
    {
        constants.columns = lattice_.x;
        constants.rows = lattice_.y;
        const gpu::BufferId buffer =
            pass.write(graph_.buffer(name, list_of(point_count(in_.size_px), bytes_a_point)));
        pass.push(constants).dispatch_over(lattice_.x, lattice_.y);
        return buffer;
    }

    gpu::Graph& graph_;
    const ChainInputs& in_;
    glm::uvec2 lattice_;
};

// Radius of the smallest bulge of a clump's outline, as a share of the size of gaps that are closed.
constexpr float bulge_share = 0.4F;
// Reach of the mean lightness of foliage, as a share of the size of gaps that are closed.
constexpr float light_share = 1.5F;

/// Gaps between leaves up to the size `clump_px` are closed, and what is narrower than a bulge is cut off.
PageLines add_clumps(gpu::Graph& graph, const ChainInputs& in, uint32_t first_word)
{
    const auto points = [&](float share) {
        return static_cast<uint32_t>(
            std::lround(share * in.foliage->clump_px / static_cast<float>(shared::cell_px)));
    };
    FoliagePasses passes(graph, in);
    const gpu::BufferId seen = passes.see();
    const uint32_t gap = points(0.5F);
    const uint32_t bulge = points(bulge_share);
    const gpu::BufferId closed = passes.resized(passes.resized(seen, gap, false), gap, true);
    const gpu::BufferId clumps = passes.resized(passes.resized(closed, bulge, true), bulge, false);
    const gpu::BufferId light =
        in.foliage->has_marks ? passes.light(seen, std::max(points(light_share), 1U)) : clumps;

    shared::CellConstants constants = cell_constants(in.size_px, shared::line_clump, first_word);
    constants.clump_px = in.foliage->clump_px;
    constants.has_outlines = in.foliage->has_outlines ? 1 : 0;
    constants.has_marks = in.foliage->has_marks ? 1 : 0;
    constants.mark_lightness = 1.0F - 0.5F * in.foliage->tone.ceiling;
    constants.first_leaf = in.foliage->first_leaf;
    auto cross = graph.compute("contour/cross clumps", shaders::cross_clumps_comp);
    cross.uniform(in.frame).sample(in.foliage->visibility, gpu::Format::rg32ui);
    cross.sample(clumps, gpu::Format::rg32ui).sample(light, gpu::Format::r32ui);
    sample_pixels(cross, *in.foliage);
    const gpu::BufferId crossings = cross.write(
        graph.buffer("contour/clump crossings", list_of(point_count(in.size_px), sizeof(glm::uvec2))));
    cross.push(constants).dispatch_over(constants.columns, constants.rows);
    return {.crossings = crossings, .kind = shared::line_clump, .first_word = first_word, .foliage = clumps};
}

} // namespace

uint32_t page_words(glm::uvec2 size_px)
{
    return (point_count(size_px) + 31) / 32;
}

InlineVector<PageLines, most_page_lines> add_page_lines(gpu::Graph& graph, const ChainInputs& in,
                                                        uint32_t first_word)
{
    InlineVector<PageLines, most_page_lines> lines;
    if (in.meetings) {
        lines.push_back(add_meetings(graph, in, first_word));
        first_word += page_words(in.size_px);
    }
    if (in.sun) {
        lines.push_back(add_shadow_edges(graph, in, *in.sun, first_word));
        first_word += page_words(in.size_px);
    }
    if (in.foliage) {
        lines.push_back(add_clumps(graph, in, first_word));
    }
    return lines;
}

gpu::BufferId add_cell_marks(gpu::Graph& graph, const PageLines& lines, glm::uvec2 size_px,
                             gpu::BufferId marks)
{
    auto mark = graph.compute("contour/mark cells", shaders::mark_cells_comp);
    mark.sample(lines.crossings, gpu::Format::rg32ui);
    const gpu::BufferId marked = mark.modify(marks);
    mark.push(cell_constants(size_px, lines.kind, lines.first_word));
    mark.dispatch((point_count(size_px) + 63) / 64);
    return marked;
}

void add_cell_segments(gpu::Graph& graph, const ChainInputs& in, const PageLines& lines, CellSegments& list)
{
    auto emit = graph.compute("contour/emit cells", shaders::emit_cells_comp);
    emit.uniform(in.frame).sample(in.line_triangles).sample(in.posed_vertices);
    emit.sample(lines.kind == shared::line_shadow  ? in.sun->visibility
                : lines.kind == shared::line_clump ? in.foliage->visibility
                                                   : in.visibility,
                gpu::Format::rg32ui);
    emit.sample(lines.crossings, gpu::Format::rg32ui);
    emit.sample(list.marks, gpu::Format::r32ui).sample(list.marks_before, gpu::Format::r32ui);
    emit.read(list.sizes);
    list.segments = emit.modify(list.segments);
    list.ranks = emit.modify(list.ranks);
    emit.sample(lines.foliage.value_or(lines.crossings), gpu::Format::rg32ui);
    emit.variant(lines.foliage ? shared::emit_cells_of_clumps : 0U);
    emit.push(cell_constants(in.size_px, lines.kind, lines.first_word, list.word_count));
    emit.dispatch_indirect(list.sizes, indirect_offset(shared::list_segments));
}

} // namespace estampe::contour
