// SPDX-License-Identifier: MIT
#pragma once

#include "options.hpp"

namespace estampe::app {

// Functions that run the commands of the program. Each of the functions prints only the requested output to
// stdout, and throws Error on failure.

void run(const RenderCommand& command);
void run(const GraphCommand& command);
void run(const InfoCommand& command);
void run(const DevicesCommand& command);
void run(const StylesCommand& command);
void run(const StyleManualCommand& command);
void run(const TamCommand& command);
void run(const NormalMapCommand& command);
void run(const NormalBakeCommand& command);
void run(const BakeCommand& command);
void run(const ViewCommand& command);
void run(const BatchCommand& command);

} // namespace estampe::app
