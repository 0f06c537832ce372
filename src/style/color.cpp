// SPDX-License-Identifier: MIT
#include "style/color.hpp"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/srgb.hpp"

namespace estampe::style {
namespace {

double encode(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// The shortest decimal whose linear value is exactly `linear`.
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

} // namespace estampe::style
