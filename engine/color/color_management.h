// Wraps OpenColorIO behind plain data. The working space of the program is scene-linear Rec.709.
#pragma once

#include "color/display_parameters.h"
#include "core/result.h"

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace blush {

// The display transform for a fragment shader: GLSL 3.30 source and lookup tables. The source defines `vec4 display_color(vec4
// scene_linear)`, whose alpha is the coverage by objects, and has a uniform for each of DisplayParameters. Gamma, false colours and
// an unprocessed background need `#define ALL_STEPS` before the source: a software rasterizer executes both sides of a condition.
struct DisplayShader {
    struct Lut {
        std::string sampler; // name of the uniform sampler
        int dimensions = 2;  // 1, 2 or 3
        int width = 0, height = 1, depth = 1;
        int channels = 3;   // 1 or 3
        bool linear = true; // filtering; nearest otherwise
        std::vector<float> values;
    };
    std::string text;
    std::vector<Lut> luts;
};

class ColorManagement {
public:
    // `config_file` empty: $OCIO if set, else the config in `assets`. If a config is invalid, warning() reports it and the one in
    // `assets` is used instead; error only if that is invalid too.
    static Result<ColorManagement> load(const std::filesystem::path& assets, const std::filesystem::path& config_file = {});
    ColorManagement(ColorManagement&&) noexcept;
    ColorManagement& operator=(ColorManagement&&) noexcept;
    ~ColorManagement();

    const std::string& warning() const; // empty if no warning
    std::string config_name() const;
    std::vector<std::string> displays() const;
    std::vector<std::string> views(std::string_view display) const;
    std::string default_display() const;
    std::string default_view(std::string_view display) const;
    std::vector<std::string> looks() const;

    // Errors: unknown display, view or look (the message lists the available ones).
    Result<DisplayShader> display_shader(const DisplayTransform& transform) const;
    // CPU version of the shader: rgb is count * 3 floats, scene-linear in, display-encoded out, in place. `coverage` is count
    // floats; null: objects cover everything.
    Result<void> apply_display(const DisplayTransform& transform, const DisplayParameters& numbers, float* rgb, size_t count,
                               const float* coverage = nullptr) const;

private:
    struct State;
    explicit ColorManagement(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace blush
