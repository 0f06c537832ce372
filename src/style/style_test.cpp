// SPDX-License-Identifier: MIT
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "style/names.hpp"
#include "style/schema.hpp"
#include "style/style_test_support.hpp"
#include "style/toml.hpp"

namespace estampe::style::test {
namespace {

TEST(StyleTable, DefaultsAreThoseOfTheStructAndLieInRange)
{
    HatchStyle style;
    for (const Parameter& parameter : hatch_table().parameters()) {
        EXPECT_EQ(parameter.get(&style), parameter.default_value) << parameter.key;
        const auto raw = parse_toml_value(format_value(parameter.default_value));
        ASSERT_TRUE(raw) << parameter.key;
        EXPECT_EQ(check(parameter, parameter.key, *raw, {}), parameter.default_value) << parameter.key;
    }
}

TEST(StyleTable, ADefaultOutOfRangeIsCaught)
{
#ifndef NDEBUG
    const auto broken =
        Table<LineStyle>("line", "").number("width_mm", &LineStyle::width_mm, {1.0F, 2.0F}, "", "");
    EXPECT_DEATH(Schema<LineStyle>{broken}, "minimum");
#endif
}

TEST(StyleRead, EveryKindOfParameter)
{
    Styles styles;
    schema().read_text(styles, R"(
        line.wobble = 1
        [hatch]
        width_mm = 2
        tone_floor = 0.7
        layers = 0x5
        seed = 4294967295
        cross = false
        ink = "#FF0000"
        wash = [0, 0.5, 1.0]
        coordinates = 'uv')",
                       "ink.toml");
    EXPECT_EQ(styles.line.wobble, 1.0F);
    EXPECT_EQ(styles.hatch.width_mm, 2.0F);
    EXPECT_EQ(styles.hatch.tone_floor, 0.7F);
    EXPECT_EQ(styles.hatch.layers, 5);
    EXPECT_EQ(styles.hatch.seed, 4294967295U);
    EXPECT_FALSE(styles.hatch.cross);
    EXPECT_EQ(styles.hatch.ink, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_FLOAT_EQ(styles.hatch.wash.y, 0.21404114F);
    EXPECT_EQ(styles.hatch.coordinates, Coordinates::uv);
}

TEST(StyleRead, AnEmptyTextChangesNothing)
{
    Styles styles;
    schema().read_text(styles, "", "empty");
    schema().read_text(styles, "[hatch]\n# nothing\n", "empty");
    EXPECT_EQ(styles, Styles());
}

TEST(StyleWrite, ReadsBackEqual)
{
    Styles styles;
    styles.hatch = {std::nextafter(0.1F, 1.0F),
                    1.0e-7F,
                    6,
                    4000000000U,
                    false,
                    glm::vec3(0.1F, 1.0e-5F, 0.77777F),
                    srgb(0x0c80fe),
                    Coordinates::projected};
    Styles copy;
    schema().read_text(copy, schema().to_toml(styles), "copy");
    EXPECT_EQ(copy, styles);
    EXPECT_NE(schema().to_toml(styles).find("wash = \"#0c80fe\""), std::string::npos);

    Styles defaults;
    Styles defaults_copy = styles;
    schema().read_text(defaults_copy, schema().to_toml(defaults), "copy");
    EXPECT_EQ(defaults_copy, defaults);
}

struct WordStyle {
    std::string words = "some";
    std::string picture;
};

TEST(StyleText, IsTakenAsItIsAndFilesAreFoundBesideTheTextThatNamesThem)
{
    const auto table = Table<WordStyle>("word", "Words")
                           .text("words", &WordStyle::words, "Words")
                           .file("picture", &WordStyle::picture, "A picture");
    const Schema<WordStyle> schema(table);
    WordStyle style;
    schema.read_text(style, "[word]\nwords = \"a \\\"b\\\" \\\\\"\npicture = \"nib.png\"",
                     "styles/mine.toml");
    EXPECT_EQ(style.words, "a \"b\" \\");
    EXPECT_EQ(style.picture, "styles/nib.png");
    WordStyle copy;
    schema.read_text(copy, schema.to_toml(style), "copy");
    EXPECT_EQ(copy.words, style.words);
    EXPECT_EQ(copy.picture, style.picture);
    schema.set(style, "word.picture=other.png");
    EXPECT_EQ(style.picture, "other.png");
    EXPECT_NE(message_of([&] { schema.set(style, "word.words=\"a\\u0007\""); }), "");
}

TEST(StyleText, NamesMayStandInPlaceOfAFile)
{
    const auto table = Table<WordStyle>("word", "Words")
                           .file_or_name("picture", &WordStyle::picture, {"pen", "pencil"}, "A picture");
    const Schema<WordStyle> schema(table);
    WordStyle style;
    schema.read_text(style, "[word]\npicture = \"pencil\"", "styles/mine.toml");
    EXPECT_EQ(style.picture, "pencil");
    schema.read_text(style, "[word]\npicture = \"nib.png\"", "styles/mine.toml");
    EXPECT_EQ(style.picture, "styles/nib.png");
    schema.set(style, "word.picture=");
    EXPECT_EQ(style.picture, "");
    const std::string message = message_of([&] { schema.set(style, "word.picture=pencli"); });
    EXPECT_NE(message.find("did you mean \"pencil\"?"), std::string::npos) << message;
    EXPECT_NE(message.find("pen, pencil, or the path of a file"), std::string::npos) << message;
}

TEST(StyleWrite, AnyColorReadsBackEqual)
{
    for (uint32_t i = 0; i <= 1000; ++i) {
        const float part = static_cast<float>(i) / 1000.0F;
        const glm::vec3 color{part, part * part, 1.0F - part};
        Styles styles;
        schema().set(styles, "hatch.ink=" + format_color(color));
        EXPECT_EQ(styles.hatch.ink, color) << format_color(color);
    }
    for (uint32_t byte = 0; byte < 256; ++byte) {
        EXPECT_EQ(format_color(srgb(byte * 0x10101U)), fmt::format("\"#{0:02x}{0:02x}{0:02x}\"", byte));
    }
}

TEST(StyleSet, TakesTomlValuesAndBareWords)
{
    Styles styles;
    schema().set(styles, "hatch.width_mm=0.5");
    schema().set(styles, " hatch.layers = 2 ");
    schema().set(styles, "hatch.cross=false");
    schema().set(styles, "hatch.ink=#ffffff");
    schema().set(styles, "hatch.wash=[1, 0, 0]");
    schema().set(styles, "hatch.coordinates=projected");
    EXPECT_EQ(styles.hatch.width_mm, 0.5F);
    EXPECT_EQ(styles.hatch.layers, 2);
    EXPECT_FALSE(styles.hatch.cross);
    EXPECT_EQ(styles.hatch.ink, glm::vec3(1.0F));
    EXPECT_EQ(styles.hatch.wash, glm::vec3(1.0F, 0.0F, 0.0F));
    EXPECT_EQ(styles.hatch.coordinates, Coordinates::projected);
    schema().set(styles, "hatch.coordinates=\"uv\"");
    schema().set(styles, "hatch.ink='#000'");
    EXPECT_EQ(styles.hatch.coordinates, Coordinates::uv);
    EXPECT_EQ(styles.hatch.ink, glm::vec3(0.0F));
}

TEST(StyleHelp, NamesEveryParameterInColumns)
{
    const std::string help = schema().help();
    EXPECT_NE(help.find("hatch: Pen strokes that carry the tone\n"), std::string::npos);
    EXPECT_NE(help.find("  hatch.width_mm     number   0.02 to 10 mm        0.35"), std::string::npos)
        << help;
    EXPECT_NE(help.find("  hatch.ink          colour   #rrggbb, name        #1b1a22"), std::string::npos)
        << help;
    for (const Section& section : schema().sections()) {
        for (const Parameter& parameter : section.parameters) {
            EXPECT_NE(help.find("  " + section.name + "." + parameter.key + " "), std::string::npos);
        }
    }
}

TEST(StyleSchema, FindsParametersByTheirFullKey)
{
    const auto [section, parameter] = schema().find("line.wobble");
    ASSERT_NE(parameter, nullptr);
    Styles styles;
    styles.line.wobble = 0.25F;
    EXPECT_EQ(parameter->get(section->place.in(&styles)), Value(0.25F));
    for (const char* key : {"", ".", "line", "line.", "wobble", ".wobble", "line.wobble.", "hatch.wobble"}) {
        EXPECT_EQ(schema().find(key).parameter, nullptr) << key;
    }
    EXPECT_NE(message_of([&] { schema().read_text(styles, "\"line.wobble\" = 1", "ink.toml"); }), "");
}

TEST(StyleSchema, SaysWhatTheReaderAllows)
{
    const auto json = nlohmann::json::parse(schema().json_schema());
    const auto& hatch = json["properties"]["hatch"]["properties"];
    EXPECT_EQ(hatch["width_mm"]["type"], "number");
    EXPECT_EQ(hatch["width_mm"]["minimum"], 0.02);
    EXPECT_EQ(hatch["width_mm"]["maximum"], 10.0);
    EXPECT_EQ(hatch["width_mm"]["default"], 0.35);
    EXPECT_EQ(hatch["seed"]["maximum"], 4294967295U);
    EXPECT_EQ(hatch["coordinates"]["enum"].size(), 3U);
    EXPECT_EQ(hatch["ink"]["default"], "#1b1a22");
    EXPECT_EQ(json["properties"]["hatch"]["additionalProperties"], false);
    EXPECT_TRUE(json["properties"].contains("extends"));
}

TEST(StylePresets, HaveNamesAndTexts)
{
    for (const std::string& name : preset_names()) {
        EXPECT_TRUE(preset_text(name)) << name;
        EXPECT_NO_THROW(static_cast<void>(parse_toml(*preset_text(name), name)));
    }
    EXPECT_FALSE(preset_text("no_preset_of_this_name"));
    EXPECT_NO_THROW(static_cast<void>(parse_toml(preset_text("default").value(), "default")));
}

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps)
{
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("", "abc"), 3U);
    EXPECT_EQ(edit_distance("hatch", "hatch"), 0U);
    EXPECT_EQ(edit_distance("widht", "width"), 1U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    const std::vector<std::string> names = {"hatch", "line"};
    EXPECT_EQ(nearest("lime", names), "line");
    EXPECT_EQ(nearest("weather", names), "");
}

} // namespace
} // namespace estampe::style::test
