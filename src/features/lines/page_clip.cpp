// SPDX-License-Identifier: MIT
#include "features/lines/page_clip.hpp"

#include <algorithm>

namespace estampe::features {
namespace {

struct Share {
    float from = 0.0F;
    float to = 1.0F;
};

/// Keeps the part of a straight piece where coordinates are from `least` to `most`.
void keep_between(float a, float b, float least, float most, Share& kept)
{
    for (const auto& [from, to] : {std::pair(a - least, b - least), std::pair(most - a, most - b)}) {
        if (from < 0.0F && to < 0.0F) {
            kept = {1.0F, 0.0F};
        } else if (from < 0.0F) {
            kept.from = std::max(kept.from, from / (from - to));
        } else if (to < 0.0F) {
            kept.to = std::min(kept.to, from / (from - to));
        }
    }
}

VectorPoint between(const VectorPoint& a, const VectorPoint& b, float share, const paper::Window& window)
{
    return {glm::clamp(glm::mix(a.page_mm, b.page_mm, share), window.min_mm, window.max_mm),
            glm::mix(a.width_mm, b.width_mm, share)};
}

bool has_length(const VectorStroke& stroke)
{
    return std::ranges::any_of(stroke.points, [&](const VectorPoint& point) {
        return point.page_mm != stroke.points.front().page_mm;
    });
}

} // namespace

std::vector<VectorStroke> clipped(const VectorStroke& stroke, const paper::Window& window)
{
    std::vector<VectorStroke> parts;
    const bool is_inside = std::ranges::all_of(stroke.points, [&](const VectorPoint& point) {
        return glm::clamp(point.page_mm, window.min_mm, window.max_mm) == point.page_mm;
    });
    if (is_inside) {
        parts.push_back(stroke);
    }
    VectorStroke open = stroke;
    open.is_closed = false;
    open.points.clear();
    const auto finish = [&] {
        if (open.points.size() > 1) {
            parts.push_back(open);
        }
        open.points.clear();
    };
    for (size_t i = 1; i < stroke.points.size() && !is_inside; ++i) {
        const VectorPoint& a = stroke.points[i - 1];
        const VectorPoint& b = stroke.points[i];
        Share kept;
        keep_between(a.page_mm.x, b.page_mm.x, window.min_mm.x, window.max_mm.x, kept);
        keep_between(a.page_mm.y, b.page_mm.y, window.min_mm.y, window.max_mm.y, kept);
        if (kept.from >= kept.to) {
            finish();
            continue;
        }
        if (open.points.empty() || kept.from > 0.0F) {
            finish();
            open.points.push_back(between(a, b, kept.from, window));
        }
        open.points.push_back(between(a, b, kept.to, window));
        if (kept.to < 1.0F) {
            finish();
        }
    }
    finish();
    std::erase_if(parts, [](const VectorStroke& part) { return !has_length(part); });
    return parts;
}

} // namespace estampe::features
