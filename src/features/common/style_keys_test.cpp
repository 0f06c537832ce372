// SPDX-License-Identifier: MIT
// Naming rules of all style keys, and the keys suggested for other names.
#include <array>
#include <string>

#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"
#include "style/names.hpp"

namespace estampe::features {
namespace {

TEST(KeyConventions, UnitsHaveOneSpelling)
{
    constexpr std::array<const char*, 6> others{"_mps", "_mps2", "_m_s", "_mm_s", "_ms", "_degrees"};
    for (const style::Section& section : style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            for (const char* const ending : others) {
                EXPECT_FALSE(parameter.key.ends_with(ending)) << section.name << "." << parameter.key;
            }
            const bool is_speed = parameter.unit == "m/s";
            EXPECT_TRUE(!is_speed || parameter.key.ends_with("_m_per_s"))
                << section.name << "." << parameter.key;
        }
    }
}

TEST(KeyConventions, TogglesOfTechniquesAreCalledEnabled)
{
    for (const style::Section& section : style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            for (const char* const word : {"drawn", "on", "active", "visible"}) {
                EXPECT_NE(parameter.key, word) << section.name;
            }
        }
    }
}

TEST(FormerNames, LeadToParametersOfToday)
{
    const auto known = style::names_known_otherwise();
    EXPECT_GT(known.size(), 100U);
    for (const auto& [before, now] : known) {
        EXPECT_NE(style_schema().find(now).parameter, nullptr) << before << " -> " << now;
        EXPECT_EQ(style_schema().find(before).parameter, nullptr) << before << " is a key";
    }
}

TEST(FormerNames, AreAnsweredInErrors)
{
    const auto answer = [](const char* assignment) -> std::string {
        StyleTables tables;
        try {
            style_schema().set(tables, assignment);
        } catch (const std::exception& problem) {
            return problem.what();
        }
        return {};
    };
    EXPECT_EQ(answer("hatch.drawn=false"),
              "--set: unknown key \"hatch.drawn\"; did you mean \"hatch.enabled\"?");
    EXPECT_EQ(answer("contour.line_width=2"),
              "--set: unknown key \"contour.line_width\"; did you mean \"contour.outline.width_mm\"?");
    EXPECT_EQ(
        answer("wind.direction_deg=20"),
        "--set: \"wind.direction_deg\" is no longer a key; write wind.towards_deg = 90 - direction_deg, "
        "which counts from +z like all bearings");
    for (const char* key :
         {"light.lights=Lamp=off", "light.objects=Glass=no_cast", "ink.zones=Fan=blow:20"}) {
        EXPECT_NE(answer(key).find("below a line [object.\"NAME\"."), std::string::npos) << answer(key);
    }
    EXPECT_EQ(answer("background=white"), "--set: unknown key \"background\"; did you mean \"paper.color\"?");
}

} // namespace
} // namespace estampe::features
