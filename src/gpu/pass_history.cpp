// SPDX-License-Identifier: MIT
#include "gpu/pass_history.hpp"

#include "core/spread.hpp"

namespace estampe::gpu {

void PassHistory::add(const std::vector<PassTiming>& passes)
{
    if (passes.size() != times_.size()) {
        times_.assign(passes.size(), {});
    }
    for (size_t i = 0; i < passes.size(); ++i) {
        times_[i].push_back(passes[i].gpu_ms);
    }
    last_ = passes;
}

std::vector<PassTiming> PassHistory::medians() const
{
    std::vector<PassTiming> result = last_;
    for (size_t i = 0; i < result.size(); ++i) {
        result[i].gpu_ms = median_of(times_[i]);
    }
    return result;
}

} // namespace estampe::gpu
