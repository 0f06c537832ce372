// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "lab/tables.hpp"

namespace estampe::lab {
namespace {

constexpr double plot_width = 480.0;
constexpr double plot_height = 320.0;
constexpr double plot_margin = 56.0;

/// A logarithmic axis of whole decades.
class Axis {
public:
    Axis(double least, double most, double from_px, double to_px)
        : low_(std::floor(std::log10(least))), high_(std::max(std::ceil(std::log10(most)), low_ + 1.0)),
          from_px_(from_px), to_px_(to_px)
    {
    }

    [[nodiscard]] double at(double value) const
    {
        return from_px_ + (to_px_ - from_px_) * (std::log10(value) - low_) / (high_ - low_);
    }

    [[nodiscard]] std::vector<double> decades() const
    {
        std::vector<double> values;
        for (double power = low_; power <= high_ + 0.5; power += 1.0) {
            values.push_back(std::pow(10.0, power));
        }
        return values;
    }

private:
    double low_, high_, from_px_, to_px_;
};

std::string text(double x, double y, const char* anchor, const std::string& words)
{
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}

} // namespace

std::string plot_of(const BenchSeries& series, const BenchResult& result)
{
    const auto cost = [&](const BenchPoint& point) -> const Spread& {
        return cost_of(point, result.software);
    };
    double least_ms = 1e9;
    double most_ms = 1e-6;
    for (const BenchPoint& point : series.points) {
        least_ms = std::clamp(cost(point).low, 1e-6, least_ms);
        most_ms = std::max(most_ms, cost(point).high);
    }
    const Axis across(series.points.front().amount, series.points.back().amount, plot_margin,
                      plot_width - 20.0);
    const Axis up(least_ms, most_ms, plot_height - plot_margin, 40.0);
    std::string svg = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                                  "font-family=\"sans-serif\" font-size=\"11\">\n"
                                  "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                                  plot_width, plot_height);
    for (const double decade : across.decades()) {
        svg += fmt::format("<path d=\"M{:.1f} {} V{}\" stroke=\"#ddd\"/>\n", across.at(decade),
                           plot_height - plot_margin, 40.0);
        svg +=
            text(across.at(decade), plot_height - plot_margin + 16.0, "middle", fmt::format("{:g}", decade));
    }
    for (const double decade : up.decades()) {
        svg += fmt::format("<path d=\"M{} {:.1f} H{}\" stroke=\"#ddd\"/>\n", plot_margin, up.at(decade),
                           plot_width - 20.0);
        svg += text(plot_margin - 6.0, up.at(decade) + 4.0, "end", fmt::format("{:g}", decade));
    }
    const BenchPoint& last = series.points.back();
    const BenchPoint& first = series.points.front();
    const double in_step_ms = cost(last).median * first.amount / last.amount;
    svg += fmt::format(
        "<clipPath id=\"field\"><rect x=\"{0}\" y=\"40\" width=\"{1}\" height=\"{2}\"/></clipPath>\n"
        "<path clip-path=\"url(#field)\" d=\"M{3:.1f} {4:.1f} L{5:.1f} {6:.1f}\" stroke=\"#999\" "
        "stroke-dasharray=\"4 4\"/>\n",
        plot_margin, plot_width - 20.0 - plot_margin, plot_height - plot_margin - 40.0,
        across.at(first.amount), up.at(in_step_ms), across.at(last.amount), up.at(cost(last).median));
    std::string line;
    for (size_t i = 0; i < series.points.size(); ++i) {
        const BenchPoint& point = series.points[i];
        const double x = across.at(point.amount);
        const double y = up.at(cost(point).median);
        line += fmt::format("{:.1f},{:.1f} ", x, y);
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f} V{2:.1f}\" stroke=\"#1b1a22\"/>\n", x,
                           up.at(std::max(cost(point).low, 1e-6)), up.at(cost(point).high));
        if (i > 0) {
            svg += text(x - 4.0, y - 6.0, "end", fmt::format("{:.2f}", growth(series, i, result.software)));
        }
    }
    svg +=
        fmt::format("<polyline fill=\"none\" stroke=\"#1b1a22\" stroke-width=\"2\" points=\"{}\"/>\n", line);
    svg += text(0.5 * plot_width, plot_height - 14.0, "middle", series.work);
    svg += text(plot_margin, 18.0, "start",
                fmt::format("{}: {} of a frame in ms, {}", series.name,
                            result.software ? "wall time" : "GPU time", result.device));
    svg += text(plot_margin, 32.0, "start",
                "numbers: power of the work that it grows by; dashes: as the work does");
    return svg + "</svg>\n";
}

} // namespace estampe::lab
