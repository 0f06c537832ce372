// SPDX-License-Identifier: MIT
#include <estampe/film.hpp>

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "core/file.hpp"
#include "output/child.hpp"

namespace estampe {
namespace {

struct Codec {
    const char* container;
    std::vector<std::string> arguments;
    /// The picture's sides must be even, because chroma is stored per 2 x 2 pixels.
    bool wants_even_sides = false;
    /// Arguments for films with alpha, used instead of `arguments`; empty: the format has no alpha.
    std::vector<std::string> with_alpha = {};
};

/// Returns the codec settings for a film's file extension. With these settings, files contain no dates,
/// program names or other data that differ between runs.
const Codec* codec_of(const std::filesystem::path& path)
{
    static const std::string video_filter =
        "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd,format=yuv";
    static const std::vector<std::string> tags{"-colorspace", "bt709",        "-color_primaries", "bt709",
                                               "-color_trc",  "iec61966-2-1", "-color_range",     "tv",
                                               "-flags:v",    "+bitexact"};
    const auto video = [&](std::vector<std::string> arguments, const char* planes) {
        arguments.insert(arguments.end(), {"-vf", video_filter + planes});
        arguments.insert(arguments.end(), tags.begin(), tags.end());
        return arguments;
    };
    static const std::vector<std::string> vp9{"-c:v",      "libvpx-vp9", "-b:v",      "0", "-crf",    "22",
                                              "-deadline", "good",       "-cpu-used", "4", "-row-mt", "1"};
    // The setting turns off VP9's hidden frames, which are not allowed with a separate alpha stream.
    std::vector<std::string> vp9_of_alpha = vp9;
    vp9_of_alpha.insert(vp9_of_alpha.end(), {"-auto-alt-ref", "0", "-metadata:s:v:0", "alpha_mode=1"});
    static const std::map<std::string, Codec> codecs{
        {".mp4",
         {"mp4",
          video({"-c:v", "libx264", "-preset", "veryfast", "-crf", "16", "-tune", "animation", "-movflags",
                 "+faststart"},
                "420p"),
          true}},
        {".webm", {"webm", video(vp9, "420p"), true, video(vp9_of_alpha, "a420p")}},
        {".gif",
         {"gif",
          {"-vf", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer:bayer_scale=4"},
          false,
          {"-vf",
           "split[a][b];[a]palettegen=stats_mode=full:reserve_transparent=1[p];[b][p]paletteuse=dither=bayer:"
           "bayer_scale=4:alpha_threshold=128"}}},
    };
    const auto found = codecs.find(lower_extension(path));
    return found == codecs.end() ? nullptr : &found->second;
}

std::vector<std::string> command_for(const Codec& codec, const std::filesystem::path& to, uint32_t width_px,
                                     uint32_t height_px, double frames_per_s, bool has_alpha)
{
    const std::vector<std::string>& arguments = has_alpha ? codec.with_alpha : codec.arguments;
    std::vector<std::string> command{"ffmpeg",     "-nostdin",
                                     "-v",         "error",
                                     "-f",         "rawvideo",
                                     "-pix_fmt",   "rgba",
                                     "-s",         fmt::format("{}x{}", width_px, height_px),
                                     "-framerate", fmt::format("{:.6g}", frames_per_s),
                                     "-i",         "pipe:0",
                                     "-an",        "-map_metadata",
                                     "-1",         "-fflags",
                                     "+bitexact"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.insert(command.end(), {"-f", codec.container, "-y", "file:" + to.string()});
    return command;
}

/// Returns the image with even width and height. If the number of rows or columns is odd, the last one is
/// doubled.
Image with_even_sides(const Image& image)
{
    Image even{.width = image.width + image.width % 2, .height = image.height + image.height % 2};
    even.rgba.resize(4ULL * even.width * even.height);
    for (uint32_t y = 0; y < even.height; ++y) {
        const auto row = image.rgba.begin() + 4LL * image.width * std::min(y, image.height - 1);
        const auto to = std::copy_n(row, 4LL * image.width, even.rgba.begin() + 4LL * even.width * y);
        if (even.width > image.width) {
            std::copy_n(row + 4LL * (image.width - 1), 4, to);
        }
    }
    return even;
}

} // namespace

bool is_film(const std::filesystem::path& path)
{
    return codec_of(path) != nullptr;
}

struct FilmWriter::Impl {
    Impl(const std::filesystem::path& path, const Codec& codec, uint32_t width, uint32_t height,
         double frames_per_s, bool has_alpha)
        : name(path.string()), width_px(width), height_px(height), has_even_sides(codec.wants_even_sides),
          file(AtomicFile::file(path)),
          encoder(command_for(codec, file.path(), width + (has_even_sides ? width % 2 : 0),
                              height + (has_even_sides ? height % 2 : 0), frames_per_s, has_alpha),
                  "films are written by ffmpeg: install Debian's package of that name")
    {
    }

    /// Throws the error of ffmpeg. Call this function after the encoder has ended.
    [[noreturn]] void fail() const { throw Error("ffmpeg cannot write the film", name, encoder.complaint()); }

    std::string name;
    uint32_t width_px;
    uint32_t height_px;
    bool has_even_sides;
    AtomicFile file;
    output::Child encoder;
    bool has_frames = false;
};

FilmWriter::FilmWriter(const std::filesystem::path& path, uint32_t width_px, uint32_t height_px,
                       double frames_per_s, bool has_alpha)
{
    const Codec* const codec = codec_of(path);
    if (codec == nullptr) {
        throw Error("a film's name ends in .mp4, .webm or .gif", path.string());
    }
    if (width_px == 0 || height_px == 0) {
        throw Error("a film without a size cannot be written", path.string());
    }
    if (!(frames_per_s >= 0.1 && frames_per_s <= 1000.0)) {
        throw Error(fmt::format("a film of {} frames a second cannot be written", frames_per_s),
                    path.string(), "0.1 to 1000 are allowed");
    }
    if (has_alpha && codec->with_alpha.empty()) {
        throw Error("such a film has no alpha channel", path.string(), "write .webm or .gif");
    }
    impl_ = std::make_unique<Impl>(path, *codec, width_px, height_px, frames_per_s, has_alpha);
}

FilmWriter::~FilmWriter() = default;

FilmWriter::FilmWriter(FilmWriter&&) noexcept = default;

FilmWriter& FilmWriter::operator=(FilmWriter&&) noexcept = default;

void FilmWriter::add(const Image& frame)
{
    if (frame.width != impl_->width_px || frame.height != impl_->height_px ||
        frame.rgba.size() != 4ULL * frame.width * frame.height) {
        throw Error(fmt::format("a frame of {} x {} pixels does not fit a film of {} x {}", frame.width,
                                frame.height, impl_->width_px, impl_->height_px),
                    impl_->name);
    }
    impl_->has_frames = true;
    const bool is_odd = impl_->has_even_sides && (frame.width % 2 != 0 || frame.height % 2 != 0);
    const Image even = is_odd ? with_even_sides(frame) : Image();
    if (!impl_->encoder.write(std::as_bytes(std::span(is_odd ? even.rgba : frame.rgba)))) {
        static_cast<void>(impl_->encoder.finish());
        impl_->fail();
    }
}

void FilmWriter::finish()
{
    if (!impl_->has_frames) {
        throw Error("a film without frames cannot be written", impl_->name);
    }
    if (!impl_->encoder.finish()) {
        impl_->fail();
    }
    impl_->file.publish();
}

} // namespace estampe
