// SPDX-License-Identifier: MIT
#include "output/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace estampe::output {
namespace {

constexpr float parallel_cosine = 0.995F; // 6 degrees
constexpr float least_overlap_mm = 1.0F;  // what crosses at a low angle stays
constexpr float cell_mm = 1.0F;
constexpr float sample_mm = 0.25F;

/// A short piece of a stroke that is drawn already.
struct Piece {
    glm::vec2 from{0.0F};
    glm::vec2 to{0.0F};
};

class DrawnPieces {
public:
    /// Whether a piece lies within `reach_mm` of the place and runs along `way`.
    [[nodiscard]] bool covers(const glm::vec2& place, const glm::vec2& way, float reach_mm) const
    {
        const glm::ivec2 middle = cell_of(place);
        for (int i = 0; i < 9; ++i) {
            const auto found = cells_.find(key_of(middle + glm::ivec2(i % 3 - 1, i / 3 - 1)));
            if (found != cells_.end() && std::ranges::any_of(found->second, [&](const Piece& piece) {
                    return std::abs(glm::dot(way, direction(piece.from, piece.to))) > parallel_cosine &&
                           distance_to(place, piece) <= reach_mm;
                })) {
                return true;
            }
        }
        return false;
    }

    void add(const VectorStroke& stroke)
    {
        for (size_t i = 1; i < stroke.points.size(); ++i) {
            const Piece piece{stroke.points[i - 1].page_mm, stroke.points[i].page_mm};
            const int steps = 1 + static_cast<int>(glm::distance(piece.from, piece.to) / (0.5F * cell_mm));
            for (int k = 0; k < steps; ++k) {
                const Piece part{
                    glm::mix(piece.from, piece.to, static_cast<float>(k) / static_cast<float>(steps)),
                    glm::mix(piece.from, piece.to, static_cast<float>(k + 1) / static_cast<float>(steps))};
                cells_[key_of(cell_of(0.5F * (part.from + part.to)))].push_back(part);
            }
        }
    }

    [[nodiscard]] static glm::vec2 direction(const glm::vec2& from, const glm::vec2& to)
    {
        const float length = glm::distance(from, to);
        return length > 0.0F ? (to - from) / length : glm::vec2(0.0F);
    }

private:
    [[nodiscard]] static float distance_to(const glm::vec2& place, const Piece& piece)
    {
        const glm::vec2 way = piece.to - piece.from;
        const float along =
            glm::clamp(glm::dot(place - piece.from, way) / std::max(glm::dot(way, way), 1e-12F), 0.0F, 1.0F);
        return glm::distance(place, piece.from + along * way);
    }

    [[nodiscard]] static glm::ivec2 cell_of(const glm::vec2& place) { return {glm::floor(place / cell_mm)}; }

    [[nodiscard]] static uint64_t key_of(const glm::ivec2& cell)
    {
        return static_cast<uint64_t>(static_cast<uint32_t>(cell.x)) << 32U | static_cast<uint32_t>(cell.y);
    }

    std::unordered_map<uint64_t, std::vector<Piece>> cells_;
};

VectorStroke without_points(const VectorStroke& stroke)
{
    VectorStroke copy = stroke;
    copy.points.clear();
    copy.is_closed = false;
    return copy;
}

/// The same stroke with points no farther apart than `step_mm`.
VectorStroke refined(const VectorStroke& stroke, float step_mm)
{
    VectorStroke fine = stroke;
    fine.points.clear();
    for (size_t i = 0; i + 1 < stroke.points.size(); ++i) {
        const VectorPoint& a = stroke.points[i];
        const VectorPoint& b = stroke.points[i + 1];
        const int steps = 1 + static_cast<int>(glm::distance(a.page_mm, b.page_mm) / step_mm);
        for (int k = 0; k < steps; ++k) {
            const float share = static_cast<float>(k) / static_cast<float>(steps);
            fine.points.push_back(
                {glm::mix(a.page_mm, b.page_mm, share), glm::mix(a.width_mm, b.width_mm, share)});
        }
    }
    fine.points.push_back(stroke.points.back());
    return fine;
}

float length_mm(const VectorStroke& stroke, size_t first, size_t last)
{
    float sum = 0.0F;
    for (size_t i = first; i < last; ++i) {
        sum += glm::distance(stroke.points[i].page_mm, stroke.points[i + 1].page_mm);
    }
    return sum;
}

/// Keeps runs of covered points that are too short to be a double line, unless they are all there is.
void keep_short_runs(const VectorStroke& stroke, std::vector<bool>& is_kept)
{
    const auto end = is_kept.end();
    for (auto run = std::find(is_kept.begin(), end, false); run != end;) {
        const auto stop = std::find(run, end, true);
        const bool is_all = run == is_kept.begin() && stop == end;
        const float length = length_mm(stroke, static_cast<size_t>(run - is_kept.begin()),
                                       static_cast<size_t>(stop - is_kept.begin()) - 1);
        if (!is_all && length < least_overlap_mm) {
            std::fill(run, stop, true);
        }
        run = std::find(stop, end, false);
    }
}

} // namespace

std::vector<VectorStroke> kept_stretches(const VectorStroke& stroke, const std::vector<bool>& is_kept)
{
    std::vector<VectorStroke> kept;
    if (std::ranges::find(is_kept, false) == is_kept.end()) {
        kept.push_back(stroke);
        return kept;
    }
    VectorStroke open = without_points(stroke);
    for (size_t i = 0; i <= stroke.points.size(); ++i) {
        if (i < stroke.points.size() && is_kept[i]) {
            open.points.push_back(stroke.points[i]);
            continue;
        }
        if (open.points.size() > 1) {
            kept.push_back(open);
        }
        open.points.clear();
    }
    return kept;
}

void remove_overlaps(VectorDrawing& drawing)
{
    std::vector<DrawnPieces> drawn(drawing.inks_srgb.size());
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        DrawnPieces& pieces = drawn.at(stroke.ink);
        const VectorStroke fine = refined(stroke, sample_mm);
        std::vector<bool> is_free(fine.points.size());
        bool all_free = true;
        for (size_t i = 0; i < fine.points.size(); ++i) {
            const size_t before = i > 0 ? i - 1 : 0;
            const size_t after = std::min(i + 1, fine.points.size() - 1);
            const glm::vec2 way =
                DrawnPieces::direction(fine.points[before].page_mm, fine.points[after].page_mm);
            is_free[i] = !pieces.covers(fine.points[i].page_mm, way, fine.points[i].width_mm / 3.0F);
            all_free = all_free && is_free[i];
        }
        keep_short_runs(fine, is_free);
        const std::vector<VectorStroke> parts =
            all_free ? std::vector<VectorStroke>{stroke} : kept_stretches(fine, is_free);
        for (const VectorStroke& part : parts) {
            pieces.add(part);
            kept.push_back(part);
        }
    }
    drawing.strokes = std::move(kept);
}

void cut_dashes(VectorDrawing& drawing)
{
    std::vector<VectorStroke> cut;
    cut.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        if (!stroke.is_hidden) {
            cut.push_back(stroke);
            continue;
        }
        const VectorStroke fine = refined(stroke, 0.1F);
        std::vector<bool> is_kept(fine.points.size());
        float at_mm = 0.0F;
        for (size_t i = 0; i < fine.points.size(); ++i) {
            at_mm += i > 0 ? glm::distance(fine.points[i - 1].page_mm, fine.points[i].page_mm) : 0.0F;
            is_kept[i] = std::fmod(at_mm, drawing.dash_mm + drawing.dash_gap_mm) <= drawing.dash_mm;
        }
        const std::vector<VectorStroke> dashes = kept_stretches(fine, is_kept);
        cut.insert(cut.end(), dashes.begin(), dashes.end());
    }
    drawing.strokes = std::move(cut);
}

void remove_thin_hatching(VectorDrawing& drawing)
{
    std::vector<VectorStroke> kept;
    kept.reserve(drawing.strokes.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        std::vector<bool> is_kept(stroke.points.size(), true);
        if (stroke.kind == StrokeKind::hatch) {
            for (size_t i = 0; i < is_kept.size(); ++i) {
                is_kept[i] = stroke.points[i].width_mm >= 0.5F * drawing.hatch_width_mm;
            }
        }
        const std::vector<VectorStroke> parts = kept_stretches(stroke, is_kept);
        kept.insert(kept.end(), parts.begin(), parts.end());
    }
    drawing.strokes = std::move(kept);
}

} // namespace estampe::output
