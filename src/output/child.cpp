// SPDX-License-Identifier: MIT
#include "output/child.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <estampe/error.hpp>
#include <fmt/format.h>

namespace estampe::output {
namespace {

/// The start of one child process: its streams, and the settings of this program that the child must not
/// inherit.
class Start {
public:
    Start(int input, int errors)
    {
        posix_spawn_file_actions_init(&streams_);
        posix_spawn_file_actions_adddup2(&streams_, input, STDIN_FILENO);
        posix_spawn_file_actions_addopen(&streams_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&streams_, errors, STDERR_FILENO);
        posix_spawnattr_init(&attributes_);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes_, &none);
        posix_spawnattr_setpgroup(&attributes_, 0);
        posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    }

    ~Start()
    {
        posix_spawn_file_actions_destroy(&streams_);
        posix_spawnattr_destroy(&attributes_);
    }

    Start(const Start&) = delete;
    Start& operator=(const Start&) = delete;

    [[nodiscard]] int run(pid_t& id, const std::vector<std::string>& command) const
    {
        std::vector<char*> words;
        words.reserve(command.size() + 1);
        for (const std::string& word : command) {
            // The cast is safe, because posix_spawn does not modify the arguments.
            words.push_back(const_cast<char*>(word.c_str()));
        }
        words.push_back(nullptr);
        return posix_spawnp(&id, words.front(), &streams_, &attributes_, words.data(), environ);
    }

private:
    posix_spawn_file_actions_t streams_{};
    posix_spawnattr_t attributes_{};
};

int file_without_name()
{
    const int file =
        open(std::filesystem::temp_directory_path().c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    return file >= 0 ? file : open("/dev/null", O_RDWR | O_CLOEXEC);
}

} // namespace

Child::Child(const std::vector<std::string>& command, const std::string& to_install)
{
    // The child's input is a socket, not a pipe. If the child ends, writing to a socket gives an error, while
    // writing to a pipe would raise a signal that ends this program.
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        throw Error(fmt::format("a program cannot be started: {}", std::strerror(errno)), command.front());
    }
    errors_ = file_without_name();
    const int problem = Start(ends[1], errors_).run(id_, command);
    close(ends[1]);
    input_ = ends[0];
    if (problem != 0) {
        id_ = -1;
        close(input_);
        close(errors_);
        throw Error(fmt::format("cannot be started: {}", std::strerror(problem)), command.front(),
                    to_install);
    }
}

Child::~Child()
{
    if (input_ >= 0) {
        close(input_);
    }
    if (id_ > 0) {
        kill(id_, SIGKILL);
        waitpid(id_, nullptr, 0);
    }
    close(errors_);
}

bool Child::write(std::span<const std::byte> bytes) const
{
    while (!bytes.empty()) {
        const ssize_t written = send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (written < 0 && errno != EINTR) {
            return false;
        }
        bytes = bytes.subspan(static_cast<size_t>(std::max<ssize_t>(written, 0)));
    }
    return true;
}

bool Child::finish()
{
    close(input_);
    input_ = -1;
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

std::string Child::complaint() const
{
    std::array<char, 400> text{};
    const ssize_t size = pread(errors_, text.data(), text.size(), 0);
    std::string words(text.data(), static_cast<size_t>(std::max<ssize_t>(size, 0)));
    while (!words.empty() && words.back() == '\n') {
        words.pop_back();
    }
    return words;
}

} // namespace estampe::output
