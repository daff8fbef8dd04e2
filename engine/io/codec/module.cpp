// What the module exports.
#include "io/codec/oiio.h"

#include <string_view>

extern "C" __attribute__((visibility("default"))) const blush::ImageCodec* blush_image_codec(const char* version) {
    static const blush::OiioCodec codec;
    return version == std::string_view(BLUSH_VERSION) ? &codec : nullptr;
}
