#include "tests/render/reference_scenes.h"

#include "io/image/image_io.h"

#include <stdexcept>

namespace blush::test {

Reference read_reference(const std::string& file) {
    const auto image = read_layers(file);
    if (!image) throw std::runtime_error(image.error().text());
    Reference r;
    r.mean.width = image->width;
    r.mean.height = image->height;
    r.renders = std::stod(image->metadata.at("blush:renders"));
    const auto channel = [&](const char* name) -> const std::vector<float>& { return image->find(name)->values; };
    for (size_t i = 0; i < channel("R").size(); ++i) {
        r.mean.pixels.push_back({channel("R")[i], channel("G")[i], channel("B")[i]});
        r.mean.errors.push_back({channel("error.R")[i], channel("error.G")[i], channel("error.B")[i]});
    }
    return r;
}

} // namespace blush::test
