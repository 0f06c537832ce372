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

    bool step(Renderer& renderer, app::WorldAnimator& animator,
              const std::function<void(PictureNews)>& tell) override;

private:
    PictureRequest request_;
    std::string path_;
};

/// Draws a take as a film, a frame a step.
class FilmJob : public PictureJob {
public:
    /// A world is animated from its beginning again; `end_s` is when the walker reached the end of the world.
    FilmJob(Take take, std::shared_ptr<const LoadedFile> file, std::optional<double> end_s,
            RenderSettings settings, std::string path);

    bool step(Renderer& renderer, app::WorldAnimator& animator,
              const std::function<void(PictureNews)>& tell) override;

private:
    void begin(const app::WorldAnimator& seen);

    Take take_;
    std::shared_ptr<const LoadedFile> file_;
    std::optional<double> end_s_;
    std::unique_ptr<app::WorldAnimator> animator_; ///< since the first step
    RenderSettings settings_;
    std::string path_;
    uint32_t next_ = 0;
    uint32_t count_;
    std::optional<FilmWriter> writer_;
};

} // namespace estampe::viewer
