#include "io/gltf/read/uri.h"

#include <algorithm>

namespace blush {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// A colon before the first slash ends a scheme (RFC 3986) or a drive letter.
bool has_scheme(std::string_view uri) { return uri.substr(0, uri.find('/')).find(':') != std::string_view::npos; }

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const auto [f, _] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    return f == folder.end();
}

} // namespace

std::string percent_decoded(std::string_view uri) {
    std::string decoded;
    decoded.reserve(uri.size());
    for (size_t i = 0; i < uri.size(); ++i) {
        const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
        const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
        decoded += low >= 0 ? char(high * 16 + low) : uri[i];
        if (low >= 0) i += 2;
    }
    return decoded;
}

std::string percent_encoded(std::string_view path) {
    constexpr std::string_view digits = "0123456789ABCDEF", plain = "-._~!$&'()*+,;=@/";
    std::string encoded;
    for (const char c : path) {
        const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (letter || plain.find(c) != plain.npos)
            encoded += c;
        else
            (encoded += '%') += {digits[uint8_t(c) >> 4], digits[uint8_t(c) & 15]};
    }
    return encoded;
}

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

Result<std::filesystem::path> resolve_uri(const std::filesystem::path& folder, const std::string& decoded_uri) {
    const std::string shown = "URI '" + decoded_uri.substr(0, 200) + "'";
    if (decoded_uri.empty()) return Error{"", "empty URI", ""};
    if (decoded_uri.find('\0') != std::string::npos || decoded_uri.find('\\') != std::string::npos)
        return Error{"", shown + " is not a plain relative path", ""};
    if (has_scheme(decoded_uri)) return Error{"", shown + " has a scheme; only files beside the scene are read", ""};
    const std::filesystem::path relative(decoded_uri);
    if (relative.is_absolute()) return Error{"", shown + " is an absolute path", ""};
    if (std::find(relative.begin(), relative.end(), "..") != relative.end()) return Error{"", shown + " leaves the scene's folder", ""};

    // Resolves symbolic links on both sides, as far as the path exists.
    std::error_code failed;
    const std::filesystem::path root = std::filesystem::weakly_canonical(folder.empty() ? std::filesystem::path(".") : folder, failed);
    if (failed) return Error{"", shown + " cannot be resolved: " + failed.message(), ""};
    const std::filesystem::path file = std::filesystem::weakly_canonical(root / relative, failed);
    if (failed) return Error{"", shown + " cannot be resolved: " + failed.message(), ""};
    if (!is_below(file, root)) return Error{"", shown + " leaves the scene's folder through a symbolic link", ""};
    return file;
}

} // namespace blush
