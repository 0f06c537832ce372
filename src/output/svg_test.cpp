// SPDX-License-Identifier: MIT
#include <estampe/vector_drawing.hpp>

#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <estampe/error.hpp>

#include "output/stroke_path.hpp"
#include "support/folder.hpp"

namespace estampe {
namespace {

VectorStroke line_at(StrokeKind kind, uint32_t object, float y_mm, float width_mm = 0.3F)
{
    VectorStroke stroke{.kind = kind, .object = object};
    for (int i = 0; i <= 10; ++i) {
        stroke.points.push_back({{static_cast<float>(i) * 2.0F, y_mm}, width_mm});
    }
    return stroke;
}

VectorDrawing sheet()
{
    VectorDrawing drawing{.width_mm = 40.0F,
                          .height_mm = 30.0F,
                          .hatch_width_mm = 0.3F,
                          .inks_srgb = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.5F}},
                          .objects = {"urn <\"1\"> & lid", "urn <\"1\"> & lid", "caf\xc3\xa9 \xff\x01"}};
    drawing.strokes = {line_at(StrokeKind::outline, 0, 5.0F), line_at(StrokeKind::hatch, 1, 7.0F),
                       line_at(StrokeKind::hatch, 0, 9.0F), line_at(StrokeKind::crease, 2, 11.0F)};
    drawing.strokes[3].is_hidden = true;
    drawing.strokes[2].points[5].width_mm = 0.6F;
    drawing.strokes[0].ink = 1;
    return drawing;
}

pugi::xml_document parsed(const VectorDrawing& drawing, const SvgSettings& settings = {})
{
    const test::Folder folder;
    save_svg(drawing, folder / "drawing.svg", settings);
    pugi::xml_document document;
    const pugi::xml_parse_result result = document.load_file((folder / "drawing.svg").c_str());
    EXPECT_TRUE(result) << result.description();
    return document;
}

std::string svg_text(const std::filesystem::path& path)
{
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

TEST(Svg, PageIsInMillimetres)
{
    const pugi::xml_document document = parsed(sheet());
    const pugi::xml_node svg = document.child("svg");
    EXPECT_STREQ(svg.attribute("width").value(), "40mm");
    EXPECT_STREQ(svg.attribute("height").value(), "30mm");
    EXPECT_STREQ(svg.attribute("viewBox").value(), "0 0 40 30");
    EXPECT_STREQ(svg.child("rect").attribute("fill").value(), "#ffffff");
}

TEST(Svg, LayersAreKindsAndGroupsAreObjects)
{
    const pugi::xml_document document = parsed(sheet());
    std::vector<std::string> layers;
    std::set<std::string> ids;
    size_t groups = 0;
    for (const pugi::xml_node layer : document.child("svg").children("g")) {
        EXPECT_STREQ(layer.attribute("inkscape:groupmode").value(), "layer");
        layers.emplace_back(layer.attribute("inkscape:label").value());
        EXPECT_TRUE(ids.insert(layer.attribute("id").value()).second);
        EXPECT_EQ(!layer.attribute("stroke-dasharray").empty(), layers.back().starts_with("hidden"));
        for (const pugi::xml_node group : layer.children("g")) {
            EXPECT_TRUE(ids.insert(group.attribute("id").value()).second) << group.attribute("id").value();
            ++groups;
        }
    }
    EXPECT_EQ(layers, (std::vector<std::string>{"hidden crease", "hatch", "outline"}));
    EXPECT_EQ(groups, 4U);
    EXPECT_TRUE(ids.contains("hatch-urn___1_____lid"));
    EXPECT_TRUE(ids.contains("hatch-urn___1_____lid-2"));
    const pugi::xml_node hatch = document.child("svg").find_child_by_attribute("id", "hatch");
    EXPECT_STREQ(hatch.child("g").attribute("inkscape:label").value(), "urn <\"1\"> & lid");
    const pugi::xml_node hidden = document.child("svg").child("g").child("g");
    EXPECT_STREQ(hidden.attribute("inkscape:label").value(), "caf\xc3\xa9 ? ");
}

TEST(Svg, EachKindHasANameOfItsOwn)
{
    std::set<std::string> names;
    for (auto kind = StrokeKind::hatch; kind <= StrokeKind::frame;
         kind = static_cast<StrokeKind>(static_cast<uint8_t>(kind) + 1)) {
        EXPECT_TRUE(names.insert(name_of(kind)).second) << name_of(kind);
    }
    EXPECT_STREQ(name_of(StrokeKind::shadow), "shadow");
    EXPECT_STREQ(name_of(StrokeKind::intersection), "intersection");
    EXPECT_STREQ(name_of(StrokeKind::outline), "outline");
}

TEST(Svg, OneWidthIsALineAndManyAreAnArea)
{
    const pugi::xml_document document = parsed(sheet());
    const pugi::xml_node hatch = document.child("svg").find_child_by_attribute("id", "hatch");
    const pugi::xml_node swelling = hatch.first_child().child("path");
    EXPECT_TRUE(swelling.attribute("stroke").empty());
    EXPECT_STREQ(swelling.attribute("fill").value(), "#000000");
    const pugi::xml_node even = hatch.last_child().child("path");
    EXPECT_STREQ(even.attribute("stroke").value(), "#000000");
    EXPECT_STREQ(even.attribute("stroke-width").value(), "0.3");
    EXPECT_STREQ(even.attribute("d").value(), "M0,7c6.667,0 13.333,0 20,0");
    const pugi::xml_node outline = document.child("svg").find_child_by_attribute("id", "outline");
    EXPECT_STREQ(outline.first_child().child("path").attribute("stroke").value(), "#ff0080");
}

TEST(Svg, PensThatDrawGetLayersByInkAndNoPaper)
{
    const pugi::xml_document document = parsed(sheet(), {.is_for_plotter = true});
    const pugi::xml_node svg = document.child("svg");
    EXPECT_TRUE(svg.child("rect").empty());
    std::vector<std::string> labels;
    for (const pugi::xml_node layer : svg.children("g")) {
        labels.emplace_back(layer.attribute("inkscape:label").value());
        for (const pugi::xml_node path : layer.children("path")) {
            EXPECT_TRUE(path.attribute("fill").empty());
        }
    }
    EXPECT_EQ(labels, (std::vector<std::string>{"1 pen #000000", "2 pen #ff0080"}));
}

TEST(Svg, TheSameBytesAgainAndNoHalfFile)
{
    const test::Folder folder;
    save_svg(sheet(), folder / "a.svg");
    save_svg(sheet(), folder / "b.svg");
    EXPECT_EQ(svg_text(folder / "a.svg"), svg_text(folder / "b.svg"));
    EXPECT_THROW(save_svg(sheet(), folder / "none" / "a.svg"), Error);
    EXPECT_THROW(save_svg({}, folder / "c.svg"), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "c.svg"));
}

TEST(Svg, NumbersHaveNoMoreDigitsThanTheyNeed)
{
    EXPECT_EQ(output::number(1.0), "1");
    EXPECT_EQ(output::number(-0.25), "-0.25");
    EXPECT_EQ(output::number(0.0004), "0");
    EXPECT_EQ(output::number(-0.0004), "0");
    EXPECT_EQ(output::number(100.0), "100");
    EXPECT_EQ(output::number(12.3456), "12.346");
}

} // namespace
} // namespace estampe
