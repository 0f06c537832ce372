// SPDX-License-Identifier: MIT
#include "viewer/panels.hpp"

#include <gtest/gtest.h>

#include "features/common/style_tables.hpp"

namespace estampe::viewer {
namespace {

std::vector<std::string> found(const std::string& search)
{
    std::vector<std::string> names;
    for (const style::Section& section : features::style_schema().sections()) {
        for (const style::Parameter& parameter : section.parameters) {
            if (matches(section, parameter, search)) {
                names.push_back(section.name + "." + parameter.key);
            }
        }
    }
    return names;
}

TEST(ParameterSearch, EveryWordCountsWhereverItStands)
{
    EXPECT_EQ(found("hatch.width_mm"), std::vector<std::string>{"hatch.width_mm"});
    EXPECT_EQ(found("WOBBLE hatch"), std::vector<std::string>{"hatch.wobble_mm"});
    EXPECT_EQ(found("no such thing"), std::vector<std::string>{});
    EXPECT_GT(found("").size(), 100U);
    EXPECT_GT(found("shadow").size(), found("shadow edge").size());
}

} // namespace
} // namespace estampe::viewer
