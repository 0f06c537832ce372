// SPDX-License-Identifier: MIT
#include "lab/tables.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <estampe/error.hpp>

namespace estampe::lab {
namespace {

constexpr double bytes_a_mib = 1048576.0;
constexpr size_t techniques_told = 3;

std::string heading(const BenchResult& result)
{
    return fmt::format("{}, {}x{} where the series does not say, medians of {} frames; cost is {}\n",
                       result.device, result.width, result.height, result.frames,
                       result.software ? "wall time" : "GPU time");
}

std::string row_of(const BenchSeries& series, size_t index, bool software)
{
    const BenchPoint& point = series.points[index];
    const Spread& cost = cost_of(point, software);
    std::string dearest;
    for (size_t i = 0; i < std::min(techniques_told, point.techniques.size()); ++i) {
        dearest += fmt::format("{}{} {:.3f}", i == 0 ? "" : ", ", point.techniques[i].name,
                               point.techniques[i].gpu_ms);
    }
    const std::string grows =
        index == 0 ? std::string("-") : fmt::format("{:.2f}", growth(series, index, software));
    return fmt::format("{:>12.0f} {:>10.3f} {:>9.3f} {:>9.3f} {:>10.3f} {:>8.2f} {:>7} {:>9.1f}{}\n",
                       point.amount, cost.median, cost.low, cost.high, point.wall_ms.median, point.ratio,
                       grows, static_cast<double>(point.memory_bytes) / bytes_a_mib,
                       software ? "" : "  " + dearest);
}

Spread spread_from(const nlohmann::ordered_json& json)
{
    return {.low = json.at("low").get<double>(),
            .median = json.at("median").get<double>(),
            .high = json.at("high").get<double>()};
}

nlohmann::ordered_json json_of(const BenchPoint& point)
{
    nlohmann::ordered_json json{{"amount", point.amount},
                                {"gpu_ms", spread_json(point.gpu_ms)},
                                {"wall_ms", spread_json(point.wall_ms)},
                                {"ratio", point.ratio},
                                {"memory_bytes", point.memory_bytes},
                                {"techniques", nlohmann::ordered_json::object()}};
    for (const TechniqueCost& technique : point.techniques) {
        json["techniques"][technique.name] = technique.gpu_ms;
    }
    return json;
}

BenchPoint point_from(const nlohmann::ordered_json& json)
{
    BenchPoint point{.amount = json.at("amount").get<double>(),
                     .gpu_ms = spread_from(json.at("gpu_ms")),
                     .wall_ms = spread_from(json.at("wall_ms")),
                     .ratio = json.at("ratio").get<double>(),
                     .memory_bytes = json.at("memory_bytes").get<uint64_t>()};
    for (const auto& technique : json.at("techniques").items()) {
        point.techniques.push_back({technique.key(), technique.value().get<double>()});
    }
    return point;
}

BenchResult result_from(const nlohmann::ordered_json& json)
{
    BenchResult result{.device = json.at("device").get<std::string>(),
                       .driver = json.at("driver").get<std::string>(),
                       .software = json.at("software").get<bool>(),
                       .width = json.at("width").get<uint32_t>(),
                       .height = json.at("height").get<uint32_t>(),
                       .frames = json.at("frames").get<uint32_t>()};
    for (const auto& of_series : json.at("series")) {
        BenchSeries series{.name = of_series.at("name").get<std::string>(),
                           .work = of_series.at("work").get<std::string>()};
        for (const auto& of_point : of_series.at("points")) {
            series.points.push_back(point_from(of_point));
        }
        result.series.push_back(std::move(series));
    }
    return result;
}

/// Half of the interquartile range, as a share of the median.
double noise_of(const Spread& cost)
{
    return 0.5 * (cost.high - cost.low) / std::max(cost.median, 1e-9);
}

const BenchPoint* find(const BenchResult& result, const std::string& series, double amount)
{
    for (const BenchSeries& candidate : result.series) {
        if (candidate.name != series) {
            continue;
        }
        const auto point = std::ranges::find(candidate.points, amount, &BenchPoint::amount);
        return point == candidate.points.end() ? nullptr : &*point;
    }
    return nullptr;
}

} // namespace

std::string text_of(const BenchResult& result)
{
    std::string text = heading(result);
    for (const BenchSeries& series : result.series) {
        text += fmt::format("\n{}, by {}\n{:>12} {:>10} {:>9} {:>9} {:>10} {:>8} {:>7} {:>9}{}\n",
                            series.name, series.work, "amount", "cost ms", "from", "to", "wall ms", "ratio",
                            "grows", "MiB", result.software ? "" : "  dearest, GPU ms");
        for (size_t i = 0; i < series.points.size(); ++i) {
            text += row_of(series, i, result.software);
        }
    }
    return text +
           "\nfrom, to: quartiles. ratio: by the first row, drawn in turn. grows: power of the work that "
           "the cost grows by\nsince the row before; 1 is as the work does.\n";
}

std::string csv_of(const BenchResult& result)
{
    std::string csv =
        "series,work,amount,gpu_ms,gpu_ms_low,gpu_ms_high,wall_ms,wall_ms_low,wall_ms_high,ratio,"
        "memory_bytes\n";
    for (const BenchSeries& series : result.series) {
        for (const BenchPoint& point : series.points) {
            csv += fmt::format("{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.4f},{}\n", series.name,
                               series.work, point.amount, point.gpu_ms.median, point.gpu_ms.low,
                               point.gpu_ms.high, point.wall_ms.median, point.wall_ms.low, point.wall_ms.high,
                               point.ratio, point.memory_bytes);
        }
    }
    return csv;
}

std::string json_of(const BenchResult& result)
{
    nlohmann::ordered_json json{{"device", result.device},
                                {"driver", result.driver},
                                {"software", result.software},
                                {"width", result.width},
                                {"height", result.height},
                                {"frames", result.frames},
                                {"series", nlohmann::ordered_json::array()}};
    for (const BenchSeries& series : result.series) {
        nlohmann::ordered_json points = nlohmann::ordered_json::array();
        for (const BenchPoint& point : series.points) {
            points.push_back(json_of(point));
        }
        json["series"].push_back({{"name", series.name}, {"work", series.work}, {"points", points}});
    }
    return json.dump(2) + "\n";
}

BenchResult read_bench_json(const std::string& path)
{
    std::ifstream file(path);
    if (!file) {
        throw Error("cannot be read", path, "write one with estampe_lab --json");
    }
    try {
        return result_from(nlohmann::ordered_json::parse(file));
    } catch (const nlohmann::json::exception& problem) {
        throw Error("is no result of estampe_lab --json", path, problem.what());
    }
}

std::string comparison_of(const BenchResult& before, const BenchResult& after)
{
    std::string text = fmt::format("before: {}, {}x{}, {} frames\nafter:  {}, {}x{}, {} frames\n",
                                   before.device, before.width, before.height, before.frames, after.device,
                                   after.width, after.height, after.frames);
    if (before.device != after.device || before.width != after.width || before.height != after.height) {
        text += "these differ in more than the program\n";
    }
    text += fmt::format("\n{:<12} {:>12} {:>11} {:>11} {:>8} {:>8}\n", "series", "amount", "before ms",
                        "after ms", "ratio", "noise");
    bool has_any = false;
    for (const BenchSeries& series : after.series) {
        for (const BenchPoint& point : series.points) {
            const BenchPoint* const was = find(before, series.name, point.amount);
            if (was == nullptr) {
                continue;
            }
            has_any = true;
            const Spread& old_cost = cost_of(*was, before.software);
            const Spread& new_cost = cost_of(point, after.software);
            const double ratio = new_cost.median / std::max(old_cost.median, 1e-9);
            const double noise = std::hypot(noise_of(old_cost), noise_of(new_cost));
            const char* const verdict = std::abs(ratio - 1.0) <= noise ? ""
                                        : ratio > 1.0                  ? "  slower"
                                                                       : "  faster";
            text += fmt::format("{:<12} {:>12.0f} {:>11.3f} {:>11.3f} {:>8.3f} {:>8.3f}{}\n", series.name,
                                point.amount, old_cost.median, new_cost.median, ratio, noise, verdict);
        }
    }
    if (!has_any) {
        throw Error("the two results have no amount of work in common", "--compare");
    }
    return text;
}

namespace {

constexpr double plot_width = 480.0;
constexpr double plot_height = 320.0;
constexpr double plot_margin = 56.0;

/// A logarithmic axis of whole powers of ten.
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
