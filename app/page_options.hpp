// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace estampe::app {

/// How large a picture is.
struct PageSize {
    uint32_t width = 1280; ///< pixels
    uint32_t height = 720;
    std::optional<double> width_mm;      ///< of a page in millimetres, exactly
    std::optional<double> height_mm;     ///< of a page in millimetres, which millimetres of the style are of
    std::optional<double> dots_per_inch; ///< of such a page, for the file to tell
};

/// The options that say how large a picture is: in pixels, or as a page and how finely it is printed.
class PageOptions {
public:
    /// Adds --size to the command, and the others where it draws pictures `for_print`; this object must
    /// outlive the parsing.
    void add_to(CLI::App& command, bool for_print);

    /// What was typed. Throws UsageError for a mistake in it.
    [[nodiscard]] PageSize read() const;

private:
    std::string size_;
    std::string page_;
    std::optional<double> dots_per_inch_;
    bool landscape_ = false;
};

} // namespace estampe::app
