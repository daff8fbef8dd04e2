#include "ui/widgets/wrapped_text.h"

#include <algorithm>
#include <imgui.h>

namespace blush {

std::string wrapped(std::string_view text, float width) {
    std::string lines;
    size_t line = 0; // where the last line begins in `lines`
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of(" \n"), text.size());
        const std::string_view word = text.substr(0, end);
        const size_t space = lines.size();
        lines += word;
        if (space > line && ImGui::CalcTextSize(lines.c_str() + line, lines.c_str() + lines.size()).x > width) {
            lines[space - 1] = '\n'; // the space before the word
            line = space;
        }
        if (end == text.size()) break;
        lines += text[end];
        if (text[end] == '\n') line = lines.size();
        text.remove_prefix(end + 1);
    }
    return lines;
}

void wrapped_text(std::string_view text) {
    const std::string lines = wrapped(text, ImGui::GetContentRegionAvail().x);
    ImGui::PushTextWrapPos(0); // for words that are longer than a line
    ImGui::TextUnformatted(lines.c_str(), lines.c_str() + lines.size());
    ImGui::PopTextWrapPos();
}

} // namespace blush
