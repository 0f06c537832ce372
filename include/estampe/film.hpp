// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include <estampe/image.hpp>

namespace estampe {

/// Returns whether the file name has the extension of a film: .mp4, .webm or .gif.
[[nodiscard]] bool is_film(const std::filesystem::path& path);

/// Encodes a film frame by frame with the program ffmpeg: H.264 in .mp4, VP9 in .webm, both with 4:2:0 colour
/// by Rec. 709; or .gif, with a palette that is computed from the film. The same frames give the same bytes
/// on the same machine. The film is written to a temporary file beside `path`, and renamed when it is
/// complete.
class FilmWriter {
public:
    /// Starts ffmpeg. `has_alpha` keeps the transparency of the frames: .webm stores an alpha plane, .gif
    /// shows or hides each pixel. Without `has_alpha`, alpha is ignored. Throws Error if ffmpeg is not
    /// installed, if is_film() is false for `path`, if the frame rate is not in 0.1 to 1000, if the folder is
    /// not writable, or if alpha is requested for .mp4, which has none.
    FilmWriter(const std::filesystem::path& path, uint32_t width_px, uint32_t height_px, double frames_per_s,
               bool has_alpha = false);
    ~FilmWriter();
    FilmWriter(FilmWriter&&) noexcept;
    FilmWriter& operator=(FilmWriter&&) noexcept;
    FilmWriter(const FilmWriter&) = delete;
    FilmWriter& operator=(const FilmWriter&) = delete;

    /// Adds the next frame of the film; waits while the encoder is behind. H.264 and VP9 require even sizes,
    /// so the last row or column of an odd size is doubled. Throws Error if the frame has another size than
    /// the film, or with ffmpeg's message if ffmpeg failed. Cost: one copy of the pixels; a .gif is kept in
    /// memory until finish().
    void add(const Image& frame);

    /// Completes the film's file and renames it to its final name. Throws Error for the same reasons as
    /// add(), and if no frame was added.
    void finish();

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace estampe
