// The desktop's file dialog on a private session bus with a fake portal.
#include "app/files/desktop_file_dialog.h"
#include "tests/support/eventually.h"

#include <sdbus-c++/sdbus-c++.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace blush::test::TEST_FILE {
namespace {

using Outcome = PortalAnswer::Outcome;
using Options = std::map<std::string, sdbus::Variant>;

// A bus without services; set in the environment during the object's lifetime.
class Bus {
public:
    Bus() {
        const std::filesystem::path config =
            std::filesystem::path(::testing::TempDir()) / ("blush-bus-" + std::to_string(::getpid()) + ".conf");
        std::ofstream(config) << "<busconfig><type>session</type><listen>unix:tmpdir=/tmp</listen><policy context=\"default\">"
                                 "<allow send_destination=\"*\"/><allow receive_sender=\"*\"/><allow own=\"*\"/></policy></busconfig>";
        int ends[2];
        if (::pipe(ends) != 0) return;
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
        posix_spawn_file_actions_addclose(&actions, ends[0]);
        const std::string option = "--config-file=" + config.string();
        const char* arguments[] = {"dbus-daemon", option.c_str(), "--nofork", "--print-address", nullptr};
        if (::posix_spawnp(&daemon_, arguments[0], &actions, nullptr, const_cast<char**>(arguments), environ) != 0) daemon_ = 0;
        posix_spawn_file_actions_destroy(&actions);
        ::close(ends[1]);
        std::string address;
        for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) address += c;
        ::close(ends[0]);
        std::filesystem::remove(config);
        ::setenv("DBUS_SESSION_BUS_ADDRESS", address.c_str(), 1);
    }
    ~Bus() {
        if (daemon_ > 0) {
            ::kill(daemon_, SIGKILL);
            ::waitpid(daemon_, nullptr, 0);
        }
        ::setenv("DBUS_SESSION_BUS_ADDRESS", "", 1);
    }
    bool runs() const { return daemon_ > 0; }

private:
    pid_t daemon_ = 0;
};

// The received request, and the reply: a code and URIs, or no reply while `code` is empty.
class Portal {
public:
    std::optional<uint32_t> code = 0;
    std::vector<std::string> uris;
    std::string method, title;
    Options options;
    std::atomic<int> asked = 0, closed = 0;

    Portal() : connection_(sdbus::createSessionBusConnection("org.freedesktop.portal.Desktop")) {
        object_ = sdbus::createObject(*connection_, "/org/freedesktop/portal/desktop");
        for (const char* name : {"OpenFile", "SaveFile"})
            object_->registerMethod(name)
                .onInterface("org.freedesktop.portal.FileChooser")
                .implementedAs([this, name](const std::string&, const std::string& asked_title, const Options& asked_options) {
                    method = name;
                    title = asked_title;
                    options = asked_options;
                    return show(object_->getCurrentlyProcessedMessage()->getSender());
                });
        object_->finishRegistration();
        connection_->enterEventLoopAsync();
    }
    // Ends without a reply, like a crash.
    void vanish() {
        connection_->leaveEventLoop();
        request_.reset();
        object_.reset();
        connection_.reset();
    }

private:
    sdbus::ObjectPath show(std::string sender) {
        sender = sender.substr(1);
        std::ranges::replace(sender, '.', '_');
        const std::string handle =
            "/org/freedesktop/portal/desktop/request/" + sender + "/" + options.at("handle_token").get<std::string>();
        request_ = sdbus::createObject(*connection_, handle);
        request_->registerMethod("Close").onInterface("org.freedesktop.portal.Request").implementedAs([this] { ++closed; });
        request_->registerSignal("Response").onInterface("org.freedesktop.portal.Request").withParameters<uint32_t, Options>();
        request_->finishRegistration();
        if (code)
            request_->emitSignal("Response")
                .onInterface("org.freedesktop.portal.Request")
                .withArguments(*code, Options{{"uris", sdbus::Variant(uris)}});
        ++asked;
        return handle;
    }

    std::unique_ptr<sdbus::IConnection> connection_;
    std::unique_ptr<sdbus::IObject> object_, request_;
};

class PortalDialog : public ::testing::Test {
protected:
    void SetUp() override { ASSERT_TRUE(bus.runs()) << "dbus-daemon is not installed"; }
    Bus bus;
    std::atomic<bool> cancel = false;
};

TEST(PathOfUri, AcceptsOnlyLocalPaths) {
    EXPECT_EQ(path_of_uri("file:///home/a%20b/l%C3%A4mp.gltf"), "/home/a b/l\u00e4mp.gltf");
    EXPECT_EQ(path_of_uri("file://localhost/tmp/x"), "/tmp/x");
    for (const char* bad :
         {"", "file://", "http://x/y", "file://elsewhere/y", "file:///a%2", "file:///a%", "file:///a%zz", "file:///a%00b", "/a"})
        EXPECT_TRUE(path_of_uri(bad).empty()) << bad;
}

TEST_F(PortalDialog, ReturnsTheChosenFile) {
    Portal portal;
    portal.uris = {"file:///scenes/red%20mug.glb"};
    const PortalAnswer answer = ask_portal({FileRequest::Use::open, "/scenes", ""}, cancel);
    EXPECT_EQ(answer.outcome, Outcome::chosen);
    EXPECT_EQ(answer.path, "/scenes/red mug.glb");
    EXPECT_EQ(portal.method, "OpenFile");
    EXPECT_EQ(portal.title, "Open a scene or an image");
    const auto folder = portal.options.at("current_folder").get<std::vector<uint8_t>>();
    EXPECT_EQ(std::string(folder.begin(), folder.end()), std::string("/scenes\0", 8));
    using Filter = sdbus::Struct<std::string, std::vector<sdbus::Struct<uint32_t, std::string>>>;
    const auto filters = portal.options.at("filters").get<std::vector<Filter>>();
    ASSERT_EQ(filters.size(), 1u);
    EXPECT_EQ(filters[0].get<0>(), "*.gltf, *.glb, *.exr");
    ASSERT_EQ(filters[0].get<1>().size(), 3u);
    EXPECT_EQ(filters[0].get<1>()[1].get<1>(), "*.[gG][lL][bB]");
}

TEST_F(PortalDialog, RequestsFoldersAndNames) {
    Portal portal;
    portal.uris = {"file:///images"};
    EXPECT_EQ(ask_portal({FileRequest::Use::snapshot_folder, "/", ""}, cancel).path, "/images");
    EXPECT_TRUE(portal.options.at("directory").get<bool>());
    EXPECT_FALSE(portal.options.contains("filters"));
    EXPECT_EQ(ask_portal({FileRequest::Use::save_scene, "/", "mug.gltf"}, cancel).outcome, Outcome::chosen);
    EXPECT_EQ(portal.method, "SaveFile");
    EXPECT_EQ(portal.options.at("current_name").get<std::string>(), "mug.gltf");
}

TEST_F(PortalDialog, CanBeCancelledByUserAndProgram) {
    Portal portal;
    portal.code = 1;
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::cancelled);
    portal.code = 0; // and no file
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::cancelled);
    portal.uris = {"trash:///x"};
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::cancelled);
    portal.code.reset();
    std::thread canceller([&] {
        EXPECT_TRUE(eventually([&] { return portal.asked >= 4; })) << "the portal is not asked";
        cancel = true;
    });
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::cancelled);
    canceller.join();
    for (int i = 0; i < 1000 && portal.closed == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(portal.closed, 1) << "the dialog stays open on the desktop";
}

TEST_F(PortalDialog, WithoutAPortalReturnsNoPortal) {
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::no_portal) << "a bus without services";
    Portal portal;
    portal.code.reset();
    std::thread crash([&] {
        EXPECT_TRUE(eventually([&] { return portal.asked >= 1; })) << "the portal is not asked";
        portal.vanish();
    });
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::no_portal) << "a portal that ends";
    crash.join();
    ::setenv("DBUS_SESSION_BUS_ADDRESS", "unix:path=/nonexistent/bus", 1);
    EXPECT_EQ(ask_portal({}, cancel).outcome, Outcome::no_portal) << "no bus";
    EXPECT_TRUE(may_have_session_bus());
    ::setenv("DBUS_SESSION_BUS_ADDRESS", "", 1);
    EXPECT_FALSE(may_have_session_bus());
}

// Runs frames of the editor until the dialog has returned.
void poll_until(DesktopFileDialog& dialog, UiState& ui, const std::function<bool()>& done) {
    for (int frame = 0; frame < 2000 && !done(); ++frame) {
        dialog.poll(ui);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(done());
}

TEST_F(PortalDialog, ReplacesTheFileBrowser) {
    Portal portal;
    portal.uris = {"file:///scenes/mug"};
    UiState ui;
    DesktopFileDialog dialog([] {});
    ui.browser = FileBrowser{FileRequest::Use::save_scene, "/scenes", "/scenes/mug.gltf"};
    dialog.poll(ui);
    ASSERT_TRUE(ui.browser);
    EXPECT_TRUE(ui.browser->on_desktop) << "the file browser is not drawn";
    poll_until(dialog, ui, [&] { return !ui.browser; });
    ASSERT_EQ(ui.files.size(), 1u);
    EXPECT_EQ(ui.files[0].path, "/scenes/mug.gltf");
    EXPECT_EQ(ui.settings.browser_folder, "/scenes");

    ui.settings.desktop_file_dialog = false;
    ui.browser = FileBrowser{};
    dialog.poll(ui);
    EXPECT_FALSE(ui.browser->on_desktop) << "switched off";
    EXPECT_EQ(portal.asked, 1);

    ui.settings.desktop_file_dialog = true;
    portal.vanish();
    ui.browser = FileBrowser{};
    dialog.poll(ui);
    EXPECT_TRUE(ui.browser->on_desktop);
    poll_until(dialog, ui, [&] { return !ui.browser->on_desktop; });
    EXPECT_TRUE(ui.browser->just_opened) << "the file browser opens instead";
    dialog.poll(ui);
    EXPECT_FALSE(ui.browser->on_desktop) << "and the desktop is not asked again";
}

} // namespace
} // namespace blush::test::TEST_FILE
