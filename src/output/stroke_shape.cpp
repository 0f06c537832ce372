// SPDX-License-Identifier: MIT
#include "output/stroke_shape.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

#include "output/curve.hpp"

namespace estampe::output {
namespace {

using glm::dvec2;
using Grid = glm::i64vec2; // whole thousandths of a millimetre

constexpr double steps_per_mm = 1000.0;

std::string decimal(int64_t thousandths)
{
    std::string text = fmt::format("{}{}.{:03}", thousandths < 0 ? "-" : "", std::abs(thousandths) / 1000,
                                   std::abs(thousandths) % 1000);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') {
        text.pop_back();
    }
    return text;
}

/// Path data in steps from point to point, which are short; whole numbers keep them from drifting.
class PathText {
public:
    void move_to(const dvec2& point)
    {
        here_ = on_grid(point);
        text_ += fmt::format("M{},{}", decimal(here_.x), decimal(here_.y));
        command_ = 'M';
    }

    void curve_to(const Cubic& curve)
    {
        begin('c');
        append(on_grid(curve[1]) - here_);
        append(on_grid(curve[2]) - here_);
        step_to(curve[3]);
    }

    void line_to(const dvec2& point)
    {
        begin('l');
        step_to(point);
    }

    /// Half a circle around to `point`, the way of a clock's hand as the page shows it.
    void turn_to(const dvec2& point, double radius)
    {
        const auto steps = static_cast<int64_t>(std::llround(radius * steps_per_mm));
        if (steps < 5) {
            line_to(point);
            return;
        }
        begin('a');
        text_ += fmt::format("{0},{0} 0 0 1 ", decimal(steps));
        needs_space_ = false;
        step_to(point);
    }

    void close()
    {
        text_ += 'z';
        command_ = 'z';
    }

    [[nodiscard]] const std::string& text() const { return text_; }

private:
    static Grid on_grid(const dvec2& point)
    {
        return {std::llround(point.x * steps_per_mm), std::llround(point.y * steps_per_mm)};
    }

    void begin(char command)
    {
        if (command_ != command || command == 'a') {
            text_ += command;
            needs_space_ = false;
        }
        command_ = command;
    }

    void append(const Grid& step)
    {
        text_ += fmt::format("{}{},{}", needs_space_ ? " " : "", decimal(step.x), decimal(step.y));
        needs_space_ = true;
    }

    void step_to(const dvec2& point)
    {
        const Grid there = on_grid(point);
        append(there - here_);
        here_ = there;
    }

    std::string text_;
    Grid here_{0};
    char command_ = ' ';
    bool needs_space_ = false;
};

std::vector<dvec2> middle_of(const VectorStroke& stroke)
{
    std::vector<dvec2> points;
    points.reserve(stroke.points.size());
    for (const VectorPoint& point : stroke.points) {
        points.emplace_back(point.page_mm);
    }
    return points;
}

dvec2 direction_of(const dvec2& v)
{
    const double length = glm::length(v);
    return length > 0.0 ? v / length : dvec2(1.0, 0.0);
}

/// One side of a smooth piece, half the width away.
std::vector<dvec2> side_of(std::span<const dvec2> middle, std::span<const VectorPoint> points, double sign,
                           const dvec2* seam)
{
    std::vector<dvec2> side;
    side.reserve(middle.size());
    const size_t last = middle.size() - 1;
    for (size_t i = 0; i <= last; ++i) {
        const bool is_end = i == 0 || i == last;
        const dvec2 along = is_end && seam != nullptr
                                ? *seam
                                : direction_of(middle[std::min(i + 1, last)] - middle[i > 0 ? i - 1 : 0]);
        side.push_back(middle[i] +
                       sign * 0.5 * static_cast<double>(points[i].width_mm) * dvec2(along.y, -along.x));
    }
    return side;
}

void add_curves(PathText& path, std::span<const dvec2> side, double tolerance_mm)
{
    for (const Cubic& curve : fit_curve(side, tolerance_mm)) {
        path.curve_to(curve);
    }
}

void add_piece(PathText& path, std::span<const dvec2> middle, std::span<const VectorPoint> points,
               const dvec2* seam, double tolerance_mm)
{
    const std::vector<dvec2> left = side_of(middle, points, 1.0, seam);
    std::vector<dvec2> right = side_of(middle, points, -1.0, seam);
    std::reverse(right.begin(), right.end());
    path.move_to(left.front());
    add_curves(path, left, tolerance_mm);
    path.turn_to(right.front(), 0.5 * static_cast<double>(points.back().width_mm));
    add_curves(path, right, tolerance_mm);
    path.turn_to(left.front(), 0.5 * static_cast<double>(points.front().width_mm));
    path.close();
}

} // namespace

std::string number(double value)
{
    return decimal(std::llround(value * steps_per_mm));
}

bool has_one_width(const VectorStroke& stroke, float tolerance_mm)
{
    const auto [least, most] = std::ranges::minmax_element(stroke.points, {}, &VectorPoint::width_mm);
    return most->width_mm - least->width_mm <= 2.0F * tolerance_mm;
}

float mean_width_mm(const VectorStroke& stroke)
{
    float sum = 0.0F;
    float length = 0.0F;
    for (size_t i = 1; i < stroke.points.size(); ++i) {
        const VectorPoint& a = stroke.points[i - 1];
        const VectorPoint& b = stroke.points[i];
        const float step = glm::distance(a.page_mm, b.page_mm);
        sum += 0.5F * step * (a.width_mm + b.width_mm);
        length += step;
    }
    return length > 0.0F ? sum / length : stroke.points.front().width_mm;
}

std::string center_path(const VectorStroke& stroke, double tolerance_mm)
{
    const std::vector<dvec2> middle = middle_of(stroke);
    PathText path;
    path.move_to(middle.front());
    for (const Cubic& curve : fit_curve(middle, tolerance_mm, stroke.is_closed)) {
        path.curve_to(curve);
    }
    if (stroke.is_closed) {
        path.close();
    }
    return path.text();
}

std::string area_path(const VectorStroke& stroke, double tolerance_mm)
{
    const std::vector<dvec2> middle = middle_of(stroke);
    const std::span<const dvec2> all(middle);
    const std::span<const VectorPoint> points(stroke.points);
    const std::vector<size_t> corners = corners_of(all);
    const bool is_ring = stroke.is_closed && corners.size() == 2 && middle.size() > 3;
    const dvec2 seam = is_ring ? direction_of(middle[1] - middle[middle.size() - 2]) : dvec2(0.0);
    PathText path;
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
        const size_t count = corners[i + 1] - corners[i] + 1;
        add_piece(path, all.subspan(corners[i], count), points.subspan(corners[i], count),
                  is_ring ? &seam : nullptr, tolerance_mm);
    }
    return path.text();
}

} // namespace estampe::output
