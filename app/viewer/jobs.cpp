// SPDX-License-Identifier: MIT
#include "viewer/jobs.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "clock.hpp"

namespace estampe::viewer {
namespace {

constexpr double frames_per_s = 24.0;

} // namespace

std::string free_name(const std::string& scene, const std::string& extension)
{
    const std::string stem = std::filesystem::path(scene).stem().string();
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}-{:03}{}", stem, number, extension);
        std::error_code problem;
        if (!std::filesystem::exists(name, problem)) {
            return name;
        }
    }
}

bool ScreenshotJob::step(Renderer& renderer, app::WorldAnimator& animator,
                         const std::function<void(PictureNews)>& tell)
{
    const Style style = animator.show(renderer, request_.style, request_.settings.time_s, request_.camera);
    const Image image = renderer.render(request_.camera, style, request_.settings);
    save_png(image, path_);
    tell(JobNews{fmt::format("wrote {}, {} x {}", path_, image.width, image.height)});
    return false;
}

FilmJob::FilmJob(Take take, std::shared_ptr<const LoadedFile> file, std::optional<double> end_s,
                 RenderSettings settings, std::string path)
    : take_(std::move(take)), file_(std::move(file)), end_s_(end_s), settings_(settings),
      path_(std::move(path)),
      count_(std::max(1U, static_cast<uint32_t>(std::lround(take_.length_s() * frames_per_s))))
{
}

void FilmJob::begin(const app::WorldAnimator& seen)
{
    writer_.emplace(path_, settings_.width, settings_.height, frames_per_s,
                    std::filesystem::path(path_).extension() == ".webm");
    animator_ = std::make_unique<app::WorldAnimator>(file_->draw, file_->scene, worlds::Occasion::walk);
    if (end_s_) {
        animator_->end_at(*end_s_);
    }
    if (seen.has_left_ground()) {
        animator_->leave_ground();
    }
}

bool FilmJob::step(Renderer& renderer, app::WorldAnimator& animator,
                   const std::function<void(PictureNews)>& tell)
{
    if (!writer_) {
        begin(animator);
    }
    const Take::Sample sample = take_.at(next_ / frames_per_s);
    settings_.time_s = sample.time_s;
    settings_.animation = sample.animation;
    settings_.continuity = next_ == 0 ? Continuity::starts : Continuity::follows;
    const app::Clock::time_point start = app::Clock::now();
    const Style style = animator_->show(renderer, *sample.style, settings_.time_s, sample.camera);
    Image image = renderer.render(sample.camera, style, settings_);
    const double drawn_s = app::seconds_since(start);
    writer_->add(image);
    ++next_;
    tell(JobNews{fmt::format("Drawing frame {} of {}", next_, count_), static_cast<double>(next_) / count_,
                 false});
    tell(Picture{.image = std::move(image), .continuity = settings_.continuity, .seconds = drawn_s});
    if (next_ < count_) {
        return true;
    }
    writer_->finish();
    tell(JobNews{fmt::format("wrote {}, {} frames", path_, count_)});
    return false;
}

} // namespace estampe::viewer
