// Drops files onto the window under a point of the screen, as a file manager does: the source's side of XDND 5
// (freedesktop.org, "Drag-and-Drop Protocol for the X Window System"). For tests, because synthetic mouse events cannot do it.
//
//   drop_files X Y FILE...
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <poll.h>

#include <cctype>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

constexpr long protocol = 5;
constexpr auto patience = std::chrono::seconds(30);

[[noreturn]] void fail(const char* what) {
    std::fprintf(stderr, "drop_files: %s\n", what);
    std::exit(1);
}

// RFC 2483 and 8089: one line per file, percent-encoded.
std::string uri_list(int count, char** files) {
    std::string list;
    for (int i = 0; i < count; ++i) {
        list += "file://";
        for (const char c : std::filesystem::absolute(files[i]).string()) {
            char escaped[4] = {c};
            if (!std::isalnum(static_cast<unsigned char>(c)) && !std::strchr("/-._~", c))
                std::snprintf(escaped, sizeof escaped, "%%%02X", static_cast<unsigned char>(c));
            list += escaped;
        }
        list += "\r\n";
    }
    return list;
}

struct Source {
    Display* display = nullptr;
    Window window = 0, target = 0;
    std::string data;

    Atom atom(const char* name) const { return XInternAtom(display, name, False); }
    bool takes_drops(Window w) const;
    Window find_target(int x, int y) const;
    void tell_target(const char* message, const long (&words)[4]) const;
    void hand_over(const XSelectionRequestEvent& request) const;
    XClientMessageEvent wait_for(const char* message) const;
};

bool Source::takes_drops(Window w) const {
    Atom type = None;
    int format = 0;
    unsigned long items = 0, left = 0;
    unsigned char* value = nullptr;
    XGetWindowProperty(display, w, atom("XdndAware"), 0, 1, False, XA_ATOM, &type, &format, &items, &left, &value);
    const bool aware = type == XA_ATOM && items == 1 && *reinterpret_cast<unsigned long*>(value) >= protocol;
    if (value) XFree(value);
    return aware;
}

// Descends from the root to the innermost window at the point.
Window Source::find_target(int x, int y) const {
    const Window root = DefaultRootWindow(display);
    for (Window w = root, child = None; w != None; w = child) {
        if (takes_drops(w)) return w;
        int inside_x = 0, inside_y = 0;
        if (!XTranslateCoordinates(display, root, w, x, y, &inside_x, &inside_y, &child)) break;
    }
    fail("no window there takes drops");
}

void Source::tell_target(const char* message, const long (&words)[4]) const {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = target;
    event.xclient.message_type = atom(message);
    event.xclient.format = 32;
    event.xclient.data.l[0] = long(window);
    for (int i = 0; i < 4; ++i) event.xclient.data.l[i + 1] = words[i];
    XSendEvent(display, target, False, NoEventMask, &event);
    XFlush(display);
}

// The target requests the data like any selection.
void Source::hand_over(const XSelectionRequestEvent& request) const {
    XChangeProperty(display, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(data.data()), int(data.size()));
    XEvent answer{};
    answer.xselection.type = SelectionNotify;
    answer.xselection.requestor = request.requestor;
    answer.xselection.selection = request.selection;
    answer.xselection.target = request.target;
    answer.xselection.property = request.property;
    answer.xselection.time = request.time;
    XSendEvent(display, request.requestor, False, NoEventMask, &answer);
    XFlush(display);
}

XClientMessageEvent Source::wait_for(const char* message) const {
    const auto end = Clock::now() + patience;
    while (Clock::now() < end) {
        if (XPending(display) == 0) {
            pollfd connection{ConnectionNumber(display), POLLIN, 0};
            poll(&connection, 1, 100);
            continue;
        }
        XEvent event;
        XNextEvent(display, &event);
        if (event.type == SelectionRequest) hand_over(event.xselectionrequest);
        if (event.type == ClientMessage && event.xclient.message_type == atom(message)) return event.xclient;
    }
    fail("the window does not answer");
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4) fail("usage: drop_files X Y FILE...");
    const int x = std::atoi(argv[1]), y = std::atoi(argv[2]);
    Source source;
    source.display = XOpenDisplay(nullptr);
    if (!source.display) fail("no display");
    source.window = XCreateSimpleWindow(source.display, DefaultRootWindow(source.display), 0, 0, 1, 1, 0, 0, 0);
    source.data = uri_list(argc - 3, argv + 3);
    XSetSelectionOwner(source.display, source.atom("XdndSelection"), source.window, CurrentTime);
    source.target = source.find_target(x, y);

    const long copy = long(source.atom("XdndActionCopy")), here = long(x) << 16 | y;
    source.tell_target("XdndEnter", {protocol << 24, long(source.atom("text/uri-list")), None, None});
    source.tell_target("XdndPosition", {0, here, CurrentTime, copy});
    if (!(source.wait_for("XdndStatus").data.l[1] & 1)) fail("the window does not want these files");
    source.tell_target("XdndDrop", {0, CurrentTime, 0, 0});
    // Bit 0 according to the specification; GLFW 3.3 sends the number of bytes instead.
    if (source.wait_for("XdndFinished").data.l[1] == 0) fail("the window did not take the files");
    return 0;
}
