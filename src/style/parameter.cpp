// SPDX-License-Identifier: MIT
#include "style/parameter.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fnmatch.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/error.hpp>

#include "core/color.hpp"
#include "style/names.hpp"
#include "style/toml.hpp"

namespace estampe::style {
namespace {

double encode(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// Returns the shortest sRGB decimal number that decodes to exactly `linear`.
std::string shortest_srgb(float linear)
{
    const double encoded = encode(linear);
    for (int digits = 1; digits < 17; ++digits) {
        std::string text = fmt::format("{:.{}g}", encoded, digits);
        if (static_cast<float>(estampe::linear_from_srgb(std::stod(text))) == linear) {
            return text;
        }
    }
    return fmt::format("{:.17g}", encoded);
}

} // namespace

glm::vec3 linear_from_srgb(const glm::dvec3& srgb)
{
    return {static_cast<float>(estampe::linear_from_srgb(srgb.x)),
            static_cast<float>(estampe::linear_from_srgb(srgb.y)),
            static_cast<float>(estampe::linear_from_srgb(srgb.z))};
}

glm::dvec3 srgb_from_linear(const glm::vec3& linear)
{
    return {encode(linear.x), encode(linear.y), encode(linear.z)};
}

glm::vec3 srgb(uint32_t rrggbb)
{
    const auto channel = [rrggbb](int shift) {
        return static_cast<double>((rrggbb >> shift) & 0xFFU) / 255.0;
    };
    return linear_from_srgb({channel(16), channel(8), channel(0)});
}

namespace {

/// Parses "#rrggbb" or "#rgb" in sRGB to a linear colour; returns nothing for any other text.
std::optional<glm::vec3> parse_color(std::string_view text)
{
    if ((text.size() != 7 && text.size() != 4) || text.front() != '#') {
        return std::nullopt;
    }
    std::string digits(text.substr(1));
    if (digits.size() == 3) {
        digits = {digits[0], digits[0], digits[1], digits[1], digits[2], digits[2]};
    }
    uint32_t rrggbb = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, problem] = std::from_chars(digits.data(), end, rrggbb, 16);
    if (problem != std::errc{} || stop != end) {
        return std::nullopt;
    }
    return srgb(rrggbb);
}

} // namespace

std::string format_color(const glm::vec3& linear)
{
    const glm::dvec3 bytes = glm::round(glm::clamp(srgb_from_linear(linear), 0.0, 1.0) * 255.0);
    std::string hex = fmt::format("#{:02x}{:02x}{:02x}", static_cast<int>(bytes.x), static_cast<int>(bytes.y),
                                  static_cast<int>(bytes.z));
    if (parse_color(hex) == linear) {
        return '"' + hex + '"';
    }
    return fmt::format("[{}, {}, {}]", shortest_srgb(linear.x), shortest_srgb(linear.y),
                       shortest_srgb(linear.z));
}

bool matches(const std::string& pattern, const std::string& name)
{
    return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

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
            if (std::ranges::find(parameter_.choices, *text) != parameter_.choices.end()) {
                return *text;
            }
            if (const auto linear = text->starts_with('#') ? parse_color(*text) : named_color(*text)) {
                return *linear;
            }
            if (const std::string meant = nearest_color_name(*text); !meant.empty()) {
                fail("is not a colour", fmt::format("did you mean {}? ", in_quotes(meant)));
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
        if (const auto* toggle = std::get_if<bool>(&raw_.value)) {
            const std::string word = *toggle ? "true" : "false";
            if (std::ranges::find(parameter_.choices, word) != parameter_.choices.end()) {
                return word;
            }
        }
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

    /// Returns the value of a file parameter: a path, or one of the names if the parameter has names. If the
    /// parameter has names, a text without a dot and without a slash is treated as a name, not as a path.
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
        return fmt::format("{}\"#rrggbb\", a name of CSS such as \"ivory\", or [r, g, b] of 0 to 1",
                           parameter.choices.empty() ? "" : "\"auto\", ");
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
        return fmt::format("{}", *number + 0.0F); // adding zero turns a negative zero into a positive one
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
        const auto byte = static_cast<unsigned char>(character);
        if (byte < 0x20 || byte == 0x7F) {
            escaped += fmt::format("\\u{:04x}", byte);
            continue;
        }
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
