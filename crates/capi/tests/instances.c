/* Instances, and batches and filters of exact rays.
 *
 * Transforms here are exact in floats, so that a scene of all moved faces, in the order of paths, has the same hits bit
 * for bit. */
#include <math.h>

#include "check.h"

enum { SOUP = 40, RAYS = 1500, MOST = 4000 };

/* A placed part: a mesh, or a group that comes before it. */
typedef struct { int part; real map[3][4]; } placed_t;
typedef struct { int count; placed_t placed[4]; } group_t;
typedef struct { uint32_t path[3], levels, face; } origin_t;

static real corners[2][3 * SOUP][3];
static uint32_t soup_faces[SOUP][3];
static const int FACE_COUNTS[2] = {SOUP, 12};
static group_t groups[3];

static real flat[3 * MOST][3];
static uint32_t flat_faces[MOST][3];
static uint32_t flat_masks[MOST];
static origin_t origins[MOST];
static uint32_t flat_count;

typedef struct { ray_t ray; instances_filter_t filter; filter_t flat_filter; instance_hit_t hit; bool is_hit; } asked_t;
static asked_t asked[RAYS];

/* The masks of the soup; the cube has none. */
static uint32_t mask_of(uint32_t face)
{
    return 1u << face % 3;
}

static void make(uint64_t *state)
{
    for (int i = 0; i < 3 * SOUP; i++) {
        soup_faces[i / 3][i % 3] = (uint32_t)i;
        for (int k = 0; k < 3; k++) {
            corners[0][i][k] = (real)(below(state, 9) - 4);
        }
    }
    for (int i = 0; i < 36; i++) {
        memcpy(corners[1][i], CUBE[CUBE_FACES[i / 3][i % 3]], sizeof corners[1][i]);
    }
    /* Parts 0 and 1 are meshes, part 2 + i is group i. */
    const int parts[3][4] = {{0, 1, 0, 1}, {2, 0, 2, 1}, {3, 1, 2, 0}};
    for (int g = 0; g < 3; g++) {
        groups[g].count = 4;
        for (int i = 0; i < 4; i++) {
            placed_t *placed = &groups[g].placed[i];
            *placed = (placed_t){.part = parts[g][i]};
            const int turn = below(state, 3);
            for (int k = 0; k < 3; k++) {
                const real scales[4] = {1, (real)0.5, -1, 2};
                placed->map[k][(k + turn) % 3] = scales[below(state, 4)];
                placed->map[k][3] = (real)(below(state, 17) - 8) / 2;
            }
            /* A shear. */
            if (i == 2) {
                placed->map[0][(turn + 1) % 3] += placed->map[1][(turn + 1) % 3];
            }
        }
    }
    /* Coincident instances: of equal distances the least path comes first. */
    groups[1].placed[2] = groups[1].placed[0];
}

/* Adds the faces of a part, in the order of paths. Maps are outermost first. */
static void flatten(int part, uint32_t levels, const uint32_t *path, const placed_t **maps)
{
    if (part >= 2) {
        const group_t *group = &groups[part - 2];
        for (int i = 0; i < group->count; i++) {
            uint32_t inner[3];
            const placed_t *inner_maps[3];
            memcpy(inner, path, levels * sizeof inner[0]);
            memcpy(inner_maps, maps, levels * sizeof inner_maps[0]);
            inner[levels] = (uint32_t)i;
            inner_maps[levels] = &group->placed[i];
            flatten(group->placed[i].part, levels + 1, inner, inner_maps);
        }
        return;
    }
    for (int face = 0; face < FACE_COUNTS[part]; face++) {
        origin_t *origin = &origins[flat_count];
        *origin = (origin_t){.levels = levels, .face = (uint32_t)face};
        memcpy(origin->path, path, levels * sizeof path[0]);
        flat_masks[flat_count] = part == 0 ? mask_of((uint32_t)face) : UINT32_MAX;
        for (int corner = 0; corner < 3; corner++) {
            const uint32_t vertex = 3 * flat_count + (uint32_t)corner;
            real at[3];
            memcpy(at, corners[part][3 * face + corner], sizeof at);
            for (uint32_t level = levels; level-- > 0;) {
                real moved[3];
                for (int k = 0; k < 3; k++) {
                    const real *row = maps[level]->map[k];
                    moved[k] = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3];
                }
                memcpy(at, moved, sizeof at);
            }
            memcpy(flat[vertex], at, sizeof at);
            flat_faces[flat_count][corner] = vertex;
        }
        flat_count++;
        CHECK(flat_count < MOST);
    }
}

static instances_t *place(int group, const object_t *objects, size_t count)
{
    /* Indices and transforms in one structure, at unaligned addresses. */
    struct { uint32_t index; char tag[5]; char map[sizeof groups[0].placed[0].map]; } rows[4];
    for (int i = 0; i < groups[group].count; i++) {
        rows[i].index = (uint32_t)groups[group].placed[i].part;
        memcpy(rows[i].map, groups[group].placed[i].map, sizeof rows[i].map);
    }
    const stackless_options options = {.threads = (uint32_t)group, .quality = (uint32_t)group};
    instances_t *made;
    OK(CALL(instances_new)(objects, sizeof objects[0], count, &rows[0].index, sizeof rows[0],
                           (const real *)(const void *)rows[0].map, sizeof rows[0], 4, &options, &made));
    return made;
}

static scene_t *mesh(int part)
{
    scene_t *scene;
    OK(CALL(scene_new)(corners[part][0], sizeof corners[part][0], 3 * (size_t)FACE_COUNTS[part], soup_faces[0],
                       sizeof soup_faces[0], (size_t)FACE_COUNTS[part], NULL, &scene));
    return scene;
}

/* The outermost group of three. Everything that it consists of is destroyed or changed. */
static instances_t *nested(void)
{
    uint32_t masks[SOUP];
    scene_t *soup = mesh(0), *box = mesh(1);
    for (uint32_t face = 0; face < SOUP; face++) {
        masks[face] = mask_of(face);
    }
    OK(CALL(scene_set_masks)(soup, masks, sizeof masks[0], SOUP));
    object_t objects[5] = {{soup, NULL}, {box, NULL}, {soup, NULL}, {soup, NULL}, {soup, NULL}};
    instances_t *made[3];
    for (int group = 0; group < 3; group++) {
        made[group] = place(group, objects, (size_t)(2 + group));
        objects[2 + group] = (object_t){NULL, made[group]};
    }
    OK(CALL(instances_free)(made[0]));
    OK(CALL(instances_free)(made[1]));
    memset(masks, 0, sizeof masks);
    OK(CALL(scene_set_masks)(soup, masks, sizeof masks[0], SOUP));
    real moved[36][3] = {{0}};
    OK(CALL(scene_refit)(box, moved[0], sizeof moved[0], 36));
    OK(CALL(scene_free)(soup));
    OK(CALL(scene_free)(box));
    return made[2];
}

/* Bit for bit: the hit of an instance, and that of the scene of all faces. */
static bool equals(const instance_hit_t *hit, const hit_t *of)
{
    if (of->face == STACKLESS_NO_FACE || hit->face == STACKLESS_NO_FACE) {
        return of->face == hit->face && hit->levels == 0 && isinf(hit->t) && isnan(hit->u) && isnan(hit->v) &&
               hit->path[0] == UINT32_MAX;
    }
    const origin_t *origin = &origins[of->face];
    bool is_equal = hit->t == of->t && hit->u == of->u && hit->v == of->v && hit->face == origin->face &&
                    hit->levels == origin->levels;
    for (uint32_t level = 0; level < STACKLESS_MAX_LEVELS; level++) {
        is_equal = is_equal && hit->path[level] == (level < origin->levels ? origin->path[level] : UINT32_MAX);
    }
    return is_equal;
}

static bool accepts(void *user, const ray_t *ray, const instance_hit_t *hit)
{
    CHECK(ray == &((const asked_t *)user)->ray && hit->levels > 0);
    return hit->u <= hit->v;
}

static bool flat_accepts(void *user, const ray_t *ray, const hit_t *hit)
{
    CHECK(ray == &((const asked_t *)user)->ray);
    return hit->u <= hit->v;
}

static void make_rays(uint64_t *state)
{
    for (int i = 0; i < RAYS; i++) {
        ray_t *ray = &asked[i].ray;
        const real *corner = flat[below(state, 3 * (int)flat_count)];
        *ray = (ray_t){.tmin = (real)below(state, 2), .tmax = i % 3 ? (real)INFINITY : 2};
        while (ray->direction[0] == 0 && ray->direction[1] == 0 && ray->direction[2] == 0) {
            for (int k = 0; k < 3; k++) {
                ray->origin[k] = (real)(below(state, 65) - 32) / 2;
                /* To a corner, or anywhere. */
                ray->direction[k] = i % 2 ? corner[k] - ray->origin[k] : (real)(below(state, 9) - 4);
            }
        }
    }
}

/* All queries of a ray, with its filter or without one. Returns the number of hits. */
static size_t check_ray(const instances_t *placed, const scene_t *scene, const asked_t *it, bool is_filtered)
{
    static instance_hit_t hits[MOST];
    static hit_t expected[MOST];
    const instances_filter_t *filter = is_filtered ? &it->filter : NULL;
    size_t count, listed;
    bool is_hit;
    instance_hit_t hit;
    OK(CALL(all1)(scene, &it->ray, is_filtered ? &it->flat_filter : NULL, expected, sizeof expected[0], MOST, &count));
    OK(CALL(instances_all1)(placed, &it->ray, filter, hits, sizeof hits[0], MOST, &listed));
    OK(CALL(instances_any1)(placed, &it->ray, filter, &is_hit));
    OK(CALL(instances_closest1)(placed, &it->ray, filter, &hit));
    CHECK(listed == count && is_hit == (count > 0) && it->is_hit == is_hit);
    const hit_t none = {.face = STACKLESS_NO_FACE}, *first = count > 0 ? &expected[0] : &none;
    CHECK(equals(&hit, first) && equals(&it->hit, first));
    for (size_t i = 0; i < count; i++) {
        CHECK(equals(&hits[i], &expected[i]));
    }
    return count;
}

static void check_all(const instances_t *placed, const scene_t *scene, uint32_t flags)
{
    const size_t stride = sizeof asked[0];
    static uint32_t skipped[RAYS];
    static instance_hit_t firsts[RAYS];
    OK(CALL(instances_closest_n)(placed, &asked[0].ray, stride, RAYS, NULL, 0, &asked[0].hit, stride, flags));
    OK(CALL(instances_any_n)(placed, &asked[0].ray, stride, RAYS, NULL, 0, &asked[0].is_hit, stride, flags));
    size_t hits = 0, deep = 0, kept = 0;
    for (int i = 0; i < RAYS; i++) {
        hits += check_ray(placed, scene, &asked[i], false);
        deep += asked[i].hit.levels == 3;
        hit_t first;
        OK(CALL(closest1)(scene, &asked[i].ray, NULL, &first));
        skipped[i] = first.face;
        firsts[i] = asked[i].hit;
        asked[i].filter = (instances_filter_t){.mask = i % 4 ? UINT32_MAX : 5, .user = &asked[i]};
        asked[i].flat_filter = (filter_t){.mask = asked[i].filter.mask, .user = &asked[i]};
        if (i % 3) {
            asked[i].filter.skip = &firsts[i];
            asked[i].flat_filter.skip = &skipped[i];
        }
        if (i % 5) {
            asked[i].filter.accepts = accepts;
            asked[i].flat_filter.accepts = flat_accepts;
        }
    }
    const instances_filter_t *filters = &asked[0].filter;
    OK(CALL(instances_closest_n)(placed, &asked[0].ray, stride, RAYS, filters, stride, &asked[0].hit, stride, flags));
    OK(CALL(instances_any_n)(placed, &asked[0].ray, stride, RAYS, filters, stride, &asked[0].is_hit, stride, flags));
    for (int i = 0; i < RAYS; i++) {
        kept += check_ray(placed, scene, &asked[i], true);
    }
    CHECK(hits > 4 * RAYS && deep > RAYS / 10 && kept > RAYS && 4 * kept < 3 * hits);
    const instances_filter_t none = {.mask = 0};
    OK(CALL(instances_any_n)(placed, &asked[0].ray, stride, RAYS, &none, 0, &asked[0].is_hit, stride, flags));
    for (int i = 0; i < RAYS; i++) {
        /* The cube has no masks, and a mask of 0 has no bit in common. */
        CHECK(!asked[i].is_hit);
    }
}

static void check_bounds(const instances_t *placed)
{
    real lower[3], upper[3], least[3], greatest[3];
    OK(CALL(instances_bounds)(placed, lower, upper));
    for (int k = 0; k < 3; k++) {
        least[k] = greatest[k] = flat[0][k];
        for (uint32_t i = 1; i < 3 * flat_count; i++) {
            least[k] = flat[i][k] < least[k] ? flat[i][k] : least[k];
            greatest[k] = flat[i][k] > greatest[k] ? flat[i][k] : greatest[k];
        }
        /* The box of a turned box is larger than that of its content. */
        CHECK(lower[k] <= least[k] && lower[k] > least[k] - 40);
        CHECK(upper[k] >= greatest[k] && upper[k] < greatest[k] + 40);
    }
}

/* Batches of exact rays answer like single ones; closed rays from points of floats like ordinary rays, filters too. */
static bool accepts_exact(void *user, const exact_ray_t *ray, const hit_t *hit)
{
    CHECK(ray >= (const exact_ray_t *)user && ray < (const exact_ray_t *)user + RAYS);
    return hit->u <= hit->v;
}

static bool accepts_any(void *user, const ray_t *ray, const hit_t *hit)
{
    CHECK(user == NULL && ray != NULL);
    return hit->u <= hit->v;
}

static bool equal(const hit_t *a, const hit_t *b)
{
    return a->face == b->face && (a->face == STACKLESS_NO_FACE || (a->t == b->t && a->u == b->u && a->v == b->v));
}

static exact_ray_t exact_rays[RAYS];
static point_t *starts[RAYS], *points[RAYS];
static bool is_hit[RAYS];

/* The closed rays from the origins of the rays. */
static void make_exact(void)
{
    for (int i = 0; i < RAYS; i++) {
        asked[i].ray.tmin = 0;
        OK(CALL(point_new)(asked[i].ray.origin, &starts[i]));
        exact_rays[i] = (exact_ray_t){.origin = starts[i], .tmax = asked[i].ray.tmax, .is_closed = true};
        memcpy(exact_rays[i].direction, asked[i].ray.direction, sizeof asked[i].ray.direction);
    }
}

/* The open ray from a met point, back to where its ray came from. */
static exact_ray_t back(int i)
{
    const real *d = asked[i].ray.direction;
    return (exact_ray_t){points[i], NULL, {-d[0], -d[1], -d[2]}, (real)INFINITY, false};
}

static void check_exact(uint32_t flags)
{
    static hit_t hits[RAYS];
    scene_t *scene = mesh(0);
    uint32_t masks[SOUP];
    for (uint32_t face = 0; face < SOUP; face++) {
        masks[face] = mask_of(face);
    }
    OK(CALL(scene_set_masks)(scene, masks, sizeof masks[0], SOUP));
    const uint32_t skip = 7;
    const exact_filter_t filter = {.mask = 3, .skip = &skip, .accepts = accepts_exact, .user = exact_rays};
    const filter_t same = {.mask = 3, .skip = &skip, .accepts = accepts_any};
    const size_t stride = sizeof exact_rays[0];
    for (int is_filtered = 0; is_filtered < 2; is_filtered++) {
        const exact_filter_t *by = is_filtered ? &filter : NULL;
        OK(CALL(exact_closest_n)(scene, exact_rays, stride, RAYS, by, 0, hits, sizeof hits[0], points,
                                 sizeof points[0], flags));
        OK(CALL(exact_any_n)(scene, exact_rays, stride, RAYS, by, 0, is_hit, sizeof is_hit[0], flags));
        size_t count = 0, bounces = 0;
        for (int i = 0; i < RAYS; i++) {
            hit_t hit;
            OK(CALL(closest1)(scene, &asked[i].ray, is_filtered ? &same : NULL, &hit));
            CHECK(equal(&hit, &hits[i]) && is_hit[i] == (hit.face != STACKLESS_NO_FACE));
            CHECK((points[i] != NULL) == is_hit[i]);
            OK(CALL(exact_closest1)(scene, &exact_rays[i], by, &hit, NULL));
            CHECK(equal(&hit, &hits[i]));
            count += is_hit[i];
            /* A ray that leaves the hit does not meet it again. */
            if (points[i] != NULL) {
                const exact_ray_t ray = back(i);
                OK(CALL(exact_closest1)(scene, &ray, NULL, &hit, NULL));
                CHECK(hit.face != hits[i].face);
                bounces += hit.face != STACKLESS_NO_FACE;
            }
            OK(CALL(point_free)(points[i]));
        }
        CHECK(count > RAYS / 10 && bounces > (is_filtered ? 50 : 2));
        OK(CALL(exact_closest_n)(scene, exact_rays, stride, RAYS, by, 0, hits, sizeof hits[0], NULL, 0, flags));
        for (int i = 0; i < RAYS; i++) {
            CHECK((hits[i].face != STACKLESS_NO_FACE) == is_hit[i]);
        }
    }
    OK(CALL(scene_free)(scene));
}

static bool accepts_placed(void *user, const exact_ray_t *ray, const instance_hit_t *hit)
{
    CHECK(user == NULL && ray >= exact_rays && ray < exact_rays + RAYS);
    return hit->u <= hit->v;
}

static bool accepts_ordinary(void *user, const ray_t *ray, const instance_hit_t *hit)
{
    CHECK(user == NULL && ray != NULL);
    return hit->u <= hit->v;
}

static bool is_same(const instance_hit_t *a, const instance_hit_t *b)
{
    return a->face == b->face && a->levels == b->levels && memcmp(a->path, b->path, sizeof a->path) == 0;
}

/* The same in instances. */
static void check_exact_instances(const instances_t *placed, uint32_t flags)
{
    static instance_hit_t hits[RAYS];
    const size_t stride = sizeof exact_rays[0];
    const instance_hit_t skip = asked[0].hit;
    const instances_exact_filter_t filter = {.mask = 3, .skip = &skip, .accepts = accepts_placed};
    const instances_filter_t same = {.mask = 3, .skip = &skip, .accepts = accepts_ordinary};
    for (int is_filtered = 0; is_filtered < 2; is_filtered++) {
        const instances_exact_filter_t *by = is_filtered ? &filter : NULL;
        OK(CALL(instances_exact_closest_n)(placed, exact_rays, stride, RAYS, by, 0, hits, sizeof hits[0], points,
                                           sizeof points[0], flags));
        OK(CALL(instances_exact_any_n)(placed, exact_rays, stride, RAYS, by, 0, is_hit, sizeof is_hit[0], flags));
        size_t count = 0, bounces = 0;
        for (int i = 0; i < RAYS; i++) {
            instance_hit_t hit;
            bool is_any;
            OK(CALL(instances_closest1)(placed, &asked[i].ray, is_filtered ? &same : NULL, &hit));
            CHECK(is_same(&hit, &hits[i]) && is_hit[i] == (hit.face != STACKLESS_NO_FACE));
            CHECK((points[i] != NULL) == is_hit[i]);
            OK(CALL(instances_exact_any1)(placed, &exact_rays[i], by, &is_any));
            CHECK(is_any == is_hit[i]);
            count += is_hit[i];
            if (points[i] != NULL) {
                CHECK(hit.t == hits[i].t && hit.u == hits[i].u && hit.v == hits[i].v);
                const exact_ray_t ray = back(i);
                OK(CALL(instances_exact_closest1)(placed, &ray, NULL, &hit, NULL));
                CHECK(!is_same(&hit, &hits[i]));
                bounces += hit.face != STACKLESS_NO_FACE;
            }
            OK(CALL(point_free)(points[i]));
        }
        CHECK(count > RAYS / 3 && bounces > 50);
    }
}

int main(void)
{
    uint64_t state = 1;
    make(&state);
    const uint32_t no_path[1] = {0};
    const placed_t *no_maps[1] = {NULL};
    flatten(4, 0, no_path, no_maps);
    instances_t *placed = nested();
    scene_t *scene;
    OK(CALL(scene_new)(flat[0], sizeof flat[0], 3 * (size_t)flat_count, flat_faces[0], sizeof flat_faces[0], flat_count,
                       NULL, &scene));
    OK(CALL(scene_set_masks)(scene, flat_masks, sizeof flat_masks[0], flat_count));
    make_rays(&state);
    for (uint32_t flags = 0; flags < 2; flags++) {
        check_all(placed, scene, flags);
    }
    make_exact();
    for (uint32_t flags = 0; flags < 2; flags++) {
        check_exact(flags);
        check_exact_instances(placed, flags);
    }
    for (int i = 0; i < RAYS; i++) {
        OK(CALL(point_free)(starts[i]));
    }
    check_bounds(placed);
    OK(CALL(instances_free)(placed));
    OK(CALL(scene_free)(scene));
    return 0;
}
