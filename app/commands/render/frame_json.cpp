#include "app/commands/render/frame_json.h"

#include "measure/statistics/bounce_energy.h"
#include "render/light_mix/light_mix.h"

namespace blush {
namespace {

OrderedJson faults_json(const Health& health) {
    OrderedJson faults = OrderedJson::array();
    for (int kind = 0; kind < Fault::kinds; ++kind)
        for (int place = 0; place < Fault::places; ++place)
            if (const int64_t count = health.count(Fault::Kind(kind), Fault::Place(place)); count > 0)
                faults.push_back({{"kind", to_string(Fault::Kind(kind))}, {"place", to_string(Fault::Place(place))}, {"count", count}});
    return faults;
}

OrderedJson rgb_json(const Vec3d& v) { return {v.x, v.y, v.z}; }

} // namespace

OrderedJson health_json(const Health& health) {
    OrderedJson first = OrderedJson::array(), fireflies = OrderedJson::array();
    for (const BadSample& s : health.first)
        first.push_back({{"cause", to_string(s.cause)},
                         {"kind", to_string(s.fault.kind)},
                         {"place", to_string(s.fault.place)},
                         {"vertex", s.fault.vertex},
                         {"x", s.x},
                         {"y", s.y},
                         {"sample", s.sample},
                         {"seed", s.seed}});
    for (const Firefly& s : health.fireflies)
        fireflies.push_back(
            {{"excess", s.excess}, {"luminance", s.luminance}, {"x", s.x}, {"y", s.y}, {"sample", s.sample}, {"seed", s.seed}});
    return {{"nan", health.nan},
            {"inf", health.infinite},
            {"negative", health.negative},
            {"truncated", health.truncated},
            {"faults", faults_json(health)},
            {"first", first},
            {"fireflies", fireflies}};
}

OrderedJson bounces_json(const Frame& frame) {
    OrderedJson bounces = OrderedJson::array();
    for (const PlaneEnergy& e : bounce_energy(frame))
        bounces.push_back({{"bounce", e.name}, {"share", e.share}, {"mean", rgb_json(e.mean)}});
    return bounces;
}

OrderedJson strategies_json(const Frame& frame) {
    OrderedJson strategies = OrderedJson::array();
    for (const PlaneEnergy& e : strategy_energy(frame))
        strategies.push_back({{"strategy", e.name}, {"share", e.share}, {"mean", rgb_json(e.mean)}});
    return strategies;
}

OrderedJson groups_json(const Frame& frame) {
    OrderedJson groups = OrderedJson::array();
    const std::vector<GroupReport> reports = report_groups(frame, frame.group_names, frame.gains);
    for (size_t k = 0; k < reports.size(); ++k) {
        const Vec3& gain = frame.gains[k];
        const std::optional<double>& noise = reports[k].noise;
        groups.push_back({{"group", reports[k].name},
                          {"energy", reports[k].energy},
                          {"noise", noise ? OrderedJson(*noise) : OrderedJson()},
                          {"gain", {gain.x, gain.y, gain.z}}});
    }
    return groups;
}

OrderedJson clamp_json(const Clamp& clamp, const ClampReport& report) {
    return {{"limit", clamp.limit},
            {"light", clamp.all ? "all" : "scattered more than once"},
            {"samples", report.samples},
            {"share", report.share},
            {"removed", rgb_json(report.removed)}};
}

} // namespace blush
