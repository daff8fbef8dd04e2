// Copies a scene with the files it refers to into the folder of a plan, for workers that do not see the original.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>

namespace blush {

// Copies `file` and what its JSON text names (buffers, images, profiles, the environment) into the folder `into`, as it lies below the
// scene's own folder. Returns the copied scene. Names that lead out of the scene's folder are left out: the importer refuses them.
// Errors: cannot read or write.
Result<std::filesystem::path> gather_scene(const std::filesystem::path& file, const std::string& json, const std::filesystem::path& into);

// Copies the environment map that these edits name to `into`/environments, and returns the edits with the new name, relative to
// `into`. `folder`: of the scene, base of a relative name. Errors: cannot read or write.
Result<std::string> gather_environment(const std::string& edits, const std::filesystem::path& folder, const std::filesystem::path& into);

} // namespace blush
