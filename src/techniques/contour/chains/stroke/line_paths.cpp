// SPDX-License-Identifier: MIT
#include "techniques/contour/chains/stroke/line_paths.hpp"

#include <algorithm>

#include <glm/gtc/packing.hpp>

namespace estampe::contour {
namespace {

constexpr float most_stretch = 3.0F; // as in split.comp

bool has(const shared::LineSample& sample, uint32_t bit)
{
    return (sample.state & bit) != 0;
}

/// Counts what the pieces of a path are, to name the path by what most of it is.
class KindCount {
public:
    void add(uint32_t kind) { ++counts_.at(kind); }

    [[nodiscard]] uint32_t most() const
    {
        return static_cast<uint32_t>(std::ranges::max_element(counts_) - counts_.begin());
    }

private:
    std::array<uint32_t, shared::line_kind_count> counts_{};
};

class Reader {
public:
    Reader(const LineLists& lists, const EdgeMesh& mesh) : lists_(lists), mesh_(mesh) {}

    /// The strokes among samples [first, last].
    void add_strokes(uint32_t first, uint32_t last, std::vector<LinePath>& paths) const
    {
        for (uint32_t start = first; start < last;) {
            if (!has(lists_.samples[start], shared::piece_is_there)) {
                ++start;
                continue;
            }
            uint32_t end = start + 1;
            while (end < last && has(lists_.samples[end], shared::piece_is_there) &&
                   lists_.strokes_before[end + 1] == lists_.strokes_before[start + 1]) {
                ++end;
            }
            paths.push_back(stroke(start, end));
            start = end;
        }
    }

    void add_hidden(uint32_t first, uint32_t last, const LineWidths& widths_px,
                    std::vector<LinePath>& paths) const
    {
        for (uint32_t start = first; start < last;) {
            uint32_t end = start;
            KindCount kinds;
            while (end < last && is_hidden_piece(end)) {
                kinds.add(kind_at(end));
                ++end;
            }
            if (end > start) {
                LinePath path{
                    .kind = kinds.most(), .triangle = triangle_of(lists_.samples[start]), .is_hidden = true};
                for (uint32_t i = start; i <= end; ++i) {
                    path.points.push_back({lists_.samples[i].page_px, widths_px.at(path.kind)});
                }
                paths.push_back(std::move(path));
            }
            start = std::max(end, start + 1);
        }
    }

private:
    [[nodiscard]] static uint32_t triangle_of(const shared::LineSample& sample)
    {
        return (sample.source & 0x0fffffffU) >> 2U;
    }

    [[nodiscard]] bool is_front(uint32_t triangle) const
    {
        const bool is_turned = (mesh_.neighbors[triangle].w & neighbor_is_turned) != 0;
        return ((lists_.facing[triangle / 32] >> (triangle & 31U) & 1U) != 0) != is_turned;
    }

    /// As in shape.comp: a fold or a boundary behind which the surface turns away is an outline there.
    [[nodiscard]] uint32_t kind_at(uint32_t sample) const
    {
        const uint32_t kind = lists_.samples[sample].source >> 28U;
        const uint32_t side = lists_.samples[sample].source & 0x0fffffffU;
        if (kind == shared::line_silhouette || kind == shared::line_border || (side & 3U) == 3U) {
            return kind;
        }
        const uint32_t beyond = mesh_.neighbors[side >> 2U][static_cast<int>(side & 3U)];
        return beyond != no_side && is_front(side >> 2U) != is_front(beyond >> 2U) ? shared::line_silhouette
                                                                                   : kind;
    }

    [[nodiscard]] LinePath stroke(uint32_t start, uint32_t end) const
    {
        LinePath path{.triangle = triangle_of(lists_.samples[start]),
                      .ink = lists_.points[2UL * start].ink,
                      .is_closed = has(lists_.samples[start], shared::sample_in_ring)};
        KindCount kinds;
        path.points.reserve(end - start + 1);
        for (uint32_t i = start; i <= end; ++i) {
            const shared::LinePoint& point = lists_.points[2UL * i + (i == start ? 0 : 1)];
            path.points.push_back({point.page_px, 2.0F * point.half_width_px});
            if (i < end) {
                kinds.add(kind_at(i));
            }
        }
        path.kind = kinds.most();
        return path;
    }

    [[nodiscard]] bool is_hidden_piece(uint32_t i) const
    {
        const shared::LineSample& from = lists_.samples[i];
        const shared::LineSample& to = lists_.samples[i + 1];
        const float spacing_px = glm::unpackHalf1x16(static_cast<uint16_t>(from.state >> 16U));
        return !has(from, shared::piece_is_there) && !has(from, shared::sample_is_off_page) &&
               !has(to, shared::sample_is_off_page) &&
               glm::distance(from.page_px, to.page_px) < most_stretch * std::max(spacing_px, 1.0F);
    }

    const LineLists& lists_;
    const EdgeMesh& mesh_;
};

} // namespace

std::vector<LinePath> line_paths(const LineLists& lists, const EdgeMesh& mesh,
                                 const std::optional<LineWidths>& hidden_widths_px)
{
    const Reader reader(lists, mesh);
    std::vector<LinePath> paths;
    const uint32_t slots = lists.sizes[shared::list_slots].count;
    const uint32_t samples = lists.sizes[shared::list_samples].count;
    for (uint32_t slot = 0; slot < slots; ++slot) {
        const uint32_t first = lists.samples_before[slot];
        const uint32_t end = lists.samples_before[slot + 1];
        if (end > samples || end < first + 2) {
            continue;
        }
        reader.add_strokes(first, end - 1, paths);
        if (hidden_widths_px) {
            reader.add_hidden(first, end - 1, *hidden_widths_px, paths);
        }
    }
    return paths;
}

} // namespace estampe::contour
