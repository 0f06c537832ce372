// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <estampe/film.hpp>

#include "core/file.hpp"
#include "core/text.hpp"
#include "features/common/style_tables.hpp"
#include "film_frames.hpp"
#include "option_values.hpp"

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

/// Page sizes in portrait orientation, in millimetres.
constexpr std::array named_pages{NamedPage{"a0", {841.0, 1189.0}},   NamedPage{"a1", {594.0, 841.0}},
                                 NamedPage{"a2", {420.0, 594.0}},    NamedPage{"a3", {297.0, 420.0}},
                                 NamedPage{"a4", {210.0, 297.0}},    NamedPage{"a5", {148.0, 210.0}},
                                 NamedPage{"a6", {105.0, 148.0}},    NamedPage{"letter", {215.9, 279.4}},
                                 NamedPage{"legal", {215.9, 355.6}}, NamedPage{"tabloid", {279.4, 431.8}}};

/// Parses a page size in millimetres, such as "210x297mm".
std::optional<Millimetres> typed_page(std::string_view text)
{
    const size_t cross = text.find('x');
    if (cross == std::string_view::npos || !text.ends_with("mm")) {
        return std::nullopt;
    }
    const auto width = number_from<double>(text.substr(0, cross));
    const auto height = number_from<double>(text.substr(cross + 1, text.size() - cross - 3));
    return width && height ? std::optional(Millimetres{*width, *height}) : std::nullopt;
}

Millimetres parse_page(const std::string& text)
{
    const std::string low = lower_case(text);
    const auto* const named =
        std::ranges::find_if(named_pages, [&](const NamedPage& page) { return page.name == low; });
    const std::optional<Millimetres> page =
        named != named_pages.end() ? std::optional(named->size) : typed_page(low);
    if (!page) {
        throw UsageError(fmt::format("{} is not a page", in_quotes(text)), "--page",
                         "write A0 to A6, letter, legal, tabloid, or a size such as 210x297mm");
    }
    constexpr double least_mm = 10.0;
    constexpr double most_mm = 5000.0; // Largest page size, the same limit as for paper.height_mm
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
    command.add_option("--size", size_, "Width and height of the picture in pixels [1280x720]")
        ->type_name("WxH");
    if (!for_print) {
        return;
    }
    command
        .add_option("--page", page_,
                    "Paper size instead of --size, such as A4, letter or 210x297mm. Sizes\n"
                    "with a name are A0 to A6, letter, legal and tabloid. Millimetres of the\n"
                    "style then refer to this page.")
        ->type_name("PAGE");
    command.add_option("--dpi", dots_per_inch_, "Pixels per inch of the page that --page names [300]")
        ->type_name("N");
    command.add_flag("--landscape", landscape_,
                     "Turn the page that --page names so that its longer side is\n"
                     "horizontal");
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

namespace {

/// Returns the frame number that `text` contains, 1 to most_frames. Returns 0 if `text` is not a number in
/// the allowed range.
uint32_t frame_number(std::string_view text)
{
    const uint32_t number = number_from<uint32_t>(text).value_or(0);
    return number <= most_frames ? number : 0;
}

/// Reads a range of frames: "48" (all frames up to this number), or "25-48".
void read_range(const std::string& text, FilmChoice& film)
{
    const size_t dash = text.find('-');
    film.first = dash == std::string::npos ? 1 : frame_number(std::string_view(text).substr(0, dash));
    film.last = frame_number(std::string_view(text).substr(dash == std::string::npos ? 0 : dash + 1));
    if (film.first == 0 || film.last < film.first) {
        throw UsageError("is neither a number of frames nor the first and the last of them",
                         "--frames " + text, "write 48, or 25-48; the first frame is 1, the last 1000000");
    }
}

/// Returns whether `output` names a film, or pictures with numbers in their names ("frames/%04d.png").
bool is_film_output(const std::string& output)
{
    return is_film(output) || is_numbered(output);
}

} // namespace

void FilmOptions::add_to(CLI::App& command)
{
    command
        .add_option("--frames", frames_,
                    "Number of frames of a film, or its first and last frame, as in 25-48\n"
                    "[to the end of the animation]")
        ->type_name("N|A-B");
    command
        .add_option("--fps", frames_per_s_,
                    "Frames per second of a film [the frame rate of the scene's file,\n"
                    "else 24]")
        ->type_name("F");
    command.add_flag("--turntable", turntable_, "Film the scene on a turntable, once around [in 5 s]");
    command.add_flag("--film", flies_,
                     "Film a built-in world along its own camera path [the camera stands\n"
                     "still]");
    command.add_flag("--resume", resume_, "Continue a film where an earlier run stopped");
}

std::optional<FilmChoice> FilmOptions::read(const std::string& output) const
{
    if (!is_film_output(output)) {
        const char* const typed = !frames_.empty() ? "--frames"
                                  : frames_per_s_  ? "--fps"
                                  : turntable_     ? "--turntable"
                                  : flies_         ? "--film"
                                  : resume_        ? "--resume"
                                                   : nullptr;
        if (typed != nullptr) {
            throw UsageError("goes with films alone", typed,
                             "the name of the output must end in .mp4, .webm or .gif, or hold a number, as "
                             "frames/%04d.png does");
        }
        return std::nullopt;
    }
    if (is_numbered(output) && lower_extension(output) != ".png") {
        throw UsageError("numbered frames are PNG pictures", "-o " + output, "the name must end in .png");
    }
    if (flies_ && turntable_) {
        throw UsageError("is another way of the camera than --turntable", "--film");
    }
    FilmChoice film{.turntable = turntable_, .flies = flies_, .resume = resume_};
    if (!frames_.empty()) {
        read_range(frames_, film);
    }
    film.frames_per_s = frames_per_s_.value_or(film.frames_per_s);
    film.has_rate = frames_per_s_.has_value();
    if (!(film.frames_per_s >= 0.1 && film.frames_per_s <= 1000.0)) {
        throw UsageError("is not 0.1 to 1000", "--fps");
    }
    return film;
}

namespace {

/// Names and limits of a picture format.
struct FormatFacts {
    PictureFormat format;
    const char* extension; ///< Value of --format for this format, after a dot
    const char* name;
    /// Bits per channel that the format allows, the usual number first; an entry of 0 is unused.
    std::array<int, 2> depths;
    int least_quality; ///< Lowest value of the quality; negative: the format has no quality
    /// Longest side in pixels that the format allows; 0: the same limit as for all pictures.
    uint32_t longest_side_px;
};

constexpr std::array known_formats{
    FormatFacts{PictureFormat::png, ".png", "PNG", {8, 16}, -1, 0},
    FormatFacts{PictureFormat::jpeg, ".jpg", "JPEG", {8, 8}, 1, 0},
    FormatFacts{PictureFormat::jpeg, ".jpeg", "JPEG", {8, 8}, 1, 0},
    FormatFacts{PictureFormat::webp, ".webp", "WebP", {8, 8}, 0, 16383},
    FormatFacts{PictureFormat::exr, ".exr", "OpenEXR", {16, 32}, -1, 0},
    FormatFacts{PictureFormat::openraster, ".ora", "OpenRaster", {8, 8}, -1, 0},
    FormatFacts{PictureFormat::svg, ".svg", "SVG", {0, 0}, -1, 0}};

std::string known_extensions()
{
    std::vector<std::string> names;
    for (const FormatFacts& facts : known_formats) {
        if (facts.format != PictureFormat::svg) {
            names.emplace_back(facts.extension);
        }
    }
    return fmt::format(
        "the name must end in {}, in .svg for strokes, or in .mp4, .webm or .gif for films; or "
        "be -, for standard output",
        fmt::join(names, ", "));
}

const FormatFacts* facts_of(std::string_view extension)
{
    const auto* const found = std::ranges::find_if(
        known_formats, [&](const FormatFacts& facts) { return facts.extension == extension; });
    return found == known_formats.end() ? nullptr : found;
}

const FormatFacts& chosen_format(const std::string& output, const std::string& format)
{
    if (output == standard_output) {
        const FormatFacts* facts = facts_of(format.empty() ? ".png" : "." + format);
        if (facts == nullptr) {
            throw UsageError(fmt::format("cannot write a picture as {}", in_quotes(format)), "--format",
                             "allowed: png, jpg, webp, exr, ora, svg");
        }
        return *facts;
    }
    if (!format.empty()) {
        throw UsageError("goes with -o - alone", "--format", "elsewhere the name of the file tells");
    }
    const std::string extension = lower_extension(output);
    const FormatFacts* facts = facts_of(extension);
    if (facts == nullptr) {
        throw UsageError(extension.empty()
                             ? "tells no format"
                             : fmt::format("cannot write a picture as {}", in_quotes(extension)),
                         "-o " + output, known_extensions());
    }
    return *facts;
}

} // namespace

void PictureOptions::add_to(CLI::App& command)
{
    command
        .add_option("--format", format_,
                    "Picture format when writing to standard output. Formats are png, jpg,\n"
                    "webp, exr, ora and svg. [png]")
        ->type_name("NAME");
    command
        .add_option("--quality", quality_,
                    "Quality of JPEG, 1 to 100, or of WebP, 0 to 100 [JPEG 92, WebP\n"
                    "lossless]")
        ->type_name("Q");
    command
        .add_option("--depth", depth_,
                    "Bits per channel: PNG 8 or 16, OpenEXR 16 or 32 (floats) [PNG 8,\n"
                    "OpenEXR 16]")
        ->type_name("BITS");
    command
        .add_option("--layers", layers_,
                    "Also write the layers, as PNG files in a new folder or as one .exr. The\n"
                    "layers are paper, wash, hatching, lines and a mask of each object.")
        ->type_name("DIR");
    command
        .add_option("--layer", layer_,
                    "Draw only one layer, on white, such as lines, hatch or wash. Other\n"
                    "layers are shadow, occlusion, clouds, and the name of an object, which\n"
                    "draws its mask.")
        ->type_name("NAME");
}

PictureChoice PictureOptions::read(const std::string& output, uint32_t width, uint32_t height) const
{
    const FormatFacts& facts = chosen_format(output, format_);
    PictureChoice choice{.format = facts.format,
                         .depth = facts.depths[0],
                         .quality = quality_,
                         .layers = layers_,
                         .layer = layer_};
    if (!layer_.empty() &&
        (facts.format == PictureFormat::svg || facts.format == PictureFormat::openraster)) {
        throw UsageError(fmt::format("{} does not hold a layer alone", facts.name), "--layer",
                         "write PNG, JPEG, WebP or OpenEXR");
    }
    if (depth_) {
        if (*depth_ == 0 || std::ranges::find(facts.depths, *depth_) == facts.depths.end()) {
            throw UsageError(fmt::format("{} is no depth of {}", *depth_, facts.name), "--depth",
                             "PNG has 8 or 16 bits a channel, OpenEXR 16 or 32, all others 8");
        }
        choice.depth = *depth_;
    }
    if (layers_ == standard_output || (!layers_.empty() && layers_ == output)) {
        throw UsageError("needs a place of its own", "--layers",
                         "give a folder, or a name that ends in .exr");
    }
    if (quality_ && facts.least_quality < 0) {
        throw UsageError("goes with JPEG and WebP alone", "--quality", "leave it out");
    }
    if (quality_ && (*quality_ < facts.least_quality || *quality_ > 100)) {
        throw UsageError(fmt::format("{} is out of range", *quality_), "--quality",
                         fmt::format("of {} it is {} to 100", facts.name, facts.least_quality));
    }
    if (facts.longest_side_px > 0 && std::max(width, height) > facts.longest_side_px) {
        throw UsageError(
            fmt::format("{} holds no side of more than {} pixels", facts.name, facts.longest_side_px),
            "--size", "draw a smaller picture, or write PNG");
    }
    return choice;
}

PictureChoice PictureOptions::of_film() const
{
    const std::array<std::pair<const char*, bool>, 5> of_pictures{{{"--format", !format_.empty()},
                                                                   {"--layers", !layers_.empty()},
                                                                   {"--layer", !layer_.empty()},
                                                                   {"--quality", quality_.has_value()},
                                                                   {"--depth", depth_.has_value()}}};
    for (const auto& [option, is_given] : of_pictures) {
        if (is_given) {
            throw UsageError("goes with single pictures alone", option, "leave it out");
        }
    }
    return {};
}

void TransparentOption::add_to(CLI::App& command)
{
    command
        .add_flag("--transparent", mode_,
                  "Leave the paper behind the scene transparent, with an alpha channel.\n"
                  "--transparent=paper leaves all bare paper transparent.")
        ->type_name("[=MODE]");
}

void TransparentOption::assign(std::vector<std::string>& assignments) const
{
    if (mode_.empty()) {
        return;
    }
    const std::string mode = mode_ == "true" ? "background" : mode_; // The option was typed without a mode
    constexpr std::array modes{"none", "background", "paper"};
    if (std::ranges::find(modes, mode) == modes.end()) {
        throw UsageError(fmt::format("cannot make {} transparent", in_quotes(mode)), "--transparent",
                         "allowed: background, paper, none");
    }
    assignments.insert(assignments.begin(), "paper.transparent=" + mode);
}

bool is_transparent(const Style& style)
{
    features::StyleTables room;
    return features::with_drawing(style.tables(), room).paper.transparent != paper::Transparency::none;
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
