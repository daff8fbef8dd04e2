#include "io/gltf/read/object.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace blush {

float checked(const GltfContext& context, double value, float otherwise, float low, float high, const std::string& where) {
    if (!std::isfinite(value)) {
        context.warn(fmt::format("not a finite number; {} is used", otherwise), where);
        return otherwise;
    }
    const double clamped = std::clamp(value, double(low), double(high));
    if (clamped != value) context.warn(fmt::format("{} is out of range; {} is used", value, clamped), where);
    return float(clamped);
}

Vec3 checked(const GltfContext& context, const std::vector<double>& values, Vec3 otherwise, float low, float high,
             const std::string& where) {
    if (values.size() != 3) return otherwise;
    return {checked(context, values[0], otherwise.x, low, high, where), checked(context, values[1], otherwise.y, low, high, where),
            checked(context, values[2], otherwise.z, low, high, where)};
}

GltfObject::GltfObject(const GltfContext& context, const tinygltf::Value& value, std::string where)
    : context_(&context), where_(std::move(where)) {
    if (value.IsObject()) members_ = &value.Get<tinygltf::Value::Object>();
}

const tinygltf::Value::Object& GltfObject::members() const {
    static const tinygltf::Value::Object none;
    return members_ ? *members_ : none;
}

const tinygltf::Value* GltfObject::find(const char* key) const {
    const auto it = members().find(key);
    return it == members().end() ? nullptr : &it->second;
}

void GltfObject::wrong_type(const char* key, const char* expected) const {
    context_->warn(fmt::format("'{}' is not {}; its default is used", key, expected), where_);
}

GltfObject GltfObject::object(const char* key) const {
    const std::string where = where_ + "." + key;
    const tinygltf::Value* value = find(key);
    if (value && !value->IsObject()) wrong_type(key, "an object");
    return value ? GltfObject(*context_, *value, where) : GltfObject(*context_, where);
}

float GltfObject::number(const char* key, float otherwise, float low, float high) const {
    const tinygltf::Value* value = find(key);
    if (!value) return otherwise;
    if (value->IsNumber()) return checked(*context_, value->GetNumberAsDouble(), otherwise, low, high, where_ + "." + key);
    wrong_type(key, "a number");
    return otherwise;
}

std::optional<int> GltfObject::integer(const char* key) const {
    const tinygltf::Value* value = find(key);
    if (!value) return std::nullopt;
    if (value->IsInt()) return value->Get<int>();
    wrong_type(key, "an integer");
    return std::nullopt;
}

bool GltfObject::boolean(const char* key, bool otherwise) const {
    const tinygltf::Value* value = find(key);
    if (!value) return otherwise;
    if (value->IsBool()) return value->Get<bool>();
    wrong_type(key, "true or false");
    return otherwise;
}

std::string GltfObject::text(const char* key) const {
    const tinygltf::Value* value = find(key);
    if (!value) return {};
    if (value->IsString()) return value->Get<std::string>();
    wrong_type(key, "a string");
    return {};
}

std::vector<double> GltfObject::numbers(const char* key, size_t count) const {
    const tinygltf::Value* value = find(key);
    if (!value) return {};
    std::vector<double> numbers;
    for (size_t i = 0; i < value->ArrayLen(); ++i)
        if (const tinygltf::Value& element = value->Get(int(i)); element.IsNumber()) numbers.push_back(element.GetNumberAsDouble());
    if (value->ArrayLen() == count && numbers.size() == count) return numbers;
    wrong_type(key, "an array of the right number of numbers");
    return {};
}

Vec3 GltfObject::vector3(const char* key, Vec3 otherwise, float low, float high) const {
    return checked(*context_, numbers(key, 3), otherwise, low, high, where_ + "." + key);
}

Vec4 GltfObject::vector4(const char* key, Vec4 otherwise, float low, float high) const {
    const std::vector<double> values = numbers(key, 4);
    if (values.size() != 4) return otherwise;
    const std::string where = where_ + "." + key;
    const auto component = [&](size_t i, float fallback) { return checked(*context_, values[i], fallback, low, high, where); };
    return {component(0, otherwise.x), component(1, otherwise.y), component(2, otherwise.z), component(3, otherwise.w)};
}

Vec2 GltfObject::vector2(const char* key, Vec2 otherwise) const {
    const std::vector<double> values = numbers(key, 2);
    if (values.size() != 2) return otherwise;
    const std::string where = where_ + "." + key;
    return {checked(*context_, values[0], otherwise.x, -any_float, any_float, where),
            checked(*context_, values[1], otherwise.y, -any_float, any_float, where)};
}

} // namespace blush
