#include "ui/gl/redraw.h"

#include <cstring>
#include <imgui.h>
#include <utility>

namespace blush {
namespace {

size_t texture_changes = 0; // OpenGL belongs to one thread

void append(std::vector<std::byte>& to, const void* from, size_t bytes) {
    if (bytes == 0) return;
    to.resize(to.size() + bytes);
    std::memcpy(to.data() + to.size() - bytes, from, bytes);
}

template <class T> void append(std::vector<std::byte>& to, const T& value) { append(to, &value, sizeof(T)); }

template <class T> void append_all(std::vector<std::byte>& to, const ImVector<T>& values) {
    append(to, values.Size);
    append(to, values.Data, size_t(values.Size) * sizeof(T));
}

// Member by member: the padding of ImDrawCmd has no value.
void append(std::vector<std::byte>& to, const ImDrawCmd& command) {
    append(to, command.ClipRect);
    append(to, command.TextureId);
    append(to, command.VtxOffset);
    append(to, command.IdxOffset);
    append(to, command.ElemCount);
    append(to, command.UserCallback);
    append(to, command.UserCallbackData);
}

} // namespace

void textures_changed() { ++texture_changes; }

bool Redraw::is_needed(const ImDrawData& data) {
    coming_.clear();
    append(coming_, data.DisplayPos);
    append(coming_, data.DisplaySize);
    append(coming_, data.FramebufferScale);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        append_all(coming_, list.VtxBuffer);
        append_all(coming_, list.IdxBuffer);
        append(coming_, list.CmdBuffer.Size);
        for (const ImDrawCmd& command : list.CmdBuffer) append(coming_, command);
    }
    drawn_.swap(coming_);
    return std::exchange(texture_changes_, texture_changes) != texture_changes || drawn_ != coming_;
}

} // namespace blush
