// make_references [RENDERS]: writes the references of every shipped scene, the means of that many independent renders (default
// 256), with their standard errors as error.*. Run it when a scene changes, never to make a failing test pass.
#include "io/image/image_io.h"
#include "tests/render/reference_scenes.h"

#include <cstdio>
#include <cstdlib>

using namespace blush;
using namespace blush::test;

namespace {

LayeredImage make_reference(const std::string& name, RenderSettings settings, int renders) {
    const Scene scene = shipped_scene(name);
    const size_t pixels = size_t(settings.width) * size_t(settings.height);
    std::vector<statistics::Moments> moments(3 * pixels);
    Renderer renderer;
    for (int i = 0; i < renders; ++i) {
        settings.seed = 1000 + uint32_t(i);
        renderer.update(scene, settings);
        renderer.render(0, settings.spp);
        const Frame frame = renderer.resolve();
        for (size_t p = 0; p < pixels; ++p)
            for (size_t c = 0; c < 3; ++c) moments[3 * p + c].add(double(frame.rgba[4 * p + c]));
    }
    LayeredImage image;
    image.width = settings.width;
    image.height = settings.height;
    image.metadata = {{"blush:scene", name}, {"blush:renders", std::to_string(renders)}, {"blush:spp", std::to_string(settings.spp)}};
    for (size_t c = 0; c < 3; ++c) {
        LayeredImage::Channel mean{std::string(1, "RGB"[c]), {}}, error{std::string("error.") + "RGB" [c], {}};
        for (size_t p = 0; p < pixels; ++p) {
            mean.values.push_back(float(moments[3 * p + c].mean));
            error.values.push_back(float(moments[3 * p + c].error()));
        }
        image.channels.push_back(std::move(mean));
        image.channels.push_back(std::move(error));
    }
    return image;
}

} // namespace

int main(int argc, char** argv) {
    const int renders = argc > 1 ? std::atoi(argv[1]) : 256;
    if (renders < 16) {
        std::fprintf(stderr, "usage: make_references [RENDERS], at least 16\n");
        return 2;
    }
    for (const std::string& name : shipped_scene_names()) {
        for (const auto& [file, settings] :
             {std::pair(reference_file(name), reference_settings(name)), std::pair(coverage_reference_file(name), coverage_settings())}) {
            const auto written = write_exr(file, make_reference(name, settings, renders));
            if (!written) {
                std::fprintf(stderr, "make_references: %s\n", written.error().text().c_str());
                return 1;
            }
            std::printf("%s\n", file.c_str());
        }
    }
}
