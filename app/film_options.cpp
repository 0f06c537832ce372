// SPDX-License-Identifier: MIT
#include "film_options.hpp"

#include <charconv>

#include <CLI/CLI.hpp>

#include <estampe/film.hpp>

#include "core/file.hpp"
#include "film_frames.hpp"
#include "usage_error.hpp"

namespace estampe::app {
namespace {

constexpr uint32_t most_frames = 1000000;

/// A whole number of 1 to most_frames that is all of `text`, else 0.
uint32_t frame_number(std::string_view text)
{
    uint32_t number = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = problem == std::errc{} && end == text.data() + text.size();
    return is_number && number <= most_frames ? number : 0;
}

/// "48", or "25-48".
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

} // namespace

bool is_film_output(const std::string& output)
{
    return is_film(output) || is_numbered(output);
}

void FilmOptions::add_to(CLI::App& command)
{
    command
        .add_option(
            "--frames", frames_,
            "Film: how many frames, or the first and the last, as in 25-48\n[to the end of the animation]")
        ->type_name("N|A-B");
    command.add_option("--fps", frames_per_s_, "Film: frames a second [what the file was made for, else 24]")
        ->type_name("F");
    command.add_flag("--turntable", turntable_, "Film: go once around what is seen [in 5 s]");
    command.add_flag("--film", flies_,
                     "Film: a world's own film, along its own camera path\n[a camera that stands still]");
    command.add_flag("--resume", resume_, "Film: go on where an earlier run stopped");
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

} // namespace estampe::app
