// SPDX-License-Identifier: MIT
#include "transparent_option.hpp"

#include <algorithm>
#include <array>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "usage_error.hpp"

namespace estampe::app {

void TransparentOption::add_to(CLI::App& command)
{
    command
        .add_flag(
            "--transparent", mode_,
            "Draw with an alpha channel and without paper behind the scene, or\nwith =paper without any "
            "bare paper")
        ->type_name("[=MODE]");
}

void TransparentOption::assign(std::vector<std::string>& assignments) const
{
    if (mode_.empty()) {
        return;
    }
    const std::string mode = mode_ == "true" ? "background" : mode_; // typed without a mode
    constexpr std::array modes{"none", "background", "paper"};
    if (std::ranges::find(modes, mode) == modes.end()) {
        throw UsageError(fmt::format("cannot make {} transparent", in_quotes(mode)), "--transparent",
                         "allowed: background, paper, none");
    }
    assignments.insert(assignments.begin(), "paper.transparent=" + mode);
}

bool is_transparent(const Style& style)
{
    return style.tables().paper.transparent != paper::Transparency::none;
}

void check_has_alpha(const DrawOptions& draw, const PictureChoice& picture, bool is_film)
{
    if (!is_transparent(draw.style)) {
        return;
    }
    if (is_film && lower_extension(draw.output) == ".mp4") {
        throw UsageError("H.264 in .mp4 has no alpha channel for transparent paper", "-o " + draw.output,
                         "write .webm, .gif or numbered frames such as frames/%04d.png");
    }
    if (!is_film && picture.format == PictureFormat::jpeg) {
        throw UsageError("JPEG has no alpha channel for transparent paper", "-o " + draw.output,
                         "write PNG, WebP, OpenEXR or OpenRaster");
    }
}

} // namespace estampe::app
