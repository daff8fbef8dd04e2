#include "ui/gl/display_pass.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace blush {
namespace {

// mixed_image() as a shader.
const char* const main_source = R"(
uniform sampler2D image, denoised;
uniform float raw_weight, denoised_weight;
uniform vec2 image_scale, denoised_scale;
uniform bool over_checker;
#ifdef ALL_STEPS
float squares() {
    ivec2 square = ivec2(gl_FragCoord.xy) / 8;
    return (square.x + square.y) % 2 == 0 ? 0.40 : 0.52;
}
#endif
// display_color is the costly part, and software OpenGL computes both sides of a condition: it is called once.
void main() {
    vec4 pixel = texelFetch(image, ivec2(gl_FragCoord.xy * image_scale), 0);
    vec3 color = raw_weight * pixel.rgb;
    if (denoised_weight != 0.0) color += denoised_weight * texelFetch(denoised, ivec2(gl_FragCoord.xy * denoised_scale), 0).rgb;
#ifdef ALL_STEPS
    float coverage = clamp(pixel.a, 0.0, 1.0);
    float unpremultiply = over_checker && pixel.a > 0.0 ? 1.0 / pixel.a : 1.0;
    vec3 shown = display_color(vec4(abs(color) * unpremultiply, over_checker ? 1.0 : pixel.a)).rgb;
    result = vec4(over_checker ? mix(vec3(squares()), shown, coverage) : shown, 1.0);
#else
    result = vec4(display_color(vec4(abs(color), pixel.a)).rgb, 1.0);
#endif
})";

// Milliseconds between checks of the clock: the time of a step is only predicted from the previous one, and other threads can
// delay it.
constexpr double max_step = 2.5;
// Predicted milliseconds up to which a denoised image is drawn finer than its coarse frame: an edit must show at once.
constexpr double max_finer_milliseconds = 16, few_pixels = 1e5; // these are always fast: the speed of small images says little

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) { return std::chrono::duration<double, std::milli>(Clock::now() - begin).count(); }

constexpr GLint image_unit = 0, denoised_unit = 1, first_table_unit = 2;

std::pair<GLenum, GlTexture> upload_table(const DisplayShader::Lut& lut) {
    const GLenum target = lut.dimensions == 1 ? GL_TEXTURE_1D : lut.dimensions == 2 ? GL_TEXTURE_2D : GL_TEXTURE_3D;
    const GLenum format = lut.channels == 1 ? GL_RED : GL_RGB;
    const GLint internal = lut.channels == 1 ? GL_R32F : GL_RGB32F;
    GlTexture texture = GlTexture::create();
    glBindTexture(target, texture.name());
    for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) glTexParameteri(target, wrap, GL_CLAMP_TO_EDGE);
    for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(target, filter, lut.linear ? GL_LINEAR : GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const float* values = lut.values.data();
    if (target == GL_TEXTURE_1D)
        glTexImage1D(target, 0, internal, lut.width, 0, format, GL_FLOAT, values);
    else if (target == GL_TEXTURE_2D)
        glTexImage2D(target, 0, internal, lut.width, lut.height, 0, format, GL_FLOAT, values);
    else
        glTexImage3D(target, 0, internal, lut.width, lut.height, lut.depth, 0, format, GL_FLOAT, values);
    return {target, std::move(texture)};
}

void set(GLuint program, const char* name, float value) { glUniform1f(glGetUniformLocation(program, name), value); }
void set(GLuint program, const char* name, int value) { glUniform1i(glGetUniformLocation(program, name), value); }

void set_numbers(GLuint program, const DisplayParameters& n) {
    set(program, "exposure_ev", n.exposure_ev);
    set(program, "gamma", n.gamma);
    const Affine& m = n.white_balance;
    const float columns[] = {m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z, m.z.x, m.z.y, m.z.z};
    glUniformMatrix3fv(glGetUniformLocation(program, "white_balance"), 1, GL_FALSE, columns);
    set(program, "false_color_of", int(n.false_color.of));
    set(program, "false_color_low", n.false_color.low);
    set(program, "false_color_high", n.false_color.high);
    set(program, "background_as_it_is", int(n.background_as_it_is));
}

} // namespace

Result<void> DisplayPass::set_shader(const DisplayShader& shader) {
    auto common = make_fill_program(shader.text + main_source),
         complete = make_fill_program("#define ALL_STEPS\n" + shader.text + main_source);
    if (!common) return common.error();
    if (!complete) return complete.error();
    common_ = std::move(*common);
    complete_ = std::move(*complete);
    if (!no_vertices_) no_vertices_ = GlVertexArray::create();
    tables_.clear();
    for (const DisplayShader::Lut& lut : shader.luts) tables_.push_back(upload_table(lut));
    for (const GLuint program : {common_.name(), complete_.name()}) {
        glUseProgram(program);
        set(program, "image", image_unit);
        set(program, "denoised", denoised_unit);
        for (size_t i = 0; i < shader.luts.size(); ++i) set(program, shader.luts[i].sampler.c_str(), first_table_unit + GLint(i));
    }
    return {};
}

void DisplayPass::SourceImage::take(int w, int h, Values values) {
    width = w;
    height = h;
    coming = std::move(values);
    next_row = 0;
    // Each edit renders small images before full ones: the texture keeps its maximum size, so it is not reallocated.
    if (texture && w <= room_width && h <= room_height) return;
    room_width = std::max(room_width, w);
    room_height = std::max(room_height, h);
    if (!texture) texture = GlTexture::create();
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glTexImage2D(GL_TEXTURE_2D, 0, format == GL_RGB ? GL_RGB32F : GL_RGBA32F, room_width, room_height, 0, format, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void DisplayPass::SourceImage::upload_rows(int count) {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const size_t channels = format == GL_RGB ? 3 : 4;
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, next_row, width, count, format, GL_FLOAT,
                    coming.get() + size_t(next_row) * size_t(width) * channels);
    next_row += count;
    if (next_row == height) coming.reset();
}

int DisplayPass::Pace::rows(double milliseconds, int width, int left) const {
    return int(std::clamp(pixels_per_millisecond * milliseconds / width, 1.0, double(left)));
}

DisplayPass::Values DisplayPass::kept(std::vector<float> values) {
    const auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    return {owner, owner->data()};
}

void DisplayPass::upload_denoised(int width, int height, Values rgb) { denoised_.take(width, height, std::move(rgb)); }

void DisplayPass::upload(int width, int height, Values rgba) {
    image_.take(width, height, std::move(rgba));
    width_ = width;
    height_ = next_row_ = height;
}

void DisplayPass::begin(const DisplayLook& look) {
    look_ = look;
    if (!common_) return;
    const double fine = double(denoised_.width) * double(denoised_.height);
    const bool finer = look.mix.denoised_weight != 0 && denoised_.width > image_.width &&
                       fine <= std::max(few_pixels, drawing_.pixels_per_millisecond * max_finer_milliseconds);
    width_ = finer ? denoised_.width : image_.width;
    height_ = finer ? denoised_.height : image_.height;
    next_row_ = 0;
}

void DisplayPass::draw_rows(int first, int count) {
    RenderTarget& target = targets_[1 - front_];
    target.begin(width_, height_);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, first, width_, count);
    const GLuint program = (look_.needs_all_steps() ? complete_ : common_).name();
    glUseProgram(program);
    set_numbers(program, look_.numbers);
    set(program, "raw_weight", look_.mix.raw_weight);
    set(program, "denoised_weight", look_.mix.denoised_weight);
    set(program, "over_checker", int(look_.over_checker));
    const auto set_scale = [&](const char* name, const SourceImage& source) {
        glUniform2f(glGetUniformLocation(program, name), float(source.width) / float(width_), float(source.height) / float(height_));
    };
    set_scale("image_scale", image_);
    set_scale("denoised_scale", denoised_);
    glActiveTexture(GL_TEXTURE0 + image_unit);
    glBindTexture(GL_TEXTURE_2D, image_.texture.name());
    glActiveTexture(GL_TEXTURE0 + denoised_unit);
    glBindTexture(GL_TEXTURE_2D, denoised_.texture.name());
    for (size_t i = 0; i < tables_.size(); ++i) {
        glActiveTexture(GLenum(GL_TEXTURE0 + first_table_unit + GLint(i)));
        glBindTexture(tables_[i].first, tables_[i].second.name());
    }
    glBindVertexArray(no_vertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
    glActiveTexture(GL_TEXTURE0);
    glDisable(GL_SCISSOR_TEST);
    target.end();
}

// One small step: uploads some rows if an upload is pending, else draws some rows.
void DisplayPass::step(double milliseconds) {
    SourceImage* const comes = image_.coming ? &image_ : denoised_.coming ? &denoised_ : nullptr;
    const int width = comes ? comes->width : width_, left = comes ? comes->height - comes->next_row : height_ - next_row_;
    Pace& pace = comes ? uploading_ : drawing_;
    const int count = pace.rows(milliseconds, width, left);
    const auto begin = Clock::now();
    if (comes)
        comes->upload_rows(count);
    else
        draw_rows(std::exchange(next_row_, next_row_ + count), count);
    glFinish(); // otherwise only the time of queueing would be measured
    pace.pixels_per_millisecond = double(count) * width / std::max(milliseconds_since(begin), 1e-3);
}

void DisplayPass::advance(double milliseconds) {
    if (!busy()) return;
    const auto begin = Clock::now();
    for (double left = milliseconds; busy() && left > 0; left = milliseconds - milliseconds_since(begin)) step(std::min(left, max_step));
    if (busy()) return;
    front_ = 1 - front_;
    textures_changed();
}

} // namespace blush
