// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <estampe/renderer.hpp>

namespace estampe::gpu {

/// GPU times of frames, per pass. A frame whose number of passes differs discards the frames before it.
class PassHistory {
public:
    void add(const std::vector<PassTiming>& passes);

    void forget()
    {
        times_.clear();
        last_.clear();
    }

    [[nodiscard]] std::vector<PassTiming> medians() const;

private:
    std::vector<std::vector<double>> times_;
    std::vector<PassTiming> last_;
};

} // namespace estampe::gpu
