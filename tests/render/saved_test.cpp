// A scene that was saved and opened again gives the very same picture.
#include "io/gltf_import.h"
#include "io/gltf_save.h"
#include "scenes.h"
#include "support/pictures.h"
#include "support/process.h"
#include "support/random_edits.h"
#include "support/storable.h"

#include <gtest/gtest.h>

namespace blush::test {
namespace {

Frame picture(const Project& project) {
    RenderSettings settings = project.render;
    settings.width = 48;
    settings.height = 27;
    return fresh_picture(project.scene, settings, 2);
}

TEST(Saved, ScenesRenderBitForBitAsTheyWere) {
    const TemporaryFolder folder;
    Rng rng(8);
    for (const std::string& name : shipped_scene_names()) {
        const auto original = import_gltf(std::string(BLUSH_ASSETS) + "/scenes/" + name + ".gltf");
        ASSERT_TRUE(original);
        for (const char* extension : {"gltf", "glb"}) {
            Project project{original->scene, {}, {}};
            for (int step = 0; step < 10; ++step) project = *blush::apply(project, random_edit(rng, project));
            project = storable(project);
            const std::string file = folder / (name + "." + extension);
            const auto saved = save_gltf(original->origin, project, file);
            ASSERT_TRUE(saved) << saved.error().text();
            const auto loaded = import_gltf(file);
            ASSERT_TRUE(loaded) << loaded.error().text();
            const Project again{loaded->scene, loaded->render.value_or(RenderSettings{}), loaded->view.value_or(ViewSettings{})};
            EXPECT_TRUE(same_picture(picture(project), picture(again))) << file;
        }
    }
}

} // namespace
} // namespace blush::test
