#include "tests/support/images.h"

#include <cstdlib>
#include <string_view>

namespace blush::test {
namespace {

template <class T> std::string_view bytes_of(const std::vector<T>& v) {
    return {reinterpret_cast<const char*>(v.data()), v.size() * sizeof(T)};
}

struct Plane {
    const char* name;
    std::string_view bytes;
    size_t pixel_size;
};
std::vector<Plane> planes_of(const Frame& frame) {
    std::vector<Plane> planes{{"rgba", bytes_of(frame.rgba), 4 * sizeof(float)},
                              {"samples", bytes_of(frame.pixel_samples), sizeof(float)},
                              {"albedo", bytes_of(frame.albedo), sizeof(Vec3)},
                              {"normal", bytes_of(frame.normal), sizeof(Vec3)},
                              {"depth", bytes_of(frame.depth), sizeof(float)},
                              {"object id", bytes_of(frame.object_id), sizeof(uint32_t)},
                              {"material id", bytes_of(frame.material_id), sizeof(uint32_t)}};
    for (const std::vector<Vec3>& group : frame.groups) planes.push_back({"group", bytes_of(group), sizeof(Vec3)});
    return planes;
}

} // namespace

RendererOptions all_planes(unsigned threads) { return {threads, false, {true, true, true, true}}; }

Frame fresh_image(const Scene& scene, const RenderSettings& settings, int64_t count, unsigned threads) {
    Renderer renderer(all_planes(threads));
    renderer.update(scene, settings);
    renderer.render(settings.first_sample, count);
    return renderer.resolve();
}

Frame render_in_steps(const Scene& scene, const RenderSettings& settings, const RendererOptions& options,
                      std::initializer_list<int64_t> ends) {
    Renderer renderer(options);
    renderer.update(scene, settings);
    int64_t first = settings.first_sample;
    for (const int64_t end : ends) {
        EXPECT_TRUE(renderer.render(first, end - first));
        first = end;
    }
    return renderer.resolve();
}

void for_each_isa(const std::function<void(const std::string&)>& test) {
    const char* const before = std::getenv("BLUSH_ISA");
    const std::string kept = before ? before : "";
    for (const std::string& isa : available_isas()) {
        setenv("BLUSH_ISA", isa.c_str(), 1);
        test(isa);
    }
    before ? setenv("BLUSH_ISA", kept.c_str(), 1) : unsetenv("BLUSH_ISA");
}

::testing::AssertionResult same_pixels(const Frame& a, const Frame& b) {
    if (a.width != b.width || a.height != b.height) return ::testing::AssertionFailure() << "sizes differ";
    if (a.samples != b.samples) return ::testing::AssertionFailure() << a.samples << " samples against " << b.samples;
    const std::vector<Plane> planes_a = planes_of(a), planes_b = planes_of(b);
    if (planes_a.size() != planes_b.size()) return ::testing::AssertionFailure() << "different groups";
    ::testing::AssertionResult result = ::testing::AssertionSuccess();
    for (size_t i = 0; i < planes_a.size(); ++i) {
        const auto& [name, p, pixel_size] = planes_a[i];
        const std::string_view q = planes_b[i].bytes;
        if (p == q) continue;
        if (p.size() != q.size()) return ::testing::AssertionFailure() << name << " exists in one image only";
        size_t differing = 0, first = 0;
        for (size_t k = p.size() / pixel_size; k-- > 0;)
            if (p.substr(k * pixel_size, pixel_size) != q.substr(k * pixel_size, pixel_size)) ++differing, first = k;
        if (result) result = ::testing::AssertionFailure();
        result << name << " differs in " << differing << " pixels, first at " << first % size_t(a.width) << "," << first / size_t(a.width)
               << "; ";
    }
    return result;
}

uint64_t checksum(const Frame& frame) {
    uint64_t sum = 14695981039346656037u; // FNV-1a
    const auto add = [&](std::string_view bytes) {
        for (const char c : bytes) sum = (sum ^ uint8_t(c)) * 1099511628211u;
    };
    for (const Plane& plane : planes_of(frame)) add(plane.bytes);
    const int64_t numbers[] = {int64_t(frame.revision), frame.width, frame.height, frame.divider, frame.samples, frame.complete};
    add({reinterpret_cast<const char*>(numbers), sizeof(numbers)});
    return sum;
}

} // namespace blush::test
