// SPDX-License-Identifier: MIT
#include <filesystem>
#include <utility>

#include <estampe/bake.hpp>
#include <estampe/error.hpp>
#include <fmt/format.h>

#include "clock.hpp"
#include "commands.hpp"
#include "core/file.hpp"
#include "drawing.hpp"
#include "progress.hpp"
#include "signals.hpp"
#include "warnings.hpp"

namespace estampe::app {
namespace {

/// Works until all is done; false when a signal came first. What is done lies in `partial` then.
bool work_through(LightmapBake& bake, const std::filesystem::path& partial)
{
    constexpr double look_s = 0.5;
    constexpr double save_s = 5.0;
    Progress progress("bake", bake.done());
    Clock::time_point saved = Clock::now();
    bool has_more = true;
    while (has_more && !was_told_to_stop()) {
        progress.show(bake.done());
        has_more = bake.work(look_s);
        if (has_more && (was_told_to_stop() || seconds_since(saved) > save_s)) {
            bake.save_progress(partial);
            saved = Clock::now();
        }
    }
    progress.clear();
    return !has_more;
}

} // namespace

void run(const BakeCommand& command)
{
    check_output(command.output, {command.scene});
    const std::filesystem::path partial = command.output + ".partial";
    check_output(partial, {command.scene});
    DrawOptions draw;
    draw.scene = command.scene;
    draw.input_format = command.input_format;
    draw.load.up = command.up;
    draw.world = command.world;
    Scene scene = load_scene_of(draw);
    print_warnings(scene.warnings);
    LightmapBake bake(std::move(scene), command.style, command.settings);
    if (bake.leaves_out_moving()) {
        print_warnings(
            {fmt::format("{}: some of it moves; only what stands still is in the map", command.scene)});
    }
    if (command.resume && bake.load_progress(partial)) {
        print_notes(
            {fmt::format("goes on from {:.0f} %, found in {}", 100.0 * bake.done(), partial.string())});
    } else if (std::filesystem::exists(partial)) {
        print_notes({fmt::format("begins anew: {} is not taken up", partial.string())});
    }
    print_notes({fmt::format("{} texels of {} x {}, each {:.1f} mm wide", bake.texel_count(),
                             command.settings.size, command.settings.size, 1000.0 / bake.texels_per_m())});
    tell_of_signals();
    if (!work_through(bake, partial)) {
        throw Error(fmt::format("stopped at {:.0f} %", 100.0 * bake.done()), command.output,
                    "the same command goes on from there");
    }
    save_lightmap(bake.map(), command.output);
    std::filesystem::remove(partial);
}

} // namespace estampe::app
