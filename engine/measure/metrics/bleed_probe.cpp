#include "measure/metrics/bleed_probe.h"

#include "color/color_difference.h"
#include "core/math.h"
#include "render/compile/expanded_lights.h"
#include "scene/affine.h"
#include "scene/node_name.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace blush {
namespace {

constexpr size_t groups_per_round = 16;
// Batches are summed in groups, the values of the intervals. If there are so many, neighbours are merged, and groups become twice as
// large.
constexpr size_t max_groups = 1024;
// More senders or lights share the last row.
constexpr size_t max_rows = 16;

// The light of one row in each group of batches.
struct BleedColumn {
    std::vector<Vec3d> groups;
    Vec3d places{0, 0, 0};
    double weight = 0;
    bool infinite = false;

    void add(size_t group, const Vec3d& light) {
        if (groups.size() <= group) groups.resize(group + 1, Vec3d{0, 0, 0});
        groups[group] = groups[group] + light;
    }
    void add(const BleedColumn& other) {
        for (size_t i = 0; i < other.groups.size(); ++i) add(i, other.groups[i]);
    }
    void halve(size_t count) {
        groups.resize(count, Vec3d{0, 0, 0});
        for (size_t i = 0; i < count / 2; ++i) groups[i] = groups[2 * i] + groups[2 * i + 1];
        groups.resize(count / 2);
    }
    double total() const {
        Vec3d sum{0, 0, 0};
        for (const Vec3d& group : groups) sum = sum + group;
        return luminance(sum);
    }
};

// Statistics of smooth functions of the means of a row and of the whole.
class BleedStatistics {
public:
    BleedStatistics(const BleedColumn& part, const BleedColumn& whole, size_t groups, int64_t batches_per_group)
        : part_(part.groups), whole_(whole.groups), scale_(1 / double(batches_per_group)) {
        part_.resize(groups, Vec3d{0, 0, 0});
        whole_.resize(groups, Vec3d{0, 0, 0});
        part_mean_ = mean(part_);
        whole_mean_ = mean(whole_);
    }
    const Vec3d& part_mean() const { return part_mean_; }
    const Vec3d& whole_mean() const { return whole_mean_; }

    // f(part, whole) with Student's interval, its standard error by linearisation (the delta method).
    template <class Function> Interval of(const Function& f) const {
        const size_t n = part_.size();
        Interval interval{false, f(part_mean_, whole_mean_), 0, 0};
        interval.low = interval.high = interval.value;
        if (n < 2) return interval;
        const Vec3d by_part = gradient(part_mean_, [&](const Vec3d& x) { return f(x, whole_mean_); });
        const Vec3d by_whole = gradient(whole_mean_, [&](const Vec3d& x) { return f(part_mean_, x); });
        double squares = 0;
        for (size_t i = 0; i < n; ++i) {
            const double off = dot(by_part, part_[i] * scale_ - part_mean_) + dot(by_whole, whole_[i] * scale_ - whole_mean_);
            squares += off * off;
        }
        const double half = student_95(int64_t(n) - 1) * std::sqrt(squares / double(n - 1) / double(n));
        return {std::isfinite(half), interval.value, interval.value - half, interval.value + half};
    }

private:
    Vec3d mean(const std::vector<Vec3d>& groups) const {
        Vec3d sum{0, 0, 0};
        for (const Vec3d& group : groups) sum = sum + group;
        return groups.empty() ? sum : sum * (scale_ / double(groups.size()));
    }
    // By central differences, a ten-thousandth of the whole apart.
    template <class Function> Vec3d gradient(const Vec3d& at, const Function& f) const {
        const double step = 1e-4 * std::max(luminance(whole_mean_), 1e-300);
        const auto along = [&](const Vec3d& d) { return (f(at + d * step) - f(at - d * step)) / (2 * step); };
        return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
    }

    std::vector<Vec3d> part_, whole_;
    double scale_;
    Vec3d part_mean_, whole_mean_;
};

double step_u(const Vec3d& part, const Vec3d& whole) { return ucs_of(whole).u - ucs_of(whole - part).u; }
double step_v(const Vec3d& part, const Vec3d& whole) { return ucs_of(whole).v - ucs_of(whole - part).v; }
double step_length(const Vec3d& part, const Vec3d& whole) { return std::hypot(step_u(part, whole), step_v(part, whole)); }
double difference(const Vec3d& part, const Vec3d& whole) {
    const double white = white_for_grey(luminance(whole));
    return delta_e_2000(lab_of(whole - part, white), lab_of(whole, white));
}
double difference_of_hue(const Vec3d& part, const Vec3d& whole) { return hue_difference(whole - part, whole); }

ColorShift shift_of(const BleedStatistics& s) {
    ColorShift shift;
    // Without the rest there is no colour to compare with.
    if (!(luminance(s.whole_mean() - s.part_mean()) > 1e-6 * luminance(s.whole_mean()))) return shift;
    shift.u = s.of(step_u);
    shift.v = s.of(step_v);
    shift.length = s.of(step_length);
    shift.length.known = shift.length.known && shift.length.low > 0;
    shift.towards = hue_towards(shift.u.value, shift.v.value);
    shift.delta_e = s.of(difference);
    shift.hue = s.of(difference_of_hue);
    return shift;
}

} // namespace

double BleedReport::error() const {
    if (!whole.known || !(whole.value > 0)) return std::numeric_limits<double>::infinity();
    double largest = (whole.high - whole.low) / 2;
    for (const BleedShare& sender : senders) largest = std::max(largest, (sender.light.high - sender.light.low) / 2);
    return largest / whole.value;
}

struct BleedProbe::State {
    State(unsigned threads, bool low_priority) : tracer(threads, low_priority) {}

    struct Series {
        BleedTarget target;
        BleedColumn whole;
        std::map<BleedSender, BleedColumn> senders;
        std::map<int32_t, BleedColumn> lights;
        std::array<BleedColumn, bleed_bounces> bounces;
        Vec3d places{0, 0, 0};
        int64_t hits = 0, dropped = 0;

        template <class Visit> void each_column(const Visit& visit) {
            visit(whole);
            for (auto& [key, column] : senders) visit(column);
            for (auto& [key, column] : lights) visit(column);
            for (BleedColumn& column : bounces) visit(column);
        }
        void add(const BleedSums& sums, size_t group);
    };
    void merge_groups();
    BleedShare share(const Series& s, std::string name, const BleedColumn& column) const;
    std::string name_of(const BleedSender& sender) const;
    std::string name_of_light(int32_t group) const;
    std::vector<BleedShare> sender_rows(const Series& s) const;
    std::vector<BleedShare> light_rows(const Series& s) const;
    std::vector<BleedShare> bounce_rows(const Series& s) const;

    BleedTracer tracer;
    Scene scene;
    std::vector<Series> series;
    size_t groups = 0;
    int64_t batches_per_group = 1, batches = 0;
};

void BleedProbe::State::Series::add(const BleedSums& sums, size_t group) {
    for (const auto& [sender, flow] : sums.senders) {
        BleedColumn& column = senders[sender];
        column.add(group, flow.light);
        column.places = column.places + flow.places;
        column.weight += flow.weight;
        column.infinite = flow.infinite;
        whole.add(group, flow.light);
    }
    for (const auto& [light, rgb] : sums.lights) lights[light].add(group, rgb);
    for (size_t i = 0; i < bounces.size(); ++i) bounces[i].add(group, sums.bounces[i]);
    places = places + sums.places;
    hits += sums.hits;
    dropped += sums.dropped;
}

void BleedProbe::State::merge_groups() {
    for (Series& s : series) s.each_column([&](BleedColumn& column) { column.halve(groups); });
    groups /= 2;
    batches_per_group *= 2;
}

BleedShare BleedProbe::State::share(const Series& s, std::string name, const BleedColumn& column) const {
    const BleedStatistics statistics(column, s.whole, groups, batches_per_group);
    BleedShare row;
    row.name = std::move(name);
    row.rgb = statistics.part_mean();
    row.infinite = column.infinite;
    row.light = statistics.of([](const Vec3d& part, const Vec3d&) { return luminance(part); });
    if (luminance(statistics.whole_mean()) > 0)
        row.share = statistics.of([](const Vec3d& part, const Vec3d& whole) { return luminance(part) / luminance(whole); });
    row.shift = shift_of(statistics);
    if (column.weight > 0) {
        row.place = column.places / column.weight;
        row.place = row.infinite ? normalize(row.place) : row.place + tracer.origin();
    }
    return row;
}

std::string BleedProbe::State::name_of_light(int32_t group) const {
    const auto& all = tracer.lights().groups;
    return group >= 0 && size_t(group) < all.size() ? all[size_t(group)].name : "glowing panes";
}

std::string BleedProbe::State::name_of(const BleedSender& sender) const {
    if (sender.by == SentBy::itself) return "seen directly";
    if (sender.by == SentBy::light) return name_of_light(sender.id);
    const Id<Node> id{uint32_t(sender.id)};
    const Node* node = scene.nodes.find(id);
    return node ? node_name(scene, id, *node) : "";
}

// The greatest columns, the others as one.
template <class Key>
static std::vector<std::pair<const Key*, BleedColumn>> greatest(const std::map<Key, BleedColumn>& columns, size_t& others) {
    std::vector<std::pair<const Key*, BleedColumn>> rows;
    for (const auto& [key, column] : columns) rows.emplace_back(&key, column);
    std::ranges::stable_sort(rows, std::greater{}, [](const auto& row) { return row.second.total(); });
    others = rows.size() > max_rows ? rows.size() - max_rows + 1 : 0;
    if (others == 0) return rows;
    BleedColumn rest;
    for (size_t i = max_rows - 1; i < rows.size(); ++i) rest.add(rows[i].second);
    rows.resize(max_rows - 1);
    rows.emplace_back(nullptr, std::move(rest));
    return rows;
}

std::vector<BleedShare> BleedProbe::State::sender_rows(const Series& s) const {
    std::vector<BleedShare> rows;
    size_t others = 0;
    for (const auto& [sender, column] : greatest(s.senders, others)) {
        rows.push_back(share(s, sender ? name_of(*sender) : std::to_string(others) + " others", column));
        rows.back().by = sender ? sender->by : SentBy::object;
        if (sender && sender->by == SentBy::object) rows.back().object = uint32_t(sender->id);
    }
    return rows;
}

std::vector<BleedShare> BleedProbe::State::light_rows(const Series& s) const {
    std::vector<BleedShare> rows;
    size_t others = 0;
    for (const auto& [light, column] : greatest(s.lights, others)) {
        rows.push_back(share(s, light ? name_of_light(*light) : std::to_string(others) + " others", column));
        rows.back().by = SentBy::light;
    }
    return rows;
}

std::vector<BleedShare> BleedProbe::State::bounce_rows(const Series& s) const {
    std::vector<BleedShare> rows;
    for (size_t i = 0; i < bleed_bounces; ++i) {
        if (s.bounces[i].total() == 0) continue;
        const std::string name = i == 0                   ? "seen directly"
                                 : i == 1                 ? "once"
                                 : i == 2                 ? "twice"
                                 : i + 1 == bleed_bounces ? std::to_string(i) + " or more times"
                                                          : std::to_string(i) + " times";
        rows.push_back(share(s, name, s.bounces[i]));
    }
    return rows;
}

BleedProbe::BleedProbe(unsigned threads, bool low_priority) : state_(std::make_unique<State>(threads, low_priority)) {}
BleedProbe::~BleedProbe() = default;

void BleedProbe::begin(const Scene& scene, const RenderSettings& settings, std::span<const BleedTarget> targets) {
    State& s = *state_;
    s.tracer.begin(scene, settings);
    s.scene = scene;
    s.series.clear();
    for (const BleedTarget& target : targets) s.series.emplace_back().target = target;
    s.groups = 0;
    s.batches_per_group = 1;
    s.batches = 0;
}

bool BleedProbe::round(const std::function<bool()>& wanted) {
    State& s = *state_;
    const int64_t count = int64_t(groups_per_round) * s.batches_per_group;
    std::vector<std::vector<BleedSums>> found;
    for (const State::Series& series : s.series) {
        found.push_back(s.tracer.trace(series.target, s.batches, count, wanted));
        if (found.back().empty()) return false;
    }
    for (size_t i = 0; i < s.series.size(); ++i)
        for (int64_t k = 0; k < count; ++k) s.series[i].add(found[i][size_t(k)], s.groups + size_t(k / s.batches_per_group));
    s.batches += count;
    s.groups += groups_per_round;
    if (s.groups == max_groups) s.merge_groups();
    return true;
}

int64_t BleedProbe::paths() const { return state_->batches * bleed_batch_paths; }

BleedReport BleedProbe::report(size_t i) const {
    const State& s = *state_;
    const State::Series& series = s.series[i];
    BleedReport report;
    report.lit = s.tracer.has_light();
    report.paths = paths();
    report.dropped = series.dropped;
    const BleedShare whole = s.share(series, "", series.whole);
    report.whole = whole.light;
    report.rgb = whole.rgb;
    // All estimates are 0 although the scene has light: the value is unknown.
    if (report.whole.value == 0 && report.lit) report.whole.known = false;
    BleedColumn direct, indirect;
    for (size_t k = 0; k < series.bounces.size(); ++k) (k < 2 ? direct : indirect).add(series.bounces[k]);
    report.direct = s.share(series, "direct", direct);
    report.indirect = s.share(series, "indirect", indirect);
    report.senders = s.sender_rows(series);
    report.lights = s.light_rows(series);
    report.bounces = s.bounce_rows(series);
    const bool at_point = series.target.kind != BleedTarget::Kind::pixels;
    report.has_place = at_point || series.hits > 0;
    report.place = at_point ? series.target.position : series.places / double(std::max<int64_t>(series.hits, 1)) + s.tracer.origin();
    report.missing_light = s.tracer.missing_light();
    return report;
}

} // namespace blush
