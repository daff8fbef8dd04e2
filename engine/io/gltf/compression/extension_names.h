// Names of the extensions that compress data.
#pragma once

namespace blush {

constexpr const char* draco_extension = "KHR_draco_mesh_compression";
constexpr const char* meshopt_extension = "EXT_meshopt_compression";

} // namespace blush
