// SPDX-License-Identifier: MIT
// The part of a desktop that xdotool does not play: drops files on a window, and minimises it.
// Usage: window_hand WINDOW drop FILE...     by version 5 of the XDND protocol, see freedesktop.org; 1 when
// refused
//        window_hand WINDOW minimise|restore     as a window manager does where there is none
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <poll.h>

namespace {

constexpr long protocol_version = 5;

/// "file:///tmp/my%20style.toml"
std::string address_of(const std::string& file)
{
    static constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/-_.~";
    std::string address = "file://";
    for (const char letter : std::filesystem::absolute(file).string()) {
        if (plain.find(letter) != std::string_view::npos) {
            address += letter;
        } else {
            std::array<char, 4> code{};
            std::snprintf(code.data(), code.size(), "%%%02X",
                          static_cast<unsigned>(static_cast<unsigned char>(letter)));
            address += code.data();
        }
    }
    return address;
}

class Hand {
public:
    explicit Hand(Window target) : display_(XOpenDisplay(nullptr)), target_(target)
    {
        if (display_ == nullptr) {
            std::fputs("window_hand: no display\n", stderr);
            std::exit(2);
        }
        own_ = XCreateSimpleWindow(display_, DefaultRootWindow(display_), 0, 0, 1, 1, 0, 0, 0);
    }

    ~Hand() { XCloseDisplay(display_); }

    Hand(const Hand&) = delete;
    Hand& operator=(const Hand&) = delete;

    /// Whether the window took them.
    [[nodiscard]] bool drop(const std::vector<std::string>& files)
    {
        for (const std::string& file : files) {
            addresses_ += address_of(file) + "\r\n";
        }
        XSetSelectionOwner(display_, atom("XdndSelection"), own_, CurrentTime);
        tell("XdndEnter", {protocol_version << 24, static_cast<long>(atom("text/uri-list")), 0, 0});
        constexpr long middle = (200L << 16) | 150L;
        tell("XdndPosition", {0, middle, CurrentTime, static_cast<long>(atom("XdndActionCopy"))});
        const XClientMessageEvent status = awaited("XdndStatus");
        if ((status.data.l[1] & 1) == 0) {
            tell("XdndLeave", {});
            return false;
        }
        tell("XdndDrop", {0, CurrentTime, 0, 0});
        return awaited("XdndFinished").data.l[1] != 0; // GLFW says how many bytes it took, not 1
    }

    void minimise()
    {
        set_state(IconicState);
        XUnmapWindow(display_, target_);
        XSync(display_, False);
    }

    void restore()
    {
        XMapWindow(display_, target_);
        set_state(NormalState);
        XSync(display_, False);
    }

private:
    [[nodiscard]] Atom atom(const char* name) const { return XInternAtom(display_, name, False); }

    void set_state(long state)
    {
        const std::array<long, 2> words{state, None};
        XChangeProperty(display_, target_, atom("WM_STATE"), atom("WM_STATE"), 32, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(words.data()), static_cast<int>(words.size()));
    }

    /// A message of the protocol; its first word is always who sends it.
    void tell(const char* message, const std::array<long, 4>& words)
    {
        XEvent event{};
        event.xclient.type = ClientMessage;
        event.xclient.window = target_;
        event.xclient.message_type = atom(message);
        event.xclient.format = 32;
        event.xclient.data.l[0] = static_cast<long>(own_);
        for (size_t i = 0; i < words.size(); ++i) {
            event.xclient.data.l[i + 1] = words[i];
        }
        XSendEvent(display_, target_, False, NoEventMask, &event);
        XFlush(display_);
    }

    /// Hands the files over to who asks for them meanwhile.
    [[nodiscard]] XClientMessageEvent awaited(const char* message)
    {
        constexpr std::chrono::seconds most(20);
        const auto end = std::chrono::steady_clock::now() + most;
        while (std::chrono::steady_clock::now() < end) {
            pollfd connection{ConnectionNumber(display_), POLLIN, 0};
            if (XPending(display_) == 0) {
                poll(&connection, 1, 100);
                continue;
            }
            XEvent event{};
            XNextEvent(display_, &event);
            if (event.type == SelectionRequest) {
                hand_over(event.xselectionrequest);
            } else if (event.type == ClientMessage && event.xclient.message_type == atom(message)) {
                return event.xclient;
            }
        }
        std::fprintf(stderr, "window_hand: no %s comes\n", message);
        std::exit(1);
    }

    void hand_over(const XSelectionRequestEvent& request)
    {
        XChangeProperty(display_, request.requestor, request.property, request.target, 8, PropModeReplace,
                        reinterpret_cast<const unsigned char*>(addresses_.data()),
                        static_cast<int>(addresses_.size()));
        XEvent event{};
        event.xselection.type = SelectionNotify;
        event.xselection.requestor = request.requestor;
        event.xselection.selection = request.selection;
        event.xselection.target = request.target;
        event.xselection.property = request.property;
        event.xselection.time = request.time;
        XSendEvent(display_, request.requestor, False, NoEventMask, &event);
        XFlush(display_);
    }

    Display* display_;
    Window target_;
    Window own_ = None;
    std::string addresses_;
};

} // namespace

int main(int argc, char** argv)
{
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words.size() < 2) {
        std::fputs("usage: window_hand WINDOW drop FILE... | minimise | restore\n", stderr);
        return 2;
    }
    Hand hand(std::strtoul(words[0].c_str(), nullptr, 0));
    if (words[1] == "drop") {
        return hand.drop({words.begin() + 2, words.end()}) ? 0 : 1;
    }
    if (words[1] == "minimise") {
        hand.minimise();
    } else {
        hand.restore();
    }
    return 0;
}
