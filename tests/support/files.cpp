// SPDX-License-Identifier: MIT
#include "support/files.hpp"

namespace estampe::test {

std::filesystem::path golden_folder()
{
    return ESTAMPE_GOLDEN_DIR;
}

std::filesystem::path square_scene()
{
    return ESTAMPE_SQUARE_GLB;
}

} // namespace estampe::test
