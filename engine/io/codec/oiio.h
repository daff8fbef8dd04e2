// The codec, by OpenImageIO: decoding.cpp and encoding.cpp, the only files that use it.
#pragma once

#include "io/codec/image_codec.h"

#include <OpenImageIO/imageio.h>

namespace blush {

struct ImageHeader {
    OIIO::ImageSpec spec;
};

class OiioCodec final : public ImageCodec {
public:
    Result<DecodedPixels> decode(const EncodedImage& file) const override;
    Result<ImageInfo> decode_info(const EncodedImage& file) const override;
    Result<void> decode_rows(const EncodedImage& file, RowSink& sink) const override;
    Result<std::vector<LayeredImage>> decode_parts(const EncodedImage& file, int max_parts) const override;
    Result<std::map<std::string, std::string>> decode_metadata(const EncodedImage& file) const override;
    Result<std::vector<uint8_t>> encode_exr(const std::string& name, const LayeredImage& image) const override;
    Result<std::vector<uint8_t>> encode_png(const std::string& name, const PngPixels& pixels,
                                            const std::map<std::string, std::string>& metadata) const override;
};

} // namespace blush
