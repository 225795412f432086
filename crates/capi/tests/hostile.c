/* Invalid calls fail with a code and a message that names the element, and write no other memory. */
#include <fenv.h>
#include <math.h>

#include "check.h"

static const ray_t RAY = {{0, 0, 0}, 0, {1, 0, 0}, (real)INFINITY};
static const size_t VERTEX = sizeof(real[3]), FACE = sizeof(uint32_t[3]);
static const real *const V = CUBE[0];
static const uint32_t *const F = CUBE_FACES[0];

/* A misaligned pointer. */
#define MISALIGNED(type) ((type *)(void *)((char *)aligned + 1))
static double aligned[64];

static void builds(void)
{
    scene_t *scene = (scene_t *)(void *)aligned;
    const stackless_options quality = {.quality = 9}, threads = {.threads = 100000};
    INVALID("scene: null", CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, NULL, NULL));
    INVALID("scene: address 0x", CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, NULL, MISALIGNED(scene_t *)));
    INVALID("vertices: null", CALL(scene_new)(NULL, VERTEX, 8, F, FACE, 12, NULL, &scene));
    CHECK(scene == NULL);
    INVALID("faces: null", CALL(scene_new)(V, VERTEX, 8, NULL, FACE, 12, NULL, &scene));
    INVALID("stride of vertices: 0,", CALL(scene_new)(V, 0, 8, F, FACE, 12, NULL, &scene));
    INVALID("stride of vertices: ", CALL(scene_new)(V, VERTEX - 1, 8, F, FACE, 12, NULL, &scene));
    INVALID("stride of faces: 11, expected a multiple of 1 that is at least 12",
            CALL(scene_new)(V, VERTEX, 8, F, FACE - 1, 12, NULL, &scene));
    INVALID("vertices: 8 elements", CALL(scene_new)(V, SIZE_MAX / 2, 8, F, FACE, 12, NULL, &scene));
    INVALID("faces: 12 elements", CALL(scene_new)(V, VERTEX, 8, F, SIZE_MAX / 11, 12, NULL, &scene));
    INVALID("vertex_count: ", CALL(scene_new)(V, VERTEX, SIZE_MAX, F, FACE, 12, NULL, &scene));
    INVALID("face_count: 2147483648", CALL(scene_new)(V, VERTEX, 8, F, FACE, 2147483648u, NULL, &scene));
    INVALID("face_count: 0", CALL(scene_new)(V, VERTEX, 8, F, FACE, 0, NULL, &scene));
    INVALID("face_count: 0", CALL(scene_new)(NULL, 0, 0, NULL, 0, 0, NULL, &scene));
    INVALID("faces[0]: index 0", CALL(scene_new)(NULL, 0, 0, F, FACE, 12, NULL, &scene));
    INVALID("faces[1]: index 7, expected less than vertex_count, 7",
            CALL(scene_new)(V, VERTEX, 7, F + 3, FACE, 11, NULL, &scene));
    INVALID("quality: 9", CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, &quality, &scene));
    INVALID("threads: 100000", CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, &threads, &scene));
    INVALID("options: address",
            CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, MISALIGNED(stackless_options), &scene));
    CHECK(scene == NULL);
    const double values[3] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    const char *texts[3] = {"vertices[5]: [1, NaN, 1], expected", "vertices[5]: [1, inf", "vertices[5]: [1, -inf"};
    for (int i = 0; i < 3; i++) {
        real bad[8][3];
        memcpy(bad, CUBE, sizeof bad);
        bad[5][1] = (real)values[i];
        INVALID(texts[i], CALL(scene_new)(bad[0], VERTEX, 8, F, FACE, 12, NULL, &scene));
    }
    OK(CALL(scene_free)(NULL));
    INVALID("scene: address", CALL(scene_free)(MISALIGNED(scene_t)));
}

static void single_rays(const scene_t *scene)
{
    hit_t hit = {0};
    bool is_hit;
    INVALID("scene: null", CALL(closest1)(NULL, &RAY, NULL, &hit));
    INVALID("ray: null", CALL(closest1)(scene, NULL, NULL, &hit));
    INVALID("hit: null", CALL(closest1)(scene, &RAY, NULL, NULL));
    INVALID("ray: address", CALL(closest1)(scene, MISALIGNED(ray_t), NULL, &hit));
    INVALID("hit: address", CALL(closest1)(scene, &RAY, NULL, MISALIGNED(hit_t)));
    INVALID("scene: null", CALL(any1)(NULL, &RAY, NULL, &is_hit));
    INVALID("is_hit: null", CALL(any1)(scene, &RAY, NULL, NULL));
    struct { ray_t ray; const char *text; } rays[] = {
        {{{(real)NAN, 0, 0}, 0, {1, 0, 0}, 1}, "ray.origin: [NaN, 0, 0], expected finite"},
        {{{0, 0, 0}, 0, {1, (real)INFINITY, 0}, 1}, "ray.direction: [1, inf, 0], expected finite"},
        {{{0, 0, 0}, 0, {0, 0, 0}, 1}, "ray.direction: [0, 0, 0]"},
        {{{0, 0, 0}, -1, {1, 0, 0}, 1}, "ray.tmin: -1, expected at least 0"},
        {{{0, 0, 0}, (real)INFINITY, {1, 0, 0}, (real)INFINITY}, "ray: tmin inf, tmax inf"},
        {{{0, 0, 0}, 0, {1, 0, 0}, (real)NAN}, "ray: tmin 0, tmax NaN"},
        {{{0, 0, 0}, 2, {1, 0, 0}, 1}, "ray.tmax: 1, expected at least tmin, 2"},
    };
    for (size_t i = 0; i < sizeof rays / sizeof rays[0]; i++) {
        INVALID(rays[i].text, CALL(closest1)(scene, &rays[i].ray, NULL, &hit));
        INVALID(rays[i].text, CALL(any1)(scene, &rays[i].ray, NULL, &is_hit));
        /* In the middle of a batch, for any number of threads. */
        ray_t batch[600];
        bool found[600];
        for (size_t j = 0; j < 600; j++) {
            batch[j] = j == 300 || j == 599 ? rays[i].ray : RAY;
        }
        for (uint32_t flags = 0; flags < 2; flags++) {
            INVALID("rays[300]", CALL(any_n)(scene, batch, sizeof batch[0], 600, NULL, 0, found, 1, flags));
        }
    }
    hit_t after = {0, 0, 0, STACKLESS_NO_FACE};
    INVALID("after: t 0, face 4294967295", CALL(next1)(scene, &RAY, &after, &hit));
    after = (hit_t){(real)NAN, 0, 0, 0};
    INVALID("after: t NaN, face 0", CALL(next1)(scene, &RAY, &after, &hit));
    INVALID("after: null", CALL(next1)(scene, &RAY, NULL, &hit));
}

static void filters(scene_t *scene)
{
    const filter_t filter = {.mask = 1}, misaligned = {.mask = 1, .skip = MISALIGNED(uint32_t)};
    const ray_t rays[2] = {RAY, RAY};
    const uint32_t masks[12] = {0};
    hit_t hits[2];
    const size_t ray = sizeof(ray_t), hit = sizeof(hit_t);
    INVALID("filter: address", CALL(closest1)(scene, &RAY, MISALIGNED(filter_t), hits));
    INVALID("filter.skip: address", CALL(closest1)(scene, &RAY, &misaligned, hits));
    INVALID("filter.skip: address", CALL(closest_n)(scene, rays, ray, 2, &misaligned, 0, hits, hit, 0));
    INVALID("filter: address", CALL(closest_n)(scene, rays, ray, 2, MISALIGNED(filter_t), 0, hits, hit, 0));
    INVALID("stride of filters: 4", CALL(closest_n)(scene, rays, ray, 2, &filter, 4, hits, hit, 0));
    INVALID("filters: 2 elements", CALL(closest_n)(scene, rays, ray, 2, &filter, SIZE_MAX / 16 * 8, hits, hit, 0));
    INVALID("masks: null", CALL(scene_set_masks)(scene, NULL, 4, 12));
    INVALID("stride of masks: 2", CALL(scene_set_masks)(scene, masks, 2, 12));
    INVALID("face_count: 11, expected 12", CALL(scene_set_masks)(scene, masks, 4, 11));
    INVALID("scene: null", CALL(scene_set_masks)(NULL, masks, 4, 12));
    INVALID("face_count", CALL(scene_set_masks)(scene, masks, 4, SIZE_MAX));
    /* In a new scene all bits are set: any bit of a filter is in common, and no bit is not. */
    const filter_t no_bit = {.mask = 0};
    OK(CALL(closest1)(scene, &RAY, &no_bit, hits));
    CHECK(hits[0].face == STACKLESS_NO_FACE);
    OK(CALL(closest1)(scene, &RAY, &filter, hits));
    CHECK(hits[0].face != STACKLESS_NO_FACE);
    /* A mask of 0 accepts no face; without a filter all faces are accepted. */
    OK(CALL(scene_set_masks)(scene, masks, 4, 12));
    const filter_t all = {.mask = UINT32_MAX};
    OK(CALL(closest1)(scene, &RAY, &all, hits));
    CHECK(hits[0].face == STACKLESS_NO_FACE);
    OK(CALL(closest1)(scene, &RAY, NULL, hits));
    CHECK(hits[0].face != STACKLESS_NO_FACE);
}

static void exact(const scene_t *scene)
{
    const real bad[3] = {0, (real)NAN, 0}, zero[3] = {0, 0, 0};
    point_t *point = (point_t *)(void *)aligned;
    hit_t hit;
    bool is_hit;
    INVALID("coordinates: [0, NaN, 0], expected finite", CALL(point_new)(bad, &point));
    CHECK(point == NULL);
    INVALID("coordinates: null", CALL(point_new)(NULL, &point));
    INVALID("point: null", CALL(point_new)(zero, NULL));
    INVALID("face: 12, expected one of 12", CALL(point_of_hit)(scene, &RAY, 12, &point));
    INVALID("does not hit face 0", CALL(point_of_hit)(scene, &RAY, 0, &point));
    INVALID("ray: null", CALL(point_of_hit)(scene, NULL, 0, &point));
    INVALID("scene: null", CALL(point_of_hit)(NULL, &RAY, 0, &point));
    OK(CALL(point_free)(NULL));
    INVALID("point: address", CALL(point_free)(MISALIGNED(point_t)));
    OK(CALL(point_new)(zero, &point));
    const struct { exact_ray_t ray; const char *text; } rays[] = {
        {{NULL, NULL, {1, 0, 0}, 1, false}, "ray.origin: null"},
        {{MISALIGNED(point_t), NULL, {1, 0, 0}, 1, false}, "ray.origin: address"},
        {{point, MISALIGNED(point_t), {1, 0, 0}, 1, false}, "ray.target: address"},
        {{point, point, {1, 0, 0}, 1, false}, "ray.target: the point is the origin"},
        {{point, NULL, {0, 0, 0}, 1, false}, "ray.direction: [0, 0, 0]"},
        {{point, NULL, {(real)NAN, 0, 0}, 1, false}, "ray.direction: [NaN, 0, 0]"},
        {{point, NULL, {1, 0, 0}, -1, true}, "ray.tmax: -1"},
        {{point, NULL, {1, 0, 0}, (real)NAN, true}, "tmax NaN"},
    };
    const exact_ray_t ray = {point, NULL, {1, 0, 0}, 1, true};
    const size_t size = sizeof ray;
    for (size_t i = 0; i < sizeof rays / sizeof rays[0]; i++) {
        INVALID(rays[i].text, CALL(exact_any1)(scene, &rays[i].ray, NULL, &is_hit));
        INVALID(rays[i].text, CALL(exact_closest1)(scene, &rays[i].ray, NULL, &hit, NULL));
        /* The last ray of a batch: no point is created. */
        exact_ray_t batch[600];
        hit_t hits[600];
        point_t *points[600];
        for (size_t j = 0; j < 600; j++) {
            batch[j] = j == 599 ? rays[i].ray : ray;
            points[j] = (point_t *)(void *)aligned;
        }
        char text[64];
        snprintf(text, sizeof text, "rays[599]%s", rays[i].text[0] == 'r' ? rays[i].text + 3 : "");
        for (uint32_t flags = 0; flags < 2; flags++) {
            INVALID(text, CALL(exact_closest_n)(scene, batch, size, 600, NULL, 0, hits, sizeof hit, points,
                                                sizeof points[0], flags));
            for (size_t j = 0; j < 600; j++) {
                CHECK(points[j] == NULL);
            }
            INVALID(text, CALL(exact_any_n)(scene, batch, size, 600, NULL, 0, &is_hit, sizeof hit, flags));
        }
    }
    const exact_filter_t misaligned = {.mask = 1, .skip = MISALIGNED(uint32_t)};
    INVALID("scene: null", CALL(exact_any1)(NULL, &ray, NULL, &is_hit));
    INVALID("hit: null", CALL(exact_closest1)(scene, &ray, NULL, NULL, NULL));
    INVALID("point: address", CALL(exact_closest1)(scene, &ray, NULL, &hit, MISALIGNED(point_t *)));
    INVALID("filter.skip: address", CALL(exact_closest1)(scene, &ray, &misaligned, &hit, NULL));
    INVALID("filter: address", CALL(exact_any1)(scene, &ray, MISALIGNED(exact_filter_t), &is_hit));
    INVALID("stride of rays", CALL(exact_any_n)(scene, &ray, size - 1, 1, NULL, 0, &is_hit, 1, 0));
    INVALID("stride of points: 4",
            CALL(exact_closest_n)(scene, &ray, size, 1, NULL, 0, &hit, sizeof hit, &point, 4, 0));
    INVALID("hits: null", CALL(exact_closest_n)(scene, &ray, size, 1, NULL, 0, NULL, sizeof hit, NULL, 0, 0));
    INVALID("flags: 2", CALL(exact_any_n)(scene, &ray, size, 1, NULL, 0, &is_hit, 1, 2));
    OK(CALL(exact_closest_n)(scene, NULL, 0, 0, NULL, 0, NULL, 0, NULL, 0, STACKLESS_PARALLEL));
    OK(CALL(point_free)(point));
}

static void batches(const scene_t *scene)
{
    ray_t rays[4] = {RAY, RAY, RAY, RAY};
    hit_t hits[4];
    bool found[4];
    uint32_t counts[4];
    uint8_t places[4];
    near_t nears[4];
    const size_t ray = sizeof(ray_t), hit = sizeof(hit_t), align = sizeof(real);
    OK(CALL(closest_n)(scene, NULL, 0, 0, NULL, 0, NULL, 0, STACKLESS_PARALLEL));
    INVALID("flags: 2", CALL(closest_n)(scene, rays, ray, 4, NULL, 0, hits, hit, 2));
    INVALID("rays: null", CALL(closest_n)(scene, NULL, ray, 4, NULL, 0, hits, hit, 0));
    INVALID("hits: null", CALL(closest_n)(scene, rays, ray, 4, NULL, 0, NULL, hit, 0));
    INVALID("scene: null", CALL(closest_n)(NULL, rays, ray, 4, NULL, 0, hits, hit, 0));
    INVALID("rays: address", CALL(closest_n)(scene, MISALIGNED(ray_t), ray, 4, NULL, 0, hits, hit, 0));
    const size_t strides[] = {0, 1, align, ray - align, ray + 1, ray + align - 1, SIZE_MAX};
    for (size_t i = 0; i < sizeof strides / sizeof strides[0]; i++) {
        INVALID("stride of rays", CALL(closest_n)(scene, rays, strides[i], 4, NULL, 0, hits, hit, 0));
    }
    INVALID("stride of hits", CALL(closest_n)(scene, rays, ray, 4, NULL, 0, hits, hit - align, 0));
    INVALID("rays: 4 elements", CALL(closest_n)(scene, rays, SIZE_MAX / 4 / 8 * 8 + 8, 4, NULL, 0, hits, hit, 0));
    INVALID("elements", CALL(closest_n)(scene, rays, ray, SIZE_MAX, NULL, 0, hits, hit, 0));
    INVALID("elements", CALL(any_n)(scene, rays, ray, SIZE_MAX / ray, NULL, 0, found, 1, STACKLESS_PARALLEL));
    INVALID("stride of is_hit: 0", CALL(any_n)(scene, rays, ray, 4, NULL, 0, found, 0, 0));
    INVALID("stride of crossings: 2", CALL(crossings_n)(scene, rays, ray, 4, counts, 2, 0));
    real points[4][3] = {{0}};
    INVALID("rule: 3", CALL(locate_n)(scene, points[0], VERTEX, 4, 3, places, 1, 0));
    INVALID("stride of points", CALL(locate_n)(scene, points[0], VERTEX - 1, 4, 0, places, 1, 0));
    real distances[4];
    INVALID("rule: 9", CALL(signed_distances_n)(scene, points[0], VERTEX, 4, 9, distances, sizeof(real), 0));
    INVALID("stride of distances: 1", CALL(signed_distances_n)(scene, points[0], VERTEX, 4, 0, distances, 1, 0));
    INVALID("distances: null", CALL(signed_distances_n)(scene, points[0], VERTEX, 4, 0, NULL, sizeof(real), 0));
    INVALID("radius: -1", CALL(nearest_n)(scene, points[0], VERTEX, 4, -1, nears, sizeof nears[0], 0));
    INVALID("radius: NaN",
            CALL(nearest_n)(scene, points[0], VERTEX, 4, (real)NAN, nears, sizeof nears[0], 0));
    size_t count;
    INVALID("radius: -1", CALL(nearest_k1)(scene, points[0], -1, nears, sizeof nears[0], 4, &count));
    INVALID("stride of nears", CALL(nearest_k1)(scene, points[0], 1, nears, 1, 4, &count));
    INVALID("count: null", CALL(nearest_k1)(scene, points[0], 1, nears, sizeof nears[0], 4, NULL));
    INVALID("nears: ", CALL(nearest_k1)(scene, points[0], 1, nears, sizeof nears[0], SIZE_MAX, &count));
    points[2][1] = (real)NAN;
    INVALID("point: [0, NaN, 0]", CALL(nearest_k1)(scene, points[2], 1, nears, sizeof nears[0], 4, &count));
    INVALID("points[2]: [0, NaN, 0]", CALL(locate_n)(scene, points[0], VERTEX, 4, 0, places, 1, 0));
    INVALID("points[2]: [0, NaN, 0]",
            CALL(signed_distances_n)(scene, points[0], VERTEX, 4, 0, distances, sizeof(real), 0));
    INVALID("points[2]: [0, NaN, 0]",
            CALL(nearest_n)(scene, points[0], VERTEX, 4, 1, nears, sizeof nears[0], 0));
}

/* Results beyond the capacity are not written; the count includes them. */
static void small_buffers(const scene_t *scene)
{
    const ray_t ray = {{0, 0, -3}, 0, {0, 0, 1}, (real)INFINITY};
    size_t count = 0, size = 0;
    OK(CALL(all1)(scene, &ray, NULL, NULL, 0, 0, &count));
    CHECK(count == 4);
    for (size_t capacity = 1; capacity <= 5; capacity++) {
        hit_t *hits = malloc(capacity * sizeof *hits);
        OK(CALL(all1)(scene, &ray, NULL, hits, sizeof *hits, capacity, &count));
        CHECK(count == 4 && hits[0].t == 2 && hits[capacity < 4 ? capacity - 1 : 3].face < 12);
        free(hits);
    }
    INVALID("count: null", CALL(all1)(scene, &ray, NULL, NULL, 0, 0, NULL));
    OK(CALL(scene_to_bytes)(scene, NULL, 0, &size));
    for (size_t capacity = 0; capacity <= size; capacity += size / 4) {
        uint8_t *bytes = malloc(capacity + 1), *all = malloc(size);
        bytes[capacity] = 99;
        OK(CALL(scene_to_bytes)(scene, bytes, capacity, &count));
        OK(CALL(scene_to_bytes)(scene, all, size, &count));
        CHECK(count == size && bytes[capacity] == 99 && memcmp(bytes, all, capacity) == 0);
        free(bytes);
        free(all);
    }
    INVALID("size: null", CALL(scene_to_bytes)(scene, NULL, 0, NULL));
}

static void garbage(const scene_t *scene, const char *folder)
{
    scene_t *read = (scene_t *)(void *)aligned;
    size_t size;
    OK(CALL(scene_to_bytes)(scene, NULL, 0, &size));
    uint8_t *bytes = malloc(size);
    OK(CALL(scene_to_bytes)(scene, bytes, size, &size));
    for (size_t i = 0; i < size; i += 1 + i / 64) {
        uint8_t *part = malloc(i + 1);
        memcpy(part, bytes, i);
        REFUSED(INVALID_DATA, "", CALL(scene_from_bytes)(part, i, 1, &read));
        CHECK(read == NULL);
        free(part);
        bytes[i] ^= 0x11;
        REFUSED(INVALID_DATA, "", CALL(scene_from_bytes)(bytes, size, 1, &read));
        bytes[i] ^= 0x11;
    }
    REFUSED(INVALID_DATA, "does not begin with", CALL(scene_from_bytes)(NULL, 0, 1, &read));
    INVALID("bytes: null", CALL(scene_from_bytes)(NULL, 9, 1, &read));
    INVALID("bytes: ", CALL(scene_from_bytes)(bytes, SIZE_MAX, 1, &read));
    INVALID("scene: null", CALL(scene_from_bytes)(bytes, size, 1, NULL));
    /* A scene of the other precision. */
    bytes[12] ^= 4 ^ 8;
    REFUSED(INVALID_DATA, "coordinates of", CALL(scene_from_bytes)(bytes, size, 1, &read));
    free(bytes);
    char file[4096];
    snprintf(file, sizeof file, "%s/none/scene", folder);
    REFUSED(FILE, "none/scene: ", CALL(scene_load)(file, 1, &read));
    REFUSED(FILE, "none/scene: ", CALL(scene_save)(scene, file));
    REFUSED(FILE, "", CALL(scene_load)(folder, 1, &read));
    INVALID("file: null", CALL(scene_load)(NULL, 1, &read));
    INVALID("file: null", CALL(scene_save)(scene, NULL));
    INVALID("expected UTF-8", CALL(scene_save)(scene, "\xff"));
    REFUSED(INVALID_DATA, "/dev/null: ", CALL(scene_load)("/dev/null", 1, &read));
}

/* A cube without its last side has no inside, but a nearest point; and a refit needs an equal number of vertices. */
static void meshes(void)
{
    scene_t *scene;
    uint8_t place;
    const real point[3] = {0, 0, 0};
    OK(CALL(scene_new)(V, VERTEX, 8, F, FACE, 10, NULL, &scene));
    REFUSED(UNSUITABLE_MESH, "the mesh is open: 4 edges",
            CALL(locate_n)(scene, point, VERTEX, 1, STACKLESS_RULE_PARITY, &place, 1, 0));
    OK(CALL(locate_n)(scene, point, VERTEX, 1, STACKLESS_RULE_WINDING, &place, 1, 0));
    CHECK(place == STACKLESS_INSIDE);
    INVALID("vertex_count: 7, expected 8", CALL(scene_refit)(scene, V, VERTEX, 7));
    INVALID("vertices: null", CALL(scene_refit)(scene, NULL, VERTEX, 8));
    INVALID("scene: null", CALL(scene_refit)(NULL, V, VERTEX, 8));
    real bad[8][3] = {{0}};
    bad[7][2] = (real)INFINITY;
    INVALID("vertices[7]: [0, 0, inf]", CALL(scene_refit)(scene, bad[0], VERTEX, 8));
    hit_t hit;
    OK(CALL(closest1)(scene, &RAY, NULL, &hit));
    CHECK(hit.t == 1);
    OK(CALL(scene_counts)(scene, NULL, NULL));
    INVALID("scene: null", CALL(scene_counts)(NULL, NULL, NULL));
    INVALID("lower: null", CALL(scene_bounds)(scene, NULL, bad[0]));
    INVALID("upper: null", CALL(scene_bounds)(scene, bad[0], NULL));
    OK(CALL(scene_free)(scene));
}

/* A refit examines the edges again. Here each face has its own vertices, and one vertex moves away. */
static void opened_by_refit(void)
{
    scene_t *scene;
    real corners[36][3];
    uint32_t faces[12][3];
    uint8_t place;
    const real point[3] = {0, 0, 0};
    for (uint32_t i = 0; i < 36; i++) {
        memcpy(corners[i], CUBE[CUBE_FACES[i / 3][i % 3]], sizeof corners[i]);
        faces[i / 3][i % 3] = i;
    }
    OK(CALL(scene_new)(corners[0], VERTEX, 36, faces[0], FACE, 12, NULL, &scene));
    OK(CALL(locate_n)(scene, point, VERTEX, 1, STACKLESS_RULE_NONZERO, &place, 1, 0));
    CHECK(place == STACKLESS_INSIDE);
    corners[35][0] += 1;
    OK(CALL(scene_refit)(scene, corners[0], VERTEX, 36));
    REFUSED(UNSUITABLE_MESH, "the mesh is open",
            CALL(locate_n)(scene, point, VERTEX, 1, STACKLESS_RULE_NONZERO, &place, 1, 0));
    OK(CALL(scene_free)(scene));
}

/* Valgrind does not support other rounding modes. */
static void roundings(scene_t *scene)
{
    hit_t hit;
    scene_t *other;
    CHECK(fesetround(FE_UPWARD) == 0);
    REFUSED(FLOAT_ENVIRONMENT, "round to the nearest", CALL(closest1)(scene, &RAY, NULL, &hit));
    REFUSED(FLOAT_ENVIRONMENT, "", CALL(closest_n)(scene, &RAY, sizeof RAY, 1, NULL, 0, &hit, sizeof hit, 0));
    REFUSED(FLOAT_ENVIRONMENT, "", CALL(scene_new)(V, VERTEX, 8, F, FACE, 12, NULL, &other));
    CHECK(fesetround(FE_TONEAREST) == 0);
    OK(CALL(closest1)(scene, &RAY, NULL, &hit));
}

int main(int count, char **arguments)
{
    CHECK(count >= 2 && stackless_error_message()[0] == 0);
    scene_t *scene = cube();
    builds();
    single_rays(scene);
    batches(scene);
    filters(scene);
    exact(scene);
    small_buffers(scene);
    garbage(scene, arguments[1]);
    meshes();
    opened_by_refit();
    if (count == 2) {
        roundings(scene);
    }
    OK(CALL(scene_free)(scene));
    return 0;
}
