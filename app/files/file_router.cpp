#include "app/files/file_router.h"

#include "ui/window/file_listing.h"

#include <utility>

namespace blush {

void FileRouter::browse(FileRequest::Use use) {
    std::error_code error;
    std::filesystem::path folder = use == FileRequest::Use::snapshot_folder ? ui.settings.snapshot_folder : ui.settings.browser_folder;
    if (!std::filesystem::is_directory(folder, error)) folder = files.scene_file().parent_path();
    if (!std::filesystem::is_directory(folder, error)) folder = std::filesystem::current_path(error);
    ui.browser = FileBrowser{use, std::filesystem::absolute(folder, error), {}, {}, true, files.scene_file().parent_path()};
}

bool FileRouter::browse_for(Command command) {
    using Use = FileRequest::Use;
    constexpr std::pair<Command, Use> asking[] = {{Command::open, Use::open},
                                                  {Command::import_scene, Use::import_scene},
                                                  {Command::environment, Use::environment},
                                                  {Command::ies, Use::ies},
                                                  {Command::map, Use::map},
                                                  {Command::snapshot_folder, Use::snapshot_folder},
                                                  {Command::load_convergence, Use::convergence},
                                                  {Command::farm_looks, Use::looks}};
    for (const auto& [asked, use] : asking) {
        if (command != asked) continue;
        browse(use);
        return true;
    }
    return false;
}

void FileRouter::take(const FileRequest& request) {
    if (ui.lesson.is_on()) return ui.toasts.note(LessonView::refusal, LessonView::refusal_details);
    switch (request.use) {
    case FileRequest::Use::open:
        if (matches(snapshot_files, request.path)) return snapshots.open(request.path, files.scene_file(), false);
        return saving.before_losing_edits("opening another scene", [&files = files, path = request.path] { files.open(path); });
    case FileRequest::Use::save_scene: return saving.save_as(request.path);
    case FileRequest::Use::import_scene: return files.import_scene(request.path);
    case FileRequest::Use::environment: return files.load_environment(request.path);
    case FileRequest::Use::convergence: return convergence.load(ui, request.path);
    case FileRequest::Use::ies: return files.load_ies(request.path, document, ui);
    case FileRequest::Use::map: return files.load_map(request.path, ui);
    case FileRequest::Use::looks: ui.farm.choices.looks_file = request.path; return;
    case FileRequest::Use::snapshot_folder:
        ui.settings.snapshot_folder = request.path.string();
        return ui.toasts.note("Snapshots go to " + request.path.string());
    }
}

void FileRouter::dispatch_dropped(const std::filesystem::path& file) {
    if (matches(lesson_files, file))
        ui.lesson.to_open = file;
    else if (ui.lesson.is_on())
        ui.toasts.note(LessonView::refusal, LessonView::refusal_details);
    else if (matches(scene_files, file))
        take({FileRequest::Use::open, file});
    else if (matches(snapshot_files, file))
        snapshots.open(file, files.scene_file(), true);
    else if (matches(environment_files, file))
        files.load_environment(file);
    else if (matches(table_files, file))
        convergence.load(ui, file);
    else if (matches(photometric_files, file))
        files.load_ies(file, document, ui);
    else
        ui.toasts.fail(file.filename().string() + " cannot be opened",
                       "Drop a glTF scene (.gltf, .glb), an environment image (.hdr, .exr), a rendered image (.exr), an IES file (.ies), "
                       "a convergence table (.csv) or a lesson (.md).");
}

} // namespace blush
