// SPDX-License-Identifier: MIT
#include <cstdio>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "report.hpp"

namespace estampe::app {

void run(const DevicesCommand& command)
{
    const std::vector<DeviceInfo> devices = list_devices();
    if (devices.empty() && !command.json) {
        throw Error("no Vulkan driver is installed", {},
                    "install one; mesa-vulkan-drivers draws on the processor");
    }
    fmt::print("{}", report_devices(devices, command.json));
}

} // namespace estampe::app
