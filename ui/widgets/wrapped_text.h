// Paragraphs that break between words only. ImGui also breaks behind a point or comma, which splits numbers such as 0.0505.
#pragma once

#include <string>
#include <string_view>

namespace blush {

// The text with line breaks in place of spaces, so that its lines fit into `width` pixels of the current font. A longer word has a
// line of its own.
std::string wrapped(std::string_view text, float width);

// Such a paragraph in the current window, to its right edge; a longer word is split.
void wrapped_text(std::string_view text);

} // namespace blush
