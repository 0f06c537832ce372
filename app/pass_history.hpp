// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/renderer.hpp>

namespace estampe::app {

/// Of at least one value.
[[nodiscard]] double median(std::vector<double> values);

/// GPU times of frames, by pass. A frame with other passes than the ones before makes it forget those.
class PassHistory {
public:
    void add(const std::vector<PassTiming>& passes);

    void forget() { times_.clear(); }

    [[nodiscard]] std::vector<PassTiming> medians() const;

private:
    std::vector<std::vector<double>> times_;
    std::vector<PassTiming> last_;
};

} // namespace estampe::app
