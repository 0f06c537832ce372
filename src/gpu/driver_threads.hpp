// SPDX-License-Identifier: MIT
#pragma once

namespace estampe::gpu {

/// Throws Error unless the system lets this process start as many threads as a driver on the processor will:
/// Mesa's waits for ever for those that it could not start. Cost: about 1 ms.
void require_driver_threads();

} // namespace estampe::gpu
