#include "app/commands/plan/look_words.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>

namespace blush {
namespace {

// Of an option with a long name; empty for --help.
std::string long_name(const CLI::Option& option) {
    const std::vector<std::string>& names = option.get_lnames();
    return names.empty() || names.front() == "help" ? std::string() : names.front();
}

// The plan decides about these for all looks.
bool is_of_plan(const std::string& name) {
    constexpr const char* of_plan[] = {"spp", "time", "error", "samples", "adaptive", "denoise", "texture-memory"};
    return std::ranges::find(of_plan, name) != std::end(of_plan);
}

} // namespace

bool is_look_option(const std::string& name) {
    CLI::App app;
    RenderOptions options;
    add_render_options(app, options);
    return !name.empty() && !is_of_plan(name) &&
           std::ranges::any_of(app.get_options(), [&](const CLI::Option* o) { return long_name(*o) == name; });
}

Words words_given(const CLI::App& command) {
    Words words;
    for (const CLI::Option* option : command.get_options())
        if (const std::string name = long_name(*option); option->count() > 0 && is_look_option(name))
            words[name] = option->results().back();
    return words;
}

Result<RenderOptions> options_of(const Words& words, const std::filesystem::path& folder, const RenderSettings& base) {
    CLI::App app;
    RenderOptions options;
    options.settings = base;
    add_render_options(app, options);
    std::vector<std::string> arguments;
    for (const auto& [name, value] : words) {
        if (!is_look_option(name)) return Error{.what = fmt::format("a look has no setting \"{}\"", name)};
        arguments.push_back(fmt::format("--{}={}", name, value));
    }
    std::ranges::reverse(arguments); // CLI11 takes them from the end
    try {
        app.parse(arguments);
    } catch (const CLI::ParseError& error) { return Error{.what = error.what()}; }
    options.settings.adaptive = false;
    if (auto& environment = options.overrides.environment; environment && !environment->file.empty() && environment->file.is_relative())
        environment->file = std::filesystem::absolute(folder / environment->file).lexically_normal();
    return options;
}

} // namespace blush
