// SPDX-License-Identifier: MIT
// The presets and the whole set of parameters, through the public header.
#include <algorithm>
#include <fstream>
#include <iterator>

#include <estampe/error.hpp>
#include <estampe/style.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"
#include "style/schema.hpp"
#include "support/files.hpp"

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
