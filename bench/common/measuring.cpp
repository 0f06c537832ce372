// SPDX-License-Identifier: MIT
#include "common/measuring.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace estampe::bench {

double sum_ms(const std::vector<PassTiming>& passes)
{
    double sum = 0.0;
    for (const PassTiming& pass : passes) {
        sum += pass.gpu_ms;
    }
    return sum;
}

void Rounds::add(double ms, const std::vector<PassTiming>& passes)
{
    const bool is_slowest = times_ms_.empty() || ms >= most_ms();
    times_ms_.push_back(ms);
    if (is_slowest) {
        slowest_ms_.clear();
    }
    for (const PassTiming& pass : passes) {
        passes_ms_[pass.name] += pass.gpu_ms;
        if (is_slowest) {
            slowest_ms_[pass.name] += pass.gpu_ms;
        }
    }
}

double Rounds::mean_ms() const
{
    return std::accumulate(times_ms_.begin(), times_ms_.end(), 0.0) / static_cast<double>(times_ms_.size());
}

double Rounds::most_ms() const
{
    return std::ranges::max(times_ms_);
}

std::string Rounds::text() const
{
    const Spread spread = spread_of(times_ms_);
    return fmt::format("{:.3f} ms ({:.3f} to {:.3f})", spread.median, spread.low, spread.high);
}

std::string Rounds::passes_table() const
{
    std::vector<std::pair<double, std::string>> passes;
    for (const auto& [name, ms] : passes_ms_) {
        passes.emplace_back(ms / static_cast<double>(times_ms_.size()), name);
    }
    std::ranges::sort(passes, std::ranges::greater{});
    std::string table;
    for (const auto& [ms, name] : passes) {
        const auto slowest = slowest_ms_.find(name);
        table += fmt::format("  {:<32} {:>9.4f} ms, {:.4f} in the slowest round\n", name, ms,
                             slowest != slowest_ms_.end() ? slowest->second : 0.0);
    }
    return table;
}

Machine::Machine(const std::string& device_name)
    : device(RendererOptions{.device = device_name}), executor(device)
{
}

double Machine::run(const gpu::Graph& graph)
{
    const WallClock clock;
    executor.run(graph);
    return device.info().software ? clock.ms() : sum_ms(passes());
}

} // namespace estampe::bench
