// Move-only owners of OpenGL objects. A context must be current wherever they are made, used and destroyed.
#pragma once

#include "core/result.h"

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

// A program that fills the target with `fragment_source` (GLSL 3.30 without #version); its input is `in vec2 uv`, (0, 0) in
// the first row of the target, and its output `out vec4 result`. The error holds the compiler's message.
Result<GlProgram> make_fill_program(const std::string& fragment_source);

// GL_LINEAR or GL_NEAREST, for a 2D texture that is shown larger than it is.
void set_filter(GLuint texture, GLint filter);

// A texture to draw into and to show, resized on demand.
class RenderTarget {
public:
    // Binds it for drawing over its whole size. RGBA8, filtered linearly when shown.
    void begin(int width, int height);
    // Back to the window.
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
