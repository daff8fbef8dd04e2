// Plans made and run by the built program, for tests.
#pragma once

#include "io/image/image_io.h"
#include "tests/app/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace blush::test {

using Arguments = std::vector<std::string>;

inline Arguments joined(Arguments arguments, const Arguments& more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

inline Finished expect_done(const Arguments& arguments) {
    Finished finished = blush(arguments);
    EXPECT_EQ(finished.exit_code, 0) << finished.err;
    return finished;
}

inline std::string text_of(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

inline void write_text(const std::string& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

inline std::vector<std::string> lines_of(const std::string& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

inline nlohmann::json json_of(const std::string& file) { return nlohmann::json::parse(text_of(file), nullptr, false); }

inline Finished shell(const std::string& command) { return run({"/bin/sh", "-c", command}); }

// A copy of a shipped scene, which a test may change.
inline std::string scene_copy(const TemporaryFolder& folder, const std::string& name) {
    for (const char* ending : {".gltf", ".bin"})
        std::filesystem::copy_file(std::filesystem::path(scene_file(name)).replace_extension(ending), folder / (name + ending));
    return folder / (name + ".gltf");
}

// A process that is not waited for yet.
class Started {
public:
    struct Program {
        Arguments words; // its path and arguments
    };
    // Of the built program. `most_bytes`: limit of a file it writes, as on a full disk; 0: none.
    explicit Started(const Arguments& arguments, uint64_t most_bytes = 0)
        : Started(Program{joined({BLUSH_BINARY}, arguments)}, most_bytes) {}
    explicit Started(Program program, uint64_t most_bytes = 0) {
        std::vector<char*> words;
        for (std::string& word : program.words) words.push_back(word.data());
        words.push_back(nullptr);
        pid_ = fork();
        if (pid_ != 0) return;
        if (most_bytes > 0) {
            const rlimit limit{most_bytes, most_bytes};
            setrlimit(RLIMIT_FSIZE, &limit);
        }
        const int nothing = open("/dev/null", O_RDWR);
        for (int fd = 0; fd < 3; ++fd) dup2(nothing, fd);
        execv(words[0], words.data());
        _exit(127);
    }
    ~Started() {
        if (pid_ > 0) end(SIGKILL);
    }
    Started(const Started&) = delete;
    Started& operator=(const Started&) = delete;

    int pid() const { return pid_; }
    void signal(int number) const { kill(pid_, number); }
    // Exit code, or 128 + signal.
    int wait() {
        int state = 0;
        waitpid(pid_, &state, 0);
        pid_ = -1;
        return WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
    }
    int end(int number) {
        signal(number);
        return wait();
    }
    int end_after(std::chrono::milliseconds time, int number) {
        std::this_thread::sleep_for(time);
        return end(number);
    }

private:
    pid_t pid_ = -1;
};

// The beauty is the same to the bit.
inline void expect_same_pixels(const std::string& file, const std::string& expected_file) {
    const Result<LayeredImage> image = read_layers(file), expected = read_layers(expected_file);
    ASSERT_TRUE(image) << image.error().text();
    ASSERT_TRUE(expected) << expected.error().text();
    for (const char* name : {"R", "G", "B", "A"}) {
        ASSERT_TRUE(image->find(name) && expected->find(name)) << name;
        EXPECT_EQ(image->find(name)->values, expected->find(name)->values) << name << " of " << file;
    }
}

// Another colour for a material of this scene: its hash is another one.
inline void change_scene(const std::string& file) {
    nlohmann::json changed = json_of(file);
    changed["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 1};
    write_text(file, changed.dump());
}

// A plan of a small image in a folder of its own.
struct SmallPlan {
    std::string scene, folder;
    int64_t spp = 64, chunk = 16;

    void make(const Arguments& more = {}) const {
        expect_done(joined(
            {"plan", scene, "-o", folder, "--quiet", "--size", "40x24", "--spp", std::to_string(spp), "--chunk", std::to_string(chunk)},
            more));
    }
    // What one process renders.
    void render_whole(const std::string& output, const Arguments& more = {}) const {
        expect_done(joined(
            {"render", scene, "-o", output, "--quiet", "--size", "40x24", "--samples", "0:" + std::to_string(spp), "--layers", "film"},
            more));
    }
    int64_t tasks() const { return int64_t(lines_of(folder + "/commands.txt").size()); }
    Arguments task(int64_t number) const { return {"plan", "run", folder, std::to_string(number), "--quiet"}; }
    Finished run(int64_t number) const { return blush(task(number)); }
    nlohmann::json status() const { return blush_json({"plan", "status", folder}); }
    std::string part(const std::string& look, const std::string& range) const { return folder + "/parts/" + look + "/" + range + ".exr"; }
};

} // namespace blush::test
