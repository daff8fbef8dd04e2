// What the panels share that measure while they are open: the strategies, the samplers and the integrators.
#pragma once

#include "ui/panel_context.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace blush {

// The settings of the image, at its full size.
inline RenderSettings lab_image_settings(const PanelContext& c) {
    RenderSettings settings = c.project().render;
    settings.width = c.render_width;
    settings.height = c.render_height;
    return settings;
}

// Starts the runner of a view, gives it `input` and polls view.state; requests another frame while more is to come. Returns what went
// wrong; empty: nothing.
template <class View, class Input> const std::string& measure_while_open(PanelContext& c, View& view, Input input) {
    using Runner = typename decltype(view.runner)::element_type;
    if (!view.runner) view.runner = std::make_shared<Runner>();
    view.runner->measure(std::move(input));
    view.state = view.runner->state();
    if (!view.state.rests && view.state.failure.empty()) c.ui.seconds_to_next_frame = std::min(c.ui.seconds_to_next_frame, 0.2);
    return view.state.failure;
}

} // namespace blush
