/* Answers through C equal those of exact arithmetic with 64-bit integers, for small integer coordinates. */
#include <math.h>
#include <pthread.h>

#include "check.h"

enum { FACES = 400, RAYS = 2000, THREADS = 4 };

/* Packed layouts, with numbers at unaligned addresses. */
#pragma pack(push, 1)
typedef struct { char tag; real position[3]; char colour[2]; } vertex_t;
typedef struct { char tag; uint32_t corners[3]; } face_t;
#pragma pack(pop)

/* Ray and hit in one structure, as in Embree. */
typedef struct { ray_t ray; int number; hit_t hit; bool is_hit; filter_t filter; } rayhit_t;

typedef struct { int64_t t, u, v, det; uint32_t face; } exact_t;

static vertex_t vertices[3 * FACES];
static face_t faces[FACES];
static rayhit_t rays[RAYS];
static exact_t found[FACES];

static void cross(const int64_t a[3], const int64_t b[3], int64_t c[3])
{
    for (int k = 0; k < 3; k++) {
        c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
}

static int64_t dot(const int64_t a[3], const int64_t b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Moeller and Trumbore's test in integers: t, u and v are fractions over a positive det. */
static bool meet(const ray_t *ray, uint32_t face, exact_t *hit)
{
    int64_t d[3], s[3], e1[3], e2[3], p[3], q[3];
    for (int k = 0; k < 3; k++) {
        const int64_t a = (int64_t)vertices[faces[face].corners[0]].position[k];
        d[k] = (int64_t)ray->direction[k];
        s[k] = (int64_t)ray->origin[k] - a;
        e1[k] = (int64_t)vertices[faces[face].corners[1]].position[k] - a;
        e2[k] = (int64_t)vertices[faces[face].corners[2]].position[k] - a;
    }
    cross(d, e2, p);
    cross(s, e1, q);
    const int64_t det = dot(e1, p), sign = det < 0 ? -1 : 1;
    *hit = (exact_t){sign * dot(e2, q), sign * dot(s, p), sign * dot(d, q), sign * det, face};
    return det != 0 && hit->u >= 0 && hit->v >= 0 && hit->u + hit->v <= hit->det &&
           (double)hit->t >= ray->tmin * (double)hit->det && (double)hit->t <= ray->tmax * (double)hit->det;
}

static int by_distance(const void *left, const void *right)
{
    const exact_t *a = left, *b = right;
    const int64_t order = a->t * b->det - b->t * a->det;
    return order != 0 ? (order > 0) - (order < 0) : (a->face > b->face) - (a->face < b->face);
}

/* All hits, sorted. */
static size_t all(const ray_t *ray)
{
    size_t count = 0;
    for (uint32_t face = 0; face < FACES; face++) {
        count += meet(ray, face, &found[count]);
    }
    qsort(found, count, sizeof found[0], by_distance);
    return count;
}

/* Bit for bit: the quotient of two exact numbers is rounded once. */
static bool equals(const hit_t *hit, const exact_t *exact)
{
    const real det = (real)exact->det;
    return hit->face == exact->face && hit->t == (real)exact->t / det && hit->u == (real)exact->u / det &&
           hit->v == (real)exact->v / det;
}

static void make(void)
{
    uint64_t state = 1;
    for (int i = 0; i < 3 * FACES; i++) {
        vertices[i].tag = 'v';
        for (int k = 0; k < 3; k++) {
            vertices[i].position[k] = (real)(below(&state, 17) - 8);
        }
    }
    for (uint32_t i = 0; i < FACES; i++) {
        faces[i] = (face_t){'f', {3 * i, 3 * i + 1, 3 * i + 2}};
    }
    for (int i = 0; i < RAYS; i++) {
        ray_t *ray = &rays[i].ray;
        *ray = (ray_t){.tmin = (real)below(&state, 2), .tmax = i % 3 ? (real)INFINITY : 2};
        while (ray->direction[0] == 0 && ray->direction[1] == 0 && ray->direction[2] == 0) {
            for (int k = 0; k < 3; k++) {
                ray->origin[k] = (real)(below(&state, 17) - 8);
                ray->direction[k] = (real)(below(&state, 9) - 4);
            }
        }
    }
}

static void check_ray(const scene_t *scene, rayhit_t *it, size_t *hits, size_t *ties)
{
    static hit_t list[FACES];
    const size_t count = all(&it->ray);
    size_t listed;
    bool is_hit;
    hit_t hit, next;
    OK(CALL(closest1)(scene, &it->ray, NULL, &hit));
    OK(CALL(any1)(scene, &it->ray, NULL, &is_hit));
    OK(CALL(all1)(scene, &it->ray, NULL, list, sizeof list[0], FACES, &listed));
    CHECK(listed == count && is_hit == (count > 0));
    if (count == 0) {
        CHECK(hit.face == STACKLESS_NO_FACE && isinf(hit.t) && isnan(hit.u) && isnan(hit.v));
        CHECK(it->hit.face == STACKLESS_NO_FACE && !it->is_hit);
        return;
    }
    CHECK(equals(&hit, &found[0]) && equals(&it->hit, &found[0]) && it->is_hit);
    next = hit;
    for (size_t i = 0; i < count; i++) {
        CHECK(equals(&list[i], &found[i]) && equals(&next, &found[i]));
        *ties += i > 0 && list[i].t == list[i - 1].t;
        OK(CALL(next1)(scene, &it->ray, &next, &next));
    }
    CHECK(next.face == STACKLESS_NO_FACE);
    *hits += count;
}

static void batches(const scene_t *scene, uint32_t flags)
{
    const size_t stride = sizeof rays[0];
    for (int i = 0; i < RAYS; i++) {
        rays[i].number = i;
        rays[i].hit.face = 7;
        rays[i].is_hit = i % 2;
    }
    OK(CALL(closest_n)(scene, &rays[0].ray, stride, RAYS, NULL, 0, &rays[0].hit, stride, flags));
    OK(CALL(any_n)(scene, &rays[0].ray, stride, RAYS, NULL, 0, &rays[0].is_hit, stride, flags));
    size_t hits = 0, ties = 0;
    for (int i = 0; i < RAYS; i++) {
        CHECK(rays[i].number == i);
        check_ray(scene, &rays[i], &hits, &ties);
    }
    CHECK(hits > 5 * RAYS && ties > RAYS / 10);
}

/* Accepts hits in one half of each triangle, and checks that the ray is the ray of the call. */
static bool accepts(void *user, const ray_t *ray, const hit_t *hit)
{
    CHECK(ray == user || ray == &((const rayhit_t *)user)->ray);
    return hit->u <= hit->v;
}

static bool accepts_any_ray(void *user, const ray_t *ray, const hit_t *hit)
{
    CHECK(user == NULL && ray >= &rays[0].ray);
    return hit->u <= hit->v;
}

static uint32_t mask_of(uint32_t face)
{
    return 1u << face % 3;
}

/* Keeps the hits that a filter accepts. */
static size_t keep(size_t count, const filter_t *filter)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t face = found[i].face;
        if ((filter->mask & mask_of(face)) != 0 && (filter->skip == NULL || face != *filter->skip) &&
            (filter->accepts == NULL || found[i].u <= found[i].v)) {
            found[kept++] = found[i];
        }
    }
    return kept;
}

static size_t check_filtered(const scene_t *scene, const rayhit_t *it)
{
    static hit_t list[FACES];
    const size_t count = keep(all(&it->ray), &it->filter);
    size_t listed;
    bool is_hit;
    hit_t hit;
    OK(CALL(closest1)(scene, &it->ray, &it->filter, &hit));
    OK(CALL(any1)(scene, &it->ray, &it->filter, &is_hit));
    OK(CALL(all1)(scene, &it->ray, &it->filter, list, sizeof list[0], FACES, &listed));
    CHECK(listed == count && is_hit == (count > 0) && it->is_hit == is_hit && it->hit.face == hit.face);
    CHECK(count > 0 ? equals(&hit, &found[0]) : hit.face == STACKLESS_NO_FACE);
    for (size_t i = 0; i < count; i++) {
        CHECK(equals(&list[i], &found[i]));
    }
    return count;
}

/* Masks, a face to skip and a function, for each ray, and for all. */
static void filters(scene_t *scene, uint32_t flags)
{
    const size_t stride = sizeof rays[0];
    struct { uint32_t mask, other; } masks[FACES];
    for (uint32_t face = 0; face < FACES; face++) {
        masks[face].mask = mask_of(face);
    }
    OK(CALL(scene_set_masks)(scene, &masks[0].mask, sizeof masks[0], FACES));
    for (int i = 0; i < RAYS; i++) {
        hit_t first;
        OK(CALL(closest1)(scene, &rays[i].ray, NULL, &first));
        rays[i].number = (int)first.face;
        rays[i].filter = (filter_t){.mask = i % 4 ? UINT32_MAX : 5, .user = &rays[i]};
        rays[i].filter.skip = i % 3 ? (const uint32_t *)&rays[i].number : NULL;
        rays[i].filter.accepts = i % 5 ? accepts : NULL;
    }
    OK(CALL(closest_n)(scene, &rays[0].ray, stride, RAYS, &rays[0].filter, stride, &rays[0].hit, stride, flags));
    OK(CALL(any_n)(scene, &rays[0].ray, stride, RAYS, &rays[0].filter, stride, &rays[0].is_hit, stride, flags));
    size_t hits = 0;
    for (int i = 0; i < RAYS; i++) {
        hits += check_filtered(scene, &rays[i]);
    }
    CHECK(hits > RAYS);
    const filter_t one = {.mask = 3, .accepts = accepts_any_ray}, none = {.mask = 0};
    OK(CALL(closest_n)(scene, &rays[0].ray, stride, RAYS, &one, 0, &rays[0].hit, stride, flags));
    OK(CALL(any_n)(scene, &rays[0].ray, stride, RAYS, &none, 0, &rays[0].is_hit, stride, flags));
    for (int i = 0; i < RAYS; i++) {
        const size_t count = keep(all(&rays[i].ray), &one);
        CHECK(count > 0 ? equals(&rays[i].hit, &found[0]) : rays[i].hit.face == STACKLESS_NO_FACE);
        CHECK(!rays[i].is_hit);
    }
}

static scene_t *soup(uint32_t quality, uint32_t threads)
{
    scene_t *scene;
    const stackless_options options = {.quality = quality, .threads = threads};
    const char *first_vertex = (const char *)&vertices[0] + offsetof(vertex_t, position);
    const char *first_face = (const char *)&faces[0] + offsetof(face_t, corners);
    OK(CALL(scene_new)((const real *)(const void *)first_vertex, sizeof vertices[0], 3 * FACES,
                       (const uint32_t *)(const void *)first_face, sizeof faces[0], FACES, &options, &scene));
    return scene;
}

/* A closed mesh: crossings, points and distances that follow from the coordinates. */
static void check_cube(void)
{
    scene_t *scene = cube();
    const real half = (real)0.5;
    const real points[5][3] = {{half, half, 0}, {1, 0, half}, {3, 0, 0}, {1, 1, 1}, {2, 2, 2}};
    const uint8_t expected[5] = {STACKLESS_INSIDE, STACKLESS_SURFACE, STACKLESS_OUTSIDE, STACKLESS_SURFACE,
                                 STACKLESS_OUTSIDE};
    for (uint32_t rule = 0; rule < 3; rule++) {
        uint8_t places[5];
        OK(CALL(locate_n)(scene, points[0], sizeof points[0], 5, rule, places, 1, STACKLESS_PARALLEL));
        CHECK(memcmp(places, expected, 5) == 0);
        real distances[5];
        OK(CALL(signed_distances_n)(scene, points[0], sizeof points[0], 4, rule, distances, sizeof(real), 0));
        CHECK(distances[0] == -half && distances[1] == 0 && distances[2] == 2 && distances[3] == 0);
    }
    near_t nears[5];
    OK(CALL(nearest_n)(scene, points[0], sizeof points[0], 5, 1, nears, sizeof nears[0], STACKLESS_SERIAL));
    CHECK(nears[0].distance == half && nears[0].point[0] == 1 && nears[0].face == 2);
    CHECK(nears[1].distance == 0 && nears[3].distance == 0);
    CHECK(nears[2].face == STACKLESS_NO_FACE && isinf(nears[2].distance) && isnan(nears[2].point[0]));
    const real beside[3] = {half, 0, 1};
    size_t nearest;
    OK(CALL(nearest_k1)(scene, beside, 1, nears, sizeof nears[0], 5, &nearest));
    /* Above a face and next to its diagonal; then the two faces of the side, and the first of two faces at distance 1. */
    const uint32_t nearest_faces[5] = {10, 11, 3, 2, 5};
    for (int i = 0; i < 5; i++) {
        CHECK(nears[i].face == nearest_faces[i] && (i == 0 || nears[i].distance >= nears[i - 1].distance));
    }
    CHECK(nearest == 5 && nears[0].distance == 0 && nears[2].distance == half && nears[4].distance == 1);
    OK(CALL(nearest_k1)(scene, beside, (real)INFINITY, nears, sizeof nears[0], 1, &nearest));
    CHECK(nearest == 1 && nears[0].face == 10);
    OK(CALL(nearest_k1)(scene, beside, 1, NULL, 0, 0, &nearest));
    CHECK(nearest == 0);
    /* Through a corner, an edge, and the diagonal of a side, along which two faces meet. */
    const ray_t through[3] = {{{0, 0, 0}, 0, {1, 1, 1}, (real)INFINITY}, {{3, 1, 0}, 0, {-1, 0, 0}, (real)INFINITY},
                              {{0, 0, 0}, 0, {0, 0, 1}, (real)INFINITY}};
    uint32_t crossings[3];
    OK(CALL(crossings_n)(scene, through, sizeof through[0], 3, crossings, sizeof crossings[0], STACKLESS_SERIAL));
    CHECK(crossings[0] == 1 && crossings[1] % 2 == 0 && crossings[2] == 1);
    size_t vertex_count, face_count;
    real lower[3], upper[3], moved[8][3];
    OK(CALL(scene_counts)(scene, &vertex_count, &face_count));
    CHECK(vertex_count == 8 && face_count == 12);
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 3; k++) {
            moved[i][k] = 2 * CUBE[i][k] + (real)k;
        }
    }
    OK(CALL(scene_refit)(scene, moved[0], sizeof moved[0], 8));
    OK(CALL(scene_bounds)(scene, lower, upper));
    CHECK(lower[0] == -2 && lower[2] == 0 && upper[0] == 2 && upper[2] == 4);
    hit_t hit;
    OK(CALL(closest1)(scene, &through[1], NULL, &hit));
    CHECK(hit.t == 1);
    CHECK(CALL(scene_free)(scene) == STACKLESS_ERROR_NONE);
}

/* Rays from a point with coordinates in thirds, on the face z = -1 of the cube, to another face. */
static void check_exact(void)
{
    scene_t *scene = cube();
    const ray_t down = {{0, 0, 2}, 0, {(real)0.25, (real)0.125, -3}, 1};
    const real corner[3] = {-1, -1, -1}, inside[3] = {0, 0, 0};
    point_t *bottom, *top, *middle, *vertex, *met;
    hit_t hit;
    bool is_hit;
    OK(CALL(closest1)(scene, &down, NULL, &hit));
    OK(CALL(point_of_hit)(scene, &down, hit.face, &top));
    const filter_t others = {.mask = UINT32_MAX, .skip = &hit.face};
    OK(CALL(closest1)(scene, &down, &others, &hit));
    OK(CALL(point_of_hit)(scene, &down, hit.face, &bottom));
    OK(CALL(point_new)(inside, &middle));
    OK(CALL(point_new)(corner, &vertex));
    const struct { exact_ray_t ray; bool is_hit; } rays[] = {
        {{bottom, top, {0, 0, 0}, 0, false}, false},
        {{bottom, top, {0, 0, 0}, 0, true}, true},
        {{middle, top, {0, 0, 0}, 0, false}, false},
        {{bottom, vertex, {0, 0, 0}, 0, false}, false},
        {{middle, vertex, {0, 0, 0}, 0, true}, true},
        {{bottom, NULL, {1, 2, 3}, (real)INFINITY, false}, true},
        {{bottom, NULL, {1, 2, -3}, (real)INFINITY, false}, false},
        {{bottom, NULL, {1, 2, -3}, (real)INFINITY, true}, true},
        {{bottom, NULL, {0, 0, 1}, 1, false}, false},
        {{bottom, NULL, {0, 0, 1}, 2, false}, false},
        {{bottom, NULL, {0, 0, 1}, 2, true}, true},
        {{bottom, NULL, {0, 0, 1}, 3, false}, true},
    };
    for (size_t i = 0; i < sizeof rays / sizeof rays[0]; i++) {
        OK(CALL(exact_any1)(scene, &rays[i].ray, NULL, &is_hit));
        OK(CALL(exact_closest1)(scene, &rays[i].ray, NULL, &hit, &met));
        CHECK(is_hit == rays[i].is_hit && (hit.face != STACKLESS_NO_FACE) == is_hit && (met != NULL) == is_hit);
        OK(CALL(exact_closest1)(scene, &rays[i].ray, NULL, &hit, NULL));
        CHECK((hit.face != STACKLESS_NO_FACE) == is_hit);
        OK(CALL(point_free)(met));
    }
    OK(CALL(exact_closest1)(scene, &rays[11].ray, NULL, &hit, &met));
    CHECK(hit.t == 2);
    /* The ray does not need its points, and a point does not need the scene. */
    OK(CALL(point_free)(bottom));
    OK(CALL(scene_free)(scene));
    scene = cube();
    const exact_ray_t back = {met, NULL, {0, 0, -1}, (real)INFINITY, false};
    OK(CALL(exact_closest1)(scene, &back, NULL, &hit, NULL));
    CHECK(hit.t == 2);
    real moved[8][3];
    for (int i = 0; i < 24; i++) {
        moved[i / 3][i % 3] = CUBE[i / 3][i % 3] * 2;
    }
    OK(CALL(scene_refit)(scene, moved[0], sizeof moved[0], 8));
    OK(CALL(exact_closest1)(scene, &back, NULL, &hit, NULL));
    CHECK(hit.t == 3);
    OK(CALL(point_free)(met));
    OK(CALL(point_free)(top));
    OK(CALL(point_free)(middle));
    OK(CALL(point_free)(vertex));
    OK(CALL(scene_free)(scene));
}

static void check_saved(const scene_t *scene, const char *file)
{
    scene_t *loaded, *read;
    size_t size, again;
    OK(CALL(scene_save)(scene, file));
    OK(CALL(scene_load)(file, 1, &loaded));
    OK(CALL(scene_to_bytes)(scene, NULL, 0, &size));
    uint8_t *bytes = malloc(size);
    OK(CALL(scene_to_bytes)(loaded, bytes, size, &again));
    CHECK(again == size);
    OK(CALL(scene_from_bytes)(bytes, size, 0, &read));
    free(bytes);
    batches(loaded, STACKLESS_SERIAL);
    batches(read, STACKLESS_PARALLEL);
    OK(CALL(scene_free)(loaded));
    OK(CALL(scene_free)(read));
}

/* Each thread has its own hits; all threads share the scene. */
static void *query(void *argument)
{
    const scene_t *scene = argument;
    hit_t *hits = malloc(RAYS * sizeof *hits);
    OK(CALL(closest_n)(scene, &rays[0].ray, sizeof rays[0], RAYS, NULL, 0, hits, sizeof *hits, STACKLESS_SERIAL));
    for (int i = 0; i < RAYS; i++) {
        CHECK(memcmp(&hits[i].face, &rays[i].hit.face, sizeof hits[i].face) == 0);
    }
    free(hits);
    scene_t *other = cube();
    OK(CALL(scene_free)(other));
    return NULL;
}

static void check_threads(scene_t *scene)
{
    pthread_t threads[THREADS];
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_create(&threads[i], NULL, query, scene) == 0);
    }
    for (int i = 0; i < THREADS; i++) {
        CHECK(pthread_join(threads[i], NULL) == 0);
    }
}

int main(int count, char **arguments)
{
    CHECK(count == 2);
    make();
    for (uint32_t quality = 0; quality <= STACKLESS_QUALITY_SPATIAL; quality++) {
        scene_t *scene = soup(quality, quality);
        batches(scene, quality % 2 ? STACKLESS_PARALLEL : STACKLESS_SERIAL);
        if (quality == STACKLESS_QUALITY_STANDARD) {
            check_saved(scene, arguments[1]);
            check_threads(scene);
        }
        filters(scene, quality % 2 ? STACKLESS_PARALLEL : STACKLESS_SERIAL);
        OK(CALL(scene_free)(scene));
    }
    check_cube();
    check_exact();
    return 0;
}
