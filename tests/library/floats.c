/*
 * Preloaded into a program, sets how its threads compute with floats, as a library compiled with -ffast-math does.
 * The variable FLOATS has the bits that are set in MXCSR, for each thread in the order in which they are started; the
 * last ones are for all further threads.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <xmmintrin.h>

struct start {
    void *(*run)(void *);
    void *argument;
};

static void *run(void *given)
{
    static atomic_int started;
    struct start start = *(struct start *)given;
    free(given);
    char *list = getenv("FLOATS"), *rest = list;
    unsigned bits = 0;
    for (int i = atomic_fetch_add(&started, 1); list && i >= 0 && *rest; i--)
        bits = (unsigned)strtoul(rest, &rest, 16);
    _mm_setcsr(0x1F80 | bits);
    return start.run(start.argument);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*routine)(void *), void *argument)
{
    int (*create)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    *(void **)&create = dlsym(RTLD_NEXT, "pthread_create");
    struct start *start = malloc(sizeof *start);
    if (!start)
        abort();
    *start = (struct start){routine, argument};
    return create(thread, attributes, run, start);
}
