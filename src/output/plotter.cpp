// SPDX-License-Identifier: MIT
#include <estampe/vector_drawing.hpp>

#include <algorithm>
#include <utility>

#include "output/overlaps.hpp"
#include "output/pen_order.hpp"

namespace estampe {
namespace {

constexpr uint64_t turn_budget = 200'000'000; // about a second

std::vector<output::PenStroke> pen_strokes(const std::vector<VectorStroke>& strokes)
{
    std::vector<output::PenStroke> ends;
    ends.reserve(strokes.size());
    for (const VectorStroke& stroke : strokes) {
        ends.push_back({stroke.points.front().page_mm, stroke.points.back().page_mm});
    }
    return ends;
}

double length_mm(const VectorStroke& stroke)
{
    double sum = 0.0;
    for (size_t i = 1; i < stroke.points.size(); ++i) {
        sum += glm::distance(stroke.points[i - 1].page_mm, stroke.points[i].page_mm);
    }
    return sum;
}

/// The strokes of each pen, in their order.
std::vector<std::vector<VectorStroke>> by_pen(const VectorDrawing& drawing)
{
    std::vector<std::vector<VectorStroke>> pens(drawing.inks_srgb.size());
    for (const VectorStroke& stroke : drawing.strokes) {
        pens.at(stroke.ink).push_back(stroke);
    }
    return pens;
}

} // namespace

PlotterWork plotter_work(const VectorDrawing& drawing)
{
    PlotterWork work{.strokes = drawing.strokes.size()};
    for (const VectorStroke& stroke : drawing.strokes) {
        work.drawn_mm += length_mm(stroke);
    }
    for (const auto& strokes : by_pen(drawing)) {
        std::vector<output::PenStep> order(strokes.size());
        for (uint32_t i = 0; i < order.size(); ++i) {
            order[i].stroke = i;
        }
        work.lifted_mm += output::travel_mm(pen_strokes(strokes), order, glm::vec2(0.0F));
    }
    return work;
}

void prepare_for_plotter(VectorDrawing& drawing)
{
    output::remove_thin_hatching(drawing);
    output::cut_dashes(drawing);
    output::remove_overlaps(drawing);
    std::erase_if(drawing.strokes, [&](const VectorStroke& stroke) {
        return length_mm(stroke) < drawing.hatch_width_mm; // a pen would make a blot of it
    });
    std::vector<std::vector<VectorStroke>> pens = by_pen(drawing);
    drawing.strokes.clear();
    for (std::vector<VectorStroke>& strokes : pens) {
        for (const output::PenStep& step :
             output::shortest_order(pen_strokes(strokes), glm::vec2(0.0F), turn_budget)) {
            VectorStroke stroke = std::move(strokes[step.stroke]);
            if (step.is_turned) {
                std::reverse(stroke.points.begin(), stroke.points.end());
            }
            drawing.strokes.push_back(std::move(stroke));
        }
    }
}

} // namespace estampe
