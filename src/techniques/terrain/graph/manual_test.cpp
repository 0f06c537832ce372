// SPDX-License-Identifier: MIT
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/files.hpp"
#include "techniques/terrain/graph/language.hpp"

namespace estampe::terrain {
namespace {

TEST(TerrainManual, SaysWhatTheLanguageIs)
{
    std::ifstream file(test::source_folder() / "docs/terrain.md");
    const std::string manual(std::istreambuf_iterator<char>(file), {});
    for (const NodeKind& kind : node_kinds()) {
        const std::string row = fmt::format("| `{}` | {} |", signature(kind), kind.help);
        EXPECT_NE(manual.find(row), std::string::npos) << row;
    }
}

} // namespace
} // namespace estampe::terrain
