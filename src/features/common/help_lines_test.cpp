// SPDX-License-Identifier: MIT
// Each help line of a style and of a terrain file must be understandable alone.
#include <span>

#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"
#include "support/help_rules.hpp"
#include "techniques/terrain/slabs/slabs.hpp"
#include "techniques/terrain/terrain_file.hpp"

namespace estampe::features {
namespace {

void expect_right(const std::string& name, const std::string& help, size_t least_words = 4)
{
    EXPECT_EQ(test::fault_of_help(help, least_words), "") << name << ": " << help;
}

void expect_right(const std::string& section, const std::string& help,
                  std::span<const style::Parameter> parameters)
{
    constexpr size_t longest = 245;
    expect_right(section, help, 2);
    for (const style::Parameter& parameter : parameters) {
        expect_right(section + "." + parameter.key, parameter.help);
        EXPECT_LE(parameter.help.size(), longest) << section << "." << parameter.key;
    }
}

template <typename Struct>
void expect_right(const style::Table<Struct>& table)
{
    expect_right(table.section(), table.help(), table.parameters());
}

TEST(HelpLines, OfTheStyleStandAlone)
{
    for (const style::Section& section : style_schema().sections()) {
        expect_right(section.name, section.help, section.parameters);
    }
}

TEST(HelpLines, OfGroundsStandAlone)
{
    expect_right(terrain::look_table());
    expect_right(terrain::wind_table());
    expect_right(terrain::mesh_table());
    expect_right(terrain::ripples_table());
    expect_right(terrain::trails_table());
    expect_right(terrain::slab_table());
}

TEST(HelpLines, WhatLeansOnOthersIsRefused)
{
    for (const char* wrong :
         {"", "Of a stroke", "And how much paler strokes are", "The same on the page, cut to this",
          "Whether any light does that", "Then the map is drawn", "It is drawn with ink",
          "They are drawn anew", "As above, for lamps alone", "Width of lines, see above",
          "Width of lines. 0 draws none", "Width of all lines on the page.", "Width of all lines. [3]x"}) {
        EXPECT_NE(test::fault_of_help(wrong), "") << wrong;
    }
    for (const char* right :
         {"Width of lines on the page", "Width of lines. 0 draws none.",
          "Turns hatching on: 0.5 is half [true]", "Width and height. Both count.\n[1x1]"}) {
        EXPECT_EQ(test::fault_of_help(right), "") << right;
    }
}

} // namespace
} // namespace estampe::features
