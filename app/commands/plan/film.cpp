#include "app/commands/plan/film.h"

#include "app/common/run_program.h"
#include "core/files.h"

#include <fmt/format.h>

namespace blush {
Result<bool> write_film(const std::filesystem::path& folder, const RenderPlan& plan, const std::string& sequence) {
    const std::filesystem::path merged = folder / "merged", list = merged / (sequence + ".ffconcat"), film = merged / (sequence + ".mp4"),
                                begun = merged / (sequence + ".begun.mp4");
    // A list, since frames may have gaps in their numbers.
    std::string frames = "ffconcat version 1.0\n";
    for (const PlanLook& look : plan.looks)
        if (look.sequence == sequence) frames += fmt::format("file {}.png\nduration {:.9f}\n", look.name, 1 / plan.frames_per_second);
    if (const Result<void> written = write_file(list, frames); !written) return written.error();
    // Most players want even sides.
    const std::optional<int> code =
        run_program({"ffmpeg", "-y", "-loglevel", "error", "-f", "concat", "-i", list.string(), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                     "-r", fmt::format("{:.9g}", plan.frames_per_second), "-pix_fmt", "yuv420p", begun.string()});
    std::error_code error;
    std::filesystem::remove(list, error);
    if (!code || *code == 127) return false;
    if (*code == 0) std::filesystem::rename(begun, film, error);
    if (*code == 0 && !error) return true;
    std::filesystem::remove(begun, error);
    return Error{.file = film.string(), .what = fmt::format("ffmpeg failed with exit code {}", *code)};
}

} // namespace blush
