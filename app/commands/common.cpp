#include "app/commands/common.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace blush {
namespace {

// An error is one line, even if untrusted names contain line breaks.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
    return text;
}

} // namespace

void add_common_options(CLI::App& app, CommonOptions& options) {
    app.add_option("--json", options.json, "Write the results as JSON to FILE; - is stdout")->type_name("FILE");
    app.add_option("--threads", options.threads, "Threads to use [one per core]")->check(CLI::Range(1, 1024))->type_name("N");
    app.add_flag("--quiet", options.quiet, "Print only errors");
}

int failed(const Error& error) {
    fmt::print(stderr, "blush: error: {}\n", one_line(error.text()));
    return exit_failed;
}

int bad_usage(const std::string& what) {
    fmt::print(stderr, "blush: error: {}\n", one_line(what));
    return exit_usage;
}

std::string option_as_value(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_positional()) continue;
        for (const std::string& value : option->results())
            if (value.starts_with("--"))
                return fmt::format("{} has no value before {}: give it one, or write ./{} for a file of this name", option->get_name(),
                                   value, value);
    }
    for (const CLI::App* command : app.get_subcommands())
        if (std::string wrong = option_as_value(*command); !wrong.empty()) return wrong;
    return {};
}

void print_warnings(const std::string& file, const std::vector<Diagnostic>& diagnostics) {
    constexpr size_t shown = 10;
    size_t count = 0;
    for (const Diagnostic& d : diagnostics) {
        if (d.severity != Diagnostic::Severity::warning || ++count > shown) continue;
        fmt::print(stderr, "blush: warning: {}\n", one_line(Error{file, d.what, d.where}.text()));
    }
    if (count > shown) fmt::print(stderr, "blush: warning: {}: {} more; see blush info\n", one_line(file), count - shown);
}

Error in_file(Error error, const std::string& file) {
    if (error.file.empty()) error.file = file;
    return error;
}

} // namespace blush
