// SPDX-License-Identifier: MIT
// The presets and the whole set of parameters, through the public header.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <estampe/error.hpp>
#include <estampe/style.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"
#include "style/schema.hpp"
#include "support/files.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

TEST(Presets, LoadByNameAndChangeThePicture)
{
    const std::string plain = Style().to_toml();
    ASSERT_FALSE(Style::presets().empty());
    for (const std::string& name : Style::presets()) {
        EXPECT_NE(Style::load(name).to_toml(), plain) << name;
    }
}

TEST(Presets, BeginWithALineThatDescribesThem)
{
    for (const std::string& name : Style::presets()) {
        EXPECT_TRUE(style::preset_text(name)->starts_with("# ")) << name;
    }
}

TEST(Presets, AreInTheirPageOfTheDocs)
{
    std::ifstream file(test::source_folder() / "docs" / "reference" / "presets.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    for (const std::string& name : Style::presets()) {
        const std::string row = fmt::format("| `{}` | {} |", name, Style::about(name));
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
    EXPECT_THROW(static_cast<void>(Style::about("none")), Error);
}

TEST(Presets, ReadBackEqual)
{
    for (const std::string& name : Style::presets()) {
        const std::string text = Style::load(name).to_toml();
        features::StyleTables tables;
        features::style_schema().read_text(tables, text, name);
        EXPECT_EQ(features::style_schema().to_toml(tables), text);
    }
}

TEST(Presets, WithoutPaintDrawSmokeInInkAlone)
{
    int count = 0;
    for (const std::string& name : Style::presets()) {
        const Style style = Style::load(name);
        const features::StyleTables& tables = style.tables();
        if (tables.wash.strength > 0.0F) {
            continue;
        }
        ++count;
        const smoke::SmokeStyle& smoke = tables.smoke;
        for (const glm::vec3& color :
             {smoke.color, smoke.shade_color, smoke.deep_color, smoke.glow_color, smoke.flame_color}) {
            EXPECT_EQ(color, glm::vec3(1.0F)) << name << ": paint that leaves the paper bare";
        }
    }
    EXPECT_GE(count, 10);
}

TEST(Additions, AreNoPresetsAndAreInTheirPageOfTheDocs)
{
    std::ifstream file(test::source_folder() / "docs" / "reference" / "presets.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    const std::vector<std::string> presets = Style::presets();
    ASSERT_FALSE(Style::additions().empty());
    for (const std::string& name : Style::additions()) {
        EXPECT_EQ(std::ranges::count(presets, name), 0) << name;
        const std::string row = fmt::format("| `{}` | {} |", name, Style::about(name));
        EXPECT_NE(page.find(row), std::string::npos) << row;
    }
}

TEST(Additions, OverrideWhatTheySetOfAnyPreset)
{
    const Style plain;
    for (const std::string& addition : Style::additions()) {
        features::StyleTables alone;
        features::style_schema().read(alone, addition);
        for (const std::string& preset : Style::presets()) {
            const Style base = Style::load(preset);
            const Style both = Style::load(preset + "+" + addition);
            for (const style::Section& section : features::style_schema().sections()) {
                for (const style::Parameter& parameter : section.parameters) {
                    const auto value = [&](const features::StyleTables& tables) {
                        return parameter.get(section.place.in(&tables));
                    };
                    const style::Value set = value(alone);
                    const style::Value now = value(both.tables());
                    EXPECT_TRUE(now == set || now == value(base.tables()))
                        << preset << "+" << addition << " " << section.name << "." << parameter.key;
                    EXPECT_TRUE(now == set || set == value(plain.tables()))
                        << preset << "+" << addition << " " << section.name << "." << parameter.key;
                }
            }
        }
    }
}

TEST(Additions, NoColorLeavesOnlyGreysInEveryPreset)
{
    for (const std::string& preset : Style::presets()) {
        const Style style = Style::load(preset + "+no-color");
        for (const style::Section& section : features::style_schema().sections()) {
            for (const style::Parameter& parameter : section.parameters) {
                const std::string key = section.name + "." + parameter.key;
                const style::Value value = parameter.get(section.place.in(&style.tables()));
                if (parameter.kind == style::Kind::color && value != style::Value(std::string("auto"))) {
                    const glm::vec3 color = style.color(key);
                    EXPECT_EQ(color.x, color.y)
                        << preset << " " << key << ": a line in no-color.toml is missing";
                    EXPECT_EQ(color.x, color.z) << preset << " " << key;
                }
            }
        }
        EXPECT_EQ(style.number("wash.saturation"), 0.0);
    }
}

TEST(Additions, PartsAreReadFromLeftToRight)
{
    EXPECT_EQ(Style::load("pencil+comic+white-paper").to_toml(), [] {
        Style style = Style::load("pencil+comic");
        for (const char* assignment :
             {"paper.color=#ffffff", "paper.border_mm=0", "paper.grain=0", "paper.granulation=0"}) {
            style.set(assignment);
        }
        return style.to_toml();
    }());
    EXPECT_NE(Style::load("pencil+comic").to_toml(), Style::load("comic+pencil").to_toml());
}

TEST(Additions, FilesMayHaveAPlusInTheirNames)
{
    const test::Folder folder;
    const std::string path = (folder.path() / "ink+wash.toml").string();
    std::ofstream(path) << "[paper]\ngrain = 0.25\n";
    EXPECT_EQ(Style::load(path).number("paper.grain"), 0.25);
    EXPECT_EQ(Style::load("comic+" + path).number("paper.grain"), 0.25);
    EXPECT_EQ(Style::load(path + "+white-paper").number("paper.grain"), 0.0);
    EXPECT_EQ(Style::load(path + "+" + path).number("paper.grain"), 0.25);
}

TEST(Additions, ErrorsNameThePartThatIsWrong)
{
    const auto message = [](const std::string& name) {
        try {
            static_cast<void>(Style::load(name));
        } catch (const Error& problem) {
            return std::string(problem.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message("comic+no-colour"),
              "no preset or style file \"no-colour\"; did you mean \"no-color\"?");
    EXPECT_EQ(message("comik+no-color"), "no preset or style file \"comik\"; did you mean \"comic\"?");
    EXPECT_NE(message("comic+").find("a part of the style \"comic+\" is empty"), std::string::npos);
    EXPECT_NE(message("+").find("is empty"), std::string::npos);
    EXPECT_NE(message("comic++no-color").find("is empty"), std::string::npos);
}

TEST(Parameters, EachHasHelpOnOneLineAndAUniqueName)
{
    std::vector<std::string> names;
    for (const style::Section& section : features::style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            names.push_back(section.name + "." + parameter.key);
            EXPECT_FALSE(parameter.help.empty()) << names.back();
            EXPECT_EQ(parameter.help.find('\n'), std::string::npos) << names.back();
        }
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

TEST(Parameters, EachTakesItsOwnDefaultAndEndsOfRange)
{
    features::StyleTables tables;
    const auto& schema = features::style_schema();
    for (const style::Section& section : schema.sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            const std::string name = section.name + "." + parameter.key;
            if (parameter.kind == style::Kind::number) {
                EXPECT_NO_THROW(schema.set(tables, fmt::format("{}={}", name, parameter.range.minimum)))
                    << name;
                EXPECT_NO_THROW(schema.set(tables, fmt::format("{}={}", name, parameter.range.maximum)))
                    << name;
                EXPECT_THROW(schema.set(tables, fmt::format("{}={}", name, parameter.range.maximum * 2 + 1)),
                             Error)
                    << name;
            } else if (parameter.kind == style::Kind::integer) {
                EXPECT_NO_THROW(schema.set(tables, fmt::format("{}={}", name, parameter.integers.minimum)))
                    << name;
                EXPECT_THROW(schema.set(tables, fmt::format("{}={}", name, parameter.integers.maximum + 1)),
                             Error)
                    << name;
            } else if (parameter.kind == style::Kind::choice) {
                for (const std::string& choice : parameter.choices) {
                    schema.set(tables, name + "=" + choice);
                    EXPECT_EQ(parameter.get(section.place.in(&tables)), style::Value(choice)) << name;
                }
            }
        }
    }
}

} // namespace
} // namespace estampe
