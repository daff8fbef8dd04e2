// Internal to io/gltf: imports textures and their samplers.
#pragma once

#include "io/gltf/read/context.h"
#include "io/gltf/read/images/image_decoding.h"

#include <optional>
#include <vector>

namespace blush {

// The textures of a file. Images are decoded in the background while the rest of the file is converted.
class TextureImport {
public:
    // Reads the image headers and starts decoding. Errors: an index out of range.
    static Result<TextureImport> begin(const GltfContext& context);

    // Adds the textures to the scene; result[i] is the id of glTF texture i, or none if its image is missing or cannot be
    // decoded. Before finish() they have no pixels, and images with a valid header count as decodable.
    std::vector<Id<Texture>> add_to(Scene& scene) const;
    bool is_done() const;
    // Waits for the images. Calls on_more() on this thread when available() has more images, with pauses. A missing image or one
    // that cannot be decoded is a warning. Errors: cancelled.
    Result<void> finish(const GltfContext& context, const std::function<void()>& on_more = {});
    // Before finish(): the image of a texture as far as it is known, at its size or smaller, or null.
    ImagePtr available(int texture) const { return decoding_ ? decoding_->available(images_[size_t(texture)]) : nullptr; }
    // After finish(): true if all images with a valid header could be decoded.
    bool all_decoded_textures() const { return !decoding_ || decoding_->all_decoded(); }

private:
    TextureImport(std::vector<int> images, std::optional<ImageDecoding> decoding)
        : images_(std::move(images)), decoding_(std::move(decoding)) {}
    static Result<TextureImport> read(const GltfContext& context, std::vector<int> images, std::optional<ImageDecoding> decoding);
    bool is_there(size_t index) const;

    std::vector<int> images_;                      // by texture, -1 for none
    std::vector<std::optional<Texture>> textures_; // without their images; none if not supported
    std::vector<uint32_t> wanted_;                 // ids
    std::vector<Id<Texture>> known_;               // for a document that is read without its pixels
    std::optional<ImageDecoding> decoding_;        // none for such a document
    ImportReport report_;                          // diagnostics to append after those of the images
    bool finished_ = false;
};

} // namespace blush
