// The network, prepared for one image size.
#pragma once

#include "core/parallel.h"
#include "core/result.h"
#include "render/denoise/convolution.h"
#include "render/denoise/unet_plan.h"
#include "render/denoise/unet_weights.h"

#include <functional>
#include <optional>
#include <vector>

namespace blush::denoise {

struct Unet {
    // The last band of a plane may have fewer rows.
    struct Layer {
        Convolution band;
        std::optional<Convolution> last_band;
    };

    UnetPlan plan;
    std::vector<Layer> layers = {};
    std::vector<double> done_after = {}; // fraction of all multiplications done after each layer; the last is 1
    size_t scratch_bytes = 0;            // of the convolutions, per worker

    // Size of the working memory of run_unet().
    size_t bytes(const Workers& workers) const { return plan.bytes(workers.threads()) + workers.threads() * scratch_bytes; }
};

// Sides must be multiples of unet_side_multiple. Errors: as of Convolution::make.
Result<Unet> make_unet(const UnetWeights& weights, int width, int height, Element element);

// Fills row y of the input: width * input channels.
using UnetSource = std::function<void(int y, float* row)>;
// Receives row y of the output: width * 3.
using UnetSink = std::function<void(int y, const float* row)>;

// memory: unet.bytes(workers), aligned to 64; needs no contents between calls. Source and sink are called once per row, from many
// threads; progress after each layer, with the completed fraction, on the caller's thread. False if cancelled.
bool run_unet(const Unet& unet, const Workers& workers, const std::function<bool()>& wanted, std::byte* memory, const UnetSource& source,
              const UnetSink& sink, const std::function<void(double)>& progress = {});

} // namespace blush::denoise
