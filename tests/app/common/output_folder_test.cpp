// Where snapshots go: to the chosen folder, beside the scene, or to the user's pictures.
#include "app/common/output_folder.h"
#include "tests/support/process.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sys/wait.h>
#include <unistd.h>

namespace blush::TEST_FILE {
namespace {

namespace fs = std::filesystem;

class OutputFolder : public testing::Test {
protected:
    void SetUp() override {
        for (const char* folder : {"scene", "assets/scenes", "pictures", "chosen"}) fs::create_directories(root / folder);
        setenv("XDG_PICTURES_DIR", pictures.c_str(), 1);
    }
    void TearDown() override { unsetenv("XDG_PICTURES_DIR"); }
    fs::path of(const fs::path& chosen, const std::string& scene) const { return output_folder(chosen, root / scene, root / "assets"); }

    const test::TemporaryFolder root;
    const fs::path pictures = root / "pictures";
};

TEST_F(OutputFolder, IsTheChosenOneForEveryScene) {
    for (const char* scene : {"scene/a.gltf", "assets/scenes/cornell.gltf"}) EXPECT_EQ(of(root / "chosen", scene), root / "chosen");
    EXPECT_EQ(of(root / "gone", "scene/a.gltf"), root / "gone") << "saving then says that it does not exist";
}

TEST_F(OutputFolder, IsThatOfTheSceneButNeverOfAShippedOne) {
    EXPECT_EQ(of({}, "scene/a.gltf"), root / "scene");
    EXPECT_EQ(of({}, "assets/scenes/cornell.gltf"), pictures);
    EXPECT_EQ(of({}, "scene/../assets/scenes/cornell.gltf"), pictures);
    EXPECT_EQ(output_folder({}, {}, root / "assets"), pictures) << "no scene";
}

// Root can write everywhere: the child becomes another user.
TEST_F(OutputFolder, IsThePicturesFolderIfTheScenesCannotBeWritten) {
    EXPECT_EQ(of({}, "missing/a.gltf"), pictures);
    fs::permissions(root.path(), fs::perms::all);
    fs::permissions(root / "scene", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
    const pid_t child = fork();
    if (child == 0) {
        if (geteuid() == 0 && setuid(65534) != 0) _exit(2);
        _exit(of({}, "scene/a.gltf") == pictures ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

} // namespace
} // namespace blush::TEST_FILE
