#include "picture.h"

#include "core/math.h"
#include "scene/affine.h"

namespace blush::test {

using namespace statistics;

Measured Picture::region(int x0, int y0, int w, int h) const {
    Measured m;
    for (int y = y0; y < y0 + h; ++y)
        for (int x = x0; x < x0 + w; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            m.mean = m.mean + pixels[i];
            if (!errors.empty()) m.error = m.error + errors[i] * errors[i];
        }
    const double n = double(w) * h;
    m.mean = m.mean / n;
    m.error = Vec3d{std::sqrt(m.error.x), std::sqrt(m.error.y), std::sqrt(m.error.z)} / n;
    return m;
}

std::vector<Measured> Picture::blocks(int w, int h) const {
    std::vector<Measured> all;
    for (int y = 0; y + h <= height; y += h)
        for (int x = 0; x + w <= width; x += w) all.push_back(region(x, y, w, h));
    return all;
}

RenderSettings settings_for(int width, int height, int64_t spp) {
    RenderSettings s;
    s.width = width;
    s.height = height;
    s.spp = spp;
    s.filter = PixelFilter::box;
    return s;
}

Picture render(const Scene& scene, const RenderSettings& settings, const PlaneSet& planes) {
    RendererOptions options;
    options.threads = 1;
    options.planes = planes;
    Renderer renderer(options);
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, settings.spp - settings.first_sample);
    Picture p;
    p.frame = renderer.resolve();
    p.width = p.frame.width;
    p.height = p.frame.height;
    for (size_t i = 0; i < p.frame.rgba.size(); i += 4) p.pixels.push_back({p.frame.rgba[i], p.frame.rgba[i + 1], p.frame.rgba[i + 2]});
    for (const Vec3& e : renderer.resolve_error()) p.errors.push_back(to_double(e));
    EXPECT_EQ(p.frame.health.dropped(), 0) << "samples were dropped";
    EXPECT_EQ(p.frame.health.truncated, 0) << "paths were cut off";
    return p;
}

namespace {

testing::AssertionResult compare(const Vec3d& a, const Vec3d& b, const Vec3d& error, double alpha, double slack) {
    constexpr const char* claims[3] = {"red differs", "green differs", "blue differs"};
    const double each = sidak(alpha, 3);
    const double d[3] = {a.x - b.x, a.y - b.y, a.z - b.z}, e[3] = {error.x, error.y, error.z}, scale[3] = {b.x, b.y, b.z};
    for (int c = 0; c < 3; ++c) {
        if (!std::isfinite(d[c])) return testing::AssertionFailure() << "channel " << c << " is not finite";
        const double beyond = std::copysign(std::max(0.0, std::abs(d[c]) - slack), d[c]);
        if (auto verdict = z_verdict(claims[c], beyond, e[c], scale[c], each); !verdict)
            return verdict << " (" << scale[c] + d[c] << " instead of " << scale[c] << ")";
    }
    return testing::AssertionSuccess();
}

} // namespace

testing::AssertionResult is_mean(const Measured& m, const Vec3d& expected, double alpha, double slack) {
    return compare(m.mean, expected, m.error, alpha, slack);
}
testing::AssertionResult is_mean(const Measured& m, double expected, double alpha, double slack) {
    return is_mean(m, Vec3d{expected, expected, expected}, alpha, slack);
}
testing::AssertionResult same_mean(const Measured& a, const Measured& b, double alpha) {
    const Vec3d error{std::hypot(a.error.x, b.error.x), std::hypot(a.error.y, b.error.y), std::hypot(a.error.z, b.error.z)};
    return compare(a.mean, b.mean, error, alpha, 0);
}
testing::AssertionResult same_means(std::span<const Measured> a, std::span<const Measured> b, double alpha) {
    if (a.size() != b.size() || a.empty()) return testing::AssertionFailure() << a.size() << " blocks and " << b.size();
    for (size_t i = 0; i < a.size(); ++i)
        if (auto verdict = same_mean(a[i], b[i], sidak(alpha, int64_t(a.size()))); !verdict) return verdict << ", block " << i;
    return testing::AssertionSuccess();
}

} // namespace blush::test
