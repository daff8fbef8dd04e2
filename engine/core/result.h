// Errors as values: Result<T> holds a T or an Error. Only main converts an Error to an exit code.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace blush {

// What went wrong and where. `file` may be empty; `where` is a JSON path, a byte offset, an option name.
struct Error {
    std::string file = {};
    std::string what = {};
    std::string where = {};

    // "FILE: what, where" without absent parts: the text after "blush: error: ".
    std::string text() const {
        std::string s;
        if (!file.empty()) s += file + ": ";
        s += what;
        if (!where.empty()) s += ", " + where;
        return s;
    }
};

// A warning or note that does not stop the operation.
struct Diagnostic {
    enum class Severity { note, warning };
    Severity severity = Severity::warning;
    std::string what = {};
    std::string where = {};
    bool operator==(const Diagnostic&) const = default;
};

template <class T> class [[nodiscard]] Result {
public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return state_.index() == 0; }
    T& operator*() & {
        assert(*this);
        return *std::get_if<0>(&state_);
    }
    const T& operator*() const& {
        assert(*this);
        return *std::get_if<0>(&state_);
    }
    T&& operator*() && {
        assert(*this);
        return std::move(*std::get_if<0>(&state_));
    }
    T* operator->() { return &**this; }
    const T* operator->() const { return &**this; }
    const Error& error() const {
        assert(!*this);
        return *std::get_if<1>(&state_);
    }

private:
    std::variant<T, Error> state_;
};

template <> class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    explicit operator bool() const { return !error_; }
    const Error& error() const {
        assert(error_);
        return *error_;
    }

private:
    std::optional<Error> error_;
};

} // namespace blush
