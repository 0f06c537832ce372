// SPDX-License-Identifier: MIT
#include "lab/tables.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lab/spread_json.hpp"

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

/// Half of what lies between the quartiles, as a share of the median.
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

} // namespace estampe::lab
