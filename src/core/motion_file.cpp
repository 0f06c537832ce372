// SPDX-License-Identifier: MIT
#include <estampe/motion.hpp>

#include <estampe/error.hpp>

#include "core/exr.hpp"
#include "core/file.hpp"

namespace estampe {

void save_motion(const Motion& motion, const std::filesystem::path& path)
{
    if (motion.pixels.empty()) {
        throw Error("there is no motion to write", path.string(),
                    "ask for it in RenderSettings::motion_since");
    }
    write_file_atomically(path, encode_float_exr(motion.width, motion.height, motion.pixels));
}

} // namespace estampe
