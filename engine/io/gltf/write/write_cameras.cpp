#include "io/gltf/write/write.h"

namespace blush {
namespace {

// Clipping planes after a change of projection: an orthographic camera has no defaults.
float plane(const Json& object, const char* key, float otherwise) {
    for (const char* projection : {"perspective", "orthographic"}) {
        float value = 0;
        if (read_json(child_or_null(child_or_null(object, projection), key), value) && value > 0) return value;
    }
    return otherwise;
}

} // namespace

void write_camera(Json& object, const Camera& camera) {
    const Lens& lens = camera.lens;
    const char* const type = lens.orthographic ? "orthographic" : "perspective";
    if (child_or_null(object, "type") != type) {
        Json projection{{"znear", json_number(plane(object, "znear", 0.01f))}};
        if (lens.orthographic) {
            projection["zfar"] = json_number(plane(object, "zfar", 1000));
            projection["xmag"] = projection["ymag"] = json_number(lens.ymag);
        }
        object["type"] = type;
        erase(object, lens.orthographic ? "perspective" : "orthographic");
        object[type] = std::move(projection);
    }
    Json& projection = child(object, type);
    constexpr float none = 0;
    if (!lens.orthographic) return set_number(projection, "yfov", lens.yfov_radians, none);
    float ymag = lens.ymag, xmag = lens.ymag;
    read_json(child_or_null(projection, "ymag"), ymag);
    read_json(child_or_null(projection, "xmag"), xmag);
    if (ymag != lens.ymag && ymag != 0) set_number(projection, "xmag", xmag / ymag * lens.ymag, none);
    set_number(projection, "ymag", lens.ymag, none);
}

} // namespace blush
