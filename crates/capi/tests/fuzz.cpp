// Calls the functions with arguments drawn from bytes. The library must refuse every invalid call with a message of one
// line, and answer every valid call. All functions must agree on a question, and write nothing but their results.
//
//     clang++ -std=c++17 -g -fsanitize=fuzzer,address,undefined -DDOUBLE -I include tests/fuzz.cpp libstackless.a
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fuzzer/FuzzedDataProvider.h>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "check.h"

using bytes = FuzzedDataProvider;
using triple = std::array<real, 3>;
using face = std::array<uint32_t, 3>;
using rows = std::array<real, 12>;

size_t up_to(bytes& from, size_t most) { return from.ConsumeIntegralInRange<size_t>(0, most); }

// One of `n`.
bool rarely(bytes& from, size_t n) { return up_to(from, n - 1) == 1; }

real number(bytes& from)
{
    using limits = std::numeric_limits<real>;
    static const real special[] = {limits::quiet_NaN(), limits::infinity(), -limits::infinity(), limits::max(),
                                   -limits::max(),      limits::min(),      limits::denorm_min(), -real{0}};
    const auto byte = from.ConsumeIntegral<uint8_t>();
    // Few different ones, so that rays and points meet vertices and edges.
    return byte < 254 ? static_cast<real>(byte % 9 - 4) / 2 : special[up_to(from, std::size(special) - 1)];
}

triple vector(bytes& from) { return {number(from), number(from), number(from)}; }

template <class T> bool are_finite(const T& numbers)
{
    return std::all_of(std::begin(numbers), std::end(numbers), [](real x) { return std::isfinite(x); });
}

// An argument that is an array. Its memory has its exact size, so the sanitizer sees all accesses outside. A few are
// invalid. Numbers of vertices, faces and transforms may be anywhere, with an alignment of 1.
template <class T> struct array {
    size_t count, stride;
    bool is_valid = true;

    array(bytes& from, size_t n, size_t alignment = alignof(T))
        : count(n), stride(sizeof(T) + alignment * up_to(from, 2))
    {
        const size_t offset = alignment == 1 ? up_to(from, 1) : 0, size = n ? (n - 1) * stride + sizeof(T) : 0;
        memory = std::make_unique<unsigned char[]>(offset + size);
        std::fill_n(memory.get(), offset + size, filler);
        first = memory.get() + offset;
        given = reinterpret_cast<T*>(first);
        if (rarely(from, 32)) {
            is_valid = n == 0;
            switch (up_to(from, 4)) {
            case 0: given = nullptr; break;
            case 1: stride = up_to(from, sizeof(T) - 1); break;
            case 2: // The end of the array is outside of the address space.
                is_valid = n < 2;
                stride = n < 2 ? stride : (PTRDIFF_MAX / (n - 1) / alignment + 1) * alignment;
                break;
            case 3: alignment > 1 ? void(stride++) : void(given = nullptr); break;
            case 4: given = alignment > 1 ? reinterpret_cast<T*>(first + 1) : nullptr; break;
            }
        }
        gap = stride;
    }

    ~array()
    {
        // Nothing was written between the elements.
        for (size_t i = 0; is_valid && i + 1 < count; i++) {
            unsigned char *begin = first + i * gap + sizeof(T), *end = first + (i + 1) * gap;
            CHECK(std::all_of(begin, end, [](unsigned char byte) { return byte == filler; }));
        }
    }

    // An element, of an array that is valid.
    T get(size_t i) const
    {
        T value;
        memcpy(&value, first + i * stride, sizeof(T));
        return value;
    }

    void fill(const T& value, size_t i)
    {
        if (is_valid) {
            memcpy(first + i * stride, &value, sizeof(T));
        }
    }

    template <class U = T> U* pointer() const { return reinterpret_cast<U*>(given); }

private:
    static constexpr unsigned char filler = 0xA5;
    std::unique_ptr<unsigned char[]> memory;
    unsigned char* first;
    T* given;
    size_t gap;
};

// Whether a call succeeded. It must do so exactly if it is valid.
bool succeeds(stackless_error code, bool is_valid, int line)
{
    const char* message = stackless_error_message();
    if (code != (is_valid ? STACKLESS_ERROR_NONE : STACKLESS_ERROR_INVALID_ARGUMENT)
        || (!is_valid && (*message == 0 || strchr(message, '\n')))) {
        const char* expected = is_valid ? "valid" : "invalid";
        fprintf(stderr, "line %d: code %d, %s call, message: %s\n", line, code, expected, message);
        abort();
    }
    return is_valid;
}
#define SUCCEEDS(call, is_valid) succeeds((call), (is_valid), __LINE__)

template <class T, stackless_error (*Free)(T*)> struct owned {
    T* it = nullptr;
    // Of a scene: the faces that certainly have an area.
    std::vector<bool> has_area = std::vector<bool>(12);
    owned() = default;
    owned(const owned&) = delete;
    ~owned() { CHECK(Free(it) == STACKLESS_ERROR_NONE); }
};
using owned_scene = owned<scene_t, CALL(scene_free)>;
using point = owned<point_t, CALL(point_free)>;
using instances = owned<instances_t, CALL(instances_free)>;

const hit_t miss = {(real)INFINITY, (real)NAN, (real)NAN, STACKLESS_NO_FACE};

bool are_same(const hit_t& a, const hit_t& b)
{
    return memcmp(&a.t, &b.t, sizeof a.t) == 0 && memcmp(&a.u, &b.u, sizeof a.u) == 0
           && memcmp(&a.v, &b.v, sizeof a.v) == 0 && a.face == b.face;
}

ray_t ray_of(bytes& from)
{
    const triple origin = vector(from), direction = vector(from);
    ray_t ray = {{origin[0], origin[1], origin[2]}, 0, {direction[0], direction[1], direction[2]}, (real)INFINITY};
    if (rarely(from, 4)) {
        ray.tmin = number(from);
        ray.tmax = number(from);
    }
    return ray;
}

bool is_valid(const ray_t& ray)
{
    const auto& d = ray.direction;
    return are_finite(ray.origin) && are_finite(d) && (d[0] != 0 || d[1] != 0 || d[2] != 0) && ray.tmin >= 0
           && ray.tmin < (real)INFINITY && ray.tmin <= ray.tmax;
}

hit_t closest(const scene_t* scene, const ray_t& ray, const filter_t* filter = nullptr)
{
    hit_t hit;
    OK(CALL(closest1)(scene, &ray, filter, &hit));
    return hit;
}

// Whether a face certainly has an area: for coordinates of `number` that are not special this is exact.
bool has_area(const triple& a, const triple& b, const triple& c)
{
    const auto is_usual = [](real x) { return x == 0 || (std::abs(x) >= real{0.5} && std::abs(x) <= 2); };
    bool is_any = false;
    for (int i = 0, j = 1, k = 2; i < 3; j = k, k = i++) {
        if (!is_usual(a[i]) || !is_usual(b[i]) || !is_usual(c[i])) {
            return false;
        }
        is_any |= (b[i] - a[i]) * (c[j] - a[j]) != (b[j] - a[j]) * (c[i] - a[i]);
    }
    return is_any;
}

// Builds a scene, or moves its vertices.
bool build(bytes& from, owned_scene& scene, bool is_refit)
{
    const size_t vertex_count = up_to(from, 9), face_count = is_refit ? 0 : up_to(from, 12);
    const auto most = static_cast<uint32_t>(rarely(from, 32) ? 10 : std::max<size_t>(vertex_count, 1) - 1);
    array<triple> vertices(from, vertex_count, 1);
    array<face> faces(from, face_count, 1);
    bool valid = vertices.is_valid && faces.is_valid;
    for (size_t i = 0; i < vertex_count; i++) {
        const triple vertex = vector(from);
        valid &= are_finite(vertex);
        vertices.fill(vertex, i);
    }
    for (size_t i = 0; i < face_count; i++) {
        face corners;
        for (auto& corner : corners) {
            corner = static_cast<uint32_t>(up_to(from, most));
            valid &= corner < vertex_count;
        }
        faces.fill(corners, i);
    }
    if (is_refit) {
        size_t expected;
        OK(CALL(scene_counts)(scene.it, &expected, nullptr));
        scene.has_area.assign(12, false);
        return SUCCEEDS(CALL(scene_refit)(scene.it, vertices.pointer<real>(), vertices.stride, vertex_count),
                        valid && vertex_count == expected);
    }
    static const uint32_t some_threads[] = {0, 0, 0, 0, 0, 0, 2, 5000};
    const stackless_options options = {static_cast<uint32_t>(up_to(from, rarely(from, 8) ? 3 : 0)),
                                       some_threads[up_to(from, 7)]};
    valid &= face_count > 0 && options.quality < 3 && options.threads < 5000;
    const bool is_built = SUCCEEDS(CALL(scene_new)(vertices.pointer<real>(), vertices.stride, vertex_count,
                                                   faces.pointer<uint32_t>(), faces.stride, face_count,
                                                   &options, &scene.it), valid);
    CHECK((scene.it != nullptr) == is_built);
    for (size_t i = 0; i < face_count && is_built; i++) {
        const auto [a, b, c] = faces.get(i);
        scene.has_area[i] = has_area(vertices.get(a), vertices.get(b), vertices.get(c));
    }
    return is_built;
}

bool is_even(void* user, const ray_t*, const hit_t* hit)
{
    ++*static_cast<std::atomic<size_t>*>(user);
    return hit->face % 2 == 0;
}

// All functions agree on the hits of a ray.
void one_ray(bytes& from, const scene_t* scene, const ray_t& ray)
{
    const hit_t first = closest(scene, ray);
    bool is_hit;
    OK(CALL(any1)(scene, &ray, nullptr, &is_hit));
    CHECK(is_hit == (first.face != STACKLESS_NO_FACE));
    array<hit_t> hits(from, up_to(from, 13));
    size_t count = 0;
    if (!SUCCEEDS(CALL(all1)(scene, &ray, nullptr, hits.pointer(), hits.stride, hits.count, &count), hits.is_valid)) {
        return;
    }
    CHECK((count > 0) == is_hit);
    hit_t even = miss;
    for (size_t i = 0; i < std::min(count, hits.count); i++) {
        const hit_t hit = hits.get(i);
        hit_t next = first;
        if (i > 0) {
            const hit_t before = hits.get(i - 1);
            OK(CALL(next1)(scene, &ray, &before, &next));
        }
        CHECK(are_same(next, hit));
        if (hit.face % 2 == 0 && even.face == STACKLESS_NO_FACE) {
            even = hit;
        }
    }
    if (count <= hits.count) {
        std::atomic<size_t> calls{0};
        const filter_t filter = {UINT32_MAX, nullptr, is_even, &calls};
        CHECK(are_same(closest(scene, ray, &filter), even));
        CHECK(calls > 0 || !is_hit);
        const filter_t others = {UINT32_MAX, &first.face, nullptr, nullptr};
        CHECK(are_same(closest(scene, ray, &others), count > 1 ? hits.get(1) : miss));
    }
    if (is_hit) {
        point met;
        OK(CALL(point_of_hit)(scene, &ray, first.face, &met.it));
    }
}

void rays(bytes& from, const scene_t* scene)
{
    // Sometimes more than a thread takes at once.
    const size_t count = up_to(from, 6) * (rarely(from, 32) ? 100 : 1);
    array<ray_t> rays(from, count);
    array<hit_t> hits(from, count);
    array<bool> found(from, count);
    bool valid = rays.is_valid;
    for (size_t i = 0; i < count; i++) {
        const ray_t ray = i < 6 ? ray_of(from) : rays.is_valid ? rays.get(i - 6) : ray_t{};
        valid &= is_valid(ray);
        rays.fill(ray, i);
    }
    const auto flags = static_cast<uint32_t>(up_to(from, rarely(from, 16) ? 2 : 1));
    valid &= flags < 2;
    if (SUCCEEDS(CALL(closest_n)(scene, rays.pointer(), rays.stride, count, nullptr, 0, hits.pointer(), hits.stride,
                                 flags), valid && hits.is_valid)) {
        for (size_t i = 0; i < count; i++) {
            CHECK(are_same(closest(scene, rays.get(i)), hits.get(i)));
        }
    }
    if (SUCCEEDS(CALL(any_n)(scene, rays.pointer(), rays.stride, count, nullptr, 0, found.pointer(), found.stride,
                             flags), valid && found.is_valid)) {
        for (size_t i = 0; i < std::min<size_t>(count, 6); i++) {
            one_ray(from, scene, rays.get(i));
        }
    }
}

void points(bytes& from, const owned_scene& owner)
{
    const scene_t* scene = owner.it;
    const size_t count = up_to(from, 4);
    array<triple> points(from, count, alignof(real));
    array<near_t> nears(from, count);
    array<uint8_t> locations(from, count);
    array<real> distances(from, count);
    bool valid = points.is_valid;
    for (size_t i = 0; i < count; i++) {
        const triple place = vector(from);
        valid &= are_finite(place);
        points.fill(place, i);
    }
    const real radius = rarely(from, 4) ? number(from) : (real)INFINITY;
    const auto rule = static_cast<uint32_t>(up_to(from, 3)), flags = static_cast<uint32_t>(up_to(from, 1));
    const real* first = points.pointer<real>();
    // Without points the radius is not read.
    if (SUCCEEDS(CALL(nearest_n)(scene, first, points.stride, count, radius, nears.pointer(), nears.stride, flags),
                 valid && nears.is_valid && (radius >= 0 || count == 0))) {
        for (size_t i = 0; i < count; i++) {
            const triple place = points.get(i);
            const near_t near = nears.get(i);
            near_t other = {};
            size_t others = 0;
            OK(CALL(nearest_k1)(scene, place.data(), radius, &other, sizeof other, 1, &others));
            CHECK(others == (near.face != STACKLESS_NO_FACE));
            CHECK(others == 0 || (other.face == near.face && other.distance == near.distance));
        }
    }
    // Open meshes are suitable for one rule alone.
    const auto located =
        CALL(locate_n)(scene, first, points.stride, count, rule, locations.pointer(), locations.stride, flags);
    const auto signs = CALL(signed_distances_n)(scene, first, points.stride, count, rule, distances.pointer(),
                                                distances.stride, flags);
    if (located == STACKLESS_ERROR_UNSUITABLE_MESH || signs == STACKLESS_ERROR_UNSUITABLE_MESH) {
        CHECK(rule != STACKLESS_RULE_WINDING && points.is_valid);
        return;
    }
    CHECK((located == STACKLESS_ERROR_NONE) == (valid && locations.is_valid && rule < 3));
    CHECK((signs == STACKLESS_ERROR_NONE) == (valid && distances.is_valid && rule < 3));
    for (size_t i = 0; i < count && located == STACKLESS_ERROR_NONE && signs == STACKLESS_ERROR_NONE; i++) {
        const real distance = distances.get(i);
        const int location = locations.get(i);
        if (distance != 0) {
            CHECK(location == (distance < 0 ? STACKLESS_INSIDE : STACKLESS_OUTSIDE));
            continue;
        }
        // The point is on the surface, unless all faces there are without area.
        const triple place = points.get(i);
        near_t there[12];
        size_t faces = 0;
        OK(CALL(nearest_k1)(scene, place.data(), 0, there, sizeof there[0], 12, &faces));
        const auto has_area = [&](const near_t& near) { return owner.has_area[near.face]; };
        CHECK(location == STACKLESS_SURFACE || std::none_of(there, there + faces, has_area));
    }
}

// A ray that starts at an exact point agrees with the ray from the same numbers, also among instances.
void exact(bytes& from, const scene_t* scene)
{
    ray_t ray = ray_of(from);
    ray.tmin = 0;
    point start, met;
    if (!SUCCEEDS(CALL(point_new)(ray.origin, &start.it), are_finite(ray.origin))) {
        CHECK(start.it == nullptr);
        return;
    }
    exact_ray_t way = {start.it, nullptr, {ray.direction[0], ray.direction[1], ray.direction[2]}, ray.tmax, true};
    hit_t hit;
    if (!SUCCEEDS(CALL(exact_closest1)(scene, &way, nullptr, &hit, &met.it), is_valid(ray))) {
        return;
    }
    CHECK(are_same(hit, closest(scene, ray)) && (met.it != nullptr) == (hit.face != STACKLESS_NO_FACE));
    // Nothing is between the start and the hit.
    way.target = met.it;
    way.is_closed = false;
    bool is_hit = false;
    if (met.it != nullptr && hit.t > 0) {
        point nearer;
        OK(CALL(exact_closest1)(scene, &way, nullptr, &hit, &nearer.it));
        OK(CALL(exact_any1)(scene, &way, nullptr, &is_hit));
        CHECK(!is_hit && are_same(hit, miss) && nearer.it == nullptr);
    }
    // The boxes of instances are rounded outwards, and must not leave the range of floats.
    std::array<real, 6> bounds;
    OK(CALL(scene_bounds)(scene, &bounds[0], &bounds[3]));
    const auto is_usual = [](real x) { return std::abs(x) < std::numeric_limits<real>::max() / 2; };
    const object_t object = {scene, nullptr};
    const auto index = static_cast<uint32_t>(rarely(from, 16));
    array<rows> maps(from, 1, 1);
    maps.fill({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, 0);
    instances placed;
    instance_hit_t inside;
    if (std::all_of(bounds.begin(), bounds.end(), is_usual)
        && SUCCEEDS(CALL(instances_new)(&object, sizeof object, 1, &index, sizeof index, maps.pointer<real>(),
                                        maps.stride, 1, nullptr, &placed.it), maps.is_valid && index == 0)) {
        OK(CALL(instances_closest1)(placed.it, &ray, nullptr, &inside));
        const hit_t same = {inside.t, inside.u, inside.v, inside.face};
        CHECK(are_same(same, closest(scene, ray)) && inside.levels == (inside.face != STACKLESS_NO_FACE));
    }
}

// Saved scenes answer equally. Changed bytes are refused.
void saved(bytes& from, const scene_t* scene)
{
    size_t size = 0;
    OK(CALL(scene_to_bytes)(scene, nullptr, 0, &size));
    std::vector<uint8_t> file(size);
    OK(CALL(scene_to_bytes)(scene, file.data(), size, &size));
    const bool is_changed = rarely(from, 2);
    if (is_changed) {
        file[up_to(from, size - 1)] ^= static_cast<uint8_t>(1 + up_to(from, 254));
    }
    owned_scene loaded;
    const auto code = CALL(scene_from_bytes)(file.data(), size, 0, &loaded.it);
    CHECK(code == (is_changed ? STACKLESS_ERROR_INVALID_DATA : STACKLESS_ERROR_NONE));
    const ray_t ray = ray_of(from);
    if (!is_changed && is_valid(ray)) {
        CHECK(are_same(closest(scene, ray), closest(loaded.it, ray)));
    }
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    // Short inputs are seeds of random ones, which reach more than their own few bytes.
    std::vector<uint8_t> random(size < 16 ? 512 : 0);
    std::seed_seq seed(data, data + size);
    std::mt19937 numbers(seed);
    std::generate(random.begin(), random.end(), [&] { return static_cast<uint8_t>(numbers()); });
    bytes from(random.empty() ? data : random.data(), random.empty() ? size : random.size());
    owned_scene scene;
    if (!build(from, scene, false)) {
        return 0;
    }
    for (int calls = 0; calls < 6 && from.remaining_bytes() > 0; calls++) {
        switch (up_to(from, 4)) {
        case 0: rays(from, scene.it); break;
        case 1: points(from, scene); break;
        case 2: exact(from, scene.it); break;
        case 3: saved(from, scene.it); break;
        case 4: build(from, scene, true); break;
        }
    }
    return 0;
}
