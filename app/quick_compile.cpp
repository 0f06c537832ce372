// SPDX-License-Identifier: MIT
#include "quick_compile.hpp"

#include <cstdlib>

namespace estampe::app {

void compile_quickly_if_soon_drawn(const RenderCommand& command)
{
    constexpr uint64_t most_pixels = uint64_t{1} << 22U;
    const DrawOptions& draw = command.draw;
    if (command.repeat == 1 && !command.film &&
        uint64_t{draw.page.width} * draw.page.height * draw.samples <= most_pixels) {
        setenv("GALLIVM_PERF", "nopt", 0);
    }
}

} // namespace estampe::app
