#include "tests/bench/markdown.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace blush::bench {
namespace {

std::string words(std::string key) {
    std::ranges::replace(key, '_', ' ');
    return key;
}

std::string cell(const Json& value) {
    if (value.is_number_float()) return fmt::format("{:.4g}", value.get<double>());
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string text;
    for (const Json& item : value) text += (text.empty() ? "" : ", ") + cell(item);
    return text;
}

using Row = std::vector<std::pair<std::string, std::string>>; // column, cell

bool is_table(const Json& value) { return value.is_array() && !value.empty() && value.front().is_object(); }

void flatten(const Json& value, const std::string& path, Row& row) {
    if (!value.is_object()) return row.emplace_back(path, cell(value)), void();
    for (const auto& [key, item] : value.items())
        if (!is_table(item)) flatten(item, path.empty() ? words(key) : path + ", " + words(key), row);
}

std::string line(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& c : cells) text += " " + c + " |";
    return text + "\n";
}

std::string table(const std::vector<Row>& rows) {
    std::vector<std::string> columns;
    for (const Row& row : rows)
        for (const auto& [column, value] : row)
            if (std::ranges::find(columns, column) == columns.end()) columns.push_back(column);
    std::string text = line(columns) + line(std::vector<std::string>(columns.size(), "---"));
    for (const Row& row : rows) {
        std::vector<std::string> cells;
        for (const std::string& column : columns) {
            const auto found = std::ranges::find(row, column, &Row::value_type::first);
            cells.push_back(found == row.end() ? "" : found->second);
        }
        text += line(cells);
    }
    return text + "\n";
}

// Tables inside the rows of another one follow it, one for each row, named by its first cell.
std::string tables(const Json& value) {
    if (!is_table(value)) {
        Row row;
        flatten(value, "", row);
        std::vector<Row> rows;
        for (const auto& [key, text] : row) rows.push_back({{"figure", key}, {"value", text}});
        std::string text = rows.empty() ? "" : table(rows);
        if (value.is_object())
            for (const auto& [key, item] : value.items())
                if (is_table(item)) text += "### " + words(key) + "\n\n" + tables(item);
        return text;
    }
    std::vector<Row> rows;
    std::string inner;
    for (const Json& item : value) {
        Row& row = rows.emplace_back();
        flatten(item, "", row);
        for (const auto& [key, nested] : item.items())
            if (is_table(nested)) inner += fmt::format("{}, {}:\n\n", row.empty() ? "" : row.front().second, words(key)) + tables(nested);
    }
    return table(rows) + inner;
}

} // namespace

std::string to_markdown(const Json& report, std::span<const ReportedCase> cases) {
    const Json& machine = report.at("machine");
    std::string text = fmt::format("{} with {} cores, load {} at the start{}.\n\n", machine.at("processor").get<std::string>(),
                                   machine.at("cores").get<int>(), cell(machine.at("load_average")),
                                   report.at("quick").get<bool>() ? ", few rounds (`--quick`)" : "");
    for (const ReportedCase& c : cases)
        if (report.contains(c.name)) text += fmt::format("## {}\n\n{}.\n\n", c.name, c.description) + tables(report.at(c.name));
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

} // namespace blush::bench
