#include "io/gltf/read/animations.h"

#include "io/gltf/read/extras.h"
#include "io/gltf/read/geometry/accessors.h"
#include "io/gltf/read/ids.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace blush {
namespace {

using Interpolation = Keyframes::Interpolation;
using Property = Channel::Property;

struct Path {
    std::string_view name;
    Property property;
    int components; // per element of the output accessor
};
constexpr std::array paths{Path{"translation", Property::translation, 3}, Path{"rotation", Property::rotation, 4},
                           Path{"scale", Property::scale, 3}, Path{"weights", Property::morph_weights, 1}};

bool finite(const std::vector<float>& values) {
    return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

// Number of quaternions that are not of unit length; 0 for other properties. Skips the tangents of cubic splines.
size_t odd_rotations(const Keyframes& k, int components) {
    if (components != 4) return 0;
    const size_t parts = k.interpolation == Interpolation::cubic_spline ? 3 : 1;
    size_t odd = 0;
    for (size_t i = 4 * (parts / 2); i + 4 <= k.values.size(); i += 4 * parts) {
        const float* q = k.values.data() + i;
        const double size = std::sqrt(double(q[0]) * q[0] + double(q[1]) * q[1] + double(q[2]) * q[2] + double(q[3]) * q[3]);
        odd += !(std::abs(size - 1) <= 0.00769); // rounding error of 8-bit components
    }
    return odd;
}

size_t target_count(const tinygltf::Model& model, int node) {
    const int mesh = model.nodes[size_t(node)].mesh;
    if (mesh < 0 || size_t(mesh) >= model.meshes.size() || model.meshes[size_t(mesh)].primitives.empty()) return 0;
    return model.meshes[size_t(mesh)].primitives.front().targets.size();
}

class AnimationReader {
public:
    AnimationReader(const GltfContext& context, const GltfIndices& indices)
        : context_(context), nodes_(ids_by_index(indices.nodes, context.model().nodes.size())) {}

    Clip read(size_t index) {
        const tinygltf::Animation& source = context_.model().animations[index];
        Clip clip;
        clip.name = source.name.empty() ? fmt::format("Animation {}", index) : source.name;
        if (context_.known) return clip;
        for (size_t c = 0; c < source.channels.size(); ++c) {
            const std::string where = fmt::format("animations[{}].channels[{}]", index, c);
            Result<Channel> channel = read_channel(source, source.channels[c], where);
            if (!channel) {
                context_.warn("ignored: " + channel.error().what, channel.error().where.empty() ? where : channel.error().where);
            } else if (channel->node) {
                clip.seconds = std::max(clip.seconds, channel->keyframes->times.back());
                clip.channels.push_back(*std::move(channel));
            }
        }
        const auto key = [](const Channel& c) { return std::pair(c.node, c.property); };
        std::ranges::stable_sort(clip.channels, {}, key);
        const auto repeated = std::ranges::unique(clip.channels, {}, key);
        if (!repeated.empty())
            context_.warn(fmt::format("ignored: {} channels whose property another channel animates", repeated.size()),
                          fmt::format("animations[{}].channels", index));
        clip.channels.erase(repeated.begin(), repeated.end());
        return clip;
    }

private:
    // A channel without a node: skipped without a warning.
    Result<Channel> read_channel(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& source, const std::string& where) {
        const auto path = std::ranges::find(paths, source.target_path, &Path::name);
        if (source.target_node < 0 && path != paths.end()) return Channel{}; // glTF 2.0, 3.11: ignored without extensions
        if (path == paths.end()) return error(fmt::format("unknown target path \"{}\"", source.target_path.substr(0, 100)));
        if (size_t(source.target_node) >= nodes_.size())
            return error(fmt::format("node {} does not exist; there are {}", source.target_node, nodes_.size()));
        if (source.sampler < 0 || size_t(source.sampler) >= animation.samplers.size())
            return error(fmt::format("sampler {} does not exist; there are {}", source.sampler, animation.samplers.size()));
        Channel channel{nodes_[size_t(source.target_node)], path->property, nullptr};
        if (!channel.node) return Channel{};
        const size_t width =
            path->property == Property::morph_weights ? target_count(context_.model(), source.target_node) : size_t(path->components);
        Result<Keyframes> keyframes = read_keyframes(animation.samplers[size_t(source.sampler)], path->components, width, where);
        if (!keyframes) return keyframes.error();
        channel.keyframes = std::make_shared<const Keyframes>(*std::move(keyframes));
        return channel;
    }

    Result<Keyframes> read_keyframes(const tinygltf::AnimationSampler& sampler, int components, size_t width, const std::string& where) {
        Keyframes keyframes;
        if (sampler.interpolation == "STEP")
            keyframes.interpolation = Interpolation::step;
        else if (sampler.interpolation == "CUBICSPLINE")
            keyframes.interpolation = Interpolation::cubic_spline;
        else if (sampler.interpolation != "LINEAR")
            return error(fmt::format("interpolation \"{}\"", sampler.interpolation.substr(0, 100)));
        Result<FloatArray> times = read_floats(context_, sampler.input, 1, 1, where);
        if (!times) return times.error();
        Result<FloatArray> values = read_floats(context_, sampler.output, components, components, where);
        if (!values) return values.error();
        keyframes.times = std::move(times->values);
        keyframes.values = std::move(values->values);
        if (keyframes.times.empty() || width == 0) return error("nothing to animate");
        if (!finite(keyframes.times) || !finite(keyframes.values)) return error("keyframes that are not finite numbers");
        if (!std::ranges::is_sorted(keyframes.times) || keyframes.times.front() < 0)
            return error("times that are negative or not in order");
        if (std::ranges::adjacent_find(keyframes.times) != keyframes.times.end())
            context_.warn("several keyframes at the same time: the last one is used", where);
        if (const size_t odd = odd_rotations(keyframes, components))
            context_.warn(fmt::format("{} rotations were not of unit length and are normalised", odd), where);
        const size_t wanted = keyframes.times.size() * width * (keyframes.interpolation == Interpolation::cubic_spline ? 3 : 1);
        if (keyframes.values.size() != wanted)
            return error(
                fmt::format("{} numbers for {} keyframes, which need {}", keyframes.values.size(), keyframes.times.size(), wanted));
        return keyframes;
    }

    static Error error(std::string what) { return Error{.what = std::move(what)}; }

    const GltfContext& context_;
    std::vector<Id<Node>> nodes_; // by index; none: not in a scene
};

} // namespace

std::vector<Id<Clip>> import_animations(const GltfContext& context, const GltfIndices& indices, Scene& scene) {
    AnimationReader reader(context, indices);
    std::vector<std::optional<Clip>> clips;
    std::vector<uint32_t> wanted;
    for (size_t i = 0; i < context.model().animations.size(); ++i) {
        clips.push_back(reader.read(i));
        wanted.push_back(requested_id(gltf_item(context.json(), "animations", i)));
    }
    return add_with_ids(scene.clips, std::move(clips), wanted);
}

} // namespace blush
