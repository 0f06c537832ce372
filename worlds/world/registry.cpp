// SPDX-License-Identifier: MIT
#include "registry.hpp"

#include <algorithm>
#include <charconv>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

namespace worlds {
namespace {

/// Parses the whole of `text` as a number; returns nothing if it is not a number or does not fit the type.
template <typename Number>
std::optional<Number> parsed(const std::string& text)
{
    Number number{};
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    return problem == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

/// Parses `text` as a number within `range`. Throws Error for any other text, also for a number that is not
/// finite.
template <typename Number, typename Range>
Number number_within(const std::string& key, const std::string& text, const Range& range, const char* kind)
{
    const std::optional<Number> number = parsed<Number>(text);
    if (!number) {
        throw estampe::Error(fmt::format("\"{}\" is not {}", text, kind), key + "=" + text,
                             fmt::format("allowed: {} to {}", range.least, range.most));
    }
    if (!(*number >= range.least && *number <= range.most)) {
        throw estampe::Error(fmt::format("{} is out of range", text), key + "=" + text,
                             fmt::format("allowed: {} to {}", range.least, range.most));
    }
    return *number;
}

} // namespace

std::string Option::syntax() const
{
    if (const auto* const words = std::get_if<Words>(&allowed)) {
        return fmt::format("{}={}", key, fmt::join(*words, "|"));
    }
    if (const auto* const range = std::get_if<NumberRange>(&allowed)) {
        return fmt::format("{}={}..{}", key, range->least, range->most);
    }
    const auto& range = std::get<WholeRange>(allowed);
    return range.most == WholeRange{}.most ? key + "=N"
                                           : fmt::format("{}={}..{}", key, range.least, range.most);
}

std::string keys_of(std::span<const Option> options)
{
    std::vector<std::string> keys;
    std::ranges::transform(options, std::back_inserter(keys), &Option::key);
    return fmt::format("{}", fmt::join(keys, ", "));
}

Values::Values(std::span<const Option> options, std::span<const std::string> assignments)
{
    const std::string remedy = options.empty() ? "it has no options" : "its options: " + keys_of(options);
    for (const Option& option : options) {
        entries_.push_back({option.key, option.initial.empty() ? Value() : parse(option, option.initial),
                            option.changes_scene});
    }
    for (const std::string& assignment : assignments) {
        const size_t sign = assignment.find('=');
        if (sign == std::string::npos || sign == 0 || sign + 1 == assignment.size()) {
            throw estampe::Error(fmt::format("\"{}\" is not of the form KEY=VALUE", assignment), {}, remedy);
        }
        const std::string key = assignment.substr(0, sign);
        const auto option = std::ranges::find(options, key, &Option::key);
        if (option == options.end()) {
            throw estampe::Error(fmt::format("the world has no option \"{}\"", key), {}, remedy);
        }
        entries_.at(static_cast<size_t>(option - options.begin())).value =
            parse(*option, assignment.substr(sign + 1));
    }
}

Values::Value Values::parse(const Option& option, const std::string& text)
{
    if (const auto* const range = std::get_if<WholeRange>(&option.allowed)) {
        return number_within<uint64_t>(option.key, text, *range, "a whole number");
    }
    if (const auto* const range = std::get_if<NumberRange>(&option.allowed)) {
        return number_within<double>(option.key, text, *range, "a number");
    }
    const auto& words = std::get<Words>(option.allowed);
    if (std::ranges::find(words, text) == words.end()) {
        throw estampe::Error(fmt::format("there is no {} \"{}\"", option.key, text), {},
                             fmt::format("allowed: {}", fmt::join(words, ", ")));
    }
    return text;
}

const Values::Value& Values::at(std::string_view key) const
{
    const auto entry = std::ranges::find(entries_, key, &Entry::key);
    if (entry == entries_.end()) {
        throw std::logic_error(fmt::format("the world has not declared the option \"{}\"", key));
    }
    return entry->value;
}

std::optional<uint64_t> Values::whole(std::string_view key) const
{
    const auto* const value = std::get_if<uint64_t>(&at(key));
    return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::optional<double> Values::number(std::string_view key) const
{
    const auto* const value = std::get_if<double>(&at(key));
    return value != nullptr ? std::optional(*value) : std::nullopt;
}

std::optional<std::string> Values::word(std::string_view key) const
{
    const auto* const value = std::get_if<std::string>(&at(key));
    return value != nullptr ? std::optional(*value) : std::nullopt;
}

bool Values::make_same_scene(const Values& other) const
{
    return std::ranges::equal(entries_, other.entries_, [](const Entry& a, const Entry& b) {
        return a.key == b.key && (!a.changes_scene || a.value == b.value);
    });
}

namespace {

bool is_simple_name(std::string_view name)
{
    const auto is_allowed = [](char letter) {
        return (letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9') || letter == '-';
    };
    return !name.empty() && name.front() != '-' && std::ranges::all_of(name, is_allowed);
}

} // namespace

void Registry::add(Description description)
{
    if (!is_simple_name(description.name)) {
        throw estampe::Error(fmt::format("a world cannot be named \"{}\"", description.name), {},
                             "use lower-case letters, digits and hyphens");
    }
    if (find(description.name) != nullptr) {
        throw estampe::Error("there are two worlds of this name", description.name);
    }
    if (!description.make) {
        throw estampe::Error("the world has no function that makes it", description.name);
    }
    std::set<std::string> keys;
    for (const Option& option : description.options) {
        if (!is_simple_name(option.key) || !keys.insert(option.key).second) {
            throw estampe::Error(
                fmt::format("the option \"{}\" is there twice, or cannot have this key", option.key),
                description.name, "use lower-case letters, digits and hyphens");
        }
    }
    // Throws Error for an initial value that is not allowed.
    static_cast<void>(Values(description.options, {}));
    all_.push_back(std::move(description));
}

const Description* Registry::find(std::string_view name) const
{
    const auto found = std::ranges::find(all_, name, &Description::name);
    return found != all_.end() ? &*found : nullptr;
}

} // namespace worlds
