// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>
#include <new>
#include <optional>
#include <system_error>
#include <variant>

#include <fcntl.h>
#include <unistd.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include "core/text.hpp"
#include "options.hpp"
#include "process.hpp"

namespace {

int fail(const char* message, int status)
{
    estampe::say(fmt::format("estampe: error: {}\n", estampe::shortened(estampe::one_line(message))));
    return status;
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
    } catch (const std::bad_alloc&) {
        return fail("out of memory; try a smaller --size or scene", 1);
    } catch (const std::system_error& error) {
        return fail(
            fmt::format("the system refused: {}; it may be out of threads or files", error.code().message())
                .c_str(),
            1);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
    return 0;
}
