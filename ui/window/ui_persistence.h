// Where each part of the UI state is saved.
//
// | state                                                       | kept in                                    | undone by           |
// |-------------------------------------------------------------|--------------------------------------------|---------------------|
// | scene, render and display settings, light mix, meters,      | the scene file (glTF, extras.blush), the   | undo                |
// |   measured and rendered region, links, groups, mute, solo   |   recovery sidecar, every snapshot         |                     |
// | camera pose                                                 | the same; not an undo step                 | moving, frame, look |
// | snapshots: image, state, samples, name, note              | layered EXR in the snapshot folder         | undo of the restore |
// | size, splitters and docks, text size, folder, recent files, | window.json                                | the same control    |
// |   overlays, snapshot settings                               |                                            |                     |
// | settings of panels, positions of floating windows,          | window.json, written here                  | the same control    |
// |   sections, tab, raw or denoised                            |                                            |                     |
// | per scene: zoom and pan, selection, folded rows of the      | window.json, for the last ten scenes       | zoom, select,       |
// |   outliner, unfolded group of the mix, snapshots            |                                            |   restore snapshot  |
// |   in the strip, open instruments                            |                                            |                     |
// | convergence runs                                            | CSV, SVG or PNG, by its Export             | the panel's own     |
// | import report, health, results of roulette lab, strategies, | not saved: read again from the file, or    |                     |
// |   meters and bleed probe                                    |   measured again                           |                     |
// | tool, drag, placing, light camera, traced paths, dialogs,   | not saved: temporary                       | Esc                 |
// |   comparison, wipes of the two piles, place of the bleed    |                                            |                     |
// |   probe, pause, playback, text being typed,                 |                                            |                     |
// |   pixel popup, sheet of shortcuts, toasts                   |                                            |                     |
#pragma once

#include "ui/window/ui_state.h"

#include <string>

namespace blush {

// Saves and restores panels, tab and view modes. Missing or invalid entries leave the state unchanged.
void save_panels(const UiState& ui, WindowSettings& settings);
void restore_panels(const WindowSettings& settings, UiState& ui);

// The state saved per scene file (above). An unknown file gets zoom to fit, and nothing selected or unfolded.
void save_scene_ui(const UiState& ui, const std::string& file, WindowSettings& settings);
void restore_scene_ui(const WindowSettings& settings, const std::string& file, const Scene& scene, UiState& ui);

} // namespace blush
