#include "ui/snapshots/picture_view.h"

namespace blush {

bool is_map(const PictureView& view) {
    return view.show == PictureView::Show::dropped || view.show == PictureView::Show::path_length ||
           view.show == PictureView::Show::survival || is_data(view);
}

bool is_data(const PictureView& view) {
    switch (view.show) {
    case PictureView::Show::albedo:
    case PictureView::Show::normal:
    case PictureView::Show::depth:
    case PictureView::Show::object_id:
    case PictureView::Show::material_id:
    case PictureView::Show::error:
    case PictureView::Show::samples: return true;
    default: return false;
    }
}

} // namespace blush
