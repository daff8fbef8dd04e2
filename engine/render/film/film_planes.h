// Lists all per-pixel numbers of a film by name, in one place for saving, loading and merging.
#pragma once

#include "render/film/film.h"

#include <fmt/format.h>

namespace blush {

// How to merge two states of one image.
enum class Combine {
    add,   // sums over samples
    first, // value of the pixel's first sample
};

struct FilmPlanes {
    // visit(name, combine, at): at(pixel) is a reference to the number or to the exact sum.
    template <class AnyFilm, class Visit> static void visit(AnyFilm& film, const Visit& visit) {
        for (size_t half = 0; half < 2; ++half) {
            const auto in_half = [&film, half ](size_t pixel) -> auto& { return film.half_buffers_[half][pixel]; };
            visit(
                name_of(half, "R"), Combine::add, [=](size_t pixel) -> auto& { return in_half(pixel).sum.x; });
            visit(
                name_of(half, "G"), Combine::add, [=](size_t pixel) -> auto& { return in_half(pixel).sum.y; });
            visit(
                name_of(half, "B"), Combine::add, [=](size_t pixel) -> auto& { return in_half(pixel).sum.z; });
            visit(
                name_of(half, "count"), Combine::add, [=](size_t pixel) -> auto& { return in_half(pixel).count; });
        }
        for (size_t c = 0; c < 3 && !film.features_.empty(); ++c) {
            visit(
                fmt::format("albedo.{}", "RGB"[c]), Combine::add, [&film, c ](size_t i) -> auto& { return film.features_[i].albedo[c]; });
            visit(
                fmt::format("normal.{}", "XYZ"[c]), Combine::add, [&film, c ](size_t i) -> auto& { return film.features_[i].normal[c]; });
        }
        if (!film.depth_.empty())
            visit(
                "depth", Combine::first, [&film](size_t i) -> auto& { return film.depth_[i]; });
        if (!film.object_id_.empty())
            visit(
                "object", Combine::first, [&film](size_t i) -> auto& { return film.object_id_[i]; });
        if (!film.material_.empty())
            visit(
                "material", Combine::first, [&film](size_t i) -> auto& { return film.material_[i]; });

        if (!film.covered_.empty())
            visit_places(
                film, visit, "covered", [&film](size_t place) -> auto& { return film.covered_[place]; });
        if (!film.caught_.empty()) {
            visit_places(
                film, visit, "caught.unoccluded", [&film](size_t place) -> auto& { return film.caught_[place].unoccluded; });
            visit_places(
                film, visit, "caught.arriving", [&film](size_t place) -> auto& { return film.caught_[place].arriving; });
            visit_places(
                film, visit, "caught.open", [&film](size_t place) -> auto& { return film.caught_[place].open; });
            visit_places(
                film, visit, "caught.R", [&film](size_t place) -> auto& { return film.caught_[place].radiance.x; });
            visit_places(
                film, visit, "caught.G", [&film](size_t place) -> auto& { return film.caught_[place].radiance.y; });
            visit_places(
                film, visit, "caught.B", [&film](size_t place) -> auto& { return film.caught_[place].radiance.z; });
        }
        for (size_t k = 0; k < size_t(film.bounces_.planes()); ++k)
            visit_vectors(
                film, visit, fmt::format("bounce.{}", k), [&film, k ](size_t place) -> auto& { return film.bounces_.sum(place, k); });
        for (size_t k = 0; k < size_t(film.groups_.groups()); ++k)
            for (int half = 0; half < 2; ++half)
                visit_vector(
                    visit, group_name(k, half), [&film, k, half ](size_t pixel) -> auto& { return film.groups_.sum(pixel, half, k); });
        for (size_t k = 0; k < size_t(film.strategies_.groups()); ++k)
            for (int half = 0; half < 2; ++half)
                visit_vector(
                    visit, strategy_name(k, half),
                    [&film, k, half ](size_t pixel) -> auto& { return film.strategies_.sum(pixel, half, k); });
        for (int half = 0; half < 2 && film.splats_.on(); ++half) visit_splats(film, visit, half);
        if (!film.paths_.empty())
            visit_vectors(
                film, visit, "paths", [&film](size_t place) -> auto& { return film.paths_[place]; });
        if (film.clamp_.on()) {
            visit_vectors(
                film, visit, "clamped", [&film](size_t place) -> auto& { return film.clamp_.account(place).removed; });
            visit_places(
                film, visit, "clamped.count", [&film](size_t place) -> auto& { return film.clamp_.account(place).samples; });
        }
    }

    static std::string half_name(int half) { return half == 0 ? "even" : "odd"; }
    static std::string group_name(size_t group, int half) { return name_of(size_t(half), fmt::format("group.{}", group)); }
    static std::string strategy_name(size_t strategy, int half) {
        return name_of(size_t(half), fmt::format("strategy.{}", found_by_names[strategy]));
    }
    static std::string splat_group_name(size_t group, int half) { return name_of(size_t(half), fmt::format("splats.group.{}", group)); }
    static std::string splat_name(int half) { return name_of(size_t(half), "splats"); }

private:
    static std::string name_of(size_t half, std::string_view what) { return fmt::format("{}.{}", half_name(int(half)), what); }

    template <class AnyFilm, class Visit> static void visit_splats(AnyFilm& film, const Visit& visit, int half) {
        visit_vector(
            visit, splat_name(half), [&film, half ](size_t pixel) -> auto& { return film.splats_.sum(pixel, half); });
        for (size_t k = 0; k < size_t(film.splats_.bounces()); ++k)
            visit_vector(
                visit, name_of(size_t(half), fmt::format("splats.bounce.{}", k)),
                [&film, k, half ](size_t pixel) -> auto& { return film.splats_.bounce_sum(pixel, half, k); });
        for (size_t k = 0; k < size_t(film.splats_.groups()); ++k)
            visit_vector(
                visit, splat_group_name(k, half),
                [&film, k, half ](size_t pixel) -> auto& { return film.splats_.group_sum(pixel, half, k); });
    }

    // One number per pixel or, if halves have separate weights, one per half.
    template <class AnyFilm, class Visit, class At>
    static void visit_places(AnyFilm& film, const Visit& visit, const std::string& name, const At& at) {
        if (!film.adaptive_) return visit(name, Combine::add, at);
        for (size_t half = 0; half < 2; ++half)
            visit(
                name_of(half, name), Combine::add, [=](size_t pixel) -> auto& { return at(2 * pixel + half); });
    }
    template <class AnyFilm, class Visit, class At>
    static void visit_vectors(AnyFilm& film, const Visit& visit, const std::string& name, const At& at) {
        visit_places(
            film, visit, name + ".R", [=](size_t place) -> auto& { return at(place).x; });
        visit_places(
            film, visit, name + ".G", [=](size_t place) -> auto& { return at(place).y; });
        visit_places(
            film, visit, name + ".B", [=](size_t place) -> auto& { return at(place).z; });
    }
    template <class Visit, class At> static void visit_vector(const Visit& visit, const std::string& name, const At& at) {
        visit(
            name + ".R", Combine::add, [=](size_t pixel) -> auto& { return at(pixel).x; });
        visit(
            name + ".G", Combine::add, [=](size_t pixel) -> auto& { return at(pixel).y; });
        visit(
            name + ".B", Combine::add, [=](size_t pixel) -> auto& { return at(pixel).z; });
    }
};

} // namespace blush
