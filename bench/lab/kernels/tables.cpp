// SPDX-License-Identifier: MIT
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lab/kernels/kernels.hpp"
#include "lab/spread_json.hpp"

namespace estampe::lab::kernels {
namespace {

size_t widest_name(const KernelsResult& result)
{
    size_t widest = 0;
    for (const ExperimentResult& experiment : result.experiments) {
        for (const KernelResult& kernel : experiment.kernels) {
            widest = std::max(widest, kernel.name.size());
        }
    }
    return widest;
}

} // namespace

std::string text_of(const KernelsResult& result)
{
    const size_t width = widest_name(result);
    std::string text = fmt::format(
        "{}, {}\n{} of {} rounds in turn: median, and quartiles of the ratio to the row that has none\n",
        result.device, result.driver, result.software ? "Processor time" : "GPU time", result.rounds);
    for (const ExperimentResult& experiment : result.experiments) {
        text += fmt::format("\n{}: {}\n{:<{}} {:>9} {:>7} {:>7} {:>7}\n", experiment.name, experiment.about,
                            "", width, "ms", "ratio", "low", "high");
        for (const KernelResult& kernel : experiment.kernels) {
            text += fmt::format("{:<{}} {:>9.3f}", kernel.name, width, kernel.ms.median);
            text += kernel.name == kernel.against
                        ? std::string("\n")
                        : fmt::format(" {:>7.2f} {:>7.2f} {:>7.2f}\n", kernel.ratio.median, kernel.ratio.low,
                                      kernel.ratio.high);
        }
    }
    return text;
}

std::string json_of(const KernelsResult& result)
{
    nlohmann::ordered_json json{{"device", result.device},
                                {"driver", result.driver},
                                {"software", result.software},
                                {"rounds", result.rounds},
                                {"experiments", nlohmann::ordered_json::array()}};
    for (const ExperimentResult& experiment : result.experiments) {
        nlohmann::ordered_json kernels = nlohmann::ordered_json::array();
        for (const KernelResult& kernel : experiment.kernels) {
            kernels.push_back({{"name", kernel.name},
                               {"against", kernel.against},
                               {"ms", spread_json(kernel.ms)},
                               {"ratio", spread_json(kernel.ratio)}});
        }
        json["experiments"].push_back(
            {{"name", experiment.name}, {"about", experiment.about}, {"kernels", std::move(kernels)}});
    }
    return json.dump(2) + "\n";
}

std::string csv_of(const KernelsResult& result)
{
    std::string text = "experiment,kernel,against,ms,ms_low,ms_high,ratio,ratio_low,ratio_high\n";
    for (const ExperimentResult& experiment : result.experiments) {
        for (const KernelResult& kernel : experiment.kernels) {
            text += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{},{}\n", experiment.name, kernel.name,
                                kernel.against, kernel.ms.median, kernel.ms.low, kernel.ms.high,
                                kernel.ratio.median, kernel.ratio.low, kernel.ratio.high);
        }
    }
    return text;
}

} // namespace estampe::lab::kernels
