// SPDX-License-Identifier: MIT
#include "pass_history.hpp"

#include <algorithm>

namespace estampe::app {

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

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
        result[i].gpu_ms = median(times_[i]);
    }
    return result;
}

} // namespace estampe::app
