#include "app/files/portal_dialog.h"

#include <sdbus-c++/sdbus-c++.h>

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <unistd.h>
#include <vector>

namespace blush {
namespace {

using namespace std::chrono_literals;
using Options = std::map<std::string, sdbus::Variant>;

constexpr const char* service = "org.freedesktop.portal.Desktop";
constexpr const char* desktop_path = "/org/freedesktop/portal/desktop";
constexpr const char* file_chooser = "org.freedesktop.portal.FileChooser";
constexpr const char* request_interface = "org.freedesktop.portal.Request";
constexpr auto time_to_appear = 3s;

// The portal's type `ay`: the bytes of a path, terminated by zero.
std::vector<uint8_t> path_bytes(const std::filesystem::path& path) {
    const std::string& text = path.native();
    std::vector<uint8_t> bytes(text.begin(), text.end());
    bytes.push_back(0);
    return bytes;
}

// One filter with all extensions, in both cases.
Options options_of(const PortalRequest& request, const std::string& token) {
    Options options{{"handle_token", sdbus::Variant(token)}, {"modal", sdbus::Variant(true)}};
    if (!request.folder.empty()) options["current_folder"] = sdbus::Variant(path_bytes(request.folder));
    if (request.use == FileRequest::Use::snapshot_folder) options["directory"] = sdbus::Variant(true);
    if (!request.name.empty()) options["current_name"] = sdbus::Variant(request.name);
    const ExtensionFilter& extensions = filter_of(request.use);
    if (extensions.empty()) return options;
    std::vector<sdbus::Struct<uint32_t, std::string>> patterns;
    std::string names;
    for (const std::string& extension : extensions) {
        std::string pattern = "*";
        for (const char c : extension) pattern += c >= 'a' && c <= 'z' ? fmt::format("[{}{}]", c, char(c - 'a' + 'A')) : std::string(1, c);
        patterns.emplace_back(0u, pattern);
        names += (names.empty() ? "*" : ", *") + extension;
    }
    using Filter = sdbus::Struct<std::string, std::vector<sdbus::Struct<uint32_t, std::string>>>;
    options["filters"] = sdbus::Variant(std::vector<Filter>{Filter(names, patterns)});
    return options;
}

// The Response signal of a request: passed from the bus thread to the waiting one.
class Response {
public:
    void set(uint32_t code, const Options& results) {
        std::vector<std::string> uris;
        const auto it = results.find("uris");
        if (it != results.end() && it->second.containsValueOfType<std::vector<std::string>>())
            uris = it->second.get<std::vector<std::string>>();
        const std::lock_guard lock(mutex_);
        if (answer_) return;
        answer_.emplace();
        answer_->path = code == 0 && !uris.empty() ? path_of_uri(uris.front()) : std::filesystem::path();
        answer_->outcome = answer_->path.empty() ? PortalAnswer::Outcome::cancelled : PortalAnswer::Outcome::chosen;
    }
    std::optional<PortalAnswer> get() const {
        const std::lock_guard lock(mutex_);
        return answer_;
    }

private:
    mutable std::mutex mutex_;
    std::optional<PortalAnswer> answer_;
};

PortalAnswer ask(const PortalRequest& request, const std::atomic<bool>& cancel) {
    static std::atomic<int> count = 0;
    Response response;
    auto connection = sdbus::createSessionBusConnection();
    const std::string token = fmt::format("blush{}_{}", ::getpid(), ++count);
    // The reply path is predictable, so the signal is connected before the request is sent.
    std::string sender = connection->getUniqueName().substr(1);
    for (char& c : sender)
        if (c == '.') c = '_';
    const std::string handle = fmt::format("{}/request/{}/{}", desktop_path, sender, token);
    auto answer = sdbus::createProxy(*connection, service, handle);
    answer->uponSignal("Response").onInterface(request_interface).call([&](const uint32_t& code, const Options& results) {
        response.set(code, results);
    });
    answer->finishRegistration();
    auto desktop = sdbus::createProxy(*connection, service, desktop_path);
    desktop->finishRegistration();
    connection->enterEventLoopAsync();
    sdbus::ObjectPath given;
    desktop->callMethod(request.use == FileRequest::Use::save_scene ? "SaveFile" : "OpenFile")
        .onInterface(file_chooser)
        .withTimeout(time_to_appear)
        .withArguments(std::string(), std::string(title_of(request.use)), options_of(request, token))
        .storeResultsTo(given);
    while (!response.get() && !cancel) {
        // If the portal ends while its dialog is open, it never answers.
        bool alive = false;
        auto bus = sdbus::createProxy(*connection, "org.freedesktop.DBus", "/org/freedesktop/DBus");
        bus->callMethod("NameHasOwner")
            .onInterface("org.freedesktop.DBus")
            .withTimeout(time_to_appear)
            .withArguments(std::string(service))
            .storeResultsTo(alive);
        if (!alive && !response.get()) return {};
        for (int i = 0; i < 10 && !response.get() && !cancel; ++i) std::this_thread::sleep_for(50ms);
    }
    if (const auto said = response.get()) return *said;
    answer->callMethod("Close").onInterface(request_interface).withTimeout(time_to_appear).dontExpectReply();
    return {PortalAnswer::Outcome::cancelled, {}};
}

} // namespace

bool may_have_session_bus() {
    if (const char* address = std::getenv("DBUS_SESSION_BUS_ADDRESS")) return *address != 0;
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");
    std::error_code missing;
    return runtime && std::filesystem::exists(std::filesystem::path(runtime) / "bus", missing);
}

PortalAnswer ask_portal(const PortalRequest& request, const std::atomic<bool>& cancel) {
    try {
        return ask(request, cancel);
    } catch (const sdbus::Error&) {
        return {}; // no bus, no portal, or no file chooser
    }
}

std::filesystem::path path_of_uri(std::string_view uri) {
    constexpr std::string_view scheme = "file://";
    if (!uri.starts_with(scheme)) return {};
    uri.remove_prefix(scheme.size());
    if (uri.starts_with("localhost/")) uri.remove_prefix(std::string_view("localhost").size());
    if (!uri.starts_with('/')) return {};
    std::string path;
    for (size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            path += uri[i];
            continue;
        }
        unsigned byte = 0;
        const char* const digits = uri.data() + i + 1;
        if (i + 2 >= uri.size()) return {};
        const auto [end, error] = std::from_chars(digits, digits + 2, byte, 16);
        if (error != std::errc() || end != digits + 2 || byte == 0) return {};
        path += char(byte);
        i += 2;
    }
    return path;
}

} // namespace blush
