// SPDX-License-Identifier: MIT
// What a renderer tells of the last picture.
#include <optional>
#include <string>
#include <vector>

#include "frame/renderer_impl.hpp"

namespace estampe {

const Motion& Renderer::motion() const
{
    return impl_->motion;
}

const std::vector<std::string>& Renderer::notes() const
{
    return impl_->notes;
}

double Renderer::gpu_ms() const
{
    return impl_->executor.gpu_ms();
}

const std::vector<PassTiming>& Renderer::timings() const
{
    return impl_->executor.timings();
}

std::vector<SolverReport> Renderer::solver_reports() const
{
    std::vector<SolverReport> reports = impl_->features.smoke.solver_reports();
    if (const std::optional<SolverReport>& of_ink = impl_->features.ink.solver_report()) {
        reports.push_back(*of_ink);
    }
    return reports;
}

uint64_t Renderer::device_memory_bytes() const
{
    return impl_->device.memory().used_bytes();
}

std::string Renderer::graph_dot() const
{
    return gpu::to_dot(impl_->drawn, gpu::compile(impl_->drawn));
}

} // namespace estampe
