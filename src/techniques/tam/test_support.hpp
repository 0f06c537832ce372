// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <estampe/error.hpp>

#include "support/folder.hpp"
#include "techniques/tam/maker.hpp"

namespace estampe::tam::testing {

using test::Folder;

/// A map that is quick to draw.
inline TamStyle small_style(Tool tool = Tool::pen, int size_px = 128)
{
    TamStyle style;
    style.tool = tool;
    style.size_px = size_px;
    style.tones = 4;
    style.length_px = 60.0F;
    style.candidates = 16;
    style.second_from = 3;
    return style;
}

/// The map that is fastest to draw.
inline const TonalArtMap& small_map()
{
    static const TonalArtMap map = make_map(small_style(Tool::pen, 32));
    return map;
}

/// The message of the Error that `job` throws; empty if it throws none.
template <typename Job>
std::string message_of(Job job)
{
    try {
        job();
    } catch (const Error& problem) {
        return problem.what();
    }
    return {};
}

} // namespace estampe::tam::testing
