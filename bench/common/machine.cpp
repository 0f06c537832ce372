// SPDX-License-Identifier: MIT
#include "common/machine.hpp"

#include "common/rounds.hpp"

namespace estampe::bench {

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
