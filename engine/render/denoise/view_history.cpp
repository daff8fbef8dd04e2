#include "render/denoise/view_history.h"

#include "core/math.h"
#include "core/parallel.h"
#include "scene/affine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace blush {
namespace {

constexpr float least_albedo = 0.05f, added_albedo = 0.02f; // below: not divided by; against small components
constexpr float largest_distance = 0.01f;                   // of a point of the history from the surface, over the distance of the camera
constexpr float least_cosine = 0.8f;                        // between normals; those of film planes are shorter than 1 at edges
constexpr float least_share = 0.05f;                        // of the taps that show the surface
constexpr int cell = 4;                                     // pixels; means are compared over three by three cells
// Relative differences of means at which history counts fully, and not at all; of a coarse image, and of one of full size.
constexpr float alike = 0.2f, other = 0.6f, alike_in_full = 0.05f, other_in_full = 0.2f;
constexpr int block = 2, steps = 6;        // pixels with one search, and its steps
constexpr float searched_distance = 0.05f; // of a point from the one found, over the distance of the camera
constexpr float small_residual = 0.1f;     // pixels, at which the search ends
constexpr float largest_residual = 0.75f;  // pixels, after the search
constexpr float depth_slack = 1.05f;       // of depths in coarse images

// By which radiance is divided: the albedo, or 1 where there is hardly any, as on lamps: with their radiance over albedo, pixels beside
// them would be fireflies. The albedo of a miss is the radiance of the background.
bool is_reflective(const FirstHitPlanes& planes, size_t pixel) {
    return planes.depth[pixel] > 0 && luminance(planes.albedo[pixel]) >= least_albedo;
}
Vec3 divisor_of(const FirstHitPlanes& planes, size_t pixel) {
    return is_reflective(planes, pixel) ? planes.albedo[pixel] + Vec3{added_albedo, added_albedo, added_albedo} : Vec3{1, 1, 1};
}

Vec3 at(std::span<const float> rgb, size_t pixel) { return {rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]}; }
// Of places within an image, from -1 on; std::floor() is a function call without SSE4.1, which not all processors have.
float floor_of(float place) { return float(int(place + 1) - 1); }
Vec3 times(const Vec3& a, const Vec3& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

// Surfaces of a row of pixels; one array for each number, so that loops over pixels have no strides. First, p is the pixel and the depth of
// its hit, <= 0 for none. Then p is the position from the history's camera, or the direction of a miss; then p_x, p_y are the place.
// n: normals. The others: where pixels around the place lie along the normal (Reprojection::sum_at()).
enum Number {
    n_x,
    n_y,
    n_z,
    p_x,
    p_y,
    p_z,
    depth,
    seen,
    distance_of_plane,
    tolerated,
    lateral_of_normal,
    normal_per_x,
    normal_per_y,
    normal_forward,
    forward_per_depth,
    numbers
};
struct Surfaces {
    explicit Surfaces(int width) : stride(size_t(width)), values(stride * numbers) {}
    float* operator[](int number) { return values.data() + stride * size_t(number); }
    const float* operator[](int number) const { return values.data() + stride * size_t(number); }

    size_t stride;
    std::vector<float> values;
};

// Between positions relative to a camera, in its own space, and pixel places: 0 is the centre of the first pixel.
class Projection {
public:
    Projection(const WorldCamera& camera, int width, int height)
        : c_(camera), half_width_(0.5f * float(width)), half_height_(0.5f * float(height)),
          right_(camera.right / dot(camera.right, camera.right)), up_(camera.up / dot(camera.up, camera.up)) {}

    struct Place {
        float x = 0, y = 0;
        float z = 0; // along the camera's axis; <= 0: behind it
    };
    Place place_of(const Vec3& p) const {
        const float z = dot(p, c_.forward), scale = c_.orthographic ? 1 : 1 / z;
        return {(dot(p, right_) * scale + 1) * half_width_ - 0.5f, (1 - dot(p, up_) * scale) * half_height_ - 0.5f, z};
    }
    // Of a miss, the direction; not with an orthographic camera, which sees all of them in one direction.
    Vec3 position_at(float x, float y, float depth) const {
        const Vec3 lateral = c_.right * ((x + 0.5f) / half_width_ - 1) + c_.up * (1 - (y + 0.5f) / half_height_);
        if (c_.orthographic) return lateral + c_.forward * depth;
        return depth > 0 ? normalize(c_.forward + lateral) * depth : c_.forward + lateral;
    }
    bool contains(const Place& p) const {
        return p.z > 0 && p.x > -0.5f && p.y > -0.5f && p.x < 2 * half_width_ - 0.5f && p.y < 2 * half_height_ - 0.5f;
    }
    // Turns pixels and depths into positions from a camera that is `offset` away.
    void to_positions(Surfaces& row, const Vec3& offset) const {
        float *x = row[p_x], *y = row[p_y], *z = row[p_z], *depths = row[depth];
        const Vec3 f = c_.forward, r = c_.right, u = c_.up;
        const float x_scale = 1 / half_width_, y_scale = 1 / half_height_;
        const bool orthographic = c_.orthographic;
#pragma omp simd
        for (size_t i = 0; i < row.stride; ++i) {
            const float sx = (x[i] + 0.5f) * x_scale - 1, sy = 1 - (y[i] + 0.5f) * y_scale, d = z[i], hit = d > 0 ? 1.f : 0.f;
            const float lx = r.x * sx + u.x * sy, ly = r.y * sx + u.y * sy, lz = r.z * sx + u.z * sy;
            const float vx = f.x + lx, vy = f.y + ly, vz = f.z + lz;
            const float per = d > 0 ? d / std::sqrt(vx * vx + vy * vy + vz * vz) : 1.f;
            x[i] = hit * offset.x + (orthographic ? lx + f.x * d : vx * per);
            y[i] = hit * offset.y + (orthographic ? ly + f.y * d : vy * per);
            z[i] = hit * offset.z + (orthographic ? lz + f.z * d : vz * per);
            depths[i] = d;
        }
    }

    // Turns positions into places, and says where pixels around them lie along the normals. `finds_misses`: a direction has one place.
    void to_places(Surfaces& row, bool finds_misses) const {
        float *x = row[p_x], *y = row[p_y];
        const float *z = row[p_z], *nx = row[n_x], *ny = row[n_y], *nz = row[n_z], *depths = row[depth];
        float *is_seen = row[seen], *planes = row[distance_of_plane], *tolerances = row[tolerated], *laterals = row[lateral_of_normal];
        float *per_x = row[normal_per_x], *per_y = row[normal_per_y], *forward = row[normal_forward], *per_depth = row[forward_per_depth];
        const Vec3 f = c_.forward, r = right_, u = up_, dx = c_.right / half_width_, dy = c_.up / -half_height_;
        const bool orthographic = c_.orthographic;
        const float half_width = half_width_, half_height = half_height_;
#pragma omp simd
        for (size_t i = 0; i < row.stride; ++i) {
            const float px = x[i], py = y[i], pz = z[i], axis = px * f.x + py * f.y + pz * f.z;
            const float inverse = 1 / axis, scale = orthographic ? 1.f : inverse, distance = std::sqrt(px * px + py * py + pz * pz);
            const float plane = nx[i] * px + ny[i] * py + nz[i] * pz, along = nx[i] * f.x + ny[i] * f.y + nz[i] * f.z;
            planes[i] = plane;
            tolerances[i] = largest_distance * distance;
            per_x[i] = nx[i] * dx.x + ny[i] * dx.y + nz[i] * dx.z;
            per_y[i] = nx[i] * dy.x + ny[i] * dy.y + nz[i] * dy.z;
            forward[i] = along;
            laterals[i] = orthographic ? plane - along * axis : plane * inverse - along;
            per_depth[i] = axis / distance;
            const float at_x = ((px * r.x + py * r.y + pz * r.z) * scale + 1) * half_width - 0.5f;
            const float at_y = (1 - (px * u.x + py * u.y + pz * u.z) * scale) * half_height - 0.5f;
            const bool inside = axis > 0 && at_x > -0.5f && at_y > -0.5f && at_x < 2 * half_width - 0.5f && at_y < 2 * half_height - 0.5f;
            is_seen[i] = inside && (depths[i] > 0 || finds_misses) ? 1.f : 0.f;
            x[i] = at_x;
            y[i] = at_y;
        }
    }

private:
    WorldCamera c_;
    float half_width_, half_height_;
    Vec3 right_, up_;
};

// What was found for a pixel; a share of 0: nothing.
struct Found {
    Vec3 radiance;
    float share;
};

// Where the history shows a surface.
struct Surface {
    bool seen = false;
    float x = 0, y = 0; // place in the history
    float depth = 0;    // there
};

class Reprojection {
public:
    Reprojection(std::span<const float> rgb, bool is_coarse, const FirstHitPlanes& now, const ViewHistory& history)
        : rgb_(rgb), now_(now), history_(history), is_coarse_(is_coarse), is_full_(now.width == history.width),
          width_(is_full_ ? history.width : (history.width + 1) / 2), height_(is_full_ ? history.height : (history.height + 1) / 2),
          scale_x_(float(history.width) / float(width_)), scale_y_(float(history.height) / float(height_)),
          here_(now.camera, width_, height_), there_(history.camera, history.width, history.height),
          offset_(to_float(now.camera.position - history.camera.position)), found_(size_t(width_) * size_t(height_)),
          across_((width_ + cell - 1) / cell), down_((height_ + cell - 1) / cell), sums_(size_t(across_) * size_t(down_)),
          trust_(sums_.size()) {}

    int width() const { return width_; }
    int height() const { return height_; }
    int rows_of_cells() const { return down_; }

    // All rows of a row of cells.
    void find(int row_of_cells) {
        const int end = std::min(height_, (row_of_cells + 1) * cell);
        if (is_full_)
            for (int y = row_of_cells * cell; y < end; ++y) find_row(y);
        else
            for (int y = row_of_cells * cell; y < end; y += block) search_rows(y, std::min(block, end - y));
        for (int y = row_of_cells * cell; y < end; ++y)
            for (int x = 0; x < width_; ++x) {
                const Found& found = found_[size_t(y) * size_t(width_) + size_t(x)];
                auto& sums = sums_[size_t(row_of_cells) * size_t(across_) + size_t(x / cell)];
                sums[0] += found.share * luminance(now_at(x, y));
                sums[1] += found.share * luminance(found.radiance);
            }
    }

    // After find() of all rows.
    void judge() {
        for (int cy = 0; cy < down_; ++cy)
            for (int cx = 0; cx < across_; ++cx) trust_[size_t(cy) * size_t(across_) + size_t(cx)] = trust_around(cx, cy);
    }

    // After judge(). Returns the sum of the shares of history.
    double mix(int row_of_cells, WithHistory& out) const {
        double shares = 0;
        for (int y = row_of_cells * cell; y < std::min(height_, (row_of_cells + 1) * cell); ++y)
            for (int x = 0; x < width_; ++x) {
                const size_t pixel = size_t(y) * size_t(width_) + size_t(x);
                const Found found = is_full_ ? found_[pixel] : smoothed(x, y);
                const float share = found.share > 0 ? found.share * trust(x, y) : 0;
                const Vec3 c = now_at(x, y) * (1 - share) + found.radiance * share;
                out.rgb[3 * pixel] = c.x;
                out.rgb[3 * pixel + 1] = c.y;
                out.rgb[3 * pixel + 2] = c.z;
                shares += double(share);
            }
        return shares;
    }

private:
    // The current image, interpolated if it is coarse.
    Vec3 now_at(int x, int y) const {
        if (is_full_) return at(rgb_, size_t(y) * size_t(width_) + size_t(x));
        const float fx = (float(x) + 0.5f) * float(now_.width) / float(width_) - 0.5f;
        const float fy = (float(y) + 0.5f) * float(now_.height) / float(height_) - 0.5f;
        const float left = floor_of(fx), top = floor_of(fy);
        const auto pixel = [&](int dx, int dy) {
            const int px = std::clamp(int(left) + dx, 0, now_.width - 1), py = std::clamp(int(top) + dy, 0, now_.height - 1);
            return at(rgb_, size_t(py) * size_t(now_.width) + size_t(px));
        };
        const float u = fx - left, v = fy - top;
        return (pixel(0, 0) * (1 - u) + pixel(1, 0) * u) * (1 - v) + (pixel(0, 1) * (1 - u) + pixel(1, 1) * u) * v;
    }

    // Pixels of a row whose first hits are known.
    void find_row(int y) {
        const size_t begin = size_t(y) * size_t(width_);
        Surfaces row(width_);
        for (int x = 0; x < width_; ++x) {
            const Vec3& n = now_.normal[begin + size_t(x)];
            row[n_x][x] = n.x;
            row[n_y][x] = n.y;
            row[n_z][x] = n.z;
            row[p_x][x] = float(x);
            row[p_y][x] = float(y);
            row[p_z][x] = now_.depth[begin + size_t(x)];
        }
        here_.to_positions(row, offset_);
        there_.to_places(row, !now_.camera.orthographic && !history_.camera.orthographic);
        for (int x = 0; x < width_; ++x) {
            Found& found = found_[begin + size_t(x)];
            found = sum_at(row, x, is_reflective(now_, begin + size_t(x)));
            found.radiance = times(found.radiance, divisor_of(now_, begin + size_t(x)));
        }
    }

    // Rows of a coarse image: one search for each block, from its middle.
    void search_rows(int y, int rows) {
        const float middle_y = float(y) + 0.5f * float(rows - 1);
        for (int x = 0; x < width_; x += block) {
            const int columns = std::min(block, width_ - x);
            const float middle_x = float(x) + 0.5f * float(columns - 1);
            const Surface surface = search(middle_x, middle_y);
            for (int j = y; j < y + rows; ++j)
                for (int i = x; i < x + columns; ++i)
                    found_[size_t(j) * size_t(width_) + size_t(i)] =
                        surface.seen ? sum_around(surface, float(i) - middle_x, float(j) - middle_y) : Found{};
        }
    }

    // Begins at the depth of the coarse pixel, and goes on from the depth that the history has there, until that surface is seen here.
    Surface search(float x, float y) const {
        const float scale_x = float(now_.width) / float(width_), scale_y = float(now_.height) / float(height_);
        const int cx = std::clamp(int((x + 0.5f) * scale_x), 0, now_.width - 1),
                  cy = std::clamp(int((y + 0.5f) * scale_y), 0, now_.height - 1);
        const float depth = now_.depth[size_t(cy) * size_t(now_.width) + size_t(cx)];
        if (depth <= 0 && now_.camera.orthographic) return {};
        const Vec3 begin = here_.position_at(x, y, depth);
        Projection::Place place = there_.place_of(depth > 0 ? begin + offset_ : begin), back;
        Surface s;
        float distance = 0;
        for (int step = 0; step < steps; ++step) {
            if (!there_.contains(place)) return {};
            s.depth = nearest(place).depth;
            const bool miss = s.depth <= 0;
            if (miss && (now_.camera.orthographic || history_.camera.orthographic)) return {};
            const Vec3 p = there_.position_at(place.x, place.y, s.depth), from_here = miss ? p : p - offset_;
            back = here_.place_of(from_here);
            distance = miss ? 0 : now_.camera.orthographic ? back.z : length(from_here);
            s.x = place.x;
            s.y = place.y;
            place.x += (x - back.x) * scale_x_;
            place.y += (y - back.y) * scale_y_;
            if (std::abs(back.x - x) + std::abs(back.y - y) < small_residual) break;
        }
        const bool ends = back.z > 0 && std::abs(back.x - x) < largest_residual && std::abs(back.y - y) < largest_residual;
        s.seen = ends && may_be_seen(cx, cy, distance);
        return s;
    }

    // True if a surface at this distance, 0 for none, is not hidden by those around a coarse pixel, nor in front of them.
    bool may_be_seen(int cx, int cy, float distance) const {
        float nearest = INFINITY, farthest = 0;
        bool misses = false;
        for (int y = std::max(0, cy - 1); y <= std::min(now_.height - 1, cy + 1); ++y)
            for (int x = std::max(0, cx - 1); x <= std::min(now_.width - 1, cx + 1); ++x) {
                const float depth = now_.depth[size_t(y) * size_t(now_.width) + size_t(x)];
                misses |= depth <= 0;
                if (depth <= 0) continue;
                nearest = std::min(nearest, depth);
                farthest = std::max(farthest, depth);
            }
        if (distance <= 0) return misses;
        return distance * depth_slack >= nearest && distance <= farthest * depth_slack;
    }

    const ViewHistory::Pixel& nearest(const Projection::Place& place) const {
        const int x = std::clamp(int(place.x + 0.5f), 0, history_.width - 1), y = std::clamp(int(place.y + 0.5f), 0, history_.height - 1);
        return history_.pixels[size_t(y) * size_t(history_.width) + size_t(x)];
    }

    // Calls add(pixel, x, y, weight) for the four pixels around a place.
    template <class Add> void for_each_tap(float x, float y, const Add& add) const {
        const float fx = floor_of(x), fy = floor_of(y), u = x - fx, v = y - fy;
        const int left = std::max(0, int(fx)), right = std::min(history_.width - 1, int(fx) + 1);
        const int top = std::max(0, int(fy)), bottom = std::min(history_.height - 1, int(fy) + 1);
        const size_t above = size_t(top) * size_t(history_.width), below = size_t(bottom) * size_t(history_.width);
        add(above + size_t(left), fx, fy, (1 - u) * (1 - v));
        add(above + size_t(right), fx + 1, fy, u * (1 - v));
        add(below + size_t(left), fx, fy + 1, (1 - u) * v);
        add(below + size_t(right), fx + 1, fy + 1, u * v);
    }

    static Found mean(const Found& sum) {
        if (sum.share < least_share) return {};
        const float scale = 1 / sum.share;
        return {sum.radiance * scale, std::min(sum.share, 1.f)};
    }

    // The irradiance that the history has for a surface whose place is known, in place of the radiance.
    Found sum_at(const Surfaces& row, int i, bool reflective) const {
        if (!(row[seen][i] > 0)) return {};
        const float x = row[p_x][i], y = row[p_y][i], plane = row[distance_of_plane][i], tolerance = row[tolerated][i];
        const float lateral = row[lateral_of_normal][i], right = row[normal_per_x][i], down = row[normal_per_y][i];
        const float forward = row[normal_forward][i], per_depth = row[forward_per_depth][i];
        const Vec3 n{row[n_x][i], row[n_y][i], row[n_z][i]};
        const bool miss = row[depth][i] <= 0, orthographic = history_.camera.orthographic;
        Found sum{};
        for_each_tap(x, y, [&](size_t index, float tap_x, float tap_y, float weight) {
            const ViewHistory::Pixel& pixel = history_.pixels[index];
            if (miss != (pixel.depth <= 0) || reflective != pixel.reflective) return;
            const float across = lateral + right * (tap_x - x) + down * (tap_y - y);
            const float along = orthographic ? across + forward * pixel.depth : (forward + across) * pixel.depth * per_depth;
            if (!miss && (std::abs(along - plane) > tolerance || dot(n, pixel.normal) < least_cosine)) return;
            sum.radiance = sum.radiance + pixel.irradiance * weight;
            sum.share += weight;
        });
        return mean(sum);
    }

    // The radiance of the history around a surface that the search has found.
    Found sum_around(const Surface& s, float dx, float dy) const {
        const float x = s.x + dx * scale_x_, y = s.y + dy * scale_y_;
        if (!(x > -0.5f && y > -0.5f && x < float(history_.width) - 0.5f && y < float(history_.height) - 0.5f)) return {};
        Found sum{};
        for_each_tap(x, y, [&](size_t index, float, float, float weight) {
            const ViewHistory::Pixel& pixel = history_.pixels[index];
            if (std::abs(pixel.depth - s.depth) > searched_distance * s.depth) return;
            sum.radiance = sum.radiance + at(history_.rgb, index) * weight;
            sum.share += weight;
        });
        return mean(sum);
    }

    // In a coarse image, where searches fail for single blocks: holes are filled from the blocks around them, and islands left out.
    Found smoothed(int x, int y) const {
        const Found& own = found_[size_t(y) * size_t(width_) + size_t(x)];
        Found sum{};
        int found = 0, all = 0;
        for (int j = y - block; j <= y + block; j += block)
            for (int i = x - block; i <= x + block; i += block) {
                if (i < 0 || j < 0 || i >= width_ || j >= height_) continue;
                ++all;
                const Found& near = found_[size_t(j) * size_t(width_) + size_t(i)];
                if (near.share <= 0) continue;
                ++found;
                if (own.share > 0) continue;
                sum.radiance = sum.radiance + near.radiance;
                sum.share += near.share;
            }
        // All of it if three quarters of the blocks were found, none if half of them were.
        const float certain = std::clamp(4 * float(found) / float(all) - 2, 0.f, 1.f);
        if (own.share > 0) return {own.radiance, own.share * certain};
        if (found == 0) return {};
        return {sum.radiance / float(found), sum.share / float(found) * certain};
    }

    float trust_around(int cx, int cy) const {
        float now = 0, before = 0;
        for (int j = std::max(0, cy - 1); j <= std::min(down_ - 1, cy + 1); ++j)
            for (int i = std::max(0, cx - 1); i <= std::min(across_ - 1, cx + 1); ++i) {
                const auto& sums = sums_[size_t(j) * size_t(across_) + size_t(i)];
                now += sums[0];
                before += sums[1];
            }
        const float most = std::max(now, before);
        if (!(most > 0)) return 1;
        const float least = is_coarse_ ? alike : alike_in_full, largest = is_coarse_ ? other : other_in_full;
        return std::clamp((largest - std::abs(now - before) / most) / (largest - least), 0.f, 1.f);
    }

    // By how alike history and image are around a pixel; interpolated between cells.
    float trust(int x, int y) const {
        const float fx = (float(x) + 0.5f) / cell - 0.5f, fy = (float(y) + 0.5f) / cell - 0.5f, left = floor_of(fx), top = floor_of(fy);
        const auto of_cell = [&](int dx, int dy) {
            const int cx = std::clamp(int(left) + dx, 0, across_ - 1), cy = std::clamp(int(top) + dy, 0, down_ - 1);
            return trust_[size_t(cy) * size_t(across_) + size_t(cx)];
        };
        const float u = fx - left, v = fy - top;
        return (of_cell(0, 0) * (1 - u) + of_cell(1, 0) * u) * (1 - v) + (of_cell(0, 1) * (1 - u) + of_cell(1, 1) * u) * v;
    }

    std::span<const float> rgb_;
    const FirstHitPlanes& now_;
    const ViewHistory& history_;
    bool is_coarse_, is_full_; // of the rendered image; of the known first hits
    int width_, height_;       // of the result
    float scale_x_, scale_y_;  // pixels of the history for one of the result

    Projection here_, there_;
    Vec3 offset_; // of the camera from that of the history
    std::vector<Found> found_;
    int across_, down_;                      // cells
    std::vector<std::array<float, 2>> sums_; // of luminance: of the image, and of the history, where there is any
    std::vector<float> trust_;
};

} // namespace

ViewHistory::ViewHistory(const FirstHitPlanes& seen, std::vector<float> radiance)
    : width(seen.width), height(seen.height), camera(seen.camera), pixels(seen.depth.size()), rgb(std::move(radiance)) {
    for (size_t i = 0; i < pixels.size(); ++i) {
        const Vec3 divisor = divisor_of(seen, i), c = at(rgb, i);
        pixels[i] = {{c.x / divisor.x, c.y / divisor.y, c.z / divisor.z}, is_reflective(seen, i), seen.normal[i], seen.depth[i]};
    }
}

WithHistory with_history(std::span<const float> rgb, bool is_coarse, const FirstHitPlanes& seen, const ViewHistory& history,
                         const Workers* workers) {
    Reprojection reprojection(rgb, is_coarse, seen, history);
    const size_t pixels = size_t(reprojection.width()) * size_t(reprojection.height());
    WithHistory out{reprojection.width(), reprojection.height(), std::vector<float>(3 * pixels), 0};
    const int rows = reprojection.rows_of_cells();
    std::vector<double> shares(static_cast<size_t>(rows));
    const auto each_row = [&](const auto& run) {
        if (workers)
            workers->for_each(rows, {}, [&](int64_t row, unsigned) { run(int(row)); });
        else
            for (int row = 0; row < rows; ++row) run(row);
    };
    each_row([&](int row) { reprojection.find(row); });
    reprojection.judge();
    each_row([&](int row) { shares[size_t(row)] = reprojection.mix(row, out); });
    double sum = 0;
    for (const double share : shares) sum += share;
    out.share = float(sum / double(std::max<size_t>(1, pixels)));
    return out;
}

} // namespace blush
