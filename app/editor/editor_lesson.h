// A lesson in the window: a document of its own, whose state each step sets, while the user's document waits.
#pragma once

#include "app/commands/lesson/lesson_file.h"
#include "scene/document/document.h"
#include "ui/jobs/background_job.h"
#include "ui/panel_context.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>

namespace blush {

class EditorLesson {
public:
    // `assets`: with scenes/ and lessons/.
    EditorLesson(std::filesystem::path assets, std::function<void()> wake) : assets_(std::move(assets)), wake_(std::move(wake)) {}

    // The shipped lessons, for the menu.
    std::vector<LessonView::File> shipped() const;
    // Executes requests of the panel and the menu, and begins a lesson that is loaded. `user`: its render size is used. Returns true if the
    // window shows another document or scene. Call once per UI frame, with the shown document in the context.
    bool poll(PanelContext c, const Project& user);
    // Ends the lesson: the window looks as before it. False if there is none.
    bool end(PanelContext c);
    // Null without a lesson.
    Document* document() { return document_ ? &*document_ : nullptr; }
    // True, with a toast, for a command of the editor that reads or writes files of the user's scene.
    bool refuses(Command command, UiState& ui) const;

private:
    struct Loaded {
        Lesson lesson;
        std::vector<Project> states; // of its steps
    };
    // What of the window the lesson changes.
    struct Kept {
        std::vector<std::string> panels;
        std::array<std::string, 2> front; // tabs of the docks
        ViewTool tool = ViewTool::none;
        Id<Node> selected;
        std::vector<Id<Node>> also_selected;
        Id<Material> selected_material;
        std::optional<LightMeter> bleed_point;
        std::optional<ImageRegion> bleed_rect;
        std::optional<PathWork::Input> paths_request;
        std::optional<LookedThrough> light_camera;
        HomeView home;
        CameraFrame frame;
        ImageZoom zoom;
        bool strip = false, opening_page = false;
        std::vector<DockTab> moved; // places of panels that make room for the text of the lesson
    };

    // A step that the user went to, and the end of the undo history then.
    struct Reached {
        size_t undo_steps = 0;
        std::string label; // of the last undo step
        size_t step = 0;
    };

    void begin(PanelContext& c, Loaded loaded);
    void go_to(PanelContext& c, size_t step, const Project& user);
    // The panels and tool of a step whose state the document has.
    void show(PanelContext& c, size_t step);
    size_t step_of_document(size_t shown) const;
    // True if the document has the state of a step with another scene.
    bool follow_document(PanelContext& c);
    static Kept kept(const PanelContext& c);
    void make_room(UiState& ui, const std::vector<std::string>& panels);

    std::filesystem::path assets_;
    std::function<void()> wake_;
    Loaded loaded_;
    std::optional<Document> document_;
    std::optional<Kept> kept_;
    std::vector<Reached> reached_;                       // in the order of undo steps; some may be of a future that edits have replaced
    uint64_t shown_revision_ = 0;                        // of the document, when the shown step was last compared with it
    int frames_to_front_ = 0;                            // the panels of the step open first; one beside the lesson would hide it
    std::unique_ptr<BackgroundJob<Result<Loaded>>> job_; // last: it uses what is above
};

} // namespace blush
