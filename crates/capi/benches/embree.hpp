// Trackers by Embree 4.4.
#ifndef EMBREE_HPP
#define EMBREE_HPP

#include <dlfcn.h>

#include "world.hpp"

// --- Embree 4.4, declared by hand: types and numbers are those of its headers.

using handle = void*;

struct alignas(16) embree_ray {
    float origin[3], tnear, direction[3], time, tfar;
    unsigned mask, id, flags;
};
struct alignas(16) embree_hit {
    float normal[3], u, v;
    unsigned prim, geometry, instance, instance_prim;
};
struct embree_ray_hit {
    embree_ray ray;
    embree_hit hit;
};
struct bounds_arguments {
    const void* user;
    unsigned prim, time;
    float (*bounds)[2][4];
};
struct filter_arguments {
    int* valid;
    const void* user;
    void* context;
    embree_ray* ray;
    embree_hit* hit;
    unsigned count;
};
struct intersect_arguments {
    int* valid;
    const void* user;
    unsigned prim;
    void* context;
    embree_ray_hit* ray;
    unsigned count, geometry;
};
struct query_arguments {
    int flags;
    unsigned features;
    void *context, *filter, *callback;
};
static_assert(sizeof(embree_ray_hit) == 96 && sizeof(bounds_arguments) == 24, "as in Embree's headers");
static_assert(sizeof(filter_arguments) == 48 && sizeof(intersect_arguments) == 48, "as in Embree's headers");

static void* library;

template <class Result = void, class... Arguments> static Result embree(const char* name, Arguments... arguments)
{
    void* const symbol = dlsym(library, name);
    if (symbol == nullptr) {
        fail(std::string("EMBREE_LIBRARY has no ") + name);
    }
    return reinterpret_cast<Result (*)(Arguments...)>(symbol)(arguments...);
}

// The faces around a volume, turned outwards.
struct shape {
    std::vector<std::array<point, 3>> corners;
    const cell* in;
    double margin;
    handle scene;
};

// A query. Embree passes it to the callbacks as its context.
struct query {
    unsigned instance = UINT32_MAX, instance_prim = UINT32_MAX;
    const std::vector<std::uint32_t>* history;
    point origin, direction, moment;
    double tmax;

    bool has_crossed(std::uint32_t number) const
    {
        return std::find(history->begin(), history->end(), number) != history->end();
    }

    // The side of an edge on which the ray passes. Two triangles compute it with opposite signs. Like MOAB, this
    // treats tiny numbers as 0.
    double side(const point& a, const point& b) const
    {
        if (b < a) {
            return -side(b, a);
        }
        const point edge = minus(b, a);
        const double found = dot(direction, cross(edge, a)) + dot(moment, edge);
        return std::abs(found) < 10 * std::numeric_limits<double>::epsilon() ? 0 : found;
    }
};

// Single precision: rejects entries, and faces of the history.
static void filter(const filter_arguments* by)
{
    const auto& q = *static_cast<const query*>(by->context);
    const auto& of = *static_cast<const shape*>(by->user);
    const auto& n = by->hit->normal;
    if (dot(q.direction, {n[0], n[1], n[2]}) < 0 || q.has_crossed(of.in->faces[by->hit->prim])) {
        by->valid[0] = 0;
    }
}

// Double precision: the box of a triangle, enlarged.
static void bounds(const bounds_arguments* by)
{
    const auto& of = *static_cast<const shape*>(by->user);
    const auto& [a, b, c] = of.corners[by->prim];
    for (int k = 0; k < 3; k++) {
        (*by->bounds)[0][k] = std::nextafterf(static_cast<float>(std::min({a[k], b[k], c[k]}) - of.margin), -INFINITY);
        (*by->bounds)[1][k] = std::nextafterf(static_cast<float>(std::max({a[k], b[k], c[k]}) + of.margin), INFINITY);
    }
}

// Double precision: the Plücker test of a triangle, for exits only.
static void intersect(const intersect_arguments* by)
{
    auto& q = *static_cast<query*>(by->context);
    const auto& of = *static_cast<const shape*>(by->user);
    const auto& [a, b, c] = of.corners[by->prim];
    const double sides[3] = {q.side(b, c), q.side(c, a), q.side(a, b)};
    const double sum = sides[0] + sides[1] + sides[2];
    if (sides[0] > 0 || sides[1] > 0 || sides[2] > 0 || sum == 0 || q.has_crossed(of.in->faces[by->prim])) {
        return;
    }
    int k = 0;
    for (int i = 1; i < 3; i++) {
        k = std::abs(q.direction[i]) > std::abs(q.direction[k]) ? i : k;
    }
    const double t = ((sides[0] * a[k] + sides[1] * b[k] + sides[2] * c[k]) / sum - q.origin[k]) / q.direction[k];
    if (0 <= t && t <= q.tmax) {
        q.tmax = t;
        by->ray->ray.tfar = std::nextafterf(static_cast<float>(t), INFINITY);
        by->ray->hit.prim = by->prim;
        by->ray->hit.geometry = by->geometry;
    }
}

class embree_scenes {
public:
    embree_scenes(handle device, const world& from, bool is_double) : w(from), is_double(is_double)
    {
        shapes.reserve(w.cells.size());
        for (std::size_t i = 0; i < w.cells.size(); i++) {
            const cell& in = w.cells[i];
            // double-down's margin: sqrt(3) d 1e-6 for a longest path of d.
            shapes.push_back({{}, &in, 3 * w.size * 1e-6, embree<handle>("rtcNewScene", device)});
            shape& made = shapes.back();
            for (const std::uint32_t number : in.faces) {
                auto [a, b, c] = w.all.faces[number];
                if (w.all.sides[number][0] == static_cast<int>(i)) {
                    std::swap(b, c);
                }
                made.corners.push_back({w.all.vertices[a], w.all.vertices[b], w.all.vertices[c]});
            }
            const auto count = static_cast<unsigned>(made.corners.size());
            const int triangles = 0, user = 120, robust = 4, high_quality = 2;
            const auto geometry = embree<handle>("rtcNewGeometry", device, is_double ? user : triangles);
            embree("rtcSetGeometryUserData", geometry, static_cast<void*>(&made));
            if (is_double) {
                embree("rtcSetGeometryUserPrimitiveCount", geometry, count);
                embree("rtcSetGeometryBoundsFunction", geometry, &bounds, static_cast<void*>(nullptr));
                embree("rtcSetGeometryIntersectFunction", geometry, &intersect);
            } else {
                // Index buffer of three unsigned, vertex buffer of three floats.
                auto* faces = embree<unsigned*>("rtcSetNewGeometryBuffer", geometry, 0, 0u, 0x5003, sizeof(face),
                                                std::size_t{count});
                auto* vertices = embree<float*>("rtcSetNewGeometryBuffer", geometry, 1, 0u, 0x9003, sizeof(float[3]),
                                                std::size_t{count} * 3);
                for (unsigned j = 0; j < count * 9; j++) {
                    faces[j / 3] = j / 3;
                    vertices[j] = static_cast<float>(made.corners[j / 9][j / 3 % 3][j % 3]);
                }
                embree("rtcSetGeometryIntersectFilterFunction", geometry, &filter);
            }
            embree("rtcSetSceneFlags", made.scene, robust);
            embree("rtcSetSceneBuildQuality", made.scene, high_quality);
            embree("rtcCommitGeometry", geometry);
            embree<unsigned>("rtcAttachGeometry", made.scene, geometry);
            embree("rtcReleaseGeometry", geometry);
            embree("rtcCommitScene", made.scene);
            if (const int error = embree<int>("rtcGetDeviceError", device)) {
                fail("Embree's error " + std::to_string(error));
            }
        }
    }

    void follow(const particle& p, track& out) const
    {
        static const auto find = reinterpret_cast<void (*)(handle, embree_ray_hit*, query_arguments*)>(
            dlsym(library, "rtcIntersect1"));
        std::minstd_rand random(p.seed);
        std::vector<std::uint32_t> history;
        point from = p.origin, d = p.direction;
        volume now = p.start;
        for (int i = 0; i < LIMIT; i++) {
            const shape& in = shapes[now];
            query q = {UINT32_MAX, UINT32_MAX, &history, from, d, cross(d, from), INFINITE};
            query_arguments arguments = {0, UINT32_MAX, &q, nullptr, nullptr};
            embree_ray_hit ray = {};
            for (int k = 0; k < 3; k++) {
                ray.ray.origin[k] = static_cast<float>(from[k]);
                ray.ray.direction[k] = static_cast<float>(d[k]);
            }
            ray.ray.tfar = INFINITY;
            ray.ray.mask = ray.hit.geometry = ray.hit.instance = UINT32_MAX;
            find(in.scene, &ray, &arguments);
            const bool is_hit = ray.hit.geometry != UINT32_MAX;
            const double t = is_double ? q.tmax : static_cast<double>(ray.ray.tfar);
            out.steps.push_back({now, from, is_hit ? along(from, t, d) : w.far(from, d)});
            if (!is_hit) {
                out.is_lost = now != nowhere;
                return;
            }
            from = out.steps.back().to;
            const std::uint32_t number = in.in->faces[ray.hit.prim];
            if (p.turns) {
                d = w.turn(random, number, now);
                history.clear();
            }
            history.push_back(number);
            now = in.in->behind[ray.hit.prim];
        }
    }

private:
    const world& w;
    bool is_double;
    std::vector<shape> shapes;
};

#endif
