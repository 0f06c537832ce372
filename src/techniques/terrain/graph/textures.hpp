// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "techniques/terrain/graph/program.hpp"

namespace estampe::terrain {

struct TextureRequest {
    std::string name; ///< a file, or a mask's name
    bool is_mask = false;
    uint32_t texels = 0; ///< of a mask, each way
};

struct TextureInProgram {
    size_t index = 0;
    double mean = 0.0;
};

/// The texture in `program`, put there if it is not yet. Throws Error for a file that cannot be read, for a
/// mask that is asked for in two sizes, and where all of them hold more than 2^24 texels. `folder` is what
/// files are looked up in.
[[nodiscard]] TextureInProgram texture_in(Program& program, const TextureRequest& request,
                                          const std::filesystem::path& folder);

} // namespace estampe::terrain
