#include "io/gltf/read/images/image_decoding.h"

#include "core/box_filter.h"
#include "core/memory_limit.h"
#include "core/task_queue.h"
#include "io/gltf/read/extras.h"
#include "io/gltf/read/images/images.h"
#include "io/gltf/read/uri.h"
#include "io/image/image_channels.h"
#include "io/image/image_io.h"
#include "io/image/jpeg_preview.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <queue>
#include <set>
#include <string_view>
#include <thread>
#include <unordered_map>

namespace blush {
namespace {

// One encoded image, shared by all glTF images with the same bytes.
struct Encoded {
    std::vector<size_t> images;
    std::span<const uint8_t> bytes;
    bool is_color = false;
    ImageInfo info;
    int halvings = 0;
    std::optional<Result<ImagePtr>> decoded;
};

constexpr std::array color_slots = {
    "baseColorTexture", "emissiveTexture",          "specularColorTexture", "sheenColorTexture", "diffuseTransmissionColorTexture",
    "diffuseTexture",   "specularGlossinessTexture"};

// Adds the textures that a material object reads as sRGB colour.
void add_color_textures(const nlohmann::json& object, std::set<int>& textures) {
    if (!object.is_object()) return;
    for (const char* slot : color_slots) {
        const auto info = object.find(slot);
        if (info == object.end() || !info->is_object()) continue;
        if (const auto index = info->find("index"); index != info->end() && index->is_number_integer()) textures.insert(index->get<int>());
    }
}

std::set<int> color_images(const GltfContext& context) {
    std::set<int> textures, images;
    for (size_t i = 0; i < context.model().materials.size(); ++i) {
        const nlohmann::json& material = gltf_item(context.json(), "materials", i);
        add_color_textures(material, textures);
        if (const auto pbr = material.find("pbrMetallicRoughness"); pbr != material.end()) add_color_textures(*pbr, textures);
        if (const auto extensions = material.find("extensions"); extensions != material.end() && extensions->is_object())
            for (const nlohmann::json& extension : *extensions) add_color_textures(extension, textures);
    }
    for (const int i : textures)
        if (i >= 0 && size_t(i) < context.model().textures.size()) images.insert(texture_image(context, size_t(i)));
    return images;
}

// Collects the images that exist, each once.
Result<std::vector<Encoded>> encoded_images(const GltfContext& context, std::span<const int> wanted) {
    const std::set<int> images(wanted.begin(), wanted.end()), colors = color_images(context);
    const auto count = int64_t(context.model().images.size());
    std::vector<Encoded> files;
    std::unordered_map<std::string_view, size_t> known;
    for (const int i : images) {
        if (i < 0 || i >= count) continue; // reported with the texture
        const auto bytes = encoded_image(context, size_t(i));
        if (!bytes) return bytes.error();
        if (bytes->empty()) continue; // reported with the texture
        const auto [file, is_new] = known.try_emplace({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, files.size());
        if (is_new) files.push_back({{}, *bytes, false, {}, 0, {}});
        files[file->second].images.push_back(size_t(i));
        files[file->second].is_color |= colors.contains(i);
    }
    return files;
}

// Declared format of an image: from its MIME type, else its file extension; empty if unknown.
std::string declared_format(const tinygltf::Image& image) {
    if (image.mimeType.starts_with("image/")) return image.mimeType.substr(6);
    const std::string ending = is_data_uri(image.uri) ? "" : std::filesystem::path(percent_decoded(image.uri)).extension().string();
    if (ending == ".jpg") return "jpeg";
    return ending.empty() ? "" : ending.substr(1);
}

void report_wrong_formats(const GltfContext& context, const std::vector<Encoded>& files) {
    constexpr std::array formats{"png", "jpeg", "webp"};
    for (const Encoded& file : files)
        for (const size_t i : file.images) {
            const std::string declared = declared_format(context.model().images[i]);
            if (file.info.format.empty() || declared == file.info.format || std::ranges::find(formats, declared) == formats.end()) continue;
            context.warn(fmt::format("declared as {} but is {}: decoded as the latter", declared, file.info.format), image_path(i));
        }
}

// Halves the largest image until all fit.
void fit_into_memory(const GltfContext& context, std::vector<Encoded>& files) {
    const auto smaller = [](const Encoded* a, const Encoded* b) { return a->info.bytes(a->halvings) < b->info.bytes(b->halvings); };
    std::priority_queue<Encoded*, std::vector<Encoded*>, decltype(smaller)> largest(smaller);
    int64_t total = 0;
    for (Encoded& file : files) {
        total += file.info.bytes();
        largest.push(&file);
    }
    while (total > context.options.texture_bytes && !largest.empty()) {
        Encoded& file = *largest.top();
        largest.pop();
        const int64_t before = file.info.bytes(file.halvings), after = file.info.bytes(file.halvings + 1);
        if (after == before) continue; // a single pixel
        ++file.halvings;
        total += after - before;
        largest.push(&file);
    }
    for (const Encoded& file : files)
        if (file.halvings > 0)
            context.warn(fmt::format("reduced {} times, from {} x {} to {} x {} pixels, so that all textures fit into {} MiB: {}",
                                     file.halvings, file.info.width, file.info.height, halved(file.info.width, file.halvings),
                                     halved(file.info.height, file.halvings), context.options.texture_bytes >> 20,
                                     image_name(context, file.images[0])),
                         image_path(file.images[0]));
}

void decode(const GltfContext& context, Encoded& file) {
    const std::string name = image_name(context, file.images[0]);
    // Images of more than 8 bits are sRGB in a PNG and linear in other formats.
    const bool is_srgb = file.is_color && (!file.info.is_float || file.info.format == "png");
    Result<ImagePtr> image =
        file.halvings == 0 ? read_image(file.bytes, name) : read_smaller_image(file.bytes, name, file.halvings, is_srgb);
    if (image) image = with_color_channels(*image);
    file.decoded = std::move(image);
}

// Reads the headers.
void read_infos(const GltfContext& context, std::vector<Encoded>& files) {
    for (Encoded& file : files) {
        const Result<ImageInfo> info = read_image_info(file.bytes, image_name(context, file.images[0]));
        if (info)
            file.info = *info;
        else
            file.decoded = info.error();
        if (file.info.channels < 3) file.info.channels += 2; // with_color_channels
    }
}

} // namespace

int64_t concurrent_decode_bytes(uint64_t memory_left) {
    return int64_t(std::clamp(memory_left / 8, uint64_t(64) << 20, uint64_t(1) << 30));
}

struct ImageDecoding::State {
    using Clock = std::chrono::steady_clock;
    const GltfContext& context;
    const std::thread::id reporter = std::this_thread::get_id();
    std::vector<Encoded> files;
    std::vector<ImagePtr> images;
    std::vector<bool> expected;
    std::atomic<size_t> done = 0;
    std::atomic<bool> waited_for = false, given_up = false;

    std::array<std::vector<size_t>, 2> by_need; // files below the share of memory of a thread, and larger ones
    std::array<std::atomic<size_t>, 2> next_needed{};
    std::atomic<size_t> colors_left = 0;
    bool colors_shown = false;
    std::vector<size_t> file_of;  // by image; files.size(): none
    std::vector<size_t> previews; // files to be decoded at an eighth of their size first
    std::atomic<size_t> next_preview = 0;
    mutable std::mutex mutex;        // of what follows, while images are decoded
    std::vector<ImagePtr> available; // by file
    std::function<void()> on_more;
    Clock::duration pause = std::chrono::milliseconds(500); // doubles: each image with more textures costs time
    Clock::time_point next_shown = Clock::now() + pause;

    TaskQueue helpers; // declared last, so that the threads end before the data they use

    explicit State(const GltfContext& c)
        : context(c), images(c.model().images.size()), expected(images.size()), helpers(c.options.threads) {}
    ~State() { given_up = true; }

    // Of JPEGs below `limit` bytes: a progressive one is held whole, as coefficients, at any size.
    void find_previews(int64_t limit) {
        constexpr int64_t worth_it = int64_t(1) << 20; // bytes
        available.resize(files.size());
        file_of.assign(images.size(), files.size());
        for (size_t f = 0; f < files.size(); ++f) {
            for (const size_t i : files[f].images) file_of[i] = f;
            if (!files[f].decoded && files[f].info.format == "jpeg" && files[f].info.bytes() > worth_it && files[f].info.bytes() <= limit)
                previews.push_back(f);
        }
        if (!context.options.on_preview_scene) previews.clear();
    }

    // Colour before other data, since it is most of what one sees, and then small images first, so that many are there early.
    void order_by_need(int64_t share) {
        for (size_t f = 0; f < files.size(); ++f) by_need[is_large(f, share)].push_back(f);
        colors_left = size_t(std::ranges::count_if(files, &Encoded::is_color));
        colors_shown = colors_left == 0;
        for (std::vector<size_t>& order : by_need)
            std::ranges::stable_sort(order, {}, [&](size_t f) { return std::pair(!files[f].is_color, files[f].info.bytes()); });
    }
    bool is_large(size_t file, int64_t share) const { return files[file].info.bytes() > share; }

    bool is_over() const { return given_up || context.cancelled(); }
    // The most needed file of those that are or are not large. The queue decides when, not which.
    void decode_next(bool large) {
        if (decode_previews() && is_reporting()) show();
        if (is_over()) return;
        const size_t index = by_need[large][next_needed[large]++];
        Encoded& file = files[index];
        if (!file.decoded) decode(context, file);
        if (*file.decoded) make_available(index, **file.decoded);
        if (file.is_color) --colors_left;
        ++done;
        if (!is_reporting()) return;
        report();
        const bool all_colors = colors_left == 0 && !colors_shown;
        colors_shown |= all_colors;
        if (done < files.size() && (all_colors || Clock::now() >= next_shown)) show();
    }
    bool is_reporting() const { return waited_for && std::this_thread::get_id() == reporter; }
    // Previews of all images come before the first image, whichever thread begins. True if this thread has made some.
    bool decode_previews() {
        bool made = false;
        for (size_t i = next_preview++; i < previews.size() && !is_over(); i = next_preview++) {
            const Encoded& file = files[previews[i]];
            if (const auto preview = read_jpeg_preview(file.bytes, image_name(context, file.images[0])))
                make_available(previews[i], with_color_channels(*preview));
            made = true;
        }
        return made;
    }
    void make_available(size_t file, ImagePtr image) {
        if (!context.options.on_preview_scene) return;
        const std::lock_guard lock(mutex);
        available[file] = std::move(image);
    }
    void report() const {
        if (files.empty()) return;
        context.progress(0.6 + 0.4 * double(done) / double(files.size()), fmt::format("textures, {} of {}", done.load(), files.size()));
    }
    void show() {
        if (on_more) on_more();
        pause *= 2;
        next_shown = Clock::now() + pause;
    }
};

ImageDecoding::ImageDecoding(std::unique_ptr<State> state) : state_(std::move(state)) {}
ImageDecoding::ImageDecoding(ImageDecoding&&) noexcept = default;
ImageDecoding::~ImageDecoding() = default;

Result<ImageDecoding> ImageDecoding::begin(const GltfContext& context, std::span<const int> wanted) {
    auto state = std::make_unique<State>(context);
    Result<std::vector<Encoded>> files = encoded_images(context, wanted);
    if (!files) return files.error();
    state->files = *std::move(files);
    read_infos(context, state->files);
    report_wrong_formats(context, state->files);
    fit_into_memory(context, state->files);
    std::vector<int64_t> sizes;
    for (const Encoded& file : state->files) {
        sizes.push_back(file.info.bytes());
        for (const size_t i : file.images) state->expected[i] = !file.decoded;
    }
    // All but one thread take images below their share of the memory, one takes larger ones, one by one.
    const unsigned threads = context.options.threads ? context.options.threads : std::max(1u, std::thread::hardware_concurrency());
    const int64_t share = concurrent_decode_bytes(memory_limit().left) / threads;
    state->find_previews(share);
    state->order_by_need(share);
    state->helpers.begin(sizes, share, [s = state.get(), share](size_t i) { s->decode_next(s->is_large(i, share)); });
    return ImageDecoding(std::move(state));
}

bool ImageDecoding::is_expected(int image) const {
    return image >= 0 && size_t(image) < state_->expected.size() && state_->expected[size_t(image)];
}

ImagePtr ImageDecoding::image(int index) const { return is_expected(index) ? state_->images[size_t(index)] : nullptr; }

bool ImageDecoding::is_done() const { return state_->done == state_->files.size(); }

bool ImageDecoding::all_decoded() const {
    for (size_t i = 0; i < state_->images.size(); ++i)
        if (state_->expected[i] && !state_->images[i]) return false;
    return true;
}

ImagePtr ImageDecoding::available(int index) const {
    if (!is_expected(index)) return nullptr;
    const std::lock_guard lock(state_->mutex);
    return state_->available[state_->file_of[size_t(index)]];
}

Result<void> ImageDecoding::finish(const std::function<void()>& on_more) {
    State& s = *state_;
    s.on_more = on_more;
    s.waited_for = true;
    s.report();
    s.helpers.finish();
    s.on_more = {};
    s.available.clear();
    if (s.context.cancelled()) return s.context.cancel_error();
    for (Encoded& file : s.files)
        for (const size_t i : file.images) {
            if (*file.decoded)
                s.images[i] = **file.decoded;
            else
                s.context.warn(file.decoded->error().what + ": " + image_name(s.context, i), image_path(i));
        }
    return {};
}

} // namespace blush
