// What the command line chooses of what a file offers: a moment of an animation, one of its scenes, a variant of its materials.
#pragma once

#include "core/result.h"
#include "scene/scene.h"

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace blush {

// Names or numbers from 0; a name wins. Empty: as the file has it.
struct StagingChoice {
    std::string animation = {};          // or "none"
    std::optional<float> seconds = {};   // of that animation, or of the one that is chosen
    std::string scene = {};
    std::string variant = {};            // or "none"
    bool operator==(const StagingChoice&) const = default;
};

// Errors: nothing of that name, a time without an animation, a time that is no number from 0.
Result<Staging> find_staging(const StagingChoice& choice, const Scene& scene);

void add_staging_options(CLI::App& app, StagingChoice& choice);

} // namespace blush
