// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <estampe/error.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "style/raw.hpp"
#include "style/suggest.hpp"

namespace estampe::style {
namespace {

class Checker {
public:
    Checker(const Parameter& parameter, const std::string& name, const Raw& raw, const std::string& where)
        : parameter_(parameter), name_(name), raw_(raw), where_(where)
    {
    }

    [[nodiscard]] Value number() const
    {
        double value = 0.0;
        if (const auto* whole = std::get_if<int64_t>(&raw_.value)) {
            value = static_cast<double>(*whole);
        } else if (const auto* real = std::get_if<double>(&raw_.value)) {
            value = *real;
        } else {
            fail("is not a number");
        }
        const auto rounded = static_cast<float>(value);
        if (!std::isfinite(value)) {
            fail("is not a finite number");
        }
        if (rounded < parameter_.range.minimum || rounded > parameter_.range.maximum) {
            fail("is out of range");
        }
        return rounded;
    }

    [[nodiscard]] Value integer() const
    {
        const auto* value = std::get_if<int64_t>(&raw_.value);
        if (value == nullptr) {
            fail("is not a whole number");
        }
        if (*value < parameter_.integers.minimum || *value > parameter_.integers.maximum) {
            fail("is out of range");
        }
        return *value;
    }

    [[nodiscard]] Value toggle() const
    {
        const auto* value = std::get_if<bool>(&raw_.value);
        if (value == nullptr) {
            fail("is neither true nor false");
        }
        return *value;
    }

    [[nodiscard]] Value color() const
    {
        if (const auto* text = std::get_if<std::string>(&raw_.value)) {
            if (const auto linear = parse_color(*text)) {
                return *linear;
            }
        }
        const auto* parts = std::get_if<std::vector<double>>(&raw_.value);
        const auto in_range = [](double part) { return part >= 0.0 && part <= 1.0; };
        if (parts == nullptr || parts->size() != 3 || !std::all_of(parts->begin(), parts->end(), in_range)) {
            fail("is not a colour");
        }
        return linear_from_srgb({(*parts)[0], (*parts)[1], (*parts)[2]});
    }

    [[nodiscard]] Value choice() const
    {
        const auto* text = std::get_if<std::string>(&raw_.value);
        if (text == nullptr) {
            fail("is not a name in quotes");
        }
        if (std::find(parameter_.choices.begin(), parameter_.choices.end(), *text) ==
            parameter_.choices.end()) {
            const std::string meant = nearest(*text, parameter_.choices);
            fail("is not one of its choices",
                 meant.empty() ? "" : fmt::format("did you mean {}? ", in_quotes(meant)));
        }
        return *text;
    }

    [[nodiscard]] Value text() const
    {
        const auto* text = std::get_if<std::string>(&raw_.value);
        if (text == nullptr) {
            fail("is not a text in quotes");
        }
        if (std::any_of(text->begin(), text->end(),
                        [](unsigned char character) { return character < 0x20 || character == 0x7F; })) {
            fail("holds characters that cannot be shown");
        }
        return *text;
    }

    /// A path, or where names may stand for one, one of those; what has neither a dot nor a slash is no path
    /// then.
    [[nodiscard]] Value file() const
    {
        Value value = text();
        const auto& path = std::get<std::string>(value);
        const auto& names = parameter_.choices;
        if (!names.empty() && !path.empty() && path.find_first_of("./") == std::string::npos &&
            std::find(names.begin(), names.end(), path) == names.end()) {
            const std::string meant = nearest(path, names);
            fail("is neither one of the names nor a file",
                 meant.empty() ? "" : fmt::format("did you mean {}? ", in_quotes(meant)));
        }
        return value;
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& suggestion = {}) const
    {
        throw Error(fmt::format("{} = {} {}", name_, raw_.shown, what), where_,
                    fmt::format("{}allowed: {}", suggestion, allowed(parameter_)));
    }

    const Parameter& parameter_;
    const std::string& name_;
    const Raw& raw_;
    const std::string& where_;
};

} // namespace

Value check(const Parameter& parameter, const std::string& name, const Raw& raw, const std::string& where)
{
    const Checker checker(parameter, name, raw, where);
    switch (parameter.kind) {
    case Kind::number:
        return checker.number();
    case Kind::integer:
        return checker.integer();
    case Kind::toggle:
        return checker.toggle();
    case Kind::color:
        return checker.color();
    case Kind::text:
        return checker.text();
    case Kind::file:
        return checker.file();
    case Kind::choice:
        break;
    }
    return checker.choice();
}

std::string allowed(const Parameter& parameter)
{
    const std::string unit = parameter.unit.empty() ? "" : " " + parameter.unit;
    switch (parameter.kind) {
    case Kind::number:
        return fmt::format("{} to {}{}", parameter.range.minimum, parameter.range.maximum, unit);
    case Kind::integer:
        return fmt::format("{} to {}{}", parameter.integers.minimum, parameter.integers.maximum, unit);
    case Kind::toggle:
        return "true or false";
    case Kind::color:
        return "\"#rrggbb\", or [r, g, b] of 0 to 1";
    case Kind::text:
        return "a text in quotes";
    case Kind::file:
        return parameter.choices.empty()
                   ? "the path of a file, in quotes"
                   : fmt::format("{}, or the path of a file, in quotes", fmt::join(parameter.choices, ", "));
    case Kind::choice:
        break;
    }
    return fmt::format("{}", fmt::join(parameter.choices, ", "));
}

std::string format_value(const Value& value)
{
    if (const auto* number = std::get_if<float>(&value)) {
        return fmt::format("{}", *number);
    }
    if (const auto* integer = std::get_if<int64_t>(&value)) {
        return fmt::format("{}", *integer);
    }
    if (const auto* toggle = std::get_if<bool>(&value)) {
        return *toggle ? "true" : "false";
    }
    if (const auto* color = std::get_if<glm::vec3>(&value)) {
        return format_color(*color);
    }
    std::string escaped;
    for (const char character : std::get<std::string>(value)) {
        escaped += character == '"' || character == '\\' ? "\\" : "";
        escaped += character;
    }
    return '"' + escaped + '"';
}

std::string in_quotes(std::string_view text)
{
    constexpr size_t longest = 60;
    std::string result = "\"";
    for (const char character : text.substr(0, longest)) {
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x20 || byte == 0x7F) {
            result += fmt::format("\\x{:02x}", byte);
        } else {
            result += character;
        }
    }
    return result + (text.size() > longest ? "...\"" : "\"");
}

} // namespace estampe::style
