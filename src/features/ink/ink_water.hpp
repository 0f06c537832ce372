// SPDX-License-Identifier: MIT
#pragma once

// Water on the page that the given flow of ink stirs, and whose eddies carry the ink.

#include <memory>
#include <optional>
#include <vector>

#include <estampe/renderer.hpp>

#include "gpu/graph/execute.hpp"
#include "techniques/ink/ink.hpp"

namespace estampe::fluid {
class Fluid;
}

namespace estampe::features {

/// What of the water the next picture of a film takes from this one.
struct KeptWater {
    double time_s = 0.0;
    std::vector<float> velocity; ///< two numbers a cell
};

class InkWater {
public:
    InkWater();
    ~InkWater();
    InkWater(const InkWater&) = delete;
    InkWater& operator=(const InkWater&) = delete;

    /// Stirs for the time that passes for the ink, and tells the stream function after it as
    /// ink::add_stream() takes it. Water that is not that of `time.from_s` starts at rest, some seconds
    /// before. With `is_measured` solver_report() tells of it. Cost: a step of some 2,000 cells for each 24th
    /// of a second.
    [[nodiscard]] std::vector<float> stirred(gpu::Device& device, gpu::Executor& executor,
                                             const ink::InkStyle& style, const ink::Page& page,
                                             const ink::Time& time, const std::vector<shared::InkZone>& zones,
                                             bool is_measured = false);

    /// Of the last time that stirred() measured steps; none where it did not since.
    [[nodiscard]] const std::optional<SolverReport>& solver_report() const { return solver_report_; }

    void forget();

    [[nodiscard]] std::optional<KeptWater> kept(gpu::Device& device, gpu::Executor& executor);

    /// The next picture may go on from that, where its page is as large.
    void recall(KeptWater kept);

private:
    std::unique_ptr<fluid::Fluid> fluid_; ///< none until it is asked for
    std::optional<KeptWater> recalled_;
    std::optional<SolverReport> solver_report_;
    double time_s_ = 0.0;
};

} // namespace estampe::features
