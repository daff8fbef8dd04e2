// Preview of a scene whose textures are loading; the document is unchanged until the import is complete.
#include "app/files/editor_files.h"
#include "tests/io/gltf/builder.h"

#include "io/image/image_io.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace blush::TEST_FILE {
namespace {

// Blocks the importing thread at its first wake(), so that the preview can be checked.
class Gate {
public:
    void arrive() {
        std::unique_lock lock(mutex_);
        arrived_ = true;
        changed_.notify_all();
        changed_.wait(lock, [this] { return open_; });
    }
    void wait_for_arrival() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return arrived_; });
    }
    void open() {
        const std::lock_guard lock(mutex_);
        open_ = true;
        changed_.notify_all();
    }

private:
    std::mutex mutex_;
    std::condition_variable changed_;
    bool arrived_ = false, open_ = false;
};

// A square with large, different textures.
std::filesystem::path write_scene(const test::TempFolder& folder) {
    test::GltfBuilder b;
    for (int i = 0; i < 8; ++i) {
        Image image{.width = 2048 - i, .height = 2048, .channels = 3, .bytes = {}, .floats = {}};
        image.bytes.assign(size_t(image.width) * 2048 * 3, uint8_t(10 * i));
        const auto png = encode_png(image);
        EXPECT_TRUE(png);
        const int view = b.buffer_view({reinterpret_cast<const char*>(png->data()), png->size()});
        b.add("textures", {{"source", b.add("images", {{"bufferView", view}, {"mimeType", "image/png"}})}});
    }
    b.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    b.show({{"attributes", {{"POSITION", b.triangle_positions()}}}, {"material", 0}});
    test::write_bytes(folder / "scene.glb", b.glb());
    return folder / "scene.glb";
}

struct Opening {
    Gate gate;
    EditorFiles files{[this] { gate.arrive(); }};
    Document document;
    UiState ui;

    ~Opening() { gate.open(); }
    // Polls until there is a preview (returns true), or the import is complete.
    bool reaches_preview(const std::filesystem::path& file) {
        files.open(file);
        gate.wait_for_arrival();
        return !files.poll(document, ui).opened && files.preview();
    }
    EditorFiles::Finished finish() {
        gate.open();
        EditorFiles::Finished finished;
        while (files.running() && !finished.opened) {
            finished = files.poll(document, ui);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return finished;
    }
};

// Calls look(opening) when the preview is ready. On a busy machine, the textures may be loaded first; then retries.
template <class Look> void look_at_preview(const Look& look) {
    const test::TempFolder folder;
    const std::filesystem::path file = write_scene(folder);
    for (int attempt = 0; attempt < 20; ++attempt) {
        Opening opening;
        if (opening.reaches_preview(file)) return look(opening);
    }
    FAIL() << "no preview in twenty attempts";
}

TEST(EditorFiles, PreviewIsShownThenTheSceneReplacesTheDocument) {
    look_at_preview([](Opening& o) {
        const Scene& early = o.files.preview()->project().scene;
        EXPECT_EQ(early.meshes.size(), 1u);
        EXPECT_TRUE(early.textures.empty());
        EXPECT_TRUE(o.document.project().scene.meshes.empty());
        EXPECT_TRUE(o.files.scene_file().empty());
        ASSERT_TRUE(o.files.running());
        EXPECT_NE(o.files.running()->what.find("shown meanwhile"), std::string::npos);
        EXPECT_EQ(o.files.preview_note(), "Textures are loading: plain colours are shown instead");
        const auto meshes = early.meshes;
        EXPECT_TRUE(o.finish().opened);
        EXPECT_FALSE(o.files.preview());
        EXPECT_EQ(o.document.project().scene.textures.size(), 8u);
        EXPECT_TRUE(o.document.project().scene.meshes.shares_storage(meshes));
        EXPECT_EQ(o.files.scene_file().filename(), "scene.glb");
        EXPECT_FALSE(o.document.modified());
    });
}

TEST(EditorFiles, CancellingAPreviewRestoresTheDocument) {
    look_at_preview([](Opening& o) {
        o.files.cancel();
        EXPECT_FALSE(o.files.preview());
        EXPECT_FALSE(o.finish().opened);
        EXPECT_FALSE(o.files.preview());
        EXPECT_TRUE(o.document.project().scene.meshes.empty());
        EXPECT_TRUE(o.files.scene_file().empty());
    });
}

TEST(EditorFiles, AnotherFileReplacesThePreview) {
    look_at_preview([](Opening& o) {
        o.gate.open();
        o.files.open("/nowhere.gltf");
        EXPECT_FALSE(o.files.preview());
        EXPECT_FALSE(o.finish().opened);
        EXPECT_FALSE(o.files.preview());
        ASSERT_FALSE(o.ui.toasts.all().empty());
        EXPECT_EQ(o.ui.toasts.all().back().kind, Toast::Kind::failure);
    });
}

TEST(FileWatch, SeesAChangeWhileTheFileWasRead) {
    const test::TempFolder folder;
    const std::filesystem::path file = folder / "scene.gltf";
    test::write_bytes(file, "{}");
    const FileWatch::Time read = FileWatch::time_of(file);
    std::filesystem::last_write_time(file, read + std::chrono::seconds(1));
    FileWatch watch;
    watch.watch(file, read);
    EXPECT_FALSE(watch.changed()) << "it may still be written";
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed()) << "once";
}

} // namespace
} // namespace blush::TEST_FILE
