// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lab/roofline/roofline.hpp"
#include "lab/spread_json.hpp"

namespace estampe::lab::roofline {
namespace {

std::string in_percent(std::optional<double> share)
{
    return share ? fmt::format("{:.1f}", 100.0 * *share) : std::string("-");
}

std::string row_of(const PassCost& pass, const Ceilings& ceilings)
{
    return fmt::format("{:<36} {:>9.4f} {:>6.1f} {:>9.2f} {:>8} {:>9} {:>8}\n", pass.name, pass.ms.median,
                       100.0 * pass.share, 1e-6 * static_cast<double>(pass.bytes),
                       in_percent(share_of_copy(pass, ceilings)),
                       pass.operations ? fmt::format("{:.2f}", 1e-6 * static_cast<double>(*pass.operations))
                                       : std::string("-"),
                       in_percent(share_of_arithmetic(pass, ceilings)));
}

} // namespace

std::string text_of(const Result& result)
{
    std::string text = fmt::format("{}, {}\n{}x{}, medians of {} frames, each pass by itself, {}\n"
                                   "The device copies {:.4g} GB/s (read and written together) and computes "
                                   "{:.4g} Gop/s (32-bit floats)\n",
                                   result.device, result.driver, result.width, result.height, result.frames,
                                   result.software ? "wall time" : "GPU time",
                                   1e-9 * result.ceilings.bytes_a_s, 1e-9 * result.ceilings.operations_a_s);
    for (const PictureCost& picture : result.pictures) {
        text += fmt::format("\n{}: {}, {:.3f} ms\n{:<36} {:>9} {:>6} {:>9} {:>8} {:>9} {:>8}\n", picture.name,
                            picture.about, picture.ms, "", "ms", "% time", "MB", "% copy", "Mop", "% arith");
        for (const PassCost& pass : picture.passes) {
            text += row_of(pass, result.ceilings);
        }
    }
    return text;
}

std::string json_of(const Result& result)
{
    nlohmann::ordered_json json{{"device", result.device},
                                {"driver", result.driver},
                                {"software", result.software},
                                {"width", result.width},
                                {"height", result.height},
                                {"frames", result.frames},
                                {"bytes_a_s", result.ceilings.bytes_a_s},
                                {"operations_a_s", result.ceilings.operations_a_s},
                                {"pictures", nlohmann::ordered_json::array()}};
    for (const PictureCost& picture : result.pictures) {
        nlohmann::ordered_json passes = nlohmann::ordered_json::array();
        for (const PassCost& pass : picture.passes) {
            nlohmann::ordered_json one{{"name", pass.name},
                                       {"ms", spread_json(pass.ms)},
                                       {"share", pass.share},
                                       {"bytes", pass.bytes},
                                       {"share_of_copy", share_of_copy(pass, result.ceilings)}};
            if (pass.operations) {
                one["operations"] = *pass.operations;
                one["share_of_arithmetic"] = *share_of_arithmetic(pass, result.ceilings);
            }
            passes.push_back(std::move(one));
        }
        json["pictures"].push_back({{"name", picture.name},
                                    {"about", picture.about},
                                    {"ms", picture.ms},
                                    {"passes", std::move(passes)}});
    }
    return json.dump(2) + "\n";
}

std::string csv_of(const Result& result)
{
    std::string text = "picture,pass,ms,share,bytes,share_of_copy,operations,share_of_arithmetic\n";
    for (const PictureCost& picture : result.pictures) {
        for (const PassCost& pass : picture.passes) {
            const auto arithmetic = share_of_arithmetic(pass, result.ceilings);
            text += fmt::format("{},\"{}\",{},{},{},{},{},{}\n", picture.name, pass.name, pass.ms.median,
                                pass.share, pass.bytes, share_of_copy(pass, result.ceilings),
                                pass.operations ? std::to_string(*pass.operations) : std::string(),
                                arithmetic ? fmt::format("{}", *arithmetic) : std::string());
        }
    }
    return text;
}

} // namespace estampe::lab::roofline
