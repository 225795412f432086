/* One source for both precisions: with -DSINGLE it calls the functions ending with _f. Also helpers. */
#ifndef CHECK_H
#define CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "stackless.h"

#ifdef SINGLE
typedef float real;
#define CALL(name) stackless_##name##_f
#else
typedef double real;
#define CALL(name) stackless_##name##_d
#endif
typedef CALL(scene) scene_t;
typedef CALL(ray) ray_t;
typedef CALL(hit) hit_t;
typedef CALL(near) near_t;
typedef CALL(filter) filter_t;
typedef CALL(point) point_t;
typedef CALL(exact_ray) exact_ray_t;
typedef CALL(exact_filter) exact_filter_t;
typedef CALL(object) object_t;
typedef CALL(instances) instances_t;
typedef CALL(instance_hit) instance_hit_t;
typedef CALL(instances_filter) instances_filter_t;
typedef CALL(instances_exact_filter) instances_exact_filter_t;

/* Ends the program if a condition does not hold. */
#define CHECK(condition) check((condition), #condition, __FILE__, __LINE__)

/* Expects a call to succeed. */
#define OK(call) expect((call), STACKLESS_ERROR_NONE, NULL, #call, __FILE__, __LINE__)

/* Expects a call to fail with a code, and a message that has this text. */
#define REFUSED(code, text, call) expect((call), STACKLESS_ERROR_##code, (text), #call, __FILE__, __LINE__)

#define INVALID(text, call) REFUSED(INVALID_ARGUMENT, text, call)

static inline void check(bool condition, const char *text, const char *file, int line)
{
    if (!condition) {
        fprintf(stderr, "%s:%d: %s does not hold\n", file, line, text);
        exit(1);
    }
}

static inline void expect(stackless_error found, stackless_error expected, const char *text, const char *call,
                          const char *file, int line)
{
    const char *message = stackless_error_message();
    if (found == expected && (text == NULL || strstr(message, text) != NULL)) {
        return;
    }
    fprintf(stderr, "%s:%d: %s\n  returned %d with the message: %s\n  expected %d: %s\n", file, line, call, (int)found,
            message, (int)expected, text ? text : "");
    exit(1);
}

/* The cube from -1 to 1, of 12 faces, counterclockwise seen from outside. */
static const real CUBE[8][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1},
                                {-1, -1, 1},  {1, -1, 1},  {-1, 1, 1},  {1, 1, 1}};
static const uint32_t CUBE_FACES[12][3] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                           {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};

static inline scene_t *cube(void)
{
    scene_t *scene;
    OK(CALL(scene_new)(CUBE[0], sizeof CUBE[0], 8, CUBE_FACES[0], sizeof CUBE_FACES[0], 12, NULL, &scene));
    return scene;
}

/* Deterministic numbers from 0 to n - 1. */
static inline int below(uint64_t *state, int n)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (int)((*state >> 33) % (uint64_t)n);
}

#endif
