// State of the Import report panel: support of a file's extensions and features, and lint warnings.
#pragma once

#include <memory>
#include <string>

namespace blush {

struct ImportReport;

struct ImportReportView {
    bool open = false;
    std::string file;                           // file that was last opened, reloaded or imported
    std::shared_ptr<const ImportReport> report; // null: none yet
};

} // namespace blush
