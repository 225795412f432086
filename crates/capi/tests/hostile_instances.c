/* Invalid calls about instances fail with a code and a message that names the element. */
#include <math.h>

#include "check.h"

/* A misaligned pointer. */
#define MISALIGNED(type) ((type *)(void *)((char *)aligned + 1))
static double aligned[16];

static const real ONE[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
static const size_t OBJECT = sizeof(object_t), MAP = sizeof ONE;

int main(void)
{
    scene_t *scene = cube();
    const object_t object = {scene, NULL}, both = {scene, (const instances_t *)(const void *)aligned};
    const object_t bad[2] = {object, {NULL, NULL}}, misaligned[2] = {object, {NULL, MISALIGNED(instances_t)}};
    const uint32_t indices[3] = {0, 0, 1};
    const real *const map = ONE[0];
    const stackless_options quality = {.quality = 9};
    instances_t *made = (instances_t *)(void *)aligned;
    INVALID("instances: null", CALL(instances_new)(&object, OBJECT, 1, indices, 4, map, MAP, 1, NULL, NULL));
    INVALID("objects: null", CALL(instances_new)(NULL, OBJECT, 1, indices, 4, map, MAP, 1, NULL, &made));
    CHECK(made == NULL);
    INVALID("objects: address",
            CALL(instances_new)(MISALIGNED(object_t), OBJECT, 1, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("stride of objects: 8", CALL(instances_new)(&object, 8, 1, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("objects[0].scene: two objects",
            CALL(instances_new)(&both, OBJECT, 1, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("objects[1].scene: null", CALL(instances_new)(bad, OBJECT, 2, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("objects[1].instances: address",
            CALL(instances_new)(misaligned, OBJECT, 2, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("indices: null", CALL(instances_new)(&object, OBJECT, 1, NULL, 4, map, MAP, 1, NULL, &made));
    INVALID("stride of indices: 2", CALL(instances_new)(&object, OBJECT, 1, indices, 2, map, MAP, 1, NULL, &made));
    INVALID("transforms: null", CALL(instances_new)(&object, OBJECT, 1, indices, 4, NULL, MAP, 1, NULL, &made));
    INVALID("stride of transforms", CALL(instances_new)(&object, OBJECT, 1, indices, 4, map, MAP - 1, 1, NULL, &made));
    INVALID("count: 0, expected at least 1",
            CALL(instances_new)(&object, OBJECT, 1, indices, 4, map, MAP, 0, NULL, &made));
    INVALID("count: ", CALL(instances_new)(&object, OBJECT, 1, indices, 4, map, MAP, SIZE_MAX, NULL, &made));
    INVALID("object_count: ", CALL(instances_new)(&object, OBJECT, SIZE_MAX, indices, 4, map, MAP, 1, NULL, &made));
    INVALID("quality: 9", CALL(instances_new)(&object, OBJECT, 1, indices, 4, map, MAP, 1, &quality, &made));
    real maps[3][3][4];
    for (int i = 0; i < 3; i++) {
        memcpy(maps[i], ONE, sizeof ONE);
    }
    INVALID("indices[2]: 1, expected less than object_count, 1",
            CALL(instances_new)(&object, OBJECT, 1, indices, 4, maps[0][0], MAP, 3, NULL, &made));
    INVALID("indices[0]: 0", CALL(instances_new)(NULL, OBJECT, 0, indices, 4, maps[0][0], MAP, 3, NULL, &made));
    maps[1][2][3] = (real)NAN;
    INVALID("transforms[1]: row 2, column 3: NaN, expected a finite number",
            CALL(instances_new)(&object, OBJECT, 1, indices, 4, maps[0][0], MAP, 2, NULL, &made));
    maps[1][2][3] = 0;
    maps[1][1][1] = 0;
    INVALID("transforms[1]: the determinant is 0",
            CALL(instances_new)(&object, OBJECT, 1, indices, 4, maps[0][0], MAP, 2, NULL, &made));
    maps[1][1][1] = sizeof(real) == 4 ? (real)3e38 : (real)1.5e308;
    maps[1][1][3] = maps[1][1][1];
    INVALID("transforms[1]: the image of its object leaves the range of floats",
            CALL(instances_new)(&object, OBJECT, 1, indices, 4, maps[0][0], MAP, 2, NULL, &made));
    CHECK(made == NULL);
    OK(CALL(instances_free)(NULL));
    INVALID("instances: address", CALL(instances_free)(MISALIGNED(instances_t)));
    /* As many levels as a path has numbers, and one more. */
    object_t outer = object;
    instances_t *levels[STACKLESS_MAX_LEVELS];
    for (int i = 0; i < STACKLESS_MAX_LEVELS; i++) {
        OK(CALL(instances_new)(&outer, OBJECT, 1, indices, 4, map, MAP, 1, NULL, &levels[i]));
        outer = (object_t){NULL, levels[i]};
    }
    INVALID("objects[0].instances: 8 levels of groups, expected at most 7",
            CALL(instances_new)(&outer, OBJECT, 1, indices, 4, map, MAP, 1, NULL, &made));
    const instances_t *const deepest = levels[STACKLESS_MAX_LEVELS - 1];
    const ray_t ray = {{0, 0, 0}, 0, {1, 0, 0}, (real)INFINITY}, nan = {{0, (real)NAN, 0}, 0, {1, 0, 0}, 1};
    const ray_t rays[2] = {ray, nan};
    const instances_filter_t skips = {.mask = 1, .skip = MISALIGNED(instance_hit_t)};
    instance_hit_t hits[2], *hit = hits;
    const size_t stride = sizeof hits[0];
    bool found[2];
    size_t count;
    real corner[3];
    OK(CALL(instances_closest1)(deepest, &ray, NULL, hit));
    CHECK(hit->t == 1 && hit->levels == 8 && hit->path[7] == 0);
    /* The path of a filter may be invalid: then nothing is skipped. */
    hit->levels = 99;
    const instances_filter_t invalid = {.mask = 1, .skip = hit};
    OK(CALL(instances_closest1)(deepest, &ray, &invalid, hit));
    CHECK(hit->t == 1 && hit->levels == 8);
    INVALID("instances: null", CALL(instances_closest1)(NULL, &ray, NULL, hit));
    INVALID("ray: null", CALL(instances_closest1)(deepest, NULL, NULL, hit));
    INVALID("hit: null", CALL(instances_closest1)(deepest, &ray, NULL, NULL));
    INVALID("hit: address", CALL(instances_closest1)(deepest, &ray, NULL, MISALIGNED(instance_hit_t)));
    INVALID("ray.origin: [0, NaN, 0]", CALL(instances_closest1)(deepest, &nan, NULL, hit));
    INVALID("filter.skip: address", CALL(instances_closest1)(deepest, &ray, &skips, hit));
    INVALID("is_hit: null", CALL(instances_any1)(deepest, &ray, NULL, NULL));
    INVALID("count: null", CALL(instances_all1)(deepest, &ray, NULL, hits, stride, 2, NULL));
    INVALID("stride of hits", CALL(instances_all1)(deepest, &ray, NULL, hits, stride - 4, 2, &count));
    OK(CALL(instances_all1)(deepest, &ray, NULL, NULL, 0, 0, &count));
    CHECK(count == 2);
    INVALID("rays[1].origin: [0, NaN, 0]",
            CALL(instances_closest_n)(deepest, rays, sizeof ray, 2, NULL, 0, hits, stride, STACKLESS_PARALLEL));
    INVALID("rays[1]", CALL(instances_any_n)(deepest, rays, sizeof ray, 2, NULL, 0, found, 1, STACKLESS_SERIAL));
    INVALID("flags: 2", CALL(instances_any_n)(deepest, rays, sizeof ray, 2, NULL, 0, found, 1, 2));
    INVALID("lower: null", CALL(instances_bounds)(deepest, NULL, corner));
    const exact_ray_t nowhere = {NULL, NULL, {1, 0, 0}, 1, false};
    INVALID("ray.origin: null", CALL(instances_exact_closest1)(deepest, &nowhere, NULL, hit, NULL));
    INVALID("rays[0].origin: null",
            CALL(instances_exact_any_n)(deepest, &nowhere, sizeof nowhere, 1, NULL, 0, found, 1, STACKLESS_SERIAL));
    for (int i = 0; i < STACKLESS_MAX_LEVELS; i++) {
        OK(CALL(instances_free)(levels[i]));
    }
    OK(CALL(scene_free)(scene));
    return 0;
}
