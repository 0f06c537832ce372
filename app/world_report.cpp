// SPDX-License-Identifier: MIT
#include "world_report.hpp"

#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace estampe::app {
namespace {

using Json = nlohmann::ordered_json;

std::string option_text(const worlds::Option& option)
{
    const std::string& otherwise = option.initial.empty() ? option.without : option.initial;
    return fmt::format("{}: {} [{}]", option.syntax(), option.meaning, otherwise);
}

Json option_json(const worlds::Option& option)
{
    Json json{{"key", option.key},
              {"meaning", option.meaning},
              {"initial", option.initial.empty() ? Json() : Json(option.initial)}};
    if (const auto* const words = std::get_if<worlds::Words>(&option.allowed)) {
        json["words"] = *words;
    } else if (const auto* const numbers = std::get_if<worlds::NumberRange>(&option.allowed)) {
        json["least"] = numbers->least;
        json["most"] = numbers->most;
    } else {
        json["least"] = std::get<worlds::WholeRange>(option.allowed).least;
        json["most"] = std::get<worlds::WholeRange>(option.allowed).most;
    }
    return json;
}

} // namespace

std::vector<std::pair<std::string, std::string>> world_rows(const worlds::Description& world)
{
    std::vector<std::pair<std::string, std::string>> rows{{"world", world.summary}};
    if (!world.styles.empty()) {
        rows.emplace_back("styles", fmt::format("{}", fmt::join(world.styles, ", ")));
    }
    if (world.film_s) {
        rows.emplace_back("film",
                          fmt::format("{:g} s along a camera path of its own, with --film", *world.film_s));
    }
    for (const worlds::Option& option : world.options) {
        rows.emplace_back("--world", option_text(option));
    }
    return rows;
}

Json world_json(const worlds::Description& world)
{
    Json json{{"name", world.name},
              {"summary", world.summary},
              {"styles", world.styles},
              {"film_s", world.film_s ? Json(*world.film_s) : Json()},
              {"options", Json::array()}};
    for (const worlds::Option& option : world.options) {
        json["options"].push_back(option_json(option));
    }
    return json;
}

std::string report_worlds(bool json)
{
    if (json) {
        Json list = Json::array();
        for (const worlds::Description& world : worlds::registry().all()) {
            list.push_back(world_json(world));
        }
        return list.dump(2) + "\n";
    }
    std::string text;
    for (const worlds::Description& world : worlds::registry().all()) {
        text += world.name + "\n";
        for (const auto& [label, words] : world_rows(world)) {
            text += fmt::format("  {:<18} {}\n", label, words);
        }
    }
    return text;
}

std::string world_examples()
{
    std::string lines;
    for (const worlds::Description& world : worlds::registry().all()) {
        for (const std::string& example : world.examples) {
            lines += fmt::format("  {}\n", example);
        }
    }
    return lines;
}

} // namespace estampe::app
