// SPDX-License-Identifier: MIT
#include "picture_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/file.hpp"
#include "core/text.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

/// What a format is called, and what it can be.
struct FormatFacts {
    PictureFormat format;
    const char* extension; ///< what --format takes, after a dot
    const char* name;
    std::array<int, 2> depths; ///< bits a channel, the usual ones first; 0: none
    int least_quality;         ///< none: negative
    uint32_t longest_side_px;  ///< that it holds, beyond what a picture may have: 0
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
    command.add_option("--format", format_, "Of -o -: png, jpg, webp, exr, ora or svg [png]")
        ->type_name("NAME");
    command
        .add_option("--quality", quality_, "JPEG: 1 to 100 [92]. WebP: 0 to 100; without it nothing is\nlost")
        ->type_name("Q");
    command
        .add_option("--depth", depth_, "Bits a channel. PNG: 8 or 16 [8]. OpenEXR: 16 or 32, of floats\n[16]")
        ->type_name("BITS");
    command
        .add_option(
            "--layers", layers_,
            "Also write paper, wash, hatching and lines apart, with masks of\nobjects: PNG files in a "
            "new folder, or one .exr")
        ->type_name("DIR");
    command
        .add_option(
            "--layer", layer_,
            "Draw one layer or mask alone, on white: wash, hatch, lines, shadow,\nocclusion, clouds or "
            "an object's name")
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

} // namespace estampe::app
