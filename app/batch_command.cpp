// SPDX-License-Identifier: MIT
#include <algorithm>
#include <exception>
#include <new>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "batch_jobs.hpp"
#include "batch_report.hpp"
#include "clock.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "core/text.hpp"
#include "drawing.hpp"
#include "film.hpp"
#include "picture_output.hpp"
#include "progress.hpp"
#include "scene_details.hpp"
#include "signals.hpp"
#include "single_picture.hpp"
#include "warnings.hpp"

namespace estampe::app {
namespace {

/// The scene that the renderer has, kept for the jobs that come next.
class SceneKeeper {
public:
    explicit SceneKeeper(Renderer& renderer) : renderer_(renderer) {}

    /// The scene and the lightmap of these options. Throws Error when they cannot be read.
    [[nodiscard]] const Scene& ensure(const DrawOptions& draw)
    {
        if (is_there_ && load_the_same(draw, loaded_) && draw.lightmap == loaded_.lightmap) {
            return scene_;
        }
        is_there_ = false;
        scene_ = load_scene_of(draw);
        print_warnings(scene_.warnings);
        if (!draw.load.up) {
            print_notes(up_axis_notes(scene_, draw.scene));
        }
        set_scene(renderer_, scene_, draw);
        loaded_ = draw;
        is_there_ = true;
        return scene_;
    }

private:
    Renderer& renderer_;
    Scene scene_;
    DrawOptions loaded_; ///< what `scene_` was read for
    bool is_there_ = false;
};

JobResult draw_job(Renderer& renderer, SceneKeeper& scenes, const BatchJob& job,
                   const RendererOptions& device)
{
    const Clock::time_point start = Clock::now();
    JobResult result{.status = JobResult::Status::failed};
    try {
        const RenderCommand command = command_of(job, device);
        check_outputs(command);
        const Scene& scene = scenes.ensure(command.draw);
        if (command.film) {
            draw_film(renderer, scene, command);
        } else {
            draw_and_write(renderer, scene, command);
        }
        result.status = JobResult::Status::done;
    } catch (const std::bad_alloc&) {
        result.error = "out of memory; try a smaller size or scene";
    } catch (const std::exception& problem) {
        result.error = one_line(problem.what());
    }
    result.seconds = seconds_since(start);
    return result;
}

/// Throws Error where not all is well.
void conclude(const BatchCommand& command, const std::vector<JobResult>& results)
{
    const auto count = [&](JobResult::Status status) {
        return std::ranges::count(results, status, &JobResult::status);
    };
    const std::string remedy = fmt::format("{} tells which", command.report);
    if (const auto left = count(JobResult::Status::not_begun); left > 0) {
        throw Error(fmt::format("stopped with {} of {} jobs not begun", left, results.size()), command.jobs,
                    remedy);
    }
    if (const auto failed = count(JobResult::Status::failed); failed > 0) {
        throw Error(fmt::format("{} of {} jobs failed", failed, results.size()), command.jobs, remedy);
    }
}

} // namespace

void run(const BatchCommand& command)
{
    const std::vector<BatchJob> jobs = shard_of(read_jobs(command.jobs), command.shard, command.shards);
    check_output(command.report, {command.jobs});
    std::vector<JobResult> results(jobs.size());
    tell_of_signals();
    Renderer renderer(command.device);
    SceneKeeper scenes(renderer);
    Progress progress("batch", 0.0);
    // As it goes, so that it is there whatever ends the program.
    const auto report = [&] { write_report(command, renderer.device().name, jobs, results); };
    report();
    for (size_t i = 0; i < jobs.size() && !was_told_to_stop(); ++i) {
        progress.show(static_cast<double>(i) / static_cast<double>(jobs.size()),
                      fmt::format("job {} of {}", i + 1, jobs.size()));
        results[i] = draw_job(renderer, scenes, jobs[i], command.device);
        progress.clear();
        if (results[i].status == JobResult::Status::failed) {
            print_warnings({fmt::format("job {}: {}", jobs[i].number, results[i].error)});
        }
        report();
    }
    conclude(command, results);
}

} // namespace estampe::app
