// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <estampe/image.hpp>

namespace estampe {

/// Whether a name ends as a film does: .mp4, .webm or .gif.
[[nodiscard]] bool is_film(const std::filesystem::path& path);

/// Writes a film while its frames are drawn, by the program ffmpeg: H.264 in .mp4, VP9 in .webm, both with
/// 4:2:0 colour by Rec. 709, and .gif with a palette of its own. The same frames give the same bytes on the
/// same machine. It is written beside `path` and gets its name when it is whole.
class FilmWriter {
public:
    /// Starts ffmpeg. With `has_alpha` the film is as transparent as its frames: .webm has a plane of alpha,
    /// .gif shows or hides each pixel; without, alpha is left out. Throws Error when there is no such
    /// program, and for a name that is_film() does not know, a picture rate that is not 0.1 to 1000, a folder
    /// that cannot be written, or alpha in .mp4, which has none.
    FilmWriter(const std::filesystem::path& path, uint32_t width_px, uint32_t height_px, double frames_per_s,
               bool has_alpha = false);
    ~FilmWriter();
    FilmWriter(FilmWriter&&) noexcept;
    FilmWriter& operator=(FilmWriter&&) noexcept;
    FilmWriter(const FilmWriter&) = delete;
    FilmWriter& operator=(const FilmWriter&) = delete;

    /// The next frame. Waits while the encoder is behind. Sides that are odd are doubled by a row or column
    /// of their last pixels, which H.264 and VP9 want. Throws Error when the frame has another size, and, in
    /// the words of ffmpeg, when that failed. Cost: a copy of the pixels; .gif is held in memory until the
    /// end.
    void add(const Image& frame);

    /// Ends the film and gives it its name. Throws Error as add() does, and when there was no frame.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
