#include "app/commands/check.h"

#include "app/commands/common.h"
#include "app/commands/interrupt.h"
#include "app/commands/json_output.h"
#include "app/commands/progress.h"
#include "measure/stability/battery.h"
#include "measure/stability/weak_points.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace blush {
namespace {

using namespace stability;

struct CheckCommand {
    std::string group;
    bool list = false;
    CommonOptions common;
};

void print_list(const std::string& only) {
    for (const StabilityGroup& group : battery()) {
        if (!only.empty() && only != group.name) continue;
        fmt::print("{}\n", group.name);
        for (const StabilityCase& c : group.cases) fmt::print("  {:<60} guards against: {}\n", c.name, weak_point(c.weak_point).name);
    }
    fmt::print("\nnumerical hot spots and their remedies\n");
    for (const WeakPoint& spot : weak_points()) fmt::print("  {:<42} {}\n", spot.name, spot.remedy);
}

void print_row(const CaseResult& r, std::string_view verdict) {
    const std::string name = r.finding.where.empty() ? r.name : fmt::format("{}: {}", r.name, r.finding.where);
    fmt::print("  {:<64} {:>12.6g} {:>12.6g} {:>9.2g} {:>9.2g}  {} {:6.2f} s\n", name, r.finding.expected, r.finding.measured,
               r.finding.sigma, r.tolerance, verdict, r.seconds);
    if (!r.error.empty()) fmt::print("    {}\n", r.error);
}

void print_report(const BatteryReport& report, double seconds) {
    fmt::print("  {:<64} {:>12} {:>12} {:>9} {:>9}\n", "", "expected", "measured", "sigma", "tolerance");
    std::string group;
    for (const CaseResult& r : report.cases) {
        if (r.group != group) fmt::print("{}\n", group = r.group);
        print_row(r, r.pass ? "pass" : "FAIL");
    }
    if (!report.limits.empty()) fmt::print("known limits\n");
    for (const CaseResult& r : report.limits) {
        print_row(r, r.pass ? "holds" : "limit");
        fmt::print("    {}\n", r.limit);
    }
    fmt::print("\n{} of {} cases passed in {:.0f} s; probability of a false alarm: {:.0f} % for the whole battery\n", report.passed,
               report.passed + report.failed, seconds, 100 * family_wise_level);
}

OrderedJson row_json(const CaseResult& r) {
    OrderedJson json;
    json["name"] = r.name;
    json["group"] = r.group;
    json["hot_spot"] = weak_point(r.weak_point).name;
    json["expected"] = r.finding.expected;
    json["measured"] = r.finding.measured;
    json["sigma"] = r.finding.sigma;
    json["tolerance"] = r.tolerance;
    json["pass"] = r.pass;
    json["seconds"] = r.seconds;
    if (!r.finding.where.empty()) json["where"] = r.finding.where;
    if (!r.error.empty()) json["error"] = r.error;
    if (!r.limit.empty()) json["reason"] = r.limit;
    return json;
}

OrderedJson report_json(const BatteryReport& report) {
    OrderedJson json;
    json["cases"] = OrderedJson::array();
    for (const CaseResult& r : report.cases) json["cases"].push_back(row_json(r));
    json["known_limits"] = OrderedJson::array();
    for (const CaseResult& r : report.limits) json["known_limits"].push_back(row_json(r));
    json["family_wise_level"] = family_wise_level;
    json["passed"] = report.passed;
    json["failed"] = report.failed;
    json["complete"] = report.complete;
    return json;
}

int run_check(const CheckCommand& c) {
    const auto& groups = battery();
    if (!c.group.empty() && std::none_of(groups.begin(), groups.end(), [&](const StabilityGroup& g) { return g.name == c.group; }))
        return bad_usage(fmt::format("there is no group \"{}\": see blush check --list", c.group));
    if (c.list) {
        print_list(c.group);
        return exit_done;
    }
    const InterruptGuard guard;
    const auto begin = std::chrono::steady_clock::now();
    const BatteryReport report = [&] {
        Progress progress(c.common.quiet);
        return run_battery(c.group, c.common.threads, [&](int finished, int all, const std::string& name) {
            progress.update(double(finished) / all, name);
            return !guard.interrupted();
        });
    }();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (const Result<void> written = write_json(c.common.json, report_json(report)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-") print_report(report, seconds);
    if (report.failed > 0)
        return failed(
            {.what = fmt::format("{} of {} cases of the stability battery failed", report.failed, report.passed + report.failed)});
    if (!report.complete) return failed({.what = "stopped before all cases had run"});
    return exit_done;
}

} // namespace

void add_check_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<CheckCommand>();
    CLI::App* sub = app.add_subcommand("check", "Run the stability battery: numerically difficult scenes with known results");
    sub->add_option("--group", command->group, "Run only the cases of this group")->type_name("NAME");
    sub->add_flag("--list", command->list, "Print the groups, their cases, and the hot spots that they test");
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_check(*command); }; });
}

} // namespace blush
