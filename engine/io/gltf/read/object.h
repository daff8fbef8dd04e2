// Internal to io/gltf: reads members of extensions and extras with checked types and ranges.
#pragma once

#include "core/vec.h"
#include "io/gltf/read/context.h"

#include <limits>
#include <optional>
#include <string>

namespace blush {

constexpr float any_float = std::numeric_limits<float>::max();

// Clamps to [low, high] with a warning; `otherwise` if the value is not finite.
float checked(const GltfContext& context, double value, float otherwise, float low, float high, const std::string& where);
// The same for three numbers; `otherwise` if there are not three.
Vec3 checked(const GltfContext& context, const std::vector<double>& values, Vec3 otherwise, float low, float high,
             const std::string& where);

// A JSON object that may be absent. An absent object has no members, so that chained lookups need no tests.
class GltfObject {
public:
    GltfObject(const GltfContext& context, const tinygltf::Value& value, std::string where);
    GltfObject(const GltfContext& context, const tinygltf::Value::Object& members, std::string where)
        : context_(&context), members_(&members), where_(std::move(where)) {}

    explicit operator bool() const { return members_ != nullptr; }
    const std::string& where() const { return where_; }
    const tinygltf::Value::Object& members() const;

    bool has(const char* key) const { return find(key) != nullptr; }
    GltfObject object(const char* key) const;
    // Members of the wrong type give a warning and are read as absent.
    float number(const char* key, float otherwise, float low, float high) const;
    std::optional<int> integer(const char* key) const;
    bool boolean(const char* key, bool otherwise) const;
    std::string text(const char* key) const;
    Vec3 vector3(const char* key, Vec3 otherwise, float low, float high) const;
    Vec4 vector4(const char* key, Vec4 otherwise, float low, float high) const;
    Vec2 vector2(const char* key, Vec2 otherwise) const;

private:
    GltfObject(const GltfContext& context, std::string where) : context_(&context), where_(std::move(where)) {}
    const tinygltf::Value* find(const char* key) const;
    std::vector<double> numbers(const char* key, size_t count) const;
    void wrong_type(const char* key, const char* expected) const;

    const GltfContext* context_;
    const tinygltf::Value::Object* members_ = nullptr;
    std::string where_;
};

} // namespace blush
