// SPDX-License-Identifier: MIT
#include "output/stroke_path.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace estampe::output {
namespace {

using glm::dvec2;

constexpr double corner_cosine = 0.643; // Cosine of the smallest turn that counts as a corner, 50 degrees
constexpr int most_improvements = 8;

dvec2 unit(const dvec2& v)
{
    const double length = glm::length(v);
    return length > 0.0 ? v / length : dvec2(0.0);
}

dvec2 derivative(const Cubic& c, double t)
{
    const double s = 1.0 - t;
    return 3.0 * s * s * (c[1] - c[0]) + 6.0 * s * t * (c[2] - c[1]) + 3.0 * t * t * (c[3] - c[2]);
}

dvec2 second_derivative(const Cubic& c, double t)
{
    return 6.0 * (1.0 - t) * (c[2] - 2.0 * c[1] + c[0]) + 6.0 * t * (c[3] - 2.0 * c[2] + c[1]);
}

double length_of(std::span<const dvec2> points)
{
    double sum = 0.0;
    for (size_t i = 1; i < points.size(); ++i) {
        sum += glm::distance(points[i - 1], points[i]);
    }
    return sum;
}

std::vector<double> chord_lengths(std::span<const dvec2> points)
{
    std::vector<double> at(points.size(), 0.0);
    for (size_t i = 1; i < points.size(); ++i) {
        at[i] = at[i - 1] + glm::distance(points[i - 1], points[i]);
    }
    for (double& value : at) {
        value /= at.back();
    }
    return at;
}

/// Fits one cubic curve to the points by least squares, with the given end tangents.
Cubic nearest_cubic(std::span<const dvec2> points, std::span<const double> at, const dvec2& leaving,
                    const dvec2& arriving)
{
    const dvec2 first = points.front();
    const dvec2 last = points.back();
    double c00 = 0.0;
    double c01 = 0.0;
    double c11 = 0.0;
    double x0 = 0.0;
    double x1 = 0.0;
    for (size_t i = 0; i < points.size(); ++i) {
        const double t = at[i];
        const double s = 1.0 - t;
        const dvec2 a0 = leaving * (3.0 * s * s * t);
        const dvec2 a1 = arriving * (3.0 * s * t * t);
        const dvec2 rest = points[i] - (first * (s * s * (s + 3.0 * t)) + last * (t * t * (t + 3.0 * s)));
        c00 += glm::dot(a0, a0);
        c01 += glm::dot(a0, a1);
        c11 += glm::dot(a1, a1);
        x0 += glm::dot(a0, rest);
        x1 += glm::dot(a1, rest);
    }
    const double determinant = c00 * c11 - c01 * c01;
    const double chord = glm::distance(first, last);
    double reach_0 = 0.0;
    double reach_1 = 0.0;
    if (std::abs(determinant) > 1e-12 * c00 * c11) {
        reach_0 = (x0 * c11 - x1 * c01) / determinant;
        reach_1 = (c00 * x1 - c01 * x0) / determinant;
    }
    // Limits the curve's handles: handles longer than the whole line would move the curve far away from the
    // points.
    const double longest = length_of(points);
    if (reach_0 < 1e-3 * chord || reach_1 < 1e-3 * chord || reach_0 > longest || reach_1 > longest) {
        reach_0 = chord / 3.0;
        reach_1 = reach_0;
    }
    return {first, first + leaving * reach_0, last + arriving * reach_1, last};
}

/// Moves each curve parameter towards the curve's point nearest to its data point, by one Newton step.
void improve(std::span<const dvec2> points, const Cubic& curve, std::vector<double>& at)
{
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        const dvec2 off = point_on(curve, at[i]) - points[i];
        const dvec2 speed = derivative(curve, at[i]);
        const double slope = glm::dot(speed, speed) + glm::dot(off, second_derivative(curve, at[i]));
        if (slope > 0.0) {
            at[i] = std::clamp(at[i] - glm::dot(off, speed) / slope, 0.0, 1.0);
        }
    }
}

struct Worst {
    size_t index = 0;
    double distance = 0.0;
};

Worst worst_of(std::span<const dvec2> points, const Cubic& curve, std::span<const double> at)
{
    Worst worst{points.size() / 2, 0.0};
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        const double distance = glm::distance(points[i], point_on(curve, at[i]));
        if (distance > worst.distance) {
            worst = {i, distance};
        }
    }
    return worst;
}

/// A part of a line: the points from `first` to `last`, and a tangent at each end. Each tangent points
/// towards the opposite end.
struct Span {
    size_t first = 0;
    size_t last = 0;
    dvec2 leaving{0.0};
    dvec2 arriving{0.0};
};

dvec2 direction_at(std::span<const dvec2> points, size_t i)
{
    return unit(points[i + 1] - points[i - 1]);
}

/// Fits one cubic curve to the points of `span`. If the curve deviates too much, sets `middle` to the point
/// where the span must be divided.
bool fit_span(std::span<const dvec2> points, const Span& span, double tolerance, Cubic& curve, size_t& middle)
{
    const auto part = points.subspan(span.first, span.last - span.first + 1);
    if (part.size() == 2) {
        const double third = glm::distance(part[0], part[1]) / 3.0;
        curve = {part[0], part[0] + span.leaving * third, part[1] + span.arriving * third, part[1]};
        return true;
    }
    std::vector<double> at = chord_lengths(part);
    Worst worst;
    for (int i = 0; i <= most_improvements; ++i) {
        curve = nearest_cubic(part, at, span.leaving, span.arriving);
        worst = worst_of(part, curve, at);
        if (worst.distance <= tolerance) {
            return true;
        }
        if (worst.distance > 16.0 * tolerance) {
            break;
        }
        improve(part, curve, at);
    }
    middle = span.first + std::clamp<size_t>(worst.index, 1, part.size() - 2);
    return false;
}

void fit_smooth(std::span<const dvec2> points, Span whole, double tolerance, std::vector<Cubic>& curves)
{
    std::vector<Span> open{whole};
    while (!open.empty()) {
        const Span span = open.back();
        open.pop_back();
        Cubic curve;
        size_t middle = 0;
        if (fit_span(points, span, tolerance, curve, middle)) {
            curves.push_back(curve);
            continue;
        }
        const dvec2 direction = direction_at(points, middle);
        open.push_back({middle, span.last, direction, span.arriving});
        open.push_back({span.first, middle, span.leaving, -direction});
    }
}

} // namespace

dvec2 point_on(const Cubic& c, double t)
{
    const double s = 1.0 - t;
    return s * s * s * c[0] + 3.0 * s * s * t * c[1] + 3.0 * s * t * t * c[2] + t * t * t * c[3];
}

std::vector<size_t> corners_of(std::span<const dvec2> points)
{
    std::vector<size_t> corners{0};
    for (size_t i = 1; i + 1 < points.size(); ++i) {
        if (glm::dot(unit(points[i] - points[i - 1]), unit(points[i + 1] - points[i])) < corner_cosine) {
            corners.push_back(i);
        }
    }
    corners.push_back(points.size() - 1);
    return corners;
}

std::vector<Cubic> fit_curve(std::span<const dvec2> points, double tolerance, bool is_closed)
{
    std::vector<dvec2> apart;
    apart.reserve(points.size());
    for (const dvec2& point : points) {
        if (apart.empty() || glm::distance(apart.back(), point) > 1e-6) {
            apart.push_back(point);
        }
    }
    std::vector<Cubic> curves;
    if (apart.size() < 2) {
        return curves;
    }
    const std::vector<size_t> corners = corners_of(apart);
    const size_t end = apart.size() - 1;
    const dvec2 seam = unit(apart[1] - apart[end - 1]);
    const bool is_smooth_seam =
        is_closed && end > 2 &&
        glm::dot(unit(apart[1] - apart[0]), unit(apart[end] - apart[end - 1])) >= corner_cosine;
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
        Span span{corners[i], corners[i + 1], {}, {}};
        span.leaving =
            is_smooth_seam && span.first == 0 ? seam : unit(apart[span.first + 1] - apart[span.first]);
        span.arriving =
            is_smooth_seam && span.last == end ? -seam : unit(apart[span.last - 1] - apart[span.last]);
        fit_smooth(apart, span, tolerance, curves);
    }
    return curves;
}

namespace {

using Grid = glm::i64vec2; // A point on the page, in integer thousandths of a millimetre

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

/// Builds path data in relative coordinates, which are short. Integers avoid accumulated rounding errors.
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

    /// Adds a half circle to `point`, clockwise on the page.
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

/// Points along one side of a smooth part of a stroke, at half the stroke's width from the centre line.
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
