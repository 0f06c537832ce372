// SPDX-License-Identifier: MIT
#include "lab/roofline/roofline.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "gpu/graph/run_watch.hpp"

namespace estampe::lab::roofline {
namespace {

/// What was found of all passes of one name in one frame.
struct FrameCost {
    double ms = 0.0;
    uint64_t bytes = 0;
    std::optional<uint64_t> operations = 0;
};

using Frame = std::map<std::string, FrameCost>;

void add(Frame& frame, const gpu::PassWork& pass)
{
    FrameCost& cost = frame[pass.name];
    cost.ms += pass.ms;
    cost.bytes += pass.bytes;
    cost.operations = cost.operations && pass.operations ? std::optional(*cost.operations + *pass.operations)
                                                         : std::nullopt;
}

/// Watches all runs for as long as it lives.
class Watch {
public:
    explicit Watch(Frame& frame)
    {
        gpu::watch_runs([&frame](std::span<const gpu::PassWork> passes) {
            for (const gpu::PassWork& pass : passes) {
                add(frame, pass);
            }
        });
    }

    ~Watch() { gpu::watch_runs({}); }

    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;
};

std::vector<Frame> draw(Renderer& renderer, const BenchPicture& picture, uint32_t frames)
{
    renderer.set_scene(picture.scene);
    const uint32_t warm_up = renderer.device().software ? 1 : 12;
    std::vector<Frame> drawn;
    for (uint32_t i = 0; i < warm_up + frames; ++i) {
        RenderSettings settings{.width = picture.width, .height = picture.height};
        if (picture.moves) {
            settings.time_s = i / 60.0;
            settings.continuity = i == 0 ? Continuity::starts : Continuity::follows;
        }
        if (i < warm_up) {
            static_cast<void>(renderer.render(picture.camera, picture.style, settings));
            continue;
        }
        Frame frame;
        const Watch watch(frame);
        static_cast<void>(renderer.render(picture.camera, picture.style, settings));
        drawn.push_back(std::move(frame));
    }
    return drawn;
}

PictureCost cost_of(const Entry& entry, const std::vector<Frame>& frames, double least_share)
{
    PictureCost picture{.name = entry.name, .about = entry.about, .passes = {}};
    for (const auto& [name, last] : frames.back()) {
        std::vector<double> times_ms;
        for (const Frame& frame : frames) {
            const auto found = frame.find(name);
            times_ms.push_back(found == frame.end() ? 0.0 : found->second.ms);
        }
        picture.passes.push_back(
            {.name = name, .ms = spread_of(times_ms), .bytes = last.bytes, .operations = last.operations});
        picture.ms += picture.passes.back().ms.median;
    }
    for (PassCost& pass : picture.passes) {
        pass.share = pass.ms.median / std::max(picture.ms, 1e-9);
    }
    std::erase_if(picture.passes, [&](const PassCost& pass) { return pass.share < least_share; });
    std::ranges::stable_sort(picture.passes, std::ranges::greater{}, &PassCost::share);
    return picture;
}

} // namespace

Result measure(const std::vector<const Entry*>& entries, const Plan& plan,
               const std::function<void(const Entry&)>& on_picture)
{
    Result result{.width = plan.width, .height = plan.height, .frames = plan.frames, .pictures = {}};
    {
        gpu::Device device(plan.device);
        result.device = device.info().name;
        result.driver = device.info().driver;
        result.software = device.info().software;
        result.ceilings = measure_ceilings(device, 9);
    }
    for (const Entry* const entry : entries) {
        on_picture(*entry);
        Renderer renderer(plan.device);
        const BenchPicture picture = entry->picture(result.software, plan.width, plan.height);
        result.pictures.push_back(cost_of(*entry, draw(renderer, picture, plan.frames), plan.least_share));
    }
    return result;
}

double share_of_copy(const PassCost& pass, const Ceilings& ceilings)
{
    return static_cast<double>(pass.bytes) / std::max(1e-3 * pass.ms.median, 1e-12) / ceilings.bytes_a_s;
}

std::optional<double> share_of_arithmetic(const PassCost& pass, const Ceilings& ceilings)
{
    if (!pass.operations) {
        return std::nullopt;
    }
    return static_cast<double>(*pass.operations) / std::max(1e-3 * pass.ms.median, 1e-12) /
           ceilings.operations_a_s;
}

} // namespace estampe::lab::roofline
