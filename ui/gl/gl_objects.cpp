#include "ui/gl/gl_objects.h"

namespace blush {
namespace {

// One triangle that covers the render target.
const char* const vertex_source = R"(#version 330 core
out vec2 uv;
void main() {
    uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);
})";

Result<void> attach_shader(GLuint program, GLenum stage, const std::string& source) {
    const GLuint shader = glCreateShader(stage);
    const char* const text = source.c_str();
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader); // deleted together with the program
    GLint compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled) return {};
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
    log.resize(size_t(length));
    return Error{"", "the graphics driver cannot compile a shader: " + log, ""};
}

} // namespace

Result<GlProgram> make_fill_program(const std::string& fragment_source) {
    GlProgram program = GlProgram::create();
    if (auto r = attach_shader(program.name(), GL_VERTEX_SHADER, vertex_source); !r) return r.error();
    const std::string fragment = "#version 330 core\nin vec2 uv;\nout vec4 result;\n" + fragment_source;
    if (auto r = attach_shader(program.name(), GL_FRAGMENT_SHADER, fragment); !r) return r.error();
    glLinkProgram(program.name());
    GLint linked = 0;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (!linked) return Error{"", "the graphics driver cannot link a shader", ""};
    return program;
}

void set_filter(GLuint texture, GLint filter) {
    glBindTexture(GL_TEXTURE_2D, texture);
    GLint was = 0;
    glGetTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, &was);
    if (was == filter) return;
    for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTexParameteri(GL_TEXTURE_2D, which, filter);
    textures_changed();
}

void RenderTarget::begin(int width, int height) {
    if (!texture_) {
        texture_ = GlTexture::create();
        framebuffer_ = GlFramebuffer::create();
    }
    if (width != width_ || height != height_) {
        width_ = width;
        height_ = height;
        glBindTexture(GL_TEXTURE_2D, texture_.name());
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_.name(), 0);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    glViewport(0, 0, width, height);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
}

void RenderTarget::end() const { glBindFramebuffer(GL_FRAMEBUFFER, 0); }

} // namespace blush
