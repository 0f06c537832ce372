// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <estampe/renderer.hpp>

#include "common/command_line.hpp"

namespace estampe::bench {

/// How the frames of a measured film are drawn.
struct FilmOptions {
    std::string device = "auto";
    std::string style;
    std::vector<std::string> assignments; ///< of --set
    std::string pictures;                 ///< folder that frames are written to; empty: none
    uint32_t width = 1920;
    uint32_t height = 1080;
    bool passes = false; ///< times each pass, which makes frames slower

    /// Adds --device, --style, --set, --width, --height, --pictures and --passes. This object must outlive
    /// the parsing.
    void add_to(CLI::App& app);

    /// The style named by --style, with the changes of --set. Throws Error as Style does.
    [[nodiscard]] Style load_style() const;

    /// Writes the frame as a PNG file if --pictures was given.
    void save(const Image& frame, int number) const;
};

} // namespace estampe::bench
