// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include <estampe/film.hpp>

#include "viewer/picture_thread.hpp"
#include "viewer/take.hpp"

namespace estampe::viewer {

/// The first of "fox-001.png", "fox-002.png", ... in the working directory that is not there.
[[nodiscard]] std::string free_name(const std::string& scene, const std::string& extension);

/// Draws the view once more, as estampe render would, and writes it as PNG.
class ScreenshotJob : public PictureJob {
public:
    ScreenshotJob(PictureRequest request, std::string path)
        : request_(std::move(request)), path_(std::move(path))
    {
    }

    bool step(Renderer& renderer, const std::function<void(PictureNews)>& tell) override;

private:
    PictureRequest request_;
    std::string path_;
};

/// Draws a take as a film, a frame a step.
class FilmJob : public PictureJob {
public:
    FilmJob(Take take, RenderSettings settings, std::string path);

    bool step(Renderer& renderer, const std::function<void(PictureNews)>& tell) override;

private:
    Take take_;
    RenderSettings settings_;
    std::string path_;
    uint32_t next_ = 0;
    uint32_t count_;
    std::optional<FilmWriter> writer_;
};

} // namespace estampe::viewer
