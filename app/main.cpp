// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <variant>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "options.hpp"
#include "text.hpp"
#include "usage_error.hpp"

namespace {

int fail(const char* message, int status)
{
    fmt::print(stderr, "estampe: error: {}\n", estampe::app::one_line(message));
    return status;
}

} // namespace

int main(int argc, char** argv)
{
    try {
        if (const std::optional<estampe::app::Command> command =
                estampe::app::read_command_line(argc, argv)) {
            std::visit([](const auto& chosen) { estampe::app::run(chosen); }, *command);
        }
        if (std::fflush(stdout) != 0) {
            throw estampe::Error("standard output cannot be written");
        }
    } catch (const estampe::app::UsageError& error) {
        return fail(error.what(), 2);
    } catch (const std::bad_alloc&) {
        return fail("out of memory; try a smaller --size or scene", 1);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
    return 0;
}
