#include "scene/document/history_memory.h"

namespace blush {
namespace {

template <class T> size_t table_bytes(const Table<T>& kept, const Table<T>& neighbour) {
    return kept.shares_storage(neighbour) ? 0 : kept.size() * sizeof(typename Table<T>::Entry);
}

size_t pixel_bytes(const ImagePtr& kept, const ImagePtr& neighbour) {
    return kept && kept != neighbour ? kept->bytes.size() + kept->floats.size() * sizeof(float) : 0;
}

size_t replaced_pixel_bytes(const Table<Texture>& kept, const Table<Texture>& neighbour) {
    size_t bytes = 0;
    for (const Id<Texture> id : Table<Texture>::changed(kept, neighbour)) {
        const Texture* a = kept.find(id);
        const Texture* b = neighbour.find(id);
        if (a) bytes += pixel_bytes(a->image, b ? b->image : nullptr);
    }
    return bytes;
}

} // namespace

size_t bytes_held(const Project& kept, const Project& neighbour) {
    const Scene& a = kept.scene;
    const Scene& b = neighbour.scene;
    return sizeof(Project) + table_bytes(a.nodes, b.nodes) + table_bytes(a.meshes, b.meshes) + table_bytes(a.materials, b.materials) +
           table_bytes(a.textures, b.textures) + table_bytes(a.lights, b.lights) + table_bytes(a.cameras, b.cameras) +
           table_bytes(a.skins, b.skins) + table_bytes(a.clips, b.clips) + pixel_bytes(a.environment.image, b.environment.image) +
           replaced_pixel_bytes(a.textures, b.textures);
}

} // namespace blush
