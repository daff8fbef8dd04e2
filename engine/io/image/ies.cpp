#include "io/image/ies.h"

#include "core/files.h"
#include "core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace blush {
namespace {

constexpr int64_t max_values = 1 << 20;
constexpr uint64_t max_bytes = 16 << 20;

// Reads lines, then numbers with arbitrary line breaks; keeps the first error.
class Reader {
public:
    explicit Reader(std::string_view text) : text_(text) {}

    std::optional<std::string_view> line() {
        if (text_.empty()) return {};
        const size_t end = std::min(text_.find('\n'), text_.size());
        std::string_view line = text_.substr(0, end);
        text_.remove_prefix(std::min(end + 1, text_.size()));
        ++line_;
        while (!line.empty() && is_space(line.back())) line.remove_suffix(1);
        while (!line.empty() && is_space(line.front())) line.remove_prefix(1);
        return line;
    }
    double number(const char* what) {
        while (!text_.empty() && (is_space(text_.front()) || text_.front() == ',')) {
            line_ += text_.front() == '\n';
            text_.remove_prefix(1);
        }
        size_t end = 0;
        while (end < text_.size() && !is_space(text_[end]) && text_[end] != ',') ++end;
        std::string_view word = text_.substr(0, end);
        text_.remove_prefix(end);
        if (word.starts_with('+')) word.remove_prefix(1);
        double value = 0;
        if (word.empty())
            fail(fmt::format("ends before {}", what));
        else if (!parse_number(word, value) || !std::isfinite(float(value)))
            fail(fmt::format("{} is not a number", what));
        return value;
    }
    double factor(const char* what) {
        const double value = number(what);
        if (!(value >= 0)) fail(fmt::format("{} is negative", what));
        return value;
    }
    int count(const char* what, int64_t low, int64_t high) {
        const double value = number(what);
        if (!(value >= double(low) && value <= double(high)) || value != std::floor(value)) {
            fail(fmt::format("{} must be a whole number from {} to {}", what, low, high));
            return int(low);
        }
        return int(value);
    }
    void fail(std::string what) {
        if (!error_) error_ = Error{"", std::move(what), fmt::format("line {}", line_ + 1)};
    }
    const std::optional<Error>& error() const { return error_; }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

    std::string_view text_;
    int64_t line_ = 0;
    std::optional<Error> error_;
};

// Reads ascending angles in degrees.
std::vector<float> read_angles(Reader& r, int count, const char* what, double low, double high) {
    std::vector<float> angles;
    for (int i = 0; i < count && !r.error(); ++i) {
        const double angle = r.number(what);
        if (!(angle >= low && angle <= high)) r.fail(fmt::format("{} must lie from {} to {} degrees", what, low, high));
        if (i > 0 && !(float(angle) > angles.back())) r.fail(fmt::format("{} must ascend", what));
        angles.push_back(float(angle));
    }
    return angles;
}

// TILT=INCLUDE: the factor at angle 0, which is the first pair.
double read_tilt(Reader& r) {
    r.count("the lamp's position", 0, 3);
    const int pairs = r.count("the number of tilt angles", 1, 1000);
    read_angles(r, pairs, "a tilt angle", 0, 180);
    double first = 1;
    for (int i = 0; i < pairs && !r.error(); ++i) {
        const double factor = r.factor("a tilt factor");
        if (i == 0) first = factor;
    }
    return first;
}

// A horizontal angle and its row of the table.
struct Row {
    float horizontal;
    std::vector<float> candela;
};

void sort_by_angle(std::vector<Row>& rows) {
    std::ranges::stable_sort(rows, {}, &Row::horizontal);
    const auto same = std::ranges::unique(rows, {}, &Row::horizontal);
    rows.erase(same.begin(), same.end());
}
// Adds mirrored rows at the angles mirrored(horizontal).
template <class Mirror> void mirror_rows(std::vector<Row>& rows, Mirror mirrored) {
    const std::vector<Row> half = rows;
    for (const Row& row : half) rows.push_back({mirrored(row.horizontal), row.candela});
    sort_by_angle(rows);
}

// Closes the circle: repeats the first row at 360 degrees, and the last one before 0 if no row is at 0.
void close_circle(std::vector<Row>& rows) {
    const Row first = rows.front(), last = rows.back();
    rows.push_back({first.horizontal + 360, first.candela});
    if (first.horizontal > 0) rows.insert(rows.begin(), {last.horizontal - 360, last.candela});
}

// Type C: angles cover a quarter, half or full turn; a range that ends before 360 degrees also means the full turn.
void unfold_type_c(Reader& r, std::vector<Row>& rows) {
    const float first = rows.front().horizontal, last = rows.back().horizontal;
    if (rows.size() == 1) return;
    if (first == 90 && last == 270) {
        mirror_rows(rows, [](float h) { return h <= 180 ? 180 - h : 540 - h; });
        close_circle(rows);
    } else if (first != 0) {
        r.fail("horizontal angles must begin at 0, or run from 90 to 270");
    } else if (last == 90) {
        mirror_rows(rows, [](float h) { return 180 - h; });
        mirror_rows(rows, [](float h) { return 360 - h; });
    } else if (last == 180) {
        mirror_rows(rows, [](float h) { return 360 - h; });
    } else if (last > 180 && last < 360) {
        close_circle(rows);
    } else if (last != 360) {
        r.fail("horizontal angles must end at 0, 90, 180 or 360");
    }
}

// Type B: angles from 0 on are mirrored to negative angles.
void unfold_type_b(std::vector<float>& vertical, std::vector<Row>& rows) {
    if (rows.size() > 1 && rows.front().horizontal == 0) mirror_rows(rows, [](float h) { return -h; });
    if (vertical.size() < 2 || vertical.front() != 0) return;
    const auto mirror = [](std::vector<float>& values, float sign) {
        std::vector<float> all;
        for (size_t i = values.size() - 1; i > 0; --i) all.push_back(sign * values[i]);
        all.insert(all.end(), values.begin(), values.end());
        values = std::move(all);
    };
    mirror(vertical, -1);
    for (Row& row : rows) mirror(row.candela, 1);
}

// Reads the header up to TILT, and whether the standard is older than 1995 and uses the ballast-lamp factor.
struct Header {
    bool is_old = true;
    std::string_view tilt;
};
Header read_header(Reader& r) {
    Header header;
    for (bool first = true; const auto line = r.line(); first = false) {
        if (first && line->starts_with("IES")) header.is_old = *line == "IESNA91";
        if (!line->starts_with("TILT=")) continue;
        header.tilt = line->substr(5);
        return header;
    }
    r.fail("not an LM-63 file: no TILT line");
    return header;
}

} // namespace

Result<IesPtr> parse_ies(std::string_view text) {
    Reader r(text);
    const Header header = read_header(r);
    if (r.error()) return *r.error();
    double scale = 1;
    if (header.tilt == "INCLUDE")
        scale = read_tilt(r);
    else if (header.tilt != "NONE")
        r.fail("tilt must be NONE or INCLUDE: other files are not read");

    r.number("the number of lamps");
    r.number("the lumens of a lamp"); // -1: absolute photometry
    scale *= r.factor("the candela multiplier");
    const int verticals = r.count("the number of vertical angles", 1, max_values),
              horizontals = r.count("the number of horizontal angles", 1, max_values);
    const int type = r.count("the photometric type", 1, 3);
    r.count("the unit of length", 1, 2);
    for (const char* side : {"the width", "the length", "the height"}) r.number(side);
    scale *= r.factor("the ballast factor");
    const double ballast_lamp = r.factor("the ballast-lamp factor");
    if (header.is_old) scale *= ballast_lamp;
    r.number("the watts");
    if (type == 3) r.fail("type A photometry (headlamps) is not supported");
    if (int64_t(verticals) * horizontals > max_values) r.fail(fmt::format("has more than {} values", max_values));
    if (r.error()) return *r.error();

    auto profile = std::make_shared<IesProfile>();
    profile->type = type == 1 ? IesProfile::Type::c : IesProfile::Type::b;
    const bool is_c = type == 1;
    profile->vertical = read_angles(r, verticals, "a vertical angle", is_c ? 0 : -90, is_c ? 180 : 90);
    std::vector<Row> rows;
    for (const float h : read_angles(r, horizontals, "a horizontal angle", is_c ? 0 : -90, is_c ? 360 : 90)) rows.push_back({h, {}});
    for (Row& row : rows)
        for (int i = 0; i < verticals && !r.error(); ++i) {
            row.candela.push_back(float(r.factor("a candela value") * scale));
            if (!std::isfinite(row.candela.back())) r.fail("a candela value is not finite");
            profile->peak = std::max(profile->peak, row.candela.back());
        }
    if (!r.error() && !(profile->peak > 0)) r.fail("all candela values are 0");
    if (!r.error() && is_c) unfold_type_c(r, rows);
    if (r.error()) return *r.error();
    if (!is_c) unfold_type_b(profile->vertical, rows);
    for (const Row& row : rows) {
        profile->horizontal.push_back(row.horizontal);
        profile->candela.insert(profile->candela.end(), row.candela.begin(), row.candela.end());
    }
    return IesPtr(std::move(profile));
}

Result<IesPtr> read_ies(const std::filesystem::path& file) {
    const Result<std::vector<uint8_t>> bytes = read_file(file, max_bytes);
    if (!bytes) return bytes.error();
    Result<IesPtr> profile = parse_ies({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
    if (profile) return profile;
    Error error = profile.error();
    error.file = file.string();
    return error;
}

} // namespace blush
