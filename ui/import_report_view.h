// What the Import report panel shows: what became of a file's extensions and features, and what is suspicious about it.
#pragma once

#include <memory>
#include <string>

namespace blush {

struct ImportReport;

struct ImportReportView {
    bool open = false;
    std::string file;                           // that was opened, reloaded or imported last
    std::shared_ptr<const ImportReport> report; // null: none was
};

} // namespace blush
