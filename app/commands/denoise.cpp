#include "app/commands/denoise.h"

#include "app/commands/common.h"
#include "app/commands/denoising.h"
#include "app/commands/interrupt.h"
#include "app/commands/render/render_options.h"
#include "app/commands/render/resume_image.h"
#include "app/commands/render/write_image.h"
#include "app/common/assets_dir.h"
#include "core/parallel.h"
#include "core/srgb.h"
#include "io/image/image_io.h"
#include "render/session/denoised_image.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

namespace blush {
namespace {

struct DenoiseCommand {
    std::string input, output;
    DenoiseQuality quality = DenoiseQuality::high;
    ViewSettings view;
    CommonOptions common;
};

// Input of the denoiser: planes of three floats per pixel.
struct Planes {
    std::vector<float> color, albedo, normal; // albedo and normal may be empty
};

using Channels = std::array<const LayeredImage::Channel*, 3>;

std::vector<float> interleaved(const Channels& channels) {
    std::vector<float> values;
    if (!channels[0] || !channels[1] || !channels[2]) return values;
    values.reserve(3 * channels[0]->values.size());
    for (size_t i = 0; i < channels[0]->values.size(); ++i)
        for (const LayeredImage::Channel* c : channels) values.push_back(c->values[i]);
    return values;
}

// Converts a display-encoded image to scene-linear, where averaging is correct.
void linearise(LayeredImage& image) {
    for (LayeredImage::Channel& channel : image.channels)
        if (channel.name != "A") std::ranges::transform(channel.values, channel.values.begin(), linear_from_srgb<float>);
}

Result<LayeredImage> read_input(const DenoiseCommand& c) {
    Result<LayeredImage> image = read_layers(c.input);
    if (!image) return image;
    if (image->more_parts) return Error{c.input, "multi-part EXR files are not supported: only the first part would be kept", ""};
    if (is_display_encoded(c.input)) linearise(*image);
    return image;
}

Result<Planes> planes_of(const LayeredImage& image) {
    Planes planes{interleaved(image.find_color()), interleaved(image.find_color("albedo")),
                  interleaved({image.find("normal.X"), image.find("normal.Y"), image.find("normal.Z")})};
    if (planes.color.empty()) return Error{.what = "the image has no channels R, G and B"};
    return planes;
}

PixelView view_of(const std::vector<float>& plane) { return {plane, 3}; }

// What the samples in the file say about its noise, for bias_correction.h.
struct Halves {
    std::vector<Vec3> difference = {}; // Frame::half_difference; empty: not known
    std::string why_not = {};          // reason why the bias is not corrected
    std::vector<float> rgba = {};      // the image of the samples
};

// Reads the film alone, and before the image: it may fill most of the memory. A damaged one leaves the bias as it is.
Halves read_halves(const DenoiseCommand& c) {
    const auto texts = read_metadata(c.input);
    const auto metadata = texts ? read_snapshot_metadata(*texts) : Result<SnapshotMetadata>(texts.error());
    if (!metadata || metadata->film.empty()) return {.why_not = "no samples in the file: render it with --layers film"};
    const Result<ResumeImage> saved = read_resume_image(c.input);
    if (!saved) return {.why_not = saved.error().what};
    Result<ResolvedFilm> resolved = resolve_film(saved->film, saved->metadata.settings, c.common.threads, true);
    if (!resolved) return {.why_not = resolved.error().what};
    Frame& frame = resolved->frame;
    if (frame.half_difference.empty()) return {.why_not = "no two halves of samples in the file"};
    return {std::move(frame.half_difference), {}, std::move(frame.rgba)};
}

// True if the pixels are those of the samples, up to the rounding of 16-bit floats: other programs edit them.
bool shows(const std::vector<float>& rgb, const Halves& halves) {
    if (rgb.size() / 3 != halves.difference.size()) return false;
    for (size_t i = 0; i < rgb.size(); ++i) {
        const float rendered = halves.rgba[i / 3 * 4 + i % 3];
        if (!(std::abs(rgb[i] - rendered) <= 1e-3f * std::abs(rendered) + 1e-6f)) return false;
    }
    return true;
}

void correct_by(Halves& halves, const DenoiseInput& input, const std::vector<float>& rgb, unsigned threads, Denoised& denoised) {
    if (halves.difference.empty()) return;
    if (!shows(rgb, halves)) {
        halves.why_not = "the pixels are not those of the samples in the file";
        return;
    }
    const Workers workers(threads);
    correct_bias_of(denoised, input, halves.difference, &workers);
}

// All channels of the file, with the new layer after the beauty.
Result<void> write_exr_output(const DenoiseCommand& c, LayeredImage image, const Denoised& denoised) {
    std::string behind = image.find("A") ? "A" : "B";
    for (size_t k = 0; k < 3; ++k) {
        LayeredImage::Channel channel{fmt::format("denoised.{}", "RGB"[k]), std::vector<float>(denoised.rgb.size() / 3)};
        for (size_t i = 0; i < channel.values.size(); ++i) channel.values[i] = denoised.rgb[3 * i + k];
        const std::string name = channel.name;
        image.set(std::move(channel), behind);
        behind = name;
    }
    image.metadata["blush:denoised"] = denoised_by(denoised);
    return write_exr(c.output, image);
}

// A display-encoded image is encoded again with the same curve; a scene-linear one goes through the view transform.
Result<void> write_display_output(const DenoiseCommand& c, const LayeredImage& image, const Denoised& denoised,
                                  const ColorManagement& color) {
    const std::map<std::string, std::string> metadata{{"blush:version", BLUSH_VERSION}, {"blush:denoised", denoised_by(denoised)}};
    std::vector<float> rgb = denoised.rgb;
    if (!is_display_encoded(c.input))
        return write_through_view(c.output, image.width, image.height, std::move(rgb), color, c.view, metadata);
    std::ranges::transform(rgb, rgb.begin(), srgb_from_linear);
    return write_display_image(c.output, image.width, image.height, rgb, metadata);
}

struct Outcome {
    int width = 0, height = 0;
    std::vector<std::string> guides; // auxiliary channels used by the network
    Denoised denoised;
    std::string not_corrected_because; // empty: the bias is corrected
};

Result<Outcome> denoise_file(const DenoiseCommand& c, const ColorManagement* color) {
    const InterruptGuard guard;
    Halves halves = read_halves(c);
    Result<LayeredImage> image = read_input(c);
    if (!image) return in_file(image.error(), c.input);
    const Result<Planes> planes = planes_of(*image);
    if (!planes) return in_file(planes.error(), c.input);
    Outcome outcome{image->width, image->height, {}, {}, {}};
    if (!planes->albedo.empty() && !planes->normal.empty()) outcome.guides = {"albedo", "normal"};

    Denoiser denoiser(weights_dir(), c.common.threads);
    const DenoiseInput input{image->width, image->height, view_of(planes->color), view_of(planes->albedo), view_of(planes->normal)};
    Result<std::vector<Denoised>> denoised = denoise_with_progress(denoiser, {&input, 1}, c.quality, c.common.quiet, guard.interrupted());
    if (!denoised) return in_file(denoised.error(), c.input);
    outcome.denoised = std::move(denoised->front());
    correct_by(halves, input, planes->color, c.common.threads, outcome.denoised);
    outcome.not_corrected_because = halves.why_not;
    const Result<void> written =
        color ? write_display_output(c, *image, outcome.denoised, *color) : write_exr_output(c, *std::move(image), outcome.denoised);
    if (!written) return in_file(written.error(), c.output);
    return outcome;
}

OrderedJson outcome_json(const DenoiseCommand& c, const Outcome& outcome) {
    OrderedJson json;
    json["input"] = c.input;
    json["width"] = outcome.width;
    json["height"] = outcome.height;
    json["guides"] = outcome.guides;
    json.update(denoised_json(outcome.denoised));
    json["not_corrected_because"] = outcome.not_corrected_because;
    json["output"] = c.output;
    return json;
}

int run_denoise(const DenoiseCommand& c) {
    const Result<ImageFormat> format = image_format(c.output);
    if (!format) return bad_usage(format.error().text());
    if (const Result<void> folder = expect_folder(c.output); !folder) return failed(folder.error());
    const Result<std::optional<ColorManagement>> color = color_for(*format, c.view);
    if (!color) return failed(color.error());
    const Result<Outcome> outcome = denoise_file(c, *color ? &**color : nullptr);
    if (!outcome) return failed(outcome.error());
    if (const Result<void> written = write_json(c.common.json, outcome_json(c, *outcome)); !written) return failed(written.error());
    if (!c.common.quiet && c.common.json != "-")
        fmt::print("{}: {}x{}, {}{}\n", c.output, outcome->width, outcome->height, denoised_summary(outcome->denoised),
                   outcome->not_corrected_because.empty() ? "" : fmt::format("; bias not corrected: {}", outcome->not_corrected_because));
    return exit_done;
}

} // namespace

void add_denoise_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<DenoiseCommand>();
    CLI::App* sub =
        app.add_subcommand("denoise", "Denoise an image; uses the channels albedo.{R,G,B} and normal.{X,Y,Z} if it has both, and "
                                      "corrects the bias of the network if it has the samples (--layers film)");
    sub->add_option("input", command->input, "EXR, HDR, PNG or JPEG file")->required()->type_name("IN");
    sub->add_option("-o,--output", command->output, "EXR: all channels of IN and a layer \"denoised\"; PNG and JPEG: the denoised image")
        ->required()
        ->type_name("OUT");
    sub->add_option_function<std::string>(
           "--quality",
           [command](const std::string& text) {
               const Result<DenoiseQuality> quality = parse_denoise_quality(text);
               if (!quality) throw CLI::ValidationError("--quality", quality.error().text());
               command->quality = *quality;
           },
           "fast: the small network; high: the large one, with albedo and normal denoised first [high]")
        ->type_name("fast|high");
    add_view_options(*sub, command->view);
    add_common_options(*sub, command->common);
    sub->callback([command, &run] { run = [command] { return run_denoise(*command); }; });
}

} // namespace blush
