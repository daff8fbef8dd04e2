#include "ui/snapshots/image_view.h"

namespace blush {

bool is_map(const ImageView& view) {
    return view.show == ImageView::Show::dropped || view.show == ImageView::Show::path_length || view.show == ImageView::Show::survival ||
           is_data(view);
}

bool is_data(const ImageView& view) {
    switch (view.show) {
    case ImageView::Show::albedo:
    case ImageView::Show::normal:
    case ImageView::Show::depth:
    case ImageView::Show::object_id:
    case ImageView::Show::material_id:
    case ImageView::Show::error:
    case ImageView::Show::samples:
    case ImageView::Show::indirect_share:
    case ImageView::Show::bleed: return true;
    default: return false;
    }
}

} // namespace blush
