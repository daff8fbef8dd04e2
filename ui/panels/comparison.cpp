// Comparison panel: which two images are compared, how, and their difference in numbers.
#include "core/text.h"
#include "ui/panels/panels.h"
#include "ui/snapshots/difference.h"
#include "ui/widgets/widgets.h"
#include "ui/window/theme.h"

#include <cmath>
#include <fmt/format.h>

namespace blush {
namespace {

using CompareMode = Comparison::Mode;

void draw_side(PanelContext& c, Fields& f, const char* label, uint64_t& side) {
    std::vector<std::string> names{"Live image"};
    std::vector<uint64_t> ids{live_image};
    for (const SnapshotPtr& s : c.ui.snapshots.list) {
        names.push_back(s->name);
        ids.push_back(s->id);
    }
    std::vector<const char*> texts;
    for (const std::string& name : names) texts.push_back(name.c_str());
    int index = int(std::ranges::find(ids, side) - ids.begin());
    if (f.choice(label, index, texts, "A snapshot or the live image.")) side = ids[size_t(index)];
    if (const SnapshotPtr s = c.ui.snapshots.find(side)) draw_layer_choice(f, *s, fmt::format("Layer of {}", label).c_str());
}

std::string stops(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    const double ratio = (a[0] + a[1] + a[2]) / (b[0] + b[1] + b[2]);
    return std::isfinite(ratio) && ratio > 0 ? signed_number(std::log2(ratio), 2) + " EV" : "";
}

void draw_numbers(PanelContext& c, Fields& f, const Difference& d) {
    const Metrics& m = d.numbers;
    f.info("relMSE", fmt::format("{:.3g}   {:.2g} %", m.relmse, 100 * std::sqrt(m.relmse)),
           "Mean of (a - b)² / (b² + 0.01), and its square root.");
    f.info("RMSE", fmt::format("{:.3g} nits", m.rmse), "Root mean square difference.");
    f.info("Mean |A - B|", fmt::format("{:.3g} nits", m.mae), "Mean absolute difference.");
    f.info("Largest", fmt::format("{:.3g} nits", m.max_abs), "Largest absolute difference of a channel.");
    f.info("PSNR", std::isfinite(m.psnr) ? fmt::format("{:.1f} dB", m.psnr) : "equal",
           "Computed on sRGB-encoded values clamped to 0 .. 1.");
    f.info("A is brighter by", stops(m.mean_a, m.mean_b), "Ratio of the means of all channels, in stops.");
    c.ui.probe.record_last_item(std::string("Compare/Numbers/") + (d.has_flip ? "FLIP" : "difference"));
    if (!d.has_flip) return;
    const FlipNumbers& flip = m.flip;
    f.info("FLIP", fmt::format("{:.4f}", flip.mean), "Mean HDR-FLIP: 0 is no visible difference, 1 is the maximum.");
    f.info("Quartiles", fmt::format("{:.3f}  {:.3f}  {:.3f}", flip.first_quartile, flip.median, flip.third_quartile),
           "Weighted quartiles of the FLIP error, as printed by the reference tool.");
    f.info("Largest FLIP", fmt::format("{:.3f}", flip.largest), "FLIP of the pixel with the largest difference.");
    f.info(fmt::format("Above {:.1f}", FlipNumbers::noticeable).c_str(), fmt::format("{:.2f} % of pixels", 100 * flip.share_noticeable),
           "Share of the pixels with a larger FLIP than this.");
    c.ui.probe.record_last_item("Compare/Numbers/FLIP above");
}

} // namespace

void draw_layer_choice(Fields& f, Snapshot& image, const char* label) {
    if (!image.layers) return;
    const ImageLayers& layers = *image.layers;
    std::vector<const char*> names;
    for (const ImageLayer& layer : layers.layers) names.push_back(layer.name.c_str());
    int index = int(layers.chosen);
    const std::string tip = fmt::format("Channels {} of {}.", layers.layers[layers.chosen].channels, layers.file.filename().string());
    if (f.choice(label, index, names, tip.c_str())) image.choose_layer(size_t(index));
    if (const std::string range = range_text(layers); !range.empty()) f.info("Black to white", range);
}

void draw_comparison_panel(PanelContext& c) {
    Comparison& compare = c.ui.snapshots.compare;
    Fields f(c.ui, "Compare");
    draw_side(c, f, "A", compare.a);
    draw_side(c, f, "B", compare.b);
    constexpr const char* modes[] = {"Wipe", "Flicker", "Difference"};
    int mode = int(compare.mode) - 1;
    if (f.choice("Show", mode, modes,
                 "Wipe: both, with a movable bar between them. Flicker: one after the other. Difference: a map of the differences."))
        compare.mode = CompareMode(mode + 1);
    if (compare.mode == CompareMode::flicker) {
        if (f.button(compare.shows_b ? "Show A" : "Show B", "Shortcut: J.")) compare.shows_b = !compare.shows_b;
    } else if (compare.mode == CompareMode::difference) {
        constexpr const char* kinds[] = {"Absolute", "Relative", "FLIP"};
        int kind = int(compare.kind);
        if (f.choice("Kind", kind, kinds,
                     "Absolute: |A - B|. Relative: |A - B| / B, as a map. FLIP: perceived difference, as a map. B is the reference."))
            compare.kind = DifferenceKind(kind);
        const Difference* d = c.ui.difference.get();
        if (compare.a == compare.b)
            quiet_text("A and B are the same image.");
        else if (!d || d->kind != compare.kind)
            quiet_text("Comparing...");
        else if (!d->problem.empty())
            quiet_text(d->problem);
        else
            draw_numbers(c, f, *d);
    }
}

} // namespace blush
