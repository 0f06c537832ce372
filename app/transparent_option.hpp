// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "options.hpp"

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// The option --transparent, which sets paper.transparent.
class TransparentOption {
public:
    /// Adds it to the command; this object must outlive the parsing.
    void add_to(CLI::App& command);

    /// Puts what was typed before `assignments` of the style, which go over it. Throws UsageError for a word
    /// that it does not take.
    void assign(std::vector<std::string>& assignments) const;

private:
    std::string mode_;
};

/// Whether pictures in this style have an alpha channel.
[[nodiscard]] bool is_transparent(const Style& style);

/// Throws UsageError where the style's paper is transparent and the picture or film is written as a format
/// without alpha, naming those that have it.
void check_has_alpha(const DrawOptions& draw, const PictureChoice& picture, bool is_film);

} // namespace estampe::app
