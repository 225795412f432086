// libstackless for C++17: owning scenes, containers, exceptions. stackless.h documents the functions.
#ifndef STACKLESS_HPP
#define STACKLESS_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "stackless.h"

namespace stackless {

// A failed call. `what` names the element, the found value and the expected value.
class error : public std::runtime_error {
public:
    explicit error(stackless_error code) : std::runtime_error(stackless_error_message()), code_(code) {}
    stackless_error code() const noexcept { return code_; }

private:
    stackless_error code_;
};

inline void check(stackless_error code)
{
    if (code != STACKLESS_ERROR_NONE) {
        throw error(code);
    }
}

enum class rule : std::uint32_t {
    parity = STACKLESS_RULE_PARITY,
    nonzero = STACKLESS_RULE_NONZERO,
    winding = STACKLESS_RULE_WINDING,
};

enum class location : std::uint8_t {
    outside = STACKLESS_OUTSIDE,
    inside = STACKLESS_INSIDE,
    surface = STACKLESS_SURFACE,
};

// The threads that answer a batch.
enum class threads : std::uint32_t { one = STACKLESS_SERIAL, all = STACKLESS_PARALLEL };

// The types and functions of a precision.
template <class Real> struct functions;

#define STACKLESS_FUNCTIONS(Real, p)                                                                                   \
    template <> struct functions<Real> {                                                                               \
        using scene = stackless_scene_##p;                                                                             \
        using ray = stackless_ray_##p;                                                                                 \
        using hit = stackless_hit_##p;                                                                                 \
        using nearest_point = stackless_near_##p;                                                                      \
        using filter = stackless_filter_##p;                                                                           \
        using point = stackless_point_##p;                                                                             \
        using exact_ray = stackless_exact_ray_##p;                                                                     \
        using exact_filter = stackless_exact_filter_##p;                                                               \
        using instances = stackless_instances_##p;                                                                     \
        using instance_hit = stackless_instance_hit_##p;                                                               \
        using instances_filter = stackless_instances_filter_##p;                                                       \
        using instances_exact_filter = stackless_instances_exact_filter_##p;                                           \
        using object = stackless_object_##p;                                                                           \
        static constexpr auto make = stackless_scene_new_##p;                                                          \
        static constexpr auto free = stackless_scene_free_##p;                                                         \
        static constexpr auto refit = stackless_scene_refit_##p;                                                       \
        static constexpr auto set_masks = stackless_scene_set_masks_##p;                                               \
        static constexpr auto counts = stackless_scene_counts_##p;                                                     \
        static constexpr auto bounds = stackless_scene_bounds_##p;                                                     \
        static constexpr auto save = stackless_scene_save_##p;                                                         \
        static constexpr auto load = stackless_scene_load_##p;                                                         \
        static constexpr auto to_bytes = stackless_scene_to_bytes_##p;                                                 \
        static constexpr auto from_bytes = stackless_scene_from_bytes_##p;                                             \
        static constexpr auto closest1 = stackless_closest1_##p;                                                       \
        static constexpr auto any1 = stackless_any1_##p;                                                               \
        static constexpr auto all1 = stackless_all1_##p;                                                               \
        static constexpr auto next1 = stackless_next1_##p;                                                             \
        static constexpr auto closest_n = stackless_closest_n_##p;                                                     \
        static constexpr auto any_n = stackless_any_n_##p;                                                             \
        static constexpr auto crossings_n = stackless_crossings_n_##p;                                                 \
        static constexpr auto locate_n = stackless_locate_n_##p;                                                       \
        static constexpr auto signed_distances_n = stackless_signed_distances_n_##p;                                   \
        static constexpr auto nearest_n = stackless_nearest_n_##p;                                                     \
        static constexpr auto nearest_k1 = stackless_nearest_k1_##p;                                                   \
        static constexpr auto point_new = stackless_point_new_##p;                                                     \
        static constexpr auto point_of_hit = stackless_point_of_hit_##p;                                               \
        static constexpr auto point_free = stackless_point_free_##p;                                                   \
        static constexpr auto exact_closest1 = stackless_exact_closest1_##p;                                           \
        static constexpr auto exact_any1 = stackless_exact_any1_##p;                                                   \
        static constexpr auto exact_closest_n = stackless_exact_closest_n_##p;                                         \
        static constexpr auto exact_any_n = stackless_exact_any_n_##p;                                                 \
        static constexpr auto instances_new = stackless_instances_new_##p;                                             \
        static constexpr auto instances_free = stackless_instances_free_##p;                                           \
        static constexpr auto instances_bounds = stackless_instances_bounds_##p;                                       \
        static constexpr auto instances_closest1 = stackless_instances_closest1_##p;                                   \
        static constexpr auto instances_any1 = stackless_instances_any1_##p;                                           \
        static constexpr auto instances_all1 = stackless_instances_all1_##p;                                           \
        static constexpr auto instances_closest_n = stackless_instances_closest_n_##p;                                 \
        static constexpr auto instances_any_n = stackless_instances_any_n_##p;                                         \
        static constexpr auto instances_exact_closest1 = stackless_instances_exact_closest1_##p;                       \
        static constexpr auto instances_exact_any1 = stackless_instances_exact_any1_##p;                               \
        static constexpr auto instances_exact_closest_n = stackless_instances_exact_closest_n_##p;                     \
        static constexpr auto instances_exact_any_n = stackless_instances_exact_any_n_##p;                             \
    };
STACKLESS_FUNCTIONS(float, f)
STACKLESS_FUNCTIONS(double, d)
#undef STACKLESS_FUNCTIONS

// Views of containers, for the classes below.
namespace detail {

template <class Items>
using item = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(std::declval<const Items&>()))>>;

template <class Items> constexpr std::size_t stride(const Items&) { return sizeof(item<Items>); }

// The rays of a container.
template <class Ray, class Rays> const Ray* of_rays(const Rays& rays)
{
    static_assert(std::is_same_v<item<Rays>, Ray>, "rays are of the precision of the scene");
    return std::data(rays);
}

// The first number of the first item. Items start with their numbers.
template <class Number, std::size_t Count = 3, class Items> const Number* numbers(const Items& items)
{
    using type = item<Items>;
    static_assert(std::is_standard_layout_v<type>, "items are structures of C");
    static_assert(sizeof(type) >= Count * sizeof(Number), "items begin with their numbers");
    return reinterpret_cast<const Number*>(std::data(items));
}

inline std::uint32_t flags(threads by) { return static_cast<std::uint32_t>(by); }

template <class Hit> std::optional<Hit> some(const Hit& found)
{
    return found.face == STACKLESS_NO_FACE ? std::nullopt : std::optional<Hit>(found);
}

// All hits: `find` fills a buffer, and returns the total number.
template <class Hit, class Find> std::vector<Hit> all(Find find)
{
    std::vector<Hit> hits(8);
    const std::size_t count = find(hits);
    const bool is_short = count > hits.size();
    hits.resize(count);
    if (is_short) {
        find(hits);
    }
    return hits;
}

// 1 for each ray that hits, otherwise 0: `find` fills a buffer.
template <class Find> std::vector<std::uint8_t> any(std::size_t count, Find find)
{
    const std::unique_ptr<bool[]> found(new bool[count]());
    find(found.get());
    return std::vector<std::uint8_t>(found.get(), found.get() + count);
}

// A filter of this type that calls `accepts(ray, hit)`.
template <class Filter, class Ray, class Hit, class Skip, class Accepts>
Filter accepting(Accepts& accepts, std::uint32_t mask, const Skip* skip)
{
    const auto ask = [](void* user, const Ray* r, const Hit* found) noexcept -> bool {
        return (*static_cast<Accepts*>(user))(*r, *found);
    };
    return {mask, skip, ask, const_cast<void*>(static_cast<const void*>(&accepts))};
}

} // namespace detail

// An exact point, such as the point of a hit.
template <class Real> class exact_point {
    using call = functions<Real>;
    using handle = typename call::point;

public:
    explicit exact_point(const std::array<Real, 3>& coordinates)
    {
        handle* made = nullptr;
        check(call::point_new(coordinates.data(), &made));
        handle_.reset(made);
    }

    // Takes ownership of a point that a function of stackless.h has created.
    explicit exact_point(handle* made) : handle_(made) {}

    const handle* get() const noexcept { return handle_.get(); }

private:
    struct deleter {
        void operator()(handle* it) const noexcept { call::point_free(it); }
    };

    std::unique_ptr<handle, deleter> handle_;
};

// A hit, with the point at which the next ray may start.
template <class Real, class Hit> struct exact_hit {
    Hit found;
    exact_point<Real> point;
};

namespace detail {

// The queries of a batch of exact rays, by functions of stackless.h.
template <class Real, class Hit, class Find, class Handle, class Rays, class Filter>
std::vector<std::optional<exact_hit<Real, Hit>>> exact_closest_n(Find find, const Handle* in, const Rays& rays,
                                                                 threads by, const Filter* of)
{
    using ray = typename functions<Real>::exact_ray;
    const std::size_t count = std::size(rays);
    std::vector<Hit> hits(count);
    std::vector<typename functions<Real>::point*> made(count);
    std::vector<std::optional<exact_hit<Real, Hit>>> found(count);
    check(find(in, of_rays<ray>(rays), sizeof(ray), count, of, 0, hits.data(), sizeof(Hit), made.data(),
               sizeof(made[0]), flags(by)));
    for (std::size_t i = 0; i < count; i++) {
        if (made[i] != nullptr) {
            found[i].emplace(exact_hit<Real, Hit>{hits[i], exact_point<Real>(made[i])});
        }
    }
    return found;
}

template <class Real, class Find, class Handle, class Rays, class Filter>
std::vector<std::uint8_t> exact_any_n(Find find, const Handle* in, const Rays& rays, threads by, const Filter* of)
{
    using ray = typename functions<Real>::exact_ray;
    const std::size_t count = std::size(rays);
    return any(count, [&](bool* found) {
        check(find(in, of_rays<ray>(rays), sizeof(ray), count, of, 0, found, sizeof(bool), flags(by)));
    });
}

} // namespace detail

// A mesh with its hierarchy, in the precision `Real`: float or double. Threads may call its const functions at the same
// time. Containers are contiguous: vectors, arrays, spans. Vertices, points and faces are structures that start with
// three numbers, such as `std::array<double, 3>` and `std::array<std::uint32_t, 3>`.
template <class Real> class scene {
    using call = functions<Real>;
    using handle = typename call::scene;

public:
    using ray = typename call::ray;
    using hit = typename call::hit;
    using nearest_point = typename call::nearest_point;
    using point = std::array<Real, 3>;
    using filter = typename call::filter;
    using exact_ray = typename call::exact_ray;
    using exact_filter = typename call::exact_filter;

    using exact_hit = stackless::exact_hit<Real, hit>;

    template <class Vertices, class Faces>
    scene(const Vertices& vertices, const Faces& faces, const stackless_options& options = {})
    {
        handle* made = nullptr;
        check(call::make(detail::numbers<Real>(vertices), detail::stride(vertices), std::size(vertices),
                         detail::numbers<std::uint32_t>(faces), detail::stride(faces), std::size(faces), &options,
                         &made));
        handle_.reset(made);
    }

    static scene load(const std::string& file, std::uint32_t threads = 0)
    {
        handle* made = nullptr;
        check(call::load(file.c_str(), threads, &made));
        return scene(made);
    }

    static scene from_bytes(const std::vector<std::uint8_t>& bytes, std::uint32_t threads = 0)
    {
        handle* made = nullptr;
        check(call::from_bytes(bytes.data(), bytes.size(), threads, &made));
        return scene(made);
    }

    void save(const std::string& file) const { check(call::save(get(), file.c_str())); }

    std::vector<std::uint8_t> to_bytes() const
    {
        std::size_t size = 0;
        check(call::to_bytes(get(), nullptr, 0, &size));
        std::vector<std::uint8_t> bytes(size);
        check(call::to_bytes(get(), bytes.data(), bytes.size(), &size));
        return bytes;
    }

    template <class Vertices> void refit(const Vertices& vertices)
    {
        check(call::refit(handle_.get(), detail::numbers<Real>(vertices), detail::stride(vertices),
                          std::size(vertices)));
    }

    // A mask for each face.
    void set_masks(const std::vector<std::uint32_t>& masks)
    {
        check(call::set_masks(handle_.get(), masks.data(), sizeof(masks[0]), masks.size()));
    }

    // A filter that calls `accepts(ray, hit)`, which must be pure and must not throw. It is not copied.
    template <class Accepts>
    static filter accepting(Accepts& accepts, std::uint32_t mask = UINT32_MAX, const std::uint32_t* skip = nullptr)
    {
        return detail::accepting<filter, ray, hit>(accepts, mask, skip);
    }

    // The same for rays that start at exact points.
    template <class Accepts>
    static exact_filter exact_accepting(Accepts& accepts, std::uint32_t mask = UINT32_MAX,
                                        const std::uint32_t* skip = nullptr)
    {
        return detail::accepting<exact_filter, exact_ray, hit>(accepts, mask, skip);
    }

    std::size_t face_count() const
    {
        std::size_t count = 0;
        check(call::counts(get(), nullptr, &count));
        return count;
    }

    // The least and the greatest coordinates.
    std::array<point, 2> bounds() const
    {
        std::array<point, 2> found;
        check(call::bounds(get(), found[0].data(), found[1].data()));
        return found;
    }

    std::optional<hit> closest(const ray& r, const filter* by = nullptr) const
    {
        hit found;
        check(call::closest1(get(), &r, by, &found));
        return detail::some(found);
    }

    bool any(const ray& r, const filter* by = nullptr) const
    {
        bool found = false;
        check(call::any1(get(), &r, by, &found));
        return found;
    }

    std::vector<hit> all(const ray& r, const filter* by = nullptr) const
    {
        return detail::all<hit>([&](std::vector<hit>& hits) {
            std::size_t count = 0;
            check(call::all1(get(), &r, by, hits.data(), sizeof(hit), hits.size(), &count));
            return count;
        });
    }

    std::optional<hit> next(const ray& r, const hit& after) const
    {
        hit found;
        check(call::next1(get(), &r, &after, &found));
        return detail::some(found);
    }

    // The exact point at which a ray hits a face.
    exact_point<Real> point_of_hit(const ray& r, std::uint32_t face) const
    {
        typename call::point* made = nullptr;
        check(call::point_of_hit(get(), &r, face, &made));
        return exact_point<Real>(made);
    }

    std::optional<exact_hit> exact_closest(const exact_ray& r, const exact_filter* by = nullptr) const
    {
        hit found;
        typename call::point* made = nullptr;
        check(call::exact_closest1(get(), &r, by, &found, &made));
        return made == nullptr ? std::nullopt : std::optional<exact_hit>({found, exact_point<Real>(made)});
    }

    bool exact_any(const exact_ray& r, const exact_filter* by = nullptr) const
    {
        bool found = false;
        check(call::exact_any1(get(), &r, by, &found));
        return found;
    }

    // A filter applies to all rays.
    template <class Rays>
    std::vector<std::optional<exact_hit>> exact_closest_n(const Rays& rays, threads by = threads::one,
                                                          const exact_filter* of = nullptr) const
    {
        return detail::exact_closest_n<Real, hit>(call::exact_closest_n, get(), rays, by, of);
    }

    template <class Rays>
    std::vector<std::uint8_t> exact_any_n(const Rays& rays, threads by = threads::one,
                                          const exact_filter* of = nullptr) const
    {
        return detail::exact_any_n<Real>(call::exact_any_n, get(), rays, by, of);
    }

    // The face of a miss is STACKLESS_NO_FACE. A filter applies to all rays.
    template <class Rays>
    std::vector<hit> closest_n(const Rays& rays, threads by = threads::one, const filter* of = nullptr) const
    {
        std::vector<hit> hits(std::size(rays));
        check(call::closest_n(get(), detail::of_rays<ray>(rays), sizeof(ray), hits.size(), of, 0, hits.data(),
                              sizeof(hit), detail::flags(by)));
        return hits;
    }

    // 1 for each ray that hits, otherwise 0.
    template <class Rays>
    std::vector<std::uint8_t> any_n(const Rays& rays, threads by = threads::one, const filter* of = nullptr) const
    {
        const std::size_t count = std::size(rays);
        return detail::any(count, [&](bool* found) {
            check(call::any_n(get(), detail::of_rays<ray>(rays), sizeof(ray), count, of, 0, found, sizeof(bool),
                              detail::flags(by)));
        });
    }

    std::uint32_t crossings(const ray& r) const { return crossings_n(std::array<ray, 1>{r})[0]; }

    template <class Rays> std::vector<std::uint32_t> crossings_n(const Rays& rays, threads by = threads::one) const
    {
        std::vector<std::uint32_t> counts(std::size(rays));
        check(call::crossings_n(get(), detail::of_rays<ray>(rays), sizeof(ray), counts.size(), counts.data(),
                                sizeof(counts[0]), detail::flags(by)));
        return counts;
    }

    location locate(const point& p, rule by = rule::parity) const { return locate_n(std::array<point, 1>{p}, by)[0]; }

    template <class Points>
    std::vector<location> locate_n(const Points& points, rule r = rule::parity, threads by = threads::one) const
    {
        std::vector<std::uint8_t> found(std::size(points));
        check(call::locate_n(get(), detail::numbers<Real>(points), detail::stride(points), found.size(),
                             static_cast<std::uint32_t>(r), found.data(), 1, detail::flags(by)));
        std::vector<location> places(found.size());
        for (std::size_t i = 0; i < found.size(); i++) {
            places[i] = static_cast<location>(found[i]);
        }
        return places;
    }

    // Negative inside.
    template <class Points>
    std::vector<Real> signed_distances_n(const Points& points, rule r = rule::parity, threads by = threads::one) const
    {
        std::vector<Real> distances(std::size(points));
        check(call::signed_distances_n(get(), detail::numbers<Real>(points), detail::stride(points), distances.size(),
                                       static_cast<std::uint32_t>(r), distances.data(), sizeof(Real),
                                       detail::flags(by)));
        return distances;
    }

    // Without a point within the radius the face is STACKLESS_NO_FACE.
    template <class Points>
    std::vector<nearest_point> nearest_n(const Points& points, Real radius, threads by = threads::one) const
    {
        std::vector<nearest_point> nears(std::size(points));
        check(call::nearest_n(get(), detail::numbers<Real>(points), detail::stride(points), nears.size(), radius,
                              nears.data(), sizeof(nearest_point), detail::flags(by)));
        return nears;
    }

    // The nearest faces in order, at most `most`.
    std::vector<nearest_point> nearest_k(const point& p, Real radius, std::size_t most) const
    {
        std::size_t count = std::min(most, face_count());
        std::vector<nearest_point> nears(count);
        check(call::nearest_k1(get(), p.data(), radius, nears.data(), sizeof(nearest_point), nears.size(), &count));
        nears.resize(count);
        return nears;
    }

    // For calls of the functions of stackless.h.
    const handle* get() const noexcept { return handle_.get(); }

private:
    struct deleter {
        void operator()(handle* it) const noexcept { call::free(it); }
    };

    explicit scene(handle* made) : handle_(made) {}

    std::unique_ptr<handle, deleter> handle_;
};

// Scenes, and other instances, placed by affine maps. They do not need their scenes any more.
template <class Real> class instances {
    using call = functions<Real>;
    using handle = typename call::instances;

public:
    using ray = typename call::ray;
    using hit = typename call::instance_hit;
    using filter = typename call::instances_filter;
    using point = std::array<Real, 3>;
    using object = typename call::object;
    using exact_ray = typename call::exact_ray;
    using exact_filter = typename call::instances_exact_filter;
    using exact_hit = stackless::exact_hit<Real, hit>;

    static object of(const scene<Real>& it) { return {it.get(), nullptr}; }
    static object of(const instances& it) { return {nullptr, it.get()}; }

    // Instance i is `objects[indices[i]]`, placed by `transforms[i]`, which starts with 12 numbers, row by row: a
    // structure such as `std::array<std::array<double, 4>, 3>`.
    template <class Transforms>
    instances(const std::vector<object>& objects, const std::vector<std::uint32_t>& indices,
              const Transforms& transforms, const stackless_options& options = {})
    {
        if (indices.size() != std::size(transforms)) {
            throw std::invalid_argument("as many indices as transforms are needed");
        }
        handle* made = nullptr;
        check(call::instances_new(objects.data(), sizeof(object), objects.size(), indices.data(),
                                  sizeof(std::uint32_t), detail::numbers<Real, 12>(transforms),
                                  detail::stride(transforms), indices.size(), &options, &made));
        handle_.reset(made);
    }

    // A filter that calls `accepts(ray, hit)`, which must be pure and must not throw. It is not copied.
    template <class Accepts>
    static filter accepting(Accepts& accepts, std::uint32_t mask = UINT32_MAX, const hit* skip = nullptr)
    {
        return detail::accepting<filter, ray, hit>(accepts, mask, skip);
    }

    // The same for rays that start at exact points.
    template <class Accepts>
    static exact_filter exact_accepting(Accepts& accepts, std::uint32_t mask = UINT32_MAX, const hit* skip = nullptr)
    {
        return detail::accepting<exact_filter, exact_ray, hit>(accepts, mask, skip);
    }

    // The least and the greatest coordinates of a box that contains all faces.
    std::array<point, 2> bounds() const
    {
        std::array<point, 2> found;
        check(call::instances_bounds(get(), found[0].data(), found[1].data()));
        return found;
    }

    std::optional<hit> closest(const ray& r, const filter* by = nullptr) const
    {
        hit found;
        check(call::instances_closest1(get(), &r, by, &found));
        return detail::some(found);
    }

    bool any(const ray& r, const filter* by = nullptr) const
    {
        bool found = false;
        check(call::instances_any1(get(), &r, by, &found));
        return found;
    }

    std::vector<hit> all(const ray& r, const filter* by = nullptr) const
    {
        return detail::all<hit>([&](std::vector<hit>& hits) {
            std::size_t count = 0;
            check(call::instances_all1(get(), &r, by, hits.data(), sizeof(hit), hits.size(), &count));
            return count;
        });
    }

    // The face of a miss is STACKLESS_NO_FACE. A filter applies to all rays.
    template <class Rays>
    std::vector<hit> closest_n(const Rays& rays, threads by = threads::one, const filter* of = nullptr) const
    {
        std::vector<hit> hits(std::size(rays));
        check(call::instances_closest_n(get(), detail::of_rays<ray>(rays), sizeof(ray), hits.size(), of, 0,
                                        hits.data(), sizeof(hit), detail::flags(by)));
        return hits;
    }

    // 1 for each ray that hits, otherwise 0.
    template <class Rays>
    std::vector<std::uint8_t> any_n(const Rays& rays, threads by = threads::one, const filter* of = nullptr) const
    {
        const std::size_t count = std::size(rays);
        return detail::any(count, [&](bool* found) {
            check(call::instances_any_n(get(), detail::of_rays<ray>(rays), sizeof(ray), count, of, 0, found,
                                        sizeof(bool), detail::flags(by)));
        });
    }

    std::optional<exact_hit> exact_closest(const exact_ray& r, const exact_filter* by = nullptr) const
    {
        hit found;
        typename call::point* made = nullptr;
        check(call::instances_exact_closest1(get(), &r, by, &found, &made));
        return made == nullptr ? std::nullopt : std::optional<exact_hit>({found, exact_point<Real>(made)});
    }

    bool exact_any(const exact_ray& r, const exact_filter* by = nullptr) const
    {
        bool found = false;
        check(call::instances_exact_any1(get(), &r, by, &found));
        return found;
    }

    // A filter applies to all rays.
    template <class Rays>
    std::vector<std::optional<exact_hit>> exact_closest_n(const Rays& rays, threads by = threads::one,
                                                          const exact_filter* of = nullptr) const
    {
        return detail::exact_closest_n<Real, hit>(call::instances_exact_closest_n, get(), rays, by, of);
    }

    template <class Rays>
    std::vector<std::uint8_t> exact_any_n(const Rays& rays, threads by = threads::one,
                                          const exact_filter* of = nullptr) const
    {
        return detail::exact_any_n<Real>(call::instances_exact_any_n, get(), rays, by, of);
    }

    // For calls of the functions of stackless.h.
    const handle* get() const noexcept { return handle_.get(); }

private:
    struct deleter {
        void operator()(handle* it) const noexcept { call::instances_free(it); }
    };

    std::unique_ptr<handle, deleter> handle_;
};

} // namespace stackless

#endif
