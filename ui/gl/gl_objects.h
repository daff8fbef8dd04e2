// Move-only RAII owners of OpenGL objects. A context must be current when they are created, used and destroyed.
#pragma once

#include "core/result.h"
#include "ui/gl/redraw.h"

#include <epoxy/gl.h>
#include <string>
#include <utility>

namespace blush {

template <class Kind> class GlObject {
public:
    GlObject() = default;
    static GlObject create() { return GlObject(Kind::create()); }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    ~GlObject() {
        if (name_) Kind::destroy(name_);
    }
    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

private:
    explicit GlObject(GLuint name) : name_(name) {}
    GLuint name_ = 0;
};

struct GlTextureKind {
    static GLuint create() {
        textures_changed(); // the name may be that of a deleted texture
        GLuint name = 0;
        glGenTextures(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct GlFramebufferKind {
    static GLuint create() {
        GLuint name = 0;
        glGenFramebuffers(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct GlVertexArrayKind {
    static GLuint create() {
        GLuint name = 0;
        glGenVertexArrays(1, &name);
        return name;
    }
    static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct GlProgramKind {
    static GLuint create() { return glCreateProgram(); }
    static void destroy(GLuint name) { glDeleteProgram(name); }
};

using GlTexture = GlObject<GlTextureKind>;
using GlFramebuffer = GlObject<GlFramebufferKind>;
using GlVertexArray = GlObject<GlVertexArrayKind>;
using GlProgram = GlObject<GlProgramKind>;

// A program that fills the target with `fragment_source` (GLSL 3.30 without #version). Its input is `in vec2 uv`, (0, 0) in the
// first row of the target, its output `out vec4 result`. Errors contain the compiler's log.
Result<GlProgram> make_fill_program(const std::string& fragment_source);

// Filter for a 2D texture, smaller and larger than on the screen: GL_LINEAR or GL_NEAREST. With the same for both, no level of
// detail has to be computed.
void set_filter(GLuint texture, GLint filter);

// A texture used as render target and for display, resized on demand.
class RenderTarget {
public:
    // Binds the framebuffer, with its whole size as viewport. RGBA8, linear filter for display.
    void begin(int width, int height);
    // Binds the window's framebuffer.
    void end() const;
    GLuint texture() const { return texture_.name(); }
    int width() const { return width_; }
    int height() const { return height_; }

private:
    GlTexture texture_;
    GlFramebuffer framebuffer_;
    int width_ = 0, height_ = 0;
};

} // namespace blush
