#include "measure/convergence/convergence_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace blush {
namespace {

using Kind = ConvergencePoint::Kind;
using Row = std::vector<std::string>;

constexpr size_t max_records = 64, max_lines = 20000, max_name_length = 120;
constexpr const char *mark_kind = "mark", *mix_kind = "mix";

std::string line_number(size_t line) { return fmt::format("line {}", line); }

std::string interval_fields(const Interval& i) {
    if (!(i.value > 0)) return ",,";
    return i.known ? fmt::format("{:.6g},{:.6g},{:.6g}", i.value, i.low, i.high) : fmt::format("{:.6g},,", i.value);
}

// The unquoted fields of the next line; quoted fields may contain line breaks. None if a quote is not closed.
std::optional<Row> next_row(std::string_view& rest) {
    Row row(1);
    bool quoted = false;
    size_t i = 0;
    for (; i < rest.size(); ++i) {
        const char c = rest[i];
        if (quoted) {
            if (c != '"')
                row.back() += c;
            else if (i + 1 < rest.size() && rest[i + 1] == '"')
                row.back() += rest[++i];
            else
                quoted = false;
        } else if (c == '"') {
            quoted = true;
        } else if (c == ',') {
            row.emplace_back();
        } else if (c == '\n') {
            break;
        } else if (c != '\r') {
            row.back() += c;
        }
    }
    if (quoted) return std::nullopt;
    rest.remove_prefix(std::min(i + 1, rest.size()));
    return row;
}

// The fields of a line by column name.
class Line {
public:
    Line(const std::map<std::string, size_t>& columns, const Row& row, size_t number) : columns_(columns), row_(row), number_(number) {}

    std::string text(const char* column) const {
        const auto at = columns_.find(column);
        return at != columns_.end() && at->second < row_.size() ? row_[at->second] : std::string();
    }
    // 0 if the field is empty or missing.
    Result<double> value(const char* column) const {
        const std::string field = text(column);
        if (field.empty()) return 0.0;
        double v = 0;
        const auto read = std::from_chars(field.data(), field.data() + field.size(), v);
        if (read.ec != std::errc{} || read.ptr != field.data() + field.size() || !std::isfinite(v) || v < 0)
            return error(fmt::format("{} is not a number >= 0", column));
        return v;
    }
    Error error(std::string what) const { return {.what = std::move(what), .where = line_number(number_)}; }

private:
    const std::map<std::string, size_t>& columns_;
    const Row& row_;
    size_t number_;
};

Result<Interval> interval_of(const Line& line, const std::string& column) {
    const auto value = line.value(column.c_str()), low = line.value((column + "_low").c_str()),
               high = line.value((column + "_high").c_str());
    for (const auto* v : {&value, &low, &high})
        if (!*v) return v->error();
    return Interval{*high > 0 && *low <= *value && *value <= *high, *value, *low, *high};
}

Result<ConvergencePoint> point_of(const Line& line, Kind kind) {
    const auto seconds = line.value("seconds"), spp = line.value("spp"), mse = line.value("mse");
    const auto rmse = interval_of(line, "rmse"), relmse = interval_of(line, "relmse");
    for (const auto* v : {&seconds, &spp, &mse})
        if (!*v) return v->error();
    for (const auto* v : {&rmse, &relmse})
        if (!*v) return v->error();
    if (*spp > 1e15) return line.error("too many samples");
    ConvergencePoint p{kind, *seconds, int64_t(*spp), *rmse, *relmse};
    if (!(p.rmse.value > 0) && *mse > 0) p.rmse = {false, std::sqrt(*mse), 0, 0};
    return p;
}

std::string name_of(const Line& line) {
    std::string name = line.text("name");
    if (name.empty()) name = line.text("variant");
    const std::string repeat = line.text("repeat");
    if (!repeat.empty() && repeat != "0") name += ", repeat " + repeat;
    if (name.size() > max_name_length) name.resize(max_name_length);
    return name;
}

// Adds a line to the record of its name.
Result<void> take(const Line& line, ConvergenceRecord& record) {
    const std::string kind = line.text("kind");
    for (const Kind k : {Kind::estimated, Kind::measured, Kind::denoised}) {
        if (kind != to_string(k) && !(kind.empty() && k == Kind::measured)) continue;
        const Result<ConvergencePoint> point = point_of(line, k);
        if (!point) return point.error();
        record.set(*point);
        return {};
    }
    if (kind != mark_kind && kind != mix_kind) return line.error("unknown kind");
    const Result<ConvergencePoint> at = point_of(line, Kind::estimated);
    if (!at) return at.error();
    record.mark({at->seconds, at->spp, line.text("label").substr(0, max_name_length), kind == mix_kind});
    return {};
}

} // namespace

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == text.npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
    quoted += '"';
    return quoted;
}

std::string to_csv(const std::vector<ConvergenceRecord>& records) {
    std::string csv = "name,seconds,spp,relmse,relmse_low,relmse_high,rmse,rmse_low,rmse_high,kind,label\n";
    for (const ConvergenceRecord& r : records) {
        for (const ConvergencePoint& p : r.points())
            csv += fmt::format("{},{:.6g},{},{},{},{},\n", csv_field(r.name), p.seconds, p.spp, interval_fields(p.relmse),
                               interval_fields(p.rmse), to_string(p.kind));
        for (const ConvergenceMark& m : r.marks())
            csv += fmt::format("{},{:.6g},{},,,,,,,{},{}\n", csv_field(r.name), m.seconds, m.spp, m.other_mix ? mix_kind : mark_kind,
                               csv_field(m.label));
    }
    return csv;
}

Result<std::vector<ConvergenceRecord>> parse_convergence_csv(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const std::optional<Row> header = next_row(text);
    std::map<std::string, size_t> columns;
    if (header)
        for (size_t i = 0; i < header->size(); ++i) columns.emplace((*header)[i], i);
    const bool named = columns.contains("name") || columns.contains("variant");
    const bool has_error = columns.contains("rmse") || columns.contains("relmse") || columns.contains("mse");
    if (!named || !has_error || !columns.contains("seconds") || !columns.contains("spp"))
        return Error{.what = "not a convergence table: it needs the columns name, seconds, spp, rmse and relmse"};
    std::vector<ConvergenceRecord> records;
    for (size_t number = 2; !text.empty(); ++number) {
        const std::optional<Row> row = next_row(text);
        if (!row) return Error{.what = "a quote is not closed", .where = line_number(number)};
        const Line line(columns, *row, number);
        if (number > max_lines) return line.error("too many lines");
        if (row->size() == 1 && row->front().empty()) continue;
        const std::string name = name_of(line);
        auto record = std::ranges::find(records, name, &ConvergenceRecord::name);
        if (record == records.end()) {
            if (records.size() == max_records) return line.error("too many runs");
            records.emplace_back().name = name;
            record = records.end() - 1;
        }
        if (const Result<void> taken = take(line, *record); !taken) return taken.error();
    }
    if (records.empty()) return Error{.what = "no runs"};
    return records;
}

} // namespace blush
