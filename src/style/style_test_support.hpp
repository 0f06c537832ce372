// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/error.hpp>
#include <gtest/gtest.h>

#include "style/schema.hpp"

namespace estampe::style::test {

enum class Coordinates : uint8_t { automatic, uv, projected };

struct HatchStyle {
    float width_mm = 0.35F;
    float tone_floor = 0.12F;
    int layers = 3;
    uint32_t seed = 7;
    bool cross = true;
    glm::vec3 ink = srgb(0x1b1a22);
    glm::vec3 wash{0.3F, 0.123456F, 1.0F};
    Coordinates coordinates = Coordinates::automatic;

    bool operator==(const HatchStyle&) const = default;
};

struct LineStyle {
    float width_mm = 0.5F;
    float wobble = 0.0F;

    bool operator==(const LineStyle&) const = default;
};

inline const Table<HatchStyle>& hatch_table()
{
    static const auto table =
        Table<HatchStyle>("hatch", "Pen strokes that carry the tone")
            .number("width_mm", &HatchStyle::width_mm, {0.02F, 10.0F}, "mm", "Width of a stroke on the page")
            .number("tone_floor", &HatchStyle::tone_floor, {0.0F, 0.7F}, "", "Darkest tone left white")
            .integer("layers", &HatchStyle::layers, {1, 6}, "", "Layers of strokes")
            .integer("seed", &HatchStyle::seed, {0, 4294967295}, "", "Start of the random numbers")
            .toggle("cross", &HatchStyle::cross, "Draw layers across each other")
            .color("ink", &HatchStyle::ink, "Colour of the ink")
            .color("wash", &HatchStyle::wash, "Colour below the ink")
            .choice("coordinates", &HatchStyle::coordinates,
                    {{"auto", Coordinates::automatic},
                     {"uv", Coordinates::uv},
                     {"projected", Coordinates::projected}},
                    "What the strokes follow");
    return table;
}

inline const Table<LineStyle>& line_table()
{
    static const auto table =
        Table<LineStyle>("line", "Contours")
            .number("width_mm", &LineStyle::width_mm, {0.0F, 5.0F}, "mm", "Width of a contour on the page")
            .number("wobble", &LineStyle::wobble, {0.0F, 1.0F}, "", "How far a line strays");
    return table;
}

struct Styles {
    HatchStyle hatch;
    LineStyle line;

    bool operator==(const Styles&) const = default;
};

inline const Schema<Styles>& schema()
{
    static const auto schema =
        Schema<Styles>().section(hatch_table(), &Styles::hatch).section(line_table(), &Styles::line);
    return schema;
}

/// The message of the Error that `action` throws, which must be a single line; empty if it throws none.
template <typename Action>
std::string message_of(const Action& action)
{
    try {
        action();
    } catch (const Error& error) {
        std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        return message;
    }
    return {};
}

} // namespace estampe::style::test
