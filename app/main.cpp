// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <variant>

#include <fcntl.h>
#include <unistd.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "core/failure.hpp"
#include "core/text.hpp"
#include "options.hpp"
#include "process.hpp"

namespace {

/// Prints an error message, also if no memory is left to format it. Returns `status`.
int fail(const char* message, int status) noexcept
{
    try {
        estampe::say(fmt::format("estampe: error: {}\n", estampe::shortened(estampe::one_line(message))));
    } catch (const std::bad_alloc&) {
        for (const char* const part : {"estampe: error: ", message, "\n"}) {
            static_cast<void>(std::fputs(part, stderr));
        }
    }
    return status;
}

/// Prints the message of the exception that is being handled. Returns the program's exit status.
int fail_as_caught() noexcept
{
    try {
        return fail(estampe::message_of_caught().c_str(), 1);
    } catch (const std::bad_alloc&) {
        return fail(estampe::out_of_memory, 1);
    }
}

/// If stdin, stdout or stderr is closed, opens an unusable file in its place, so that no output file gets the
/// descriptor of a standard stream.
void hold_standard_streams()
{
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) < 0) {
            static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
        }
    }
}

} // namespace

int main(int argc, char** argv)
{
    hold_standard_streams();
    estampe::app::end_well_without_memory();
    try {
        estampe::app::watch_signals();
        if (const std::optional<estampe::app::Command> command =
                estampe::app::read_command_line(argc, argv)) {
            std::visit([](const auto& chosen) { estampe::app::run(chosen); }, *command);
        }
        if (std::fflush(stdout) != 0) {
            throw estampe::Error("standard output cannot be written");
        }
    } catch (const estampe::app::UsageError& error) {
        return fail(error.what(), 2);
    } catch (const std::exception&) {
        return fail_as_caught();
    }
    return 0;
}
