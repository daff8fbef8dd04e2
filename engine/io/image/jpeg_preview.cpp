#include "io/image/jpeg_preview.h"

#include <csetjmp>
#include <cstddef> // libjpeg needs size_t
#include <cstdio>  // and FILE
#include <utility>

#include <jpeglib.h>

namespace blush {
namespace {

constexpr unsigned reduction = 8;

// As in jpeg_encoding.cpp: the error handler jumps back into functions that hold nothing that has a destructor.
struct JpegDecoder {
    jpeg_decompress_struct libjpeg{};
    jpeg_error_mgr errors{};
    std::jmp_buf failed{};
    char message[JMSG_LENGTH_MAX] = {};

    JpegDecoder() = default;
    JpegDecoder(const JpegDecoder&) = delete;
    JpegDecoder& operator=(const JpegDecoder&) = delete;
    ~JpegDecoder() { jpeg_destroy_decompress(&libjpeg); }
};

// Reads the header. False: it has failed, and the decoder has the message; the same below.
bool start_preview(JpegDecoder& decoder, std::span<const uint8_t> bytes) {
    jpeg_decompress_struct& d = decoder.libjpeg;
    if (setjmp(decoder.failed)) return false;
    jpeg_create_decompress(&d);
    jpeg_mem_src(&d, bytes.data(), bytes.size());
    jpeg_read_header(&d, TRUE);
    d.out_color_space = d.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    d.scale_num = 1;
    d.scale_denom = reduction;
    d.do_fancy_upsampling = FALSE;
    jpeg_start_decompress(&d);
    return true;
}

bool read_preview_rows(JpegDecoder& decoder, uint8_t* out, size_t row_bytes) {
    jpeg_decompress_struct& d = decoder.libjpeg;
    if (setjmp(decoder.failed)) return false;
    while (d.output_scanline < d.output_height) {
        JSAMPROW row = out + size_t(d.output_scanline) * row_bytes;
        jpeg_read_scanlines(&d, &row, 1);
    }
    return true;
}

} // namespace

Result<ImagePtr> read_jpeg_preview(std::span<const uint8_t> bytes, const std::string& name) {
    JpegDecoder decoder;
    decoder.libjpeg.client_data = &decoder;
    decoder.libjpeg.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = [](j_common_ptr libjpeg) {
        auto& failed = *static_cast<JpegDecoder*>(libjpeg->client_data);
        failed.errors.format_message(libjpeg, failed.message);
        std::longjmp(failed.failed, 1);
    };
    decoder.errors.output_message = [](j_common_ptr) {};
    const auto error = [&] { return Error{name, std::string("cannot decode: ") + decoder.message, ""}; };
    if (!start_preview(decoder, bytes)) return error();
    auto image = std::make_shared<Image>();
    image->width = int(decoder.libjpeg.output_width);
    image->height = int(decoder.libjpeg.output_height);
    image->channels = decoder.libjpeg.output_components;
    const size_t row_bytes = size_t(image->width) * size_t(image->channels);
    image->bytes.resize(row_bytes * size_t(image->height));
    if (!read_preview_rows(decoder, image->bytes.data(), row_bytes)) return error();
    return ImagePtr(std::move(image));
}

} // namespace blush
