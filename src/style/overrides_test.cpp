// SPDX-License-Identifier: MIT
// Overrides for single materials and objects.
#include "style/style_test_support.hpp"

#include <nlohmann/json.hpp>

namespace estampe::style {
namespace {

using By = Surfaces::By;

/// A style in which strokes and washes may differ between surfaces, and of lines only the width.
struct Sample {
    test::HatchStyle hatch;
    test::LineStyle line;
    std::vector<Override> overrides;

    void read(const std::string& text);

    [[nodiscard]] std::string error_of(const std::string& text)
    {
        return test::message_of([&] { read(text); });
    }
};

const Schema<Sample>& schema()
{
    static const Table<test::HatchStyle> hatch_table = Table(test::hatch_table()).by_surface_but({"seed"});
    static const Table<test::LineStyle> line_table =
        Table(test::line_table()).by_surface({"width_mm"}).by_object({"wobble"});
    static const auto schema = Schema<Sample>()
                                   .section(hatch_table, &Sample::hatch)
                                   .section(line_table, &Sample::line)
                                   .overrides(&Sample::overrides);
    return schema;
}

void Sample::read(const std::string& text)
{
    schema().read_text(*this, text, "a.toml");
}

Override hatch_width(By by, const std::string& pattern, float width_mm)
{
    return {{by, pattern}, "hatch", "width_mm", width_mm};
}

TEST(StyleOverrides, ComeInTheOrderOfTheTextWhateverItsTables)
{
    Sample sample;
    sample.read("[object.\"tower*\".hatch]\nwidth_mm = 1\n"
                "[hatch]\nwidth_mm = 2\n"
                "[material.brick.hatch]\nwidth_mm = 3\ncross = false\n"
                "[object.\"*\".line]\nwidth_mm = 4\n");
    const std::vector<Override> expected{hatch_width(By::object, "tower*", 1.0F),
                                         hatch_width(By::material, "brick", 3.0F),
                                         {{By::material, "brick"}, "hatch", "cross", false},
                                         {{By::object, "*"}, "line", "width_mm", 4.0F}};
    EXPECT_EQ(sample.overrides, expected);
    EXPECT_EQ(sample.hatch.width_mm, 2.0F);
}

TEST(StyleOverrides, OfTheSameTheLastHolds)
{
    Sample sample;
    sample.read("material.a.hatch.width_mm = 1\nmaterial.b.hatch.width_mm = 2\n");
    schema().set(sample, "material.a.hatch.width_mm=3");
    const std::vector<Override> expected{hatch_width(By::material, "b", 2.0F),
                                         hatch_width(By::material, "a", 3.0F)};
    EXPECT_EQ(sample.overrides, expected);
}

TEST(StyleOverrides, AreSetByPatternsWithDotsAndQuotesToo)
{
    Sample sample;
    schema().set(sample, "object.wall.001.hatch.width_mm=1");
    schema().set(sample, "object.\"a b\".hatch.width_mm = 2");
    const std::vector<Override> expected{hatch_width(By::object, "wall.001", 1.0F),
                                         hatch_width(By::object, "a b", 2.0F)};
    EXPECT_EQ(sample.overrides, expected);
}

TEST(StyleOverrides, AreWrittenSoThatTheyReadBackInTheirOrder)
{
    Sample sample;
    sample.read("material.\"a \\\"b\\\".*\".hatch.width_mm = 1\nobject.c.line.width_mm = 2\n"
                "material.\"a \\\"b\\\".*\".hatch.ink = \"#102030\"\n");
    ASSERT_EQ(sample.overrides.size(), 3U);
    Sample again;
    again.read(schema().to_toml(sample));
    EXPECT_EQ(again.overrides, sample.overrides);
    EXPECT_EQ(again.hatch, sample.hatch);
}

TEST(StyleOverrides, GoToTheirParameter)
{
    Sample sample;
    schema().apply(sample, hatch_width(By::all, "", 1.5F));
    EXPECT_EQ(sample.hatch.width_mm, 1.5F);
    EXPECT_EQ(sample.line, test::LineStyle());
}

TEST(StyleOverrides, MistakesSayWhereAndWhat)
{
    Sample sample;
    EXPECT_EQ(sample.error_of("[material.\"brick*\".hatch]\nwidth = 1\n"),
              "a.toml:2:1: unknown key \"hatch.width\"; did you mean \"hatch.width_mm\"?");
    EXPECT_EQ(sample.error_of("[material.brick.hatch]\nwidth_mm = 99\n"),
              "a.toml:2:12: hatch.width_mm = 99 is out of range; allowed: 0.02 to 10 mm");
    EXPECT_EQ(sample.error_of("[material.brick.hatsh]\n"),
              "a.toml:1:17: unknown section \"hatsh\"; did you mean \"hatch\"?");
    EXPECT_EQ(sample.error_of("[matrial.brick.hatch]\n"),
              "a.toml:1:2: unknown section \"matrial\"; did you mean \"material\"?");
    EXPECT_EQ(sample.error_of("[object.tower]\nwidth_mm = 1\n"),
              "a.toml:2:1: \"width_mm\" stands in no section; put keys below a line such as "
              "[object.\"brick*\".hatch]");
    EXPECT_EQ(sample.error_of("[object.tower.hatch]\nseed = 1\n"),
              "a.toml:2:1: \"hatch.seed\" is the same all over the picture; put it below a line [hatch]");
    EXPECT_EQ(test::message_of([&] { schema().set(sample, "object.a.hatch.seed=5"); }),
              "--set: \"hatch.seed\" is the same all over the picture; put it below a line [hatch]");
    EXPECT_EQ(test::message_of([&] { schema().set(sample, "material.a.line.wobble=0.5"); }),
              "--set: \"line.wobble\" cannot differ by material; name an object: put it below a line "
              "[object.\"NAME\".line]");
    EXPECT_EQ(
        sample.error_of("[material.\"kind:wod\".hatch]\nwidth_mm = 1\n"),
        "a.toml:2:1: unknown kind of material \"wod\"; kinds are stone, wood, cloth, metal, skin, sand, "
        "water, leaves");
    EXPECT_TRUE(sample.overrides.empty());
    schema().set(sample, "object.a.line.wobble=0.5");
    EXPECT_EQ(sample.overrides.size(), 1U);
}

TEST(StyleOverrides, AreAnErrorWhereNothingDiffers)
{
    test::Styles plain;
    EXPECT_EQ(test::message_of(
                  [&] { test::schema().read_text(plain, "[material.a.hatch]\nwidth_mm = 1\n", "a.toml"); }),
              "a.toml:1:13: nothing here differs from surface to surface; sections are hatch, line");
}

TEST(StyleOverrides, AreInTheSchemaAndTheManual)
{
    Sample sample;
    const auto json = nlohmann::json::parse(schema().json_schema());
    for (const std::string by : {"material", "object"}) {
        const auto& sections = json["$defs"][by]["properties"];
        EXPECT_TRUE(sections["hatch"]["properties"].contains("width_mm"));
        EXPECT_FALSE(sections["hatch"]["properties"].contains("seed"));
        EXPECT_EQ(sections["line"]["properties"].contains("wobble"), by == "object");
        EXPECT_EQ(json["properties"][by]["additionalProperties"]["$ref"], "#/$defs/" + by);
    }
    EXPECT_NE(schema().help().find("\n  line: width_mm\n"), std::string::npos);
    EXPECT_NE(schema().help().find("\n  line: wobble\n"), std::string::npos);
}

TEST(StyleOverrides, PatternsAreThoseOfFileNames)
{
    EXPECT_TRUE(matches("brick*", "brick_01"));
    EXPECT_FALSE(matches("brick*", "a brick"));
    EXPECT_TRUE(matches("pane_?", "pane_7"));
    EXPECT_TRUE(matches("[AB]*", "Beam"));
    EXPECT_FALSE(matches("", "Beam"));
}

} // namespace
} // namespace estampe::style
