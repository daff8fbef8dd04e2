// OpenColorIO behind plain data. The working space of everything else is scene-linear Rec.709.
#pragma once

#include "color/display_numbers.h"
#include "core/result.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// Text and tables of the display transform for a fragment shader: GLSL 3.30 source that defines
// `vec4 display_color(vec4 scene_linear)`, whose alpha is the share of the pixel that objects cover, with a uniform in it for each
// DisplayNumber.
struct DisplayShader {
    struct Lut {
        std::string sampler;  // name of the uniform sampler
        int dimensions = 2;   // 1, 2 or 3
        int width = 0, height = 1, depth = 1;
        int channels = 3;     // 1 or 3
        bool linear = true;   // filtering; nearest otherwise
        std::vector<float> values;
    };
    std::string text;
    std::vector<Lut> luts;
};

class ColorManagement {
public:
    // `config_file` empty: $OCIO if set, else the config in `assets`. A broken config is reported in `warning` and
    // the one in `assets` is used in its place; only if that is broken too is it an error.
    static Result<ColorManagement> load(const std::filesystem::path& assets, const std::filesystem::path& config_file = {});
    ColorManagement(ColorManagement&&) noexcept;
    ColorManagement& operator=(ColorManagement&&) noexcept;
    ~ColorManagement();

    const std::string& warning() const; // empty if all is well
    std::string config_name() const;
    std::vector<std::string> displays() const;
    std::vector<std::string> views(std::string_view display) const;
    std::string default_display() const;
    std::string default_view(std::string_view display) const;
    std::vector<std::string> looks() const;

    // Errors: unknown display, view or look (the message lists those there are).
    Result<DisplayShader> display_shader(const DisplayTransform& transform) const;
    // The shader's twin on the processor: rgb is count * 3 floats, scene-linear in, display-encoded out, in place. `coverage` is count
    // floats; null: objects cover everything.
    Result<void> apply_display(const DisplayTransform& transform, const DisplayNumbers& numbers, float* rgb, size_t count,
                               const float* coverage = nullptr) const;

private:
    struct State;
    explicit ColorManagement(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush
