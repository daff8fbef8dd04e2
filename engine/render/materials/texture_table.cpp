#include "render/materials/texture_table.h"

#include "core/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace blush {
namespace {

TextureWrap wrap(Texture::Wrap w) {
    return w == Texture::Wrap::repeat ? wrap_repeat : w == Texture::Wrap::clamp_to_edge ? wrap_clamp : wrap_mirror;
}

class TableBuilder {
public:
    explicit TableBuilder(std::vector<TextureSource> sources) { table_.sources = std::move(sources); }

    TextureTable build(TextureTable&& before, const Workers* workers) && {
        for (const TextureSource& source : table_.sources) place(source);
        table_.images.resize(images_.size());
        for (ImageTexelsPtr& texels : before.images)
            if (const auto known = places_.find({texels->image->serial, texels->is_color}); known != places_.end())
                table_.images[known->second] = std::move(texels);
        before = {}; // frees what is not read any more before the new ones are made
        const auto fill_one = [&](int64_t i, unsigned) {
            if (!table_.images[size_t(i)]) table_.images[size_t(i)] = image_texels(images_[size_t(i)], sources_[size_t(i)]->is_color);
        };
        const auto count = int64_t(images_.size());
        if (workers)
            workers->for_each(count, {}, fill_one);
        else
            for (int64_t i = 0; i < count; ++i) fill_one(i, 0);
        finish();
        return std::move(table_);
    }

private:
    // The texels of a source, as colour or as data.
    void place(const TextureSource& source) {
        ImagePtr image = source.image;
        if (!image || !is_whole(*image)) {
            warn(source, "image does not hold width x height pixels of 1 to 4 channels, or too many: read as white");
            image = white_;
        }
        const auto [known, is_new] = places_.try_emplace({image->serial, source.is_color}, images_.size());
        if (is_new) {
            images_.push_back(std::move(image));
            sources_.push_back(&source);
        }
        used_.push_back(known->second);
    }

    void finish() {
        std::vector<int32_t> first_levels;
        for (size_t i = 0; i < images_.size(); ++i) {
            const ImageTexels& texels = *table_.images[i];
            first_levels.push_back(int32_t(table_.levels.size()));
            table_.levels.insert(table_.levels.end(), texels.levels.begin(), texels.levels.end());
            if (texels.replaced > 0) warn(*sources_[i], fmt::format("{} values are negative or not finite: read as 0", texels.replaced));
        }
        for (size_t i = 0; i < table_.sources.size(); ++i) {
            const TextureSource& source = table_.sources[i];
            table_.records.push_back({.first_level = first_levels[used_[i]],
                                      .levels = int32_t(table_.images[used_[i]]->levels.size()),
                                      .wrap_u = wrap(source.wrap_u),
                                      .wrap_v = wrap(source.wrap_v),
                                      .filter = source.filter == Texture::Filter::nearest ? filter_nearest : filter_linear});
        }
    }

    void warn(const TextureSource& source, std::string what) {
        table_.warnings.push_back({Diagnostic::Severity::warning, std::move(what), fmt::format("texture \"{}\"", source.name)});
    }

    TextureTable table_;
    std::vector<size_t> used_;                           // by source: index into the following
    std::vector<ImagePtr> images_;                       // each once as colour, once as data
    std::vector<const TextureSource*> sources_;          // the first one of each
    std::map<std::pair<uint64_t, bool>, size_t> places_; // by (serial, as colour)
    const ImagePtr white_ = std::make_shared<Image>(Image{.width = 1, .height = 1, .channels = 1, .bytes = {255}, .floats = {}});
};

} // namespace

int32_t TextureTable::index_of(Id<Texture> id, bool is_color) const {
    const auto key = [](const TextureSource& s) { return std::tuple(s.id, s.is_color); };
    const auto it = std::ranges::lower_bound(sources, std::tuple(id, is_color), {}, key);
    return it != sources.end() && key(*it) == std::tuple(id, is_color) ? int32_t(it - sources.begin()) : -1;
}

float TextureTable::texels_per_unit(int32_t texture) const {
    const TextureLevel& image = levels[size_t(records[size_t(texture)].first_level)];
    return float(std::sqrt(double(image.width) * image.height));
}

TextureTables TextureTable::tables() const { return {records.data(), levels.data(), nullptr, srgb_byte_values()}; }

size_t TextureTable::memory_bytes() const {
    size_t bytes = 0;
    for (const ImageTexelsPtr& texels : images) bytes += texels->memory_bytes();
    return bytes;
}

TextureTable build_texture_table(std::vector<TextureSource> sources, TextureTable&& before, const Workers* workers) {
    const auto begin = std::chrono::steady_clock::now();
    TextureTable table = TableBuilder(std::move(sources)).build(std::move(before), workers);
    table.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return table;
}

} // namespace blush
