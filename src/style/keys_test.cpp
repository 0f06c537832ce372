// SPDX-License-Identifier: MIT
// Keys in tables of a section, automatic switches, and colours by name.
#include <optional>

#include <estampe/error.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "style/style_test_support.hpp"

namespace estampe::style::test {
namespace {

struct Kind {
    bool enabled = true;
    float width_mm = 0.5F;
    std::optional<glm::vec3> ink;

    bool operator==(const Kind&) const = default;
};

struct Lines {
    Kind outline;
    Kind crease{.enabled = false, .width_mm = 0.2F};
    AutoToggle sky = AutoToggle::automatic;
    glm::vec3 ink{0.0F};

    bool operator==(const Lines&) const = default;
};

struct Drawing {
    Lines lines;
    std::vector<Override> overrides;

    bool operator==(const Drawing&) const = default;
};

const Schema<Drawing>& drawing_schema()
{
    static const auto table = [] {
        const auto outline = [](auto Kind::*member) { return within(&Lines::outline, member); };
        const auto crease = [](auto Kind::*member) { return within(&Lines::crease, member); };
        auto made = Table<Lines>("contour", "Ink lines of every kind");
        made.toggle("outline.enabled", outline(&Kind::enabled), "Turns outlines on")
            .number("outline.width_mm", outline(&Kind::width_mm), {0.02F, 20.0F}, "mm", "Width of outlines")
            .color_or_auto("outline.ink", outline(&Kind::ink), "Colour of outlines")
            .toggle("crease.enabled", crease(&Kind::enabled), "Turns creases on")
            .number("crease.width_mm", crease(&Kind::width_mm), {0.02F, 20.0F}, "mm", "Width of creases")
            .auto_toggle("sky", &Lines::sky, "Draws a sky")
            .color("ink", &Lines::ink, "Colour of the ink")
            .by_surface({"outline.width_mm"});
        return made;
    }();
    static const auto schema =
        Schema<Drawing>().section(table, &Drawing::lines).overrides(&Drawing::overrides);
    return schema;
}

Drawing read(const std::string& text)
{
    Drawing drawing;
    drawing_schema().read_text(drawing, text, "test.toml");
    return drawing;
}

TEST(StyleKeys, StandInTablesOfTheirSectionOrWithDots)
{
    const Drawing tables = read("[contour.outline]\nwidth_mm = 2\n[contour.crease]\nenabled = true\n");
    EXPECT_EQ(tables.lines.outline.width_mm, 2.0F);
    EXPECT_TRUE(tables.lines.crease.enabled);
    EXPECT_EQ(read("[contour]\noutline.width_mm = 2\ncrease.enabled = true\n"), tables);
    Drawing set;
    drawing_schema().set(set, "contour.outline.width_mm=2");
    drawing_schema().set(set, "contour.crease.enabled=true");
    EXPECT_EQ(set, tables);
    EXPECT_EQ(read(drawing_schema().to_toml(tables)), tables);
}

TEST(StyleKeys, InTablesMayDifferBySurface)
{
    const Drawing table = read("[material.\"brick*\".contour.outline]\nwidth_mm = 3\n");
    const std::vector<Override> expected{
        {{Surfaces::By::material, "brick*"}, "contour", "outline.width_mm", 3.0F}};
    EXPECT_EQ(table.overrides, expected);
    Drawing set;
    drawing_schema().set(set, "material.brick*.contour.outline.width_mm=3");
    EXPECT_EQ(set, table);
    Drawing quoted;
    drawing_schema().set(quoted, "object.\"a.b\".contour.outline.width_mm=3");
    EXPECT_EQ(quoted.overrides.at(0).surfaces.pattern, "a.b");
    EXPECT_EQ(read(drawing_schema().to_toml(table)), table);
}

TEST(StyleKeys, MistakesInTablesSayWhereAndWhat)
{
    EXPECT_EQ(message_of([] { read("[contour.outlin]\nwidth_mm = 2\n"); }),
              "test.toml:1:10: unknown section \"contour.outlin\"; did you mean \"contour.outline\"?");
    EXPECT_EQ(message_of([] { read("[contour.outline]\nwidth = 2\n"); }),
              "test.toml:2:1: unknown key \"contour.outline.width\"; did you mean "
              "\"contour.outline.width_mm\"?");
    EXPECT_EQ(message_of([] { read("[contour]\noutline = 2\n"); }),
              "test.toml:2:1: \"contour.outline\" is a section, not a key; put its keys below a line "
              "[contour.outline]");
    EXPECT_NE(message_of([] { read("[contour.outline.width_mm]\nx = 2\n"); }), "");
}

TEST(StyleKeys, StandInTheJsonSchemaAsTheyDoInToml)
{
    const auto schema = nlohmann::json::parse(drawing_schema().json_schema());
    const auto& contour = schema.at("properties").at("contour");
    const auto& outline = contour.at("properties").at("outline");
    EXPECT_EQ(outline.at("properties").at("width_mm").at("type"), "number");
    EXPECT_EQ(outline.at("additionalProperties"), false);
    EXPECT_EQ(contour.at("properties").at("sky").at("enum"), nlohmann::json({"auto", true, false}));
    EXPECT_TRUE(schema.at("$defs")
                    .at("material")
                    .at("properties")
                    .at("contour")
                    .at("properties")
                    .contains("outline"));
}

TEST(StyleKeys, AToggleMayBeLeftToTheScene)
{
    EXPECT_EQ(read("[contour]\nsky = true\n").lines.sky, AutoToggle::on);
    EXPECT_EQ(read("[contour]\nsky = false\n").lines.sky, AutoToggle::off);
    EXPECT_EQ(read("[contour]\nsky = \"auto\"\n").lines.sky, AutoToggle::automatic);
    Drawing drawing;
    drawing_schema().set(drawing, "contour.sky=true");
    EXPECT_EQ(drawing.lines.sky, AutoToggle::on);
    EXPECT_NE(drawing_schema().to_toml(drawing).find("\nsky = true\n"), std::string::npos);
    EXPECT_EQ(message_of([] { read("[contour]\nsky = 1\n"); }),
              "test.toml:2:7: contour.sky = 1 is not a name in quotes; allowed: auto, true, false");
}

TEST(StyleKeys, AColorMayBeAuto)
{
    EXPECT_EQ(read("[contour]\noutline.ink = \"navy\"\n").lines.outline.ink, srgb(0x000080));
    const Drawing set = read("[contour]\noutline.ink = [1, 0, 0]\n");
    EXPECT_EQ(set.lines.outline.ink, srgb(0xff0000));
    EXPECT_EQ(read(drawing_schema().to_toml(set)), set);
    Drawing drawing = set;
    drawing_schema().set(drawing, "contour.outline.ink=auto");
    EXPECT_FALSE(drawing.lines.outline.ink);
    EXPECT_EQ(read(drawing_schema().to_toml(drawing)), drawing);
    EXPECT_NE(
        message_of([] { read("[contour]\noutline.ink = \"none\"\n"); }).find("allowed: \"auto\", \"#rr"),
        std::string::npos);
    EXPECT_THROW(drawing_schema().set(drawing, "contour.ink=auto"), Error) << "always a colour";
    const auto schema = nlohmann::json::parse(drawing_schema().json_schema());
    const auto& ink = schema.at("properties").at("contour").at("properties").at("outline").at("properties");
    EXPECT_EQ(ink.at("ink").at("default"), "auto");
    EXPECT_EQ(ink.at("ink").at("anyOf").back().at("enum"), nlohmann::json({"auto"}));
}

TEST(StyleKeys, ColorsHaveTheNamesOfCss)
{
    EXPECT_EQ(read("[contour]\nink = \"ivory\"\n").lines.ink, srgb(0xfffff0));
    EXPECT_EQ(read("[contour]\nink = \"RebeccaPurple\"\n").lines.ink, srgb(0x663399));
    Drawing drawing;
    drawing_schema().set(drawing, "contour.ink=navy");
    EXPECT_EQ(drawing.lines.ink, srgb(0x000080));
    EXPECT_EQ(message_of([] { read("[contour]\nink = \"nawy\"\n"); }),
              "test.toml:2:7: contour.ink = \"nawy\" is not a colour; did you mean \"navy\"? allowed: "
              "\"#rrggbb\", a name of CSS such as \"ivory\", or [r, g, b] of 0 to 1");
}

} // namespace
} // namespace estampe::style::test
