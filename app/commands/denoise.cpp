#include "app/commands/denoise.h"

#include "app/commands/common.h"
#include "app/commands/denoising.h"
#include "app/commands/interrupt.h"
#include "app/commands/render/render_options.h"
#include "app/commands/render/write_image.h"
#include "app/common/assets_dir.h"
#include "core/srgb.h"
#include "io/image/image_io.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
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
};

Result<Outcome> denoise_file(const DenoiseCommand& c, const ColorManagement* color) {
    const InterruptGuard guard;
    Result<LayeredImage> image = read_input(c);
    if (!image) return in_file(image.error(), c.input);
    const Result<Planes> planes = planes_of(*image);
    if (!planes) return in_file(planes.error(), c.input);
    Outcome outcome{image->width, image->height, {}, {}};
    if (!planes->albedo.empty() && !planes->normal.empty()) outcome.guides = {"albedo", "normal"};

    Denoiser denoiser(weights_dir(), c.common.threads);
    const DenoiseInput input{image->width, image->height, view_of(planes->color), view_of(planes->albedo), view_of(planes->normal)};
    Result<std::vector<Denoised>> denoised = denoise_with_progress(denoiser, {&input, 1}, c.quality, c.common.quiet, guard.interrupted());
    if (!denoised) return in_file(denoised.error(), c.input);
    outcome.denoised = std::move(denoised->front());
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
        fmt::print("{}: {}x{}, {}\n", c.output, outcome->width, outcome->height, denoised_summary(outcome->denoised));
    return exit_done;
}

} // namespace

void add_denoise_command(CLI::App& app, std::function<int()>& run) {
    const auto command = std::make_shared<DenoiseCommand>();
    CLI::App* sub = app.add_subcommand("denoise", "Denoise an image; uses the channels albedo.{R,G,B} and normal.{X,Y,Z} if it has both");
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
