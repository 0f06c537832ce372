// SPDX-License-Identifier: MIT
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/files.hpp"
#include "techniques/terrain/graph/node_kinds.hpp"

namespace estampe::terrain {
namespace {

std::string shown(const NodeParameter& parameter)
{
    if (parameter.default_number) {
        return fmt::format("{} = {:.3g}", parameter.name, *parameter.default_number);
    }
    if (!parameter.default_text.empty()) {
        return fmt::format("{} = \"{}\"", parameter.name, parameter.default_text);
    }
    return std::string(parameter.name);
}

/// A line of the manual's table.
std::string row_of(const NodeKind& kind)
{
    std::string arguments;
    for (const NodeParameter& parameter : kind.parameters) {
        arguments += (arguments.empty() ? "" : ", ") + shown(parameter);
    }
    const bool is_sign = kind.name.size() == 1;
    return is_sign ? fmt::format("| `{}` | {} |", kind.name, kind.help)
                   : fmt::format("| `{}({})` | {} |", kind.name, arguments, kind.help);
}

TEST(TerrainManual, SaysWhatTheLanguageIs)
{
    std::ifstream file(test::source_folder() / "docs/terrain.md");
    const std::string manual(std::istreambuf_iterator<char>(file), {});
    for (const NodeKind& kind : node_kinds()) {
        EXPECT_NE(manual.find(row_of(kind)), std::string::npos) << row_of(kind);
    }
}

} // namespace
} // namespace estampe::terrain
