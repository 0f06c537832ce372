// SPDX-License-Identifier: MIT
#include "quick_compile.hpp"

#include <cstdlib>

namespace estampe::app {
namespace {

constexpr const char* setting = "GALLIVM_PERF"; ///< Mesa's

} // namespace

bool compile_quickly()
{
    return std::getenv(setting) == nullptr && setenv(setting, "nopt", 1) == 0;
}

void compile_well()
{
    unsetenv(setting);
}

void compile_quickly_if_soon_drawn(const RenderCommand& command)
{
    constexpr uint64_t most_pixels = uint64_t{1} << 22U;
    const DrawOptions& draw = command.draw;
    if (command.repeat == 1 && !command.film &&
        uint64_t{draw.page.width} * draw.page.height * draw.samples <= most_pixels) {
        compile_quickly();
    }
}

} // namespace estampe::app
