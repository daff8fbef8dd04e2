// Denoised images of a session, with a fake for the networks. Tests rely on the order of announcements.
#include "render/session/render_session.h"

#include "tests/render/session/recording_session.h"
#include "tests/support/eventually.h"
#include "tests/support/images.h"
#include "tests/support/sample_project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <new>
#include <thread>

namespace blush::TEST_FILE {
namespace {

using State = SessionStatus::State;
using test::checksum;
using test::Event;
using test::eventually;
using test::fresh_image;
using test::RecordingSession;
using test::same_pixels;

// Returns each image unchanged, and records its calls.
class StandIn {
public:
    struct Call {
        DenoiseQuality quality;
        std::optional<float> scale;
        float tolerance;
        bool guided;
    };
    // Replaces the answer if set; called on the denoiser's thread with the number of the call, from 1.
    std::function<Result<std::optional<Denoised>>(size_t call, const std::function<bool()>& wanted)> instead;

    DenoiseFunction function() {
        return [this](const DenoiseInput& input, const DenoiseOptions& options, const std::function<bool()>& wanted) {
            return answer(input, options, wanted);
        };
    }
    std::vector<Call> calls() const {
        const std::lock_guard lock(mutex_);
        return calls_;
    }

private:
    Result<std::optional<Denoised>> answer(const DenoiseInput& input, const DenoiseOptions& options, const std::function<bool()>& wanted) {
        size_t number = 0;
        {
            const std::lock_guard lock(mutex_);
            calls_.push_back({options.quality, options.exposure_scale, options.exposure_tolerance,
                              !input.albedo.values.empty() && !input.normal.values.empty()});
            number = calls_.size();
        }
        if (instead) {
            Result<std::optional<Denoised>> answered = instead(number, wanted);
            if (answered && *answered) (*answered)->rgb.resize(3 * size_t(input.width) * size_t(input.height));
            return answered;
        }
        Denoised denoised;
        for (size_t i = 0; i < size_t(input.width) * size_t(input.height); ++i)
            for (size_t k = 0; k < 3; ++k) denoised.rgb.push_back(input.color.values[i * size_t(input.color.stride) + k]);
        // The measured scale is never within the tolerance.
        denoised.exposure_scale =
            options.exposure_scale && std::isinf(options.exposure_tolerance) ? *options.exposure_scale : float(number);
        return std::optional(std::move(denoised));
    }

    mutable std::mutex mutex_;
    std::vector<Call> calls_;
};

Result<std::optional<Denoised>> wait_until_cancelled(const std::function<bool()>& wanted) {
    EXPECT_TRUE(eventually([&] { return !wanted(); })) << "denoising is not cancelled";
    return std::optional<Denoised>();
}

Project small_project(int64_t spp = 8, int width = 32, int height = 24) {
    Project project = test::sample_project().project;
    project.render.width = width;
    project.render.height = height;
    project.render.spp = spp;
    return project;
}

// The same scene under different light.
Project lit_by(Project project, float intensity) {
    const auto [id, light] = project.scene.lights.entries()[0];
    Light brighter = light;
    brighter.intensity = intensity;
    project.scene.lights.set(id, brighter);
    return project;
}

void submit(RenderSession& session, uint64_t revision, const Project& project) { session.submit(revision, project.scene, project.render); }
void submit(RecordingSession& session, uint64_t revision, const Project& project) {
    session->submit(revision, project.scene, project.render);
}

// The last denoised image of a revision.
test::EventTest ends(uint64_t revision) {
    return [=](const Event& e) { return e.denoised && e.denoised->revision == revision && e.denoised->quality == DenoiseQuality::high; };
}

bool shows(const DenoisedImage& denoised, const Frame& frame) {
    if (denoised.denoised.rgb.size() != frame.rgba.size() / 4 * 3) return false;
    for (size_t i = 0; i < frame.rgba.size() / 4; ++i)
        if (!std::equal(&frame.rgba[4 * i], &frame.rgba[4 * i] + 3, &denoised.denoised.rgb[3 * i])) return false;
    return true;
}

TEST(DenoisedSession, NothingIsDenoisedBeforeItIsWanted) {
    StandIn networks;
    RecordingSession session(2, {}, networks.function());
    submit(session, 1, small_project());
    session.wait_for(1, State::complete);
    session.shut_down();
    EXPECT_TRUE(networks.calls().empty());
    for (const Event& e : session.events()) EXPECT_EQ(e.denoised, nullptr);
}

TEST(DenoisedSession, TheFirstIsFastAndTheLastIsTheBestOfTheLastFrame) {
    const Project project = small_project(16);
    StandIn networks;
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    submit(session, 1, project);
    const Event last = session.wait_for(ends(1));
    session.shut_down();
    ASSERT_TRUE(last.denoised);
    EXPECT_EQ(last.denoised->samples, 16);
    EXPECT_TRUE(shows(*last.denoised, *last.frame));
    EXPECT_TRUE(same_pixels(*last.frame, fresh_image(project.scene, project.render, 16))) << "frames are unchanged";
    const auto calls = networks.calls();
    EXPECT_EQ(calls.front().quality, DenoiseQuality::fast);
    EXPECT_EQ(calls.back().quality, DenoiseQuality::high);
    for (const auto& call : calls) EXPECT_TRUE(call.guided);
    int64_t samples = 0;
    for (const Event& e : session.events()) {
        if (!e.denoised) continue;
        EXPECT_GE(e.denoised->samples, samples) << "sample counts never decrease";
        EXPECT_LE(e.denoised->samples, e.frame->samples);
        samples = e.denoised->samples;
    }
}

TEST(DenoisedSession, EnabledWhenCompleteItAddsAnImageAndResetsNothing) {
    StandIn networks;
    RecordingSession session(2, {}, networks.function());
    submit(session, 1, small_project());
    const Event before = session.wait_for(1, State::complete);
    session->want_denoised(true);
    // Both runs may end before the frame is resolved again with half differences, by which the bias is then corrected.
    const Event after = session.wait_for([](const Event& e) { return ends(1)(e) && e.denoised->denoised.bias_corrected; });
    EXPECT_TRUE(before.frame->half_difference.empty()) << "nothing that only the denoiser needs";
    EXPECT_EQ(after.frame->half_difference.size(), after.frame->rgba.size() / 4) << "resolved again for it";
    EXPECT_EQ(after.frame->rgba, before.frame->rgba);
    EXPECT_EQ(after.status.state, State::complete);
    const size_t calls = networks.calls().size();
    EXPECT_EQ(calls, 2u) << "the fast quality first, then the best";

    for (int i = 0; i < 50; ++i) session->want_denoised(i % 2 == 0);
    EXPECT_EQ(session->images().denoised, after.denoised) << "it is kept for toggling on again";
    session->want_denoised(true);
    // Any work for it would have been done before the next image.
    submit(session, 2, lit_by(small_project(), 3));
    session.wait_for(ends(2));
    session.shut_down();
    EXPECT_EQ(session.events().back().denoised->revision, 2u);
    for (const Event& e : session.events())
        if (e.denoised && e.denoised->revision == 1) {
            EXPECT_TRUE(e.denoised == after.denoised || e.denoised->quality == DenoiseQuality::fast ||
                        !e.denoised->denoised.bias_corrected);
        }
}

TEST(DenoisedSession, DenoisedImagesBelongToTheImageOfTheirFrame) {
    const Project project = small_project(6);
    constexpr uint64_t last = 12;
    StandIn networks;
    RecordingSession session(
        2,
        [&, next = uint64_t(2)](RenderSession& s, const Event& e) mutable {
            if (next > last || !e.denoised || e.denoised->revision + 1 != next) return;
            submit(s, next, lit_by(project, float(next)));
            ++next;
        },
        networks.function());
    session->want_denoised(true);
    submit(session, 1, project);
    session.wait_for(ends(last));
    session.shut_down();
    for (const Event& e : session.events())
        if (e.denoised) { EXPECT_EQ(e.denoised->revision, e.frame->revision); }
}

TEST(DenoisedSession, DraggingDoesNotFlickerBetweenNoisyAndDenoised) {
    // Coarse frames that are denoised within a frame are published with their denoised version, or the window would flicker.
    const Project project = small_project(2, 256, 256);
    StandIn networks;
    networks.instead = [](size_t, const std::function<bool()>&) {
        return Result<std::optional<Denoised>>(std::optional<Denoised>(Denoised{}));
    };
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    // At first its speed is unknown; on a busy machine the first prediction may be wrong.
    constexpr uint64_t learnt = 3, last = 8;
    for (uint64_t revision = 1; revision <= last; ++revision) {
        submit(session, revision, lit_by(project, float(revision)));
        session.wait_for(ends(revision));
    }
    session.shut_down();
    std::map<uint64_t, Event> first;
    for (const Event& e : session.events())
        if (e.frame) first.try_emplace(e.frame->revision, e);
    EXPECT_EQ(first[1].denoised, nullptr);
    for (uint64_t revision = learnt + 1; revision <= last; ++revision) {
        ASSERT_TRUE(first[revision].denoised) << revision;
        EXPECT_EQ(first[revision].denoised->revision, revision);
        EXPECT_EQ(first[revision].denoised->divider, first[revision].frame->divider);
    }
}

TEST(DenoisedSession, AnEditCancelsDenoising) {
    StandIn networks;
    std::atomic<bool> begun{false};
    networks.instead = [&](size_t call, const std::function<bool()>& wanted) {
        // The first run would never end by itself; the next ones finish at once.
        if (call > 1) return Result<std::optional<Denoised>>(std::optional<Denoised>(Denoised{}));
        begun = true;
        return wait_until_cancelled(wanted);
    };
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    submit(session, 1, small_project());
    EXPECT_TRUE(eventually([&] { return begun.load(); })) << "denoising does not begin";
    submit(session, 2, lit_by(small_project(), 3));
    session.wait_for(ends(2));
    session.shut_down();
    for (const Event& e : session.events())
        if (e.denoised) { EXPECT_EQ(e.denoised->revision, 2u); }
}

TEST(DenoisedSession, RenderingPausesForTheFirstDenoisedImage) {
    StandIn networks;
    std::atomic<bool> begun{false}, may_end{false};
    networks.instead = [&](size_t call, const std::function<bool()>&) {
        begun = true;
        if (call == 1) {
            EXPECT_TRUE(eventually([&] { return may_end.load(); }));
        }
        return Result<std::optional<Denoised>>(std::optional<Denoised>(Denoised{}));
    };
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    submit(session, 1, small_project(1'000'000));
    EXPECT_TRUE(eventually([&] { return begun.load(); })) << "denoising does not begin";
    // A batch that has begun is finished.
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    const int64_t samples = session->images().frame->samples;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(session->images().frame->samples, samples);
    may_end = true;
    EXPECT_TRUE(eventually([&] { return session->images().frame->samples > samples; })) << "rendering does not resume";
}

TEST(DenoisedSession, ToggledOffItStopsInTheMiddle) {
    StandIn networks;
    std::atomic<bool> begun{false};
    networks.instead = [&](size_t, const std::function<bool()>& wanted) {
        begun = true;
        return wait_until_cancelled(wanted);
    };
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    submit(session, 1, small_project());
    EXPECT_TRUE(eventually([&] { return begun.load(); })) << "denoising does not begin";
    session->want_denoised(false);
    EXPECT_EQ(session.wait_for(1, State::complete).denoised, nullptr);
}

TEST(DenoisedSession, EndsInTheMiddleOfDenoising) {
    for (int i = 0; i < 20; ++i) {
        StandIn networks;
        std::atomic<int> ended{0};
        networks.instead = [&](size_t, const std::function<bool()>& wanted) {
            auto nothing = wait_until_cancelled(wanted);
            ++ended;
            return nothing;
        };
        RecordingSession session(2, {}, networks.function());
        session->want_denoised(true);
        submit(session, 1, small_project());
        if (i % 2) {
            EXPECT_TRUE(eventually([&] { return !networks.calls().empty(); })) << "denoising does not begin";
        }
        session.shut_down();
        EXPECT_EQ(size_t(ended), networks.calls().size()) << "the denoiser still runs";
        for (const Event& e : session.events()) EXPECT_EQ(e.denoised, nullptr) << "published although it was cancelled";
    }
}

TEST(DenoisedSession, RendersIfDenoisingFails) {
    const Project project = small_project();
    for (const bool throws : {false, true}) {
        StandIn networks;
        networks.instead = [&](size_t, const std::function<bool()>&) -> Result<std::optional<Denoised>> {
            if (throws) throw std::bad_alloc();
            return Error{"rt_hdr.tza", "damaged", ""};
        };
        RecordingSession session(2, {}, networks.function());
        session->want_denoised(true);
        submit(session, 1, project);
        const Event failed = session.wait_for([](const Event& e) { return !e.status.denoiser_failure.empty(); });
        EXPECT_EQ(failed.status.denoiser_failure, throws ? "not enough memory to denoise" : "rt_hdr.tza: damaged");
        submit(session, 2, lit_by(project, 3));
        const Event done = session.wait_for(2, State::complete);
        EXPECT_TRUE(done.status.message.empty());
        EXPECT_FALSE(done.status.denoiser_failure.empty()) << "still so";
        EXPECT_TRUE(same_pixels(*done.frame, fresh_image(lit_by(project, 3).scene, project.render, 8)));
        session.shut_down();
        EXPECT_EQ(networks.calls().size(), 1u) << "not tried again";
    }
}

TEST(DenoisedSession, TheExposureScaleIsConstantWhileAnImageRefines) {
    const Project project = small_project(64);
    StandIn networks;
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    for (uint64_t revision = 1; revision <= 3; ++revision) {
        submit(session, revision, lit_by(project, float(revision)));
        session.wait_for(ends(revision));
    }
    session.shut_down();
    std::map<uint64_t, std::vector<float>> scales;
    for (const Event& e : session.events())
        if (e.denoised) scales[e.denoised->revision].push_back(e.denoised->denoised.exposure_scale);
    ASSERT_EQ(scales.size(), 3u);
    for (const auto& [revision, of_image] : scales)
        for (const float scale : of_image) EXPECT_EQ(scale, of_image[0]) << "image " << revision;
    // The first run of an image starts from the scale of the previous image, within a tolerance.
    const auto calls = networks.calls();
    EXPECT_FALSE(calls[0].scale);
    for (size_t i = 1; i < calls.size(); ++i) EXPECT_TRUE(calls[i].scale);
    EXPECT_EQ(std::count_if(calls.begin(), calls.end(), [](const auto& c) { return std::isfinite(c.tolerance); }), 3) << "one per image";
}

// Weights and working memory are freed after the toggle stays off; the existing denoised image stays.
TEST(DenoisedSession, DenoiserMemoryIsFreedWhenDisabled) {
    constexpr std::array<bool, denoise_qualities> none{};
    StandIn networks;
    std::mutex guard;
    std::vector<std::weak_ptr<int>> made; // created by the maker, while alive
    SessionOptions options;
    options.threads = 2;
    options.denoiser_grace = 0;
    options.denoiser = [&] {
        const auto weights = std::make_shared<int>();
        const std::lock_guard lock(guard);
        made.push_back(weights);
        return [weights, denoise = networks.function()](const auto&... arguments) { return denoise(arguments...); };
    };
    {
        RecordingSession session(options);
        session->want_denoised(true);
        submit(session, 1, small_project());
        EXPECT_NE(session.wait_for(ends(1)).status.denoised_with, none);
        session->want_denoised(false);
        session.wait_for([&](const Event& e) { return ends(1)(e) && e.status.denoised_with == none; });
        {
            const std::lock_guard lock(guard);
            ASSERT_EQ(made.size(), 1u);
            EXPECT_TRUE(made[0].expired());
        }
        session->want_denoised(true);
        submit(session, 2, lit_by(small_project(), 3));
        session.wait_for(ends(2));
        EXPECT_EQ(made.size(), 2u) << "made again";
    }
    made.clear();
    options.denoiser_grace = 1e6;
    RecordingSession session(options);
    for (uint64_t revision = 1; revision <= 3; ++revision) {
        session->want_denoised(true);
        submit(session, revision, lit_by(small_project(), float(revision)));
        session.wait_for(ends(revision));
        session->want_denoised(false);
    }
    EXPECT_EQ(made.size(), 1u) << "toggling off and on keeps the denoiser";
}

TEST(DenoisedSession, PublishedImagesNeverChange) {
    const Project project = small_project(12);
    const auto sum = [](const DenoisedImage& p) {
        double total = 0;
        for (const float v : p.denoised.rgb) total += double(v);
        return total;
    };
    std::map<DenoisedPtr, double> held;
    std::map<FramePtr, uint64_t> sources;
    StandIn networks;
    {
        RecordingSession session(
            2,
            [&](RenderSession&, const Event& e) {
                if (e.denoised) held.try_emplace(e.denoised, sum(*e.denoised));
                if (e.frame && e.denoised) sources.try_emplace(e.frame, checksum(*e.frame));
            },
            networks.function());
        session->want_denoised(true);
        for (uint64_t revision = 1; revision <= 5; ++revision) {
            submit(session, revision, lit_by(project, float(revision)));
            session.wait_for(ends(revision));
        }
    }
    EXPECT_GE(held.size(), 5u);
    for (const auto& [image, before] : held) EXPECT_EQ(sum(*image), before);
    for (const auto& [frame, before] : sources) EXPECT_EQ(checksum(*frame), before);
}

TEST(DenoisedSession, ManyThreadsMayToggleSubmitAndRead) {
    const Project project = small_project(2, 16, 12);
    StandIn networks;
    RecordingSession session(2, {}, networks.function());
    std::vector<std::thread> callers;
    for (uint64_t t = 0; t < 3; ++t)
        callers.emplace_back([&, t] {
            for (uint64_t i = 0; i < 150; ++i) {
                session->want_denoised(i % 5 != 0);
                submit(session, 1 + 150 * t + i, lit_by(project, float(1 + i)));
                session->pause(i % 7 == 0);
                const Images images = session->images();
                if (images.denoised) { EXPECT_LE(images.denoised->samples, images.frame->samples); }
            }
        });
    for (std::thread& caller : callers) caller.join();
    session->pause(false);
    session->want_denoised(true);
    submit(session, 1000, lit_by(project, 77));
    const Event done = session.wait_for(ends(1000));
    ASSERT_TRUE(done.frame);
    EXPECT_TRUE(shows(*done.denoised, *done.frame));
}

TEST(DenoisedSession, AWithheldFrameIsShownWhenDenoisingIsDisabled) {
    const Project project = small_project(2, 256, 256);
    StandIn networks;
    std::atomic<bool> slow{false}, begun{false};
    networks.instead = [&](size_t, const std::function<bool()>& wanted) {
        if (!slow) return Result<std::optional<Denoised>>(std::optional<Denoised>(Denoised{}));
        begun = true;
        return wait_until_cancelled(wanted);
    };
    RecordingSession session(2, {}, networks.function());
    session->want_denoised(true);
    submit(session, 1, project);
    session.wait_for(ends(1));
    slow = true;
    session->pause(true); // so that no later frame replaces it
    submit(session, 2, lit_by(project, 3));
    EXPECT_TRUE(eventually([&] { return begun.load(); })) << "denoising does not begin";
    session->want_denoised(false);
    EXPECT_EQ(session->images().frame->revision, 2u);
}

} // namespace
} // namespace blush::TEST_FILE
