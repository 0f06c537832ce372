// SPDX-License-Identifier: MIT
#include "scene/camera_words.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include <estampe/error.hpp>

namespace estampe {

CameraWords::CameraWords(const std::string& text, const char* form,
                         std::initializer_list<std::string_view> keys,
                         std::initializer_list<std::string_view> lone)
    : text_(text), form_(form)
{
    const auto is_among = [](std::string_view word, std::initializer_list<std::string_view> list) {
        return std::find(list.begin(), list.end(), word) != list.end();
    };
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const size_t equals = word.find('=');
        const std::string key = word.substr(0, equals);
        if (equals == std::string::npos && !is_among(key, lone))
            refuse(fmt::format("\"{}\" is not of the form key=value", word));
        if (!is_among(key, keys))
            refuse(fmt::format("unknown key \"{}\"", key));
        const auto value =
            equals == std::string::npos ? std::nullopt : std::optional(word.substr(equals + 1));
        if (!words_.emplace(key, value).second)
            refuse(fmt::format("\"{}\" is given twice", key));
    }
}

void CameraWords::refuse(const std::string& what) const
{
    throw Error(what, fmt::format("camera \"{}\"", text_), form_);
}

bool CameraWords::has(std::string_view key) const
{
    return words_.contains(key);
}

std::optional<std::string_view> CameraWords::value(std::string_view key) const
{
    const auto found = words_.find(key);
    return found != words_.end() && found->second ? std::optional<std::string_view>(*found->second)
                                                  : std::nullopt;
}

double CameraWords::parse(std::string_view key, std::string_view digits) const
{
    if (digits.starts_with('+'))
        digits.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{} || end != digits.data() + digits.size() || !(std::abs(number) <= 1e12))
        refuse(fmt::format("{}: \"{}\" is not a number up to 1e12", key, digits));
    return number;
}

std::optional<double> CameraWords::number(std::string_view key) const
{
    const std::optional<std::string_view> digits = value(key);
    return digits ? std::optional(parse(key, *digits)) : std::nullopt;
}

std::optional<glm::dvec3> CameraWords::vector(std::string_view key) const
{
    std::optional<std::string_view> list = value(key);
    if (!list)
        return std::nullopt;
    glm::dvec3 vector{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const size_t comma = list->find(',');
        if ((comma == std::string_view::npos) != (axis == 2))
            refuse(fmt::format("{} needs three numbers, x,y,z", key));
        vector[axis] = parse(key, list->substr(0, comma));
        list->remove_prefix(axis == 2 ? list->size() : comma + 1);
    }
    return vector;
}

std::optional<double> CameraWords::fov_deg() const
{
    const std::optional<double> degrees = number("fov");
    if (degrees && (*degrees < 1.0 || *degrees > 170.0))
        refuse("fov must be from 1 to 170 degrees");
    return degrees;
}

std::optional<double> CameraWords::half_height_m() const
{
    const std::optional<double> half_m = number("ortho");
    if (half_m && *half_m <= 0.0)
        refuse("ortho must be greater than zero");
    return half_m;
}

} // namespace estampe
