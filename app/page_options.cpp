// SPDX-License-Identifier: MIT
#include "page_options.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/text.hpp"
#include "option_values.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

constexpr double inch_mm = 25.4;
constexpr double usual_dots_per_inch = 300.0;

struct Millimetres {
    double width = 0.0;
    double height = 0.0;
};

struct NamedPage {
    const char* name;
    Millimetres size;
};

/// Upright.
constexpr std::array named_pages{NamedPage{"a0", {841.0, 1189.0}},   NamedPage{"a1", {594.0, 841.0}},
                                 NamedPage{"a2", {420.0, 594.0}},    NamedPage{"a3", {297.0, 420.0}},
                                 NamedPage{"a4", {210.0, 297.0}},    NamedPage{"a5", {148.0, 210.0}},
                                 NamedPage{"a6", {105.0, 148.0}},    NamedPage{"letter", {215.9, 279.4}},
                                 NamedPage{"legal", {215.9, 355.6}}, NamedPage{"tabloid", {279.4, 431.8}}};

std::optional<double> number_in(std::string_view text)
{
    double number = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data(), end, number);
    return problem == std::errc{} && stop == end ? std::optional(number) : std::nullopt;
}

/// "210x297mm"
std::optional<Millimetres> typed_page(std::string_view text)
{
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos || !text.ends_with("mm")) {
        return std::nullopt;
    }
    const auto width = number_in(text.substr(0, cross));
    const auto height = number_in(text.substr(cross + 1, text.size() - cross - 3));
    return width && height ? std::optional(Millimetres{*width, *height}) : std::nullopt;
}

Millimetres parse_page(const std::string& text)
{
    std::string low = text;
    std::ranges::transform(low, low.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto* const named =
        std::ranges::find_if(named_pages, [&](const NamedPage& page) { return page.name == low; });
    const std::optional<Millimetres> page =
        named != named_pages.end() ? std::optional(named->size) : typed_page(low);
    if (!page) {
        throw UsageError(fmt::format("{} is not a page", in_quotes(text)), "--page",
                         "write A0 to A6, letter, legal, tabloid, or a size such as 210x297mm");
    }
    constexpr double least_mm = 10.0;
    constexpr double most_mm = 5000.0; // as paper.height_mm
    const auto [shorter, longer] = std::minmax(page->width, page->height);
    if (!(shorter >= least_mm && longer <= most_mm)) {
        throw UsageError(fmt::format("{} is out of range", text), "--page",
                         fmt::format("each side may have {} to {} mm", least_mm, most_mm));
    }
    return *page;
}

uint32_t pixels_of(double mm, double dots_per_inch)
{
    return static_cast<uint32_t>(std::max(std::lround(mm / inch_mm * dots_per_inch), 1L));
}

} // namespace

void PageOptions::add_to(CLI::App& command, bool for_print)
{
    command.add_option("--size", size_, "Width and height in pixels [1280x720]")->type_name("WxH");
    if (!for_print) {
        return;
    }
    command
        .add_option("--page", page_,
                    "In place of --size: A0 to A6, letter, legal, tabloid, or such as\n"
                    "210x297mm; millimetres of the style are then of that page")
        ->type_name("PAGE");
    command.add_option("--dpi", dots_per_inch_, "Pixels an inch of the page [300]")->type_name("N");
    command.add_flag("--landscape", landscape_, "Lay the longer side of the page across");
}

PageSize PageOptions::read() const
{
    PageSize size;
    if (page_.empty()) {
        if (dots_per_inch_ || landscape_) {
            throw UsageError("goes with --page alone", dots_per_inch_ ? "--dpi" : "--landscape",
                             "name a page, such as --page A4");
        }
        if (!size_.empty()) {
            std::tie(size.width, size.height) = parse_size(size_);
        }
        return size;
    }
    if (!size_.empty()) {
        throw UsageError("does not go with --size", "--page", "--dpi says how many pixels a page has");
    }
    const double dots_per_inch = dots_per_inch_.value_or(usual_dots_per_inch);
    if (!(dots_per_inch >= 1.0 && dots_per_inch <= 10000.0)) {
        throw UsageError("is not 1 to 10000", "--dpi");
    }
    Millimetres page = parse_page(page_);
    if (landscape_ && page.width < page.height) {
        std::swap(page.width, page.height);
    }
    size.width = pixels_of(page.width, dots_per_inch);
    size.height = pixels_of(page.height, dots_per_inch);
    size.width_mm = page.width;
    size.height_mm = page.height;
    size.dots_per_inch = dots_per_inch;
    if (std::max(size.width, size.height) > largest_side_px) {
        throw UsageError(
            fmt::format("{} has {} x {} pixels at {} dpi", page_, size.width, size.height, dots_per_inch),
            "--dpi", fmt::format("each side may have 1 to {} pixels", largest_side_px));
    }
    return size;
}

} // namespace estampe::app
