// Lack of memory, threads or disk space ends with one error line and exit code 1; warnings about what an image cannot show.
#include "core/sanitized.h"
#include "io/image/image_io.h"
#include "io/image/jpeg_encoding.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace blush::TEST_FILE {
namespace {

using test::Finished;
using test::scene_file;
using test::TemporaryFolder;
using Json = nlohmann::json;

// Runs in a shell that sets limits and variables first.
Finished in_shell(const std::string& before, const std::vector<std::string>& arguments) {
    std::string line = before + " exec \"$0\" \"$@\"";
    std::vector<std::string> command{"/bin/sh", "-c", line, BLUSH_BINARY};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return test::run(command);
}

testing::AssertionResult ends_in_one_line(const Finished& finished) {
    if (finished.exit_code != 1) return testing::AssertionFailure() << "exit code " << finished.exit_code << ": " << finished.err;
    if (!test::is_one_line(finished.err) || !finished.err.starts_with("blush: error: ")) return testing::AssertionFailure() << finished.err;
    return testing::AssertionSuccess();
}

std::vector<std::string> small_render(const std::string& output, const std::string& scene = scene_file("cornell")) {
    return {"render", scene, "-o", output, "--size", "64x48", "--spp", "2", "--quiet"};
}

// Sanitizers reserve more address space than these limits.
#ifndef BLUSH_SANITIZED
TEST(Limits, OutOfMemoryIsOneLine) {
    const TemporaryFolder folder;
    int refused = 0;
    for (int mib = 180; mib <= 1000; mib += 40) {
        const Finished finished = in_shell("ulimit -v " + std::to_string(mib * 1024) + ";", small_render(folder / "a.exr"));
        if (finished.exit_code == 0) continue;   // enough
        if (finished.exit_code == 127) continue; // the loader could not load the program's libraries
        ++refused;
        EXPECT_TRUE(ends_in_one_line(finished)) << mib << " MiB";
        EXPECT_EQ(finished.err.find("processor"), std::string::npos) << mib << " MiB: " << finished.err;
        EXPECT_EQ(finished.err.find("std::bad_alloc"), std::string::npos) << mib << " MiB: " << finished.err;
    }
    EXPECT_GT(refused, 0) << "some of these limits must be too low, or nothing was tested";
}

TEST(Limits, TooLargeImagesStateTheirMemory) {
    const TemporaryFolder folder;
    const Finished finished = in_shell(
        "ulimit -v 4000000;", {"render", scene_file("cornell"), "-o", folder / "a.exr", "--size", "20000x20000", "--spp", "1", "--quiet"});
    EXPECT_TRUE(ends_in_one_line(finished));
    EXPECT_NE(finished.err.find("20000 x 20000 pixels needs"), std::string::npos) << finished.err;
    EXPECT_NE(finished.err.find("by ulimit -v"), std::string::npos) << finished.err;
}

// Two copies of a bumpy sheet of 2 n^2 triangles.
std::string sheet_file(const TemporaryFolder& folder, uint32_t n) {
    std::vector<float> positions;
    std::vector<uint32_t> indices;
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            const float x = 2 * float(i) / float(n) - 1, z = 2 * float(j) / float(n) - 1;
            positions.insert(positions.end(), {x, 0.1f * std::sin(9 * x) * std::cos(7 * z), z});
        }
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = j * (n + 1) + i, c = a + n + 2;
            indices.insert(indices.end(), {a, c, a + 1, a, c - 1, c});
        }
    const size_t position_bytes = positions.size() * 4, index_bytes = indices.size() * 4;
    std::ofstream bin(folder / "sheet.bin", std::ios::binary);
    bin.write(reinterpret_cast<const char*>(positions.data()), std::streamsize(position_bytes));
    bin.write(reinterpret_cast<const char*>(indices.data()), std::streamsize(index_bytes));
    const Json json = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes", {{{"mesh", 0}}, {{"mesh", 0}, {"translation", {0, 1, 0}}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
        {"accessors",
         {{{"bufferView", 0},
           {"componentType", 5126},
           {"count", positions.size() / 3},
           {"type", "VEC3"},
           {"min", {-1, -1, -1}},
           {"max", {1, 1, 1}}},
          {{"bufferView", 1}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}}}},
        {"bufferViews",
         {{{"buffer", 0}, {"byteLength", position_bytes}}, {{"buffer", 0}, {"byteOffset", position_bytes}, {"byteLength", index_bytes}}}},
        {"buffers", {{{"byteLength", position_bytes + index_bytes}, {"uri", "sheet.bin"}}}}};
    const std::string file = folder / "sheet.gltf";
    std::ofstream(file) << json;
    return file;
}

TEST(Limits, InfoSaysThatTreesAreCompactForWantOfMemory) {
    const TemporaryFolder folder;
    const std::string scene = sheet_file(folder, 700);
    const std::string plenty = "memory suffices, and tracing is faster";
    EXPECT_NE(test::blush({"info", scene}).out.find(plenty), std::string::npos);
    int compact = 0;
    for (int mib = 600; mib <= 2000; mib += 40) {
        // One arena of malloc: otherwise the address space in use depends on which threads meet.
        const Finished finished = in_shell("export MALLOC_ARENA_MAX=1; ulimit -v " + std::to_string(mib * 1024) + ";", {"info", scene});
        if (finished.exit_code == 127) continue; // the loader could not load the program's libraries
        if (finished.exit_code != 0) {
            EXPECT_TRUE(ends_in_one_line(finished)) << mib << " MiB";
            continue;
        }
        if (finished.out.find(plenty) != std::string::npos) break;
        compact += finished.out.find("memory is short for 980000 triangles: tracing takes 1.24 times as long") != std::string::npos;
    }
    EXPECT_GT(compact, 0) << "some of these limits must leave little, or nothing was tested";
}

// Encodes in a child process that may use only so much more address space: 'w' written, 'e' an Error; 'x' if the process ended.
char encoded_within(size_t bytes, int width, int height, const std::vector<uint8_t>& rgb) {
    const pid_t child = fork();
    if (child == 0) {
        size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlim_t most = pages * size_t(sysconf(_SC_PAGESIZE)) + bytes;
        const rlimit limit{most, most};
        std::atexit([] { _exit('x'); }); // other handlers would wait for threads that a child does not have
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit('l');
        _exit(encode_jpeg("a.jpg", width, height, rgb) ? 'w' : 'e');
    }
    int status = 0;
    waitpid(child, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    return code == 'w' || code == 'e' ? char(code) : 'x';
}

TEST(Limits, JpegEncodingNeverEndsTheProcess) {
    // Noise, so that the file is large.
    constexpr int width = 65500, height = 48;
    std::vector<uint8_t> rgb(size_t(width) * height * 3);
    uint32_t state = 1;
    for (uint8_t& value : rgb) value = uint8_t((state = state * 1664525 + 1013904223) >> 24);
    std::string ends;
    for (size_t kib = 16; kib <= size_t(1) << 17; kib = kib * 3 / 2) ends += encoded_within(kib * 1024, width, height, rgb);
    const size_t enough = ends.find('w');
    EXPECT_EQ(ends.find('x'), std::string::npos) << ends;
    EXPECT_NE(enough, std::string::npos) << ends;
    EXPECT_GT(std::min(enough, ends.size()), 3u) << "some of these limits must be too low: " << ends;
}
#endif

TEST(Limits, OfFilesAreReported) {
    const TemporaryFolder folder;
    std::vector<std::string> large = small_render(folder / "a.exr");
    large[5] = "512x512";
    const Finished finished = in_shell("ulimit -f 8;", large);
    EXPECT_TRUE(ends_in_one_line(finished));
    EXPECT_NE(finished.err.find("File too large"), std::string::npos) << finished.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Limits, LibrariesStayQuiet) {
    const TemporaryFolder folder;
    for (const std::string variables : {"OMP_NUM_THREADS=x", "OMP_DISPLAY_ENV=verbose", "OMP_STACKSIZE=-1 OMP_WAIT_POLICY=never",
                                        "GOMP_SPINCOUNT=no", "GOMP_CPU_AFFINITY=x", "TBB_VERSION=1"})
        for (const char* threads : {"1", "1024"}) {
            std::vector<std::string> arguments = small_render(folder / "a.exr");
            arguments.insert(arguments.end(), {"--threads", threads});
            const Finished finished = in_shell("export " + variables + ";", arguments);
            EXPECT_EQ(finished.exit_code, 0) << finished.err;
            EXPECT_EQ(finished.err, "") << variables;
            EXPECT_EQ(finished.out, "") << variables;
        }
}

TEST(Limits, ImpossibleJpegsAreRefusedBeforeRendering) {
    const TemporaryFolder folder;
    for (const char* size : {"65501x1", "1x65536"}) {
        const Finished finished = test::blush({"render", folder / "not-there.gltf", "-o", folder / "a.jpg", "--size", size});
        EXPECT_EQ(finished.exit_code, 2);
        EXPECT_TRUE(test::is_one_line(finished.err)) << finished.err;
        EXPECT_NE(finished.err.find("at most 65500 pixels a side"), std::string::npos) << finished.err;
    }
    // And when it is written, in this process, which continues.
    const std::vector<float> row(size_t(65501) * 3, 0.5f);
    const Result<void> written = write_display_image(folder / "a.jpg", 65501, 1, row);
    ASSERT_FALSE(written);
    EXPECT_NE(written.error().what.find("at most 65500"), std::string::npos);
    ASSERT_TRUE(
        write_display_image(folder / "a.jpg", 65500, 1, std::span(row).first(size_t(65500) * 3), {{"long", std::string(200000, 'x')}}));
}

// ---- warnings about an image

// One triangle in front of or behind the camera.
std::string triangle_file(const TemporaryFolder& folder, double z) {
    const std::string file = folder / "triangle.gltf";
    const Json json = {
        {"asset", {{"version", "2.0"}}},
        {"scene", 0},
        {"scenes", {{{"nodes", {0, 1}}}}},
        {"nodes", {{{"mesh", 0}}, {{"camera", 0}, {"translation", {0.3, 0.3, z}}}}},
        {"cameras", {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}}},
        {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}, {"min", {0, 0, 0}}, {"max", {1, 1, 0}}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", 36}}}},
        {"buffers",
         {{{"byteLength", 36}, {"uri", "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}}}};
    std::ofstream(file) << json;
    return file;
}

double mean_of(const std::string& exr) {
    const LayeredImage image = *read_layers(exr);
    double sum = 0;
    for (const float v : image.find("G")->values) sum += double(v);
    return sum / double(image.find("G")->values.size());
}

TEST(Warnings, NoLightInAFileSuggestsALightRig) {
    const TemporaryFolder folder;
    const std::string scene = triangle_file(folder, 2);
    const std::vector<std::string> arguments{"render", scene, "-o", folder / "a.exr", "--size", "64x48", "--spp", "16"};
    const Finished dark = test::blush(arguments);
    EXPECT_EQ(dark.exit_code, 0);
    EXPECT_NE(dark.err.find("no light in this file"), std::string::npos) << dark.err;
    EXPECT_EQ(mean_of(folder / "a.exr"), 0);
    for (const char* rig : {"studio", "sky"}) {
        std::vector<std::string> lit = arguments;
        lit.insert(lit.end(), {"--light", rig});
        const Finished finished = test::blush(lit);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        EXPECT_EQ(finished.err.find("no light"), std::string::npos) << finished.err;
        EXPECT_GT(mean_of(folder / "a.exr"), 0.1) << rig;
        EXPECT_LT(mean_of(folder / "a.exr"), 0.8) << rig;
    }
    std::vector<std::string> as_it_is = arguments;
    as_it_is.insert(as_it_is.end(), {"--light", "none"});
    EXPECT_EQ(test::blush(as_it_is).err.find("no light"), std::string::npos) << "it was requested";
    EXPECT_EQ(test::blush({"render", scene, "-o", folder / "a.exr", "--light", "moon"}).exit_code, 2);
    const Finished own =
        test::blush({"render", scene_file("cornell"), "-o", folder / "a.exr", "--size", "16x16", "--spp", "1", "--light", "studio"});
    EXPECT_NE(own.err.find("has its own lights"), std::string::npos) << own.err;
}

TEST(Warnings, NothingIsVisible) {
    const TemporaryFolder folder;
    for (const double z : {2.0, -2.0}) {
        const Json json = test::blush_json(
            {"render", triangle_file(folder, z), "-o", folder / "a.exr", "--size", "32x32", "--spp", "1", "--env", "constant=1,1,1"});
        EXPECT_EQ(json["warnings"].dump().find("sees no object") != std::string::npos, z < 0) << json["warnings"];
    }
}

// The triangle, of this material, and a point light without size.
std::string lit_triangle_file(const TemporaryFolder& folder, const Json& material) {
    const std::string scene = triangle_file(folder, 2);
    Json json = Json::parse(std::ifstream(scene));
    json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_transmission", "KHR_materials_volume"};
    json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 10}}};
    json["nodes"].push_back({{"translation", {0.3, 0.3, 1}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    json["scenes"][0]["nodes"].push_back(2);
    json["meshes"][0]["primitives"][0]["material"] = 0;
    json["materials"].push_back(material); // not = {material}: Clang copies it, GCC makes an array
    std::ofstream(scene) << json;
    return scene;
}

Json mirror(double roughness) { return {{"pbrMetallicRoughness", {{"metallicFactor", 1}, {"roughnessFactor", roughness}}}}; }

Json glass(double roughness) {
    Json material = {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", roughness}}}};
    material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 1;
    material["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 1; // solid
    return material;
}

TEST(Warnings, LightThatCannotBeFound) {
    const TemporaryFolder folder;
    for (const double roughness : {0.0, 0.5}) {
        const std::string scene = lit_triangle_file(folder, mirror(roughness));
        const std::vector<std::string> arguments{"render", scene, "-o", folder / "a.exr", "--size", "32x24", "--spp", "16"};
        const Finished finished = test::blush(arguments);
        EXPECT_EQ(finished.exit_code, 0) << finished.err;
        const bool smooth = roughness == 0;
        EXPECT_EQ(finished.out.find(", some light cannot be found") != std::string::npos, smooth) << finished.out;
        const Json error = test::blush_json(arguments)["error"];
        EXPECT_EQ(error["missing_light"].is_string(), smooth) << error;
        EXPECT_TRUE(error["relmse"].is_null() || !smooth) << error;
    }
}

// As text and as JSON: which light, by which paths, and what to do.
TEST(Warnings, InfoNamesLightThatCannotBeFound) {
    const TemporaryFolder folder;
    const std::string begin = "some light cannot be found: caustics of point, spot and sun lights of zero size, where they are seen ",
                      end = "; give these lights a radius or an angle, or the material some roughness";
    const struct {
        Json material;
        std::string paths; // empty: all light is found
    } cases[]{
        {glass(0), "through smooth glass or in smooth surfaces"}, {mirror(0), "in smooth surfaces"}, {glass(0.5), ""}, {mirror(0.5), ""}};
    for (const auto& [material, paths] : cases) {
        const std::string scene = lit_triangle_file(folder, material), warning = begin + paths + end;
        const Finished text = test::blush({"info", scene});
        EXPECT_EQ(text.exit_code, 0) << text.err;
        std::vector<std::string> said;
        const Json json = test::blush_json({"info", scene});
        for (const Json& line : json["warnings"])
            if (line.get<std::string>().find("cannot be found") != std::string::npos) said.push_back(line);
        if (paths.empty()) {
            EXPECT_EQ(text.out.find("cannot be found"), std::string::npos) << material << text.out;
            EXPECT_TRUE(said.empty()) << material << said.front();
        } else {
            EXPECT_NE(text.out.find("warning                " + warning + "\n"), std::string::npos) << material << text.out;
            EXPECT_EQ(said, std::vector<std::string>{warning}) << material;
        }
    }
}

TEST(Warnings, EnvironmentsWithInvalidRadiance) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(write_exr(folder / "sky.exr", {2, 1, {{"R", {1, nan}}, {"G", {1, inf}}, {"B", {1, -1}}}, {}}));
    const Json json = test::blush_json(
        {"render", scene_file("furnace"), "-o", folder / "a.exr", "--size", "16x16", "--spp", "1", "--env", folder / "sky.exr"});
    EXPECT_NE(json["warnings"].dump().find("3 values are negative or not finite"), std::string::npos) << json["warnings"];
}

TEST(Warnings, ComparedPixelsThatAreNotFinite) {
    const TemporaryFolder folder;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto write = [&](const char* name, std::vector<float> values) {
        ASSERT_TRUE(write_exr(folder / name, {2, 1, {{"R", values}, {"G", values}, {"B", values}}, {}}));
    };
    write("a.exr", {0.5f, nan});
    write("b.exr", {0.5f, 1});
    write("bad.exr", {nan, nan});
    const Finished some = test::blush({"compare", folder / "a.exr", folder / "b.exr", "--quiet"});
    EXPECT_EQ(some.exit_code, 0);
    EXPECT_NE(some.err.find("a.exr: 1 pixel is not finite"), std::string::npos) << some.err;
    const Finished none = test::blush({"compare", folder / "bad.exr", folder / "b.exr", "--quiet"});
    EXPECT_TRUE(ends_in_one_line(none));
}

} // namespace
} // namespace blush::TEST_FILE
