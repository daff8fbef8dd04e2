#include "io/image/jpeg_encoding.h"

#include <algorithm>
#include <csetjmp>
#include <cstddef> // libjpeg needs size_t
#include <cstdio>  // and FILE
#include <cstring>
#include <new>
#include <utility>

#include <jpeglib.h>

namespace blush {
namespace {

constexpr int quality = 95;

// libjpeg's own error handler ends the process: OpenImageIO uses it, so this calls libjpeg directly. The handler here jumps back
// into encode(), which therefore holds nothing that has a destructor.
struct Encoder {
    jpeg_compress_struct libjpeg{};
    jpeg_error_mgr errors{};
    jpeg_destination_mgr sink{};
    std::jmp_buf failed{};
    char message[JMSG_LENGTH_MAX] = {};
    std::vector<uint8_t> bytes;

    Encoder() = default;
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
    ~Encoder() { jpeg_destroy_compress(&libjpeg); }
};

Encoder& encoder_of(void* client_data) { return *static_cast<Encoder*>(client_data); }

void leave(j_common_ptr libjpeg) {
    Encoder& encoder = encoder_of(libjpeg->client_data);
    encoder.errors.format_message(libjpeg, encoder.message);
    std::longjmp(encoder.failed, 1);
}

// No exception may pass through libjpeg.
bool has_grown(Encoder& encoder) {
    constexpr size_t least = 1 << 16;
    const size_t used = encoder.bytes.size();
    try {
        encoder.bytes.resize(std::max(2 * used, least));
    } catch (const std::bad_alloc&) { return false; }
    encoder.sink.next_output_byte = encoder.bytes.data() + used;
    encoder.sink.free_in_buffer = encoder.bytes.size() - used;
    return true;
}

void grow(j_compress_ptr libjpeg) {
    Encoder& encoder = encoder_of(libjpeg->client_data);
    if (has_grown(encoder)) return;
    std::strcpy(encoder.message, "not enough memory for the image");
    std::longjmp(encoder.failed, 1);
}

// False: it has failed, and the encoder has the message.
bool encode(Encoder& encoder, int width, int height, const uint8_t* rgb) {
    jpeg_compress_struct& c = encoder.libjpeg;
    if (setjmp(encoder.failed)) return false;
    jpeg_create_compress(&c);
    encoder.sink.init_destination = grow;
    encoder.sink.empty_output_buffer = [](j_compress_ptr libjpeg) -> boolean { return grow(libjpeg), TRUE; };
    encoder.sink.term_destination = [](j_compress_ptr) {};
    c.dest = &encoder.sink;
    c.image_width = JDIMENSION(width);
    c.image_height = JDIMENSION(height);
    c.input_components = 3;
    c.in_color_space = JCS_RGB;
    jpeg_set_defaults(&c);
    jpeg_set_quality(&c, quality, TRUE);
    for (int i = 0; i < c.num_components; ++i) c.comp_info[i].h_samp_factor = c.comp_info[i].v_samp_factor = 1;
    jpeg_start_compress(&c, TRUE);
    while (c.next_scanline < c.image_height) {
        JSAMPROW row = const_cast<uint8_t*>(rgb) + size_t(c.next_scanline) * size_t(width) * 3; // libjpeg only reads it
        jpeg_write_scanlines(&c, &row, 1);
    }
    jpeg_finish_compress(&c);
    return true;
}

} // namespace

Result<std::vector<uint8_t>> encode_jpeg(const std::string& name, int width, int height, std::span<const uint8_t> rgb) {
    Encoder encoder;
    encoder.libjpeg.client_data = &encoder;
    encoder.libjpeg.err = jpeg_std_error(&encoder.errors);
    encoder.errors.error_exit = leave;
    encoder.errors.output_message = [](j_common_ptr) {};
    if (!encode(encoder, width, height, rgb.data())) return Error{name, std::string("cannot encode: ") + encoder.message, ""};
    encoder.bytes.resize(encoder.bytes.size() - encoder.sink.free_in_buffer);
    return std::move(encoder.bytes);
}

} // namespace blush
