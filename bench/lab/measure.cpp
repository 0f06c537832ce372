// SPDX-License-Identifier: MIT
#include "lab/measure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "common/rounds.hpp"
#include "gpu/pass_history.hpp"

namespace estampe::lab {
namespace {

/// Draws one picture again and again.
class Drawn {
public:
    Drawn(const RendererOptions& device, BenchPicture picture)
        : picture_(std::move(picture)), renderer_(device)
    {
        renderer_.set_scene(picture_.scene);
        draw(); // compiles and uploads
    }

    /// What was drawn so far does not count.
    void forget()
    {
        passes_.forget();
        gpu_ms_.clear();
        wall_ms_.clear();
    }

    void draw(bool by_passes = false)
    {
        RenderSettings settings{.width = picture_.width, .height = picture_.height};
        settings.time_passes = by_passes;
        if (picture_.moves) {
            settings.time_s = frame_ / 60.0;
            settings.continuity = frame_ == 0 ? Continuity::starts : Continuity::follows;
        }
        ++frame_;
        const bench::WallClock clock;
        static_cast<void>(renderer_.render(picture_.camera, picture_.style, settings));
        const double wall_ms = clock.ms();
        if (by_passes) {
            passes_.add(renderer_.timings());
        } else {
            wall_ms_.push_back(wall_ms);
            gpu_ms_.push_back(renderer_.gpu_ms());
        }
    }

    [[nodiscard]] BenchPoint point(double amount) const
    {
        return {.amount = amount,
                .gpu_ms = spread_of(gpu_ms_),
                .wall_ms = spread_of(wall_ms_),
                .memory_bytes = renderer_.device_memory_bytes(),
                .techniques = techniques()};
    }

    [[nodiscard]] const std::vector<double>& costs() const
    {
        return renderer_.device().software ? wall_ms_ : gpu_ms_;
    }

    [[nodiscard]] const DeviceInfo& device() const { return renderer_.device(); }

private:
    [[nodiscard]] std::vector<TechniqueCost> techniques() const
    {
        std::map<std::string, double> sums_ms;
        for (const PassTiming& pass : passes_.medians()) {
            sums_ms[pass.name.substr(0, pass.name.find('/'))] += pass.gpu_ms;
        }
        std::vector<TechniqueCost> costs;
        costs.reserve(sums_ms.size());
        for (const auto& [name, gpu_ms] : sums_ms) {
            costs.push_back({name, gpu_ms});
        }
        std::ranges::stable_sort(costs, std::ranges::greater{}, &TechniqueCost::gpu_ms);
        return costs;
    }

    BenchPicture picture_;
    Renderer renderer_;
    gpu::PassHistory passes_;
    std::vector<double> gpu_ms_;
    std::vector<double> wall_ms_;
    int frame_ = 0;
};

/// A GPU raises its clock only when it has had something to do for a while. What passes cost is asked in the
/// end, as a frame takes longer by that.
void draw_in_turn(Drawn& base, Drawn* other, uint32_t frames)
{
    const uint32_t warm_up = base.device().software ? 1 : 12;
    for (uint32_t frame = 0; frame < warm_up + frames; ++frame) {
        if (frame == warm_up) {
            base.forget();
            if (other != nullptr) {
                other->forget();
            }
        }
        base.draw();
        if (other != nullptr) {
            other->draw();
        }
    }
    constexpr uint32_t most_by_passes = 5;
    Drawn& asked = other != nullptr ? *other : base;
    for (uint32_t frame = 0; frame < std::min(frames, most_by_passes); ++frame) {
        asked.draw(true);
    }
}

} // namespace

const Spread& cost_of(const BenchPoint& point, bool software)
{
    return software ? point.wall_ms : point.gpu_ms;
}

double growth(const BenchSeries& series, size_t point, bool software)
{
    if (point == 0) {
        return 0.0;
    }
    const BenchPoint& before = series.points[point - 1];
    const BenchPoint& here = series.points[point];
    return std::log(cost_of(here, software).median / cost_of(before, software).median) /
           std::log(here.amount / before.amount);
}

BenchResult measure(const std::vector<const Series*>& series, const BenchPlan& plan,
                    const std::function<void(const Series&, double amount)>& on_point)
{
    BenchResult result{.width = plan.width, .height = plan.height, .frames = plan.frames};
    for (const Series* one : series) {
        BenchSeries measured{.name = one->name, .work = one->work};
        std::optional<Drawn> base;
        for (const double amount : one->amounts) {
            if (base && (amount > plan.most_share * one->amounts.back() ||
                         (result.software && amount > one->most_on_processor))) {
                break;
            }
            on_point(*one, amount);
            if (!base) {
                base.emplace(plan.device, one->picture(amount, plan.width, plan.height));
                result.device = base->device().name;
                result.driver = base->device().driver;
                result.software = base->device().software;
                draw_in_turn(*base, nullptr, plan.frames);
                measured.points.push_back(base->point(amount));
                continue;
            }
            Drawn here(plan.device, one->picture(amount, plan.width, plan.height));
            draw_in_turn(*base, &here, plan.frames);
            BenchPoint point = here.point(amount);
            point.ratio = median_of(here.costs()) / std::max(median_of(base->costs()), 1e-9);
            measured.points.push_back(std::move(point));
        }
        result.series.push_back(std::move(measured));
    }
    return result;
}

} // namespace estampe::lab
