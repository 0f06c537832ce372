// SPDX-License-Identifier: MIT
#include "support/files.hpp"

namespace estampe::test {

std::filesystem::path source_folder()
{
    return ESTAMPE_SOURCE_DIR;
}

std::filesystem::path golden_folder()
{
    return source_folder() / "tests" / "golden";
}

std::filesystem::path square_scene()
{
    return ESTAMPE_SQUARE_GLB;
}

} // namespace estampe::test
