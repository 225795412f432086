/* libstackless: exact ray tracing on triangle meshes.
 *
 * Every answer is that of exact arithmetic for the numbers as they are, rounded once. Names that end with _d are of
 * double precision, those with _f of single precision. A scene of one precision takes rays, points and vertices of
 * that precision.
 *
 * Pointers. Each is null, or points to as many values as the call says, which no other thread changes during the
 * call. Results need not be initialised, and may stand in one structure with the arguments, but must not overlap
 * them. A scene is one that this library made and that was not freed. This is all that the library cannot check. It
 * refuses null pointers (unless it says that they may be null, and but for arrays of 0 elements), misaligned
 * pointers, strides that are less than an element or would misalign one, sizes beyond the address space, numbers that
 * are not finite, indices without a vertex.
 *
 * Arrays. The stride is the distance in bytes from one element to the next: sizeof(stackless_ray_d) for an array of
 * rays.
 *
 * Threads. Any number of threads may query a scene at the same time, also while others build scenes. A scene must not
 * be in use while it is refitted or freed.
 *
 * Floats. Each thread that calls must round to nearest and keep subnormal numbers, as it does unless told otherwise
 * (_MM_SET_FLUSH_ZERO_MODE, -ffast-math); if not, calls fail with STACKLESS_ERROR_FLOAT_ENVIRONMENT.
 *
 * cbindgen makes this file of crates/capi/src. */

#ifndef STACKLESS_H
#define STACKLESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The index of no face: that of a ray that misses.
#define STACKLESS_NO_FACE UINT32_MAX

// How much time a build may take: a moderate time, and nearly the fastest queries.
#define STACKLESS_QUALITY_STANDARD 0

// A shorter build, and slower queries.
#define STACKLESS_QUALITY_FAST 1

// A longer build.
#define STACKLESS_QUALITY_HIGH 2

// As standard, with triangles split between leaves where they are long and thin. It takes more memory.
#define STACKLESS_QUALITY_SPATIAL 3

// A batch is answered by the calling thread.
#define STACKLESS_SERIAL 0

// A batch is answered by the threads of the scene. The answers are the same.
#define STACKLESS_PARALLEL 1

// Points with an odd number of crossings are inside. The mesh must be closed.
#define STACKLESS_RULE_PARITY 0

// Points with a winding number other than 0 are inside. The mesh must be closed and oriented. Overlapping parts unite.
#define STACKLESS_RULE_NONZERO 1

// Points with a winding number above 1/2 are inside. Any mesh will do: where it has holes this is a good guess.
#define STACKLESS_RULE_WINDING 2

// The point is outside.
#define STACKLESS_OUTSIDE 0

// The point is inside.
#define STACKLESS_INSIDE 1

// The point is on a face, exactly.
#define STACKLESS_SURFACE 2

// What a function returns. After any but `STACKLESS_ERROR_NONE`, `stackless_error_message` says more, and what the
// function should have written is unspecified.
typedef enum {
    // Success.
    STACKLESS_ERROR_NONE = 0,
    // A pointer is null or misaligned, or a number is out of range.
    STACKLESS_ERROR_INVALID_ARGUMENT = 1,
    // There is not enough memory, or no thread could be started.
    STACKLESS_ERROR_OUT_OF_MEMORY = 2,
    // A thread does not compute as IEEE 754 says: it flushes subnormal numbers, or does not round to nearest.
    STACKLESS_ERROR_FLOAT_ENVIRONMENT = 3,
    // A file cannot be read or written.
    STACKLESS_ERROR_FILE = 4,
    // Bytes are not a saved scene of this precision.
    STACKLESS_ERROR_INVALID_DATA = 5,
    // The mesh is open or not oriented, and the function or the rule needs one that is.
    STACKLESS_ERROR_UNSUITABLE_MESH = 6,
    // A bug in this library. Destroy the scene.
    STACKLESS_ERROR_INTERNAL = 7,
} stackless_error;

// A point that is known exactly: one of floats, or that of a hit. Any number of threads may use it at the same time.
typedef struct stackless_point_d stackless_point_d;

// A point that is known exactly: one of floats, or that of a hit. Any number of threads may use it at the same time.
typedef struct stackless_point_f stackless_point_f;

// A mesh with its hierarchy. Any number of threads may query it at the same time.
typedef struct stackless_scene_d stackless_scene_d;

// A mesh with its hierarchy. Any number of threads may query it at the same time.
typedef struct stackless_scene_f stackless_scene_f;

// How a scene is built. All zeros are the defaults.
typedef struct {
    // One of `STACKLESS_QUALITY_...`.
    uint32_t quality;
    // Number of threads for the build and for parallel batches; 0 for one per processor, shared by all scenes.
    uint32_t threads;
} stackless_options;

// The points `origin + t * direction` with `tmin <= t <= tmax`.
typedef struct {
    // Finite.
    double origin[3];
    // The least distance of a hit, at least 0.
    double tmin;
    // Finite, and not zero. It need not have length 1.
    double direction[3];
    // The greatest distance of a hit, at least `tmin`. May be infinite.
    double tmax;
} stackless_ray_d;

// Where a ray meets a face.
typedef struct {
    // Distance in lengths of the direction; infinite for a miss.
    double t;
    // Weight of the face's second vertex; NaN for a miss.
    double u;
    // Weight of the face's third vertex; NaN for a miss.
    double v;
    // Index of the face; `STACKLESS_NO_FACE` for a miss.
    uint32_t face;
} stackless_hit_d;

// The hits of a ray that count. A query finds the first of these. Faces that are masked or skipped are not tested.
typedef struct {
    // Hits of a face count if its mask and this one have a bit in common. All bits are set in the masks of a new scene.
    uint32_t mask;
    // The index of a face whose hits do not count. May be null.
    const uint32_t *skip;
    // Returns whether a hit counts: for transparency, and for the sides of faces. May be null. `ray` is that of the call,
    // where the program has it. The function must always return the same for a hit. It is called in no particular order,
    // perhaps several times for one face, and by several threads at once in parallel batches. It must return: it must
    // neither throw an exception nor jump. It may query scenes.
    bool (*accepts)(void *user, const stackless_ray_d *ray, const stackless_hit_d *hit);
    // Passed to `accepts`.
    void *user;
} stackless_filter_d;

// The point of the mesh that is nearest to another point.
typedef struct {
    // Where it is; NaN if there is none.
    double point[3];
    // How far away; infinite if there is none.
    double distance;
    // Index of its face; `STACKLESS_NO_FACE` if there is none.
    uint32_t face;
} stackless_near_d;

// A ray that begins at an exact point, such as that of a hit.
typedef struct {
    // Where it begins.
    const stackless_point_d *origin;
    // Where it ends, at t = 1. May be null: then the ray has this direction and this end.
    const stackless_point_d *target;
    // Finite, and not zero.
    double direction[3];
    // The greatest distance of a hit, at least 0. May be infinite.
    double tmax;
    // Whether the ends count. If not, hits have 0 < t < tmax: the face that the ray leaves is not hit, nor any other face
    // that contains the origin.
    bool is_closed;
} stackless_exact_ray_d;

// The points `origin + t * direction` with `tmin <= t <= tmax`.
typedef struct {
    // Finite.
    float origin[3];
    // The least distance of a hit, at least 0.
    float tmin;
    // Finite, and not zero. It need not have length 1.
    float direction[3];
    // The greatest distance of a hit, at least `tmin`. May be infinite.
    float tmax;
} stackless_ray_f;

// Where a ray meets a face.
typedef struct {
    // Distance in lengths of the direction; infinite for a miss.
    float t;
    // Weight of the face's second vertex; NaN for a miss.
    float u;
    // Weight of the face's third vertex; NaN for a miss.
    float v;
    // Index of the face; `STACKLESS_NO_FACE` for a miss.
    uint32_t face;
} stackless_hit_f;

// The hits of a ray that count. A query finds the first of these. Faces that are masked or skipped are not tested.
typedef struct {
    // Hits of a face count if its mask and this one have a bit in common. All bits are set in the masks of a new scene.
    uint32_t mask;
    // The index of a face whose hits do not count. May be null.
    const uint32_t *skip;
    // Returns whether a hit counts: for transparency, and for the sides of faces. May be null. `ray` is that of the call,
    // where the program has it. The function must always return the same for a hit. It is called in no particular order,
    // perhaps several times for one face, and by several threads at once in parallel batches. It must return: it must
    // neither throw an exception nor jump. It may query scenes.
    bool (*accepts)(void *user, const stackless_ray_f *ray, const stackless_hit_f *hit);
    // Passed to `accepts`.
    void *user;
} stackless_filter_f;

// The point of the mesh that is nearest to another point.
typedef struct {
    // Where it is; NaN if there is none.
    float point[3];
    // How far away; infinite if there is none.
    float distance;
    // Index of its face; `STACKLESS_NO_FACE` if there is none.
    uint32_t face;
} stackless_near_f;

// A ray that begins at an exact point, such as that of a hit.
typedef struct {
    // Where it begins.
    const stackless_point_f *origin;
    // Where it ends, at t = 1. May be null: then the ray has this direction and this end.
    const stackless_point_f *target;
    // Finite, and not zero.
    float direction[3];
    // The greatest distance of a hit, at least 0. May be infinite.
    float tmax;
    // Whether the ends count. If not, hits have 0 < t < tmax: the face that the ray leaves is not hit, nor any other face
    // that contains the origin.
    bool is_closed;
} stackless_exact_ray_f;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the reason why the last failed call of this thread failed: one line that names the element, the found and the
// expected value. Empty if no call has failed. Valid until the next failure of this thread.
const char *stackless_error_message(void);

// Builds a scene in double precision. Vertices and faces are copied. Strides are in bytes; they and the addresses of
// both arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null after
// an error.
stackless_error stackless_scene_new_d(const double *vertices,
                                      size_t vertex_stride,
                                      size_t vertex_count,
                                      const uint32_t *faces,
                                      size_t face_stride,
                                      size_t face_count,
                                      const stackless_options *options,
                                      stackless_scene_d **scene);

// Destroys a scene, which no thread may use any more. Null is ignored.
stackless_error stackless_scene_free_d(stackless_scene_d *scene);

// Moves the vertices, as many as the scene has; the faces stay. Much faster than a new scene, but queries are slower
// the more the vertices have moved relative to each other. No other thread may use the scene meanwhile.
stackless_error stackless_scene_refit_d(stackless_scene_d *scene,
                                        const double *vertices,
                                        size_t vertex_stride,
                                        size_t vertex_count);

// Gives each face a mask, which the filters of rays are compared with. Masks are not saved. No other thread may use the
// scene meanwhile.
stackless_error stackless_scene_set_masks_d(stackless_scene_d *scene,
                                            const uint32_t *masks,
                                            size_t mask_stride,
                                            size_t face_count);

// Writes the numbers of vertices and of faces. Each pointer but the first may be null.
stackless_error stackless_scene_counts_d(const stackless_scene_d *scene, size_t *vertex_count, size_t *face_count);

// Writes the least and the greatest coordinates of the corners of faces, three numbers each.
stackless_error stackless_scene_bounds_d(const stackless_scene_d *scene, double *lower, double *upper);

// Writes a scene to a file, whole or not at all. The path is UTF-8. Files are the same on all machines, and those of
// the Python package.
stackless_error stackless_scene_save_d(const stackless_scene_d *scene, const char *file);

// Reads a scene from a file. Everything in it is checked. `threads` is as in `stackless_options`. `*scene` is null
// after an error.
stackless_error stackless_scene_load_d(const char *file, uint32_t threads, stackless_scene_d **scene);

// Writes the bytes of a scene, as many as there is room for, and to `size` how many it has. To learn that, call it
// with a capacity of 0; `bytes` may then be null.
stackless_error stackless_scene_to_bytes_d(const stackless_scene_d *scene,
                                           uint8_t *bytes,
                                           size_t capacity,
                                           size_t *size);

// Reads a scene from bytes, as `stackless_scene_load_d`.
stackless_error stackless_scene_from_bytes_d(const uint8_t *bytes,
                                             size_t size,
                                             uint32_t threads,
                                             stackless_scene_d **scene);

// Finds the closest hit of a ray: the least exact distance, and of equal ones the least index of a face. With a filter,
// which may be null, the first hit that it accepts.
stackless_error stackless_closest1_d(const stackless_scene_d *scene,
                                     const stackless_ray_d *ray,
                                     const stackless_filter_d *filter,
                                     stackless_hit_d *hit);

// Finds out whether a ray hits anything, with a filter anything that it accepts. It may be null.
stackless_error stackless_any1_d(const stackless_scene_d *scene,
                                 const stackless_ray_d *ray,
                                 const stackless_filter_d *filter,
                                 bool *is_hit);

// Finds all hits of a ray, each face once, in the order of exact distances and then of indices; with a filter, which may
// be null, those that it accepts. Writes the first ones, as many as there is room for, and to `count` how many there
// are. With a capacity of 0, `hits` may be null.
stackless_error stackless_all1_d(const stackless_scene_d *scene,
                                 const stackless_ray_d *ray,
                                 const stackless_filter_d *filter,
                                 stackless_hit_d *hits,
                                 size_t hit_stride,
                                 size_t capacity,
                                 size_t *count);

// Finds the first hit after another one of the same ray, in the order of `stackless_all1_d`. So a program can walk
// from hit to hit: none is lost or met again, however close they are. `after` and `hit` may be the same.
stackless_error stackless_next1_d(const stackless_scene_d *scene,
                                  const stackless_ray_d *ray,
                                  const stackless_hit_d *after,
                                  stackless_hit_d *hit);

// Finds the closest hit of each ray, by `stackless_closest1_d`. `filters` may be null. There is one for each ray, or
// with a stride of 0 one for all.
stackless_error stackless_closest_n_d(const stackless_scene_d *scene,
                                      const stackless_ray_d *rays,
                                      size_t ray_stride,
                                      size_t count,
                                      const stackless_filter_d *filters,
                                      size_t filter_stride,
                                      stackless_hit_d *hits,
                                      size_t hit_stride,
                                      uint32_t flags);

// Finds out for each ray whether it hits anything, by `stackless_any1_d`. Filters are as in `stackless_closest_n_d`.
stackless_error stackless_any_n_d(const stackless_scene_d *scene,
                                  const stackless_ray_d *rays,
                                  size_t ray_stride,
                                  size_t count,
                                  const stackless_filter_d *filters,
                                  size_t filter_stride,
                                  bool *is_hit,
                                  size_t is_hit_stride,
                                  uint32_t flags);

// Counts how often each ray crosses a closed mesh. A crossing at an edge or a vertex is one, and touching is none.
stackless_error stackless_crossings_n_d(const stackless_scene_d *scene,
                                        const stackless_ray_d *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        uint32_t *crossings,
                                        size_t crossing_stride,
                                        uint32_t flags);

// Says of each point, three numbers, whether it is inside, outside or on a face: `STACKLESS_INSIDE`,
// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
// looks at all edges.
stackless_error stackless_locate_n_d(const stackless_scene_d *scene,
                                     const double *points,
                                     size_t point_stride,
                                     size_t count,
                                     uint32_t rule,
                                     uint8_t *locations,
                                     size_t location_stride,
                                     uint32_t flags);

// Measures how far each point, three numbers, is from the mesh: the exact distance, rounded once, and negative inside
// by a rule `STACKLESS_RULE_...`.
stackless_error stackless_signed_distances_n_d(const stackless_scene_d *scene,
                                               const double *points,
                                               size_t point_stride,
                                               size_t count,
                                               uint32_t rule,
                                               double *distances,
                                               size_t distance_stride,
                                               uint32_t flags);

// Finds the point of the mesh that is nearest to each point, three numbers, and no farther than the radius, which may
// be infinite. Of equally near faces it is the one of the least index.
stackless_error stackless_nearest_n_d(const stackless_scene_d *scene,
                                      const double *points,
                                      size_t point_stride,
                                      size_t count,
                                      double radius,
                                      stackless_near_d *nears,
                                      size_t near_stride,
                                      uint32_t flags);

// Finds the faces that are nearest to a point, three numbers, and no farther than the radius, which may be infinite: the
// first `capacity` ones in the order of distances and then of indices. Writes to `count` how many it has found.
stackless_error stackless_nearest_k1_d(const stackless_scene_d *scene,
                                       const double *point,
                                       double radius,
                                       stackless_near_d *nears,
                                       size_t near_stride,
                                       size_t capacity,
                                       size_t *count);

// Makes an exact point of three numbers. `*point` is null after an error.
stackless_error stackless_point_new_d(const double *coordinates, stackless_point_d **point);

// Makes the exact point at which a ray hits a face. It is not rounded. `*point` is null after an error.
stackless_error stackless_point_of_hit_d(const stackless_scene_d *scene,
                                         const stackless_ray_d *ray,
                                         uint32_t face,
                                         stackless_point_d **point);

// Destroys a point, which no thread may use any more. Null is ignored. Rays that began there do not need it.
stackless_error stackless_point_free_d(stackless_point_d *point);

// Finds the closest hit of a ray that begins at an exact point, and makes the exact point of the hit: the next ray may
// begin there. `point` may be null. `*point` is null after a miss and after an error.
stackless_error stackless_exact_closest1_d(const stackless_scene_d *scene,
                                           const stackless_exact_ray_d *ray,
                                           stackless_hit_d *hit,
                                           stackless_point_d **point);

// Finds out whether a ray that begins at an exact point hits anything.
stackless_error stackless_exact_any1_d(const stackless_scene_d *scene, const stackless_exact_ray_d *ray, bool *is_hit);

// Builds a scene in single precision. Vertices and faces are copied. Strides are in bytes; they and the addresses of
// both arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null after
// an error.
stackless_error stackless_scene_new_f(const float *vertices,
                                      size_t vertex_stride,
                                      size_t vertex_count,
                                      const uint32_t *faces,
                                      size_t face_stride,
                                      size_t face_count,
                                      const stackless_options *options,
                                      stackless_scene_f **scene);

// Destroys a scene, which no thread may use any more. Null is ignored.
stackless_error stackless_scene_free_f(stackless_scene_f *scene);

// Moves the vertices, as many as the scene has; the faces stay. Much faster than a new scene, but queries are slower
// the more the vertices have moved relative to each other. No other thread may use the scene meanwhile.
stackless_error stackless_scene_refit_f(stackless_scene_f *scene,
                                        const float *vertices,
                                        size_t vertex_stride,
                                        size_t vertex_count);

// Gives each face a mask, which the filters of rays are compared with. Masks are not saved. No other thread may use the
// scene meanwhile.
stackless_error stackless_scene_set_masks_f(stackless_scene_f *scene,
                                            const uint32_t *masks,
                                            size_t mask_stride,
                                            size_t face_count);

// Writes the numbers of vertices and of faces. Each pointer but the first may be null.
stackless_error stackless_scene_counts_f(const stackless_scene_f *scene, size_t *vertex_count, size_t *face_count);

// Writes the least and the greatest coordinates of the corners of faces, three numbers each.
stackless_error stackless_scene_bounds_f(const stackless_scene_f *scene, float *lower, float *upper);

// Writes a scene to a file, whole or not at all. The path is UTF-8. Files are the same on all machines, and those of
// the Python package.
stackless_error stackless_scene_save_f(const stackless_scene_f *scene, const char *file);

// Reads a scene from a file. Everything in it is checked. `threads` is as in `stackless_options`. `*scene` is null
// after an error.
stackless_error stackless_scene_load_f(const char *file, uint32_t threads, stackless_scene_f **scene);

// Writes the bytes of a scene, as many as there is room for, and to `size` how many it has. To learn that, call it
// with a capacity of 0; `bytes` may then be null.
stackless_error stackless_scene_to_bytes_f(const stackless_scene_f *scene,
                                           uint8_t *bytes,
                                           size_t capacity,
                                           size_t *size);

// Reads a scene from bytes, as `stackless_scene_load_f`.
stackless_error stackless_scene_from_bytes_f(const uint8_t *bytes,
                                             size_t size,
                                             uint32_t threads,
                                             stackless_scene_f **scene);

// Finds the closest hit of a ray: the least exact distance, and of equal ones the least index of a face. With a filter,
// which may be null, the first hit that it accepts.
stackless_error stackless_closest1_f(const stackless_scene_f *scene,
                                     const stackless_ray_f *ray,
                                     const stackless_filter_f *filter,
                                     stackless_hit_f *hit);

// Finds out whether a ray hits anything, with a filter anything that it accepts. It may be null.
stackless_error stackless_any1_f(const stackless_scene_f *scene,
                                 const stackless_ray_f *ray,
                                 const stackless_filter_f *filter,
                                 bool *is_hit);

// Finds all hits of a ray, each face once, in the order of exact distances and then of indices; with a filter, which may
// be null, those that it accepts. Writes the first ones, as many as there is room for, and to `count` how many there
// are. With a capacity of 0, `hits` may be null.
stackless_error stackless_all1_f(const stackless_scene_f *scene,
                                 const stackless_ray_f *ray,
                                 const stackless_filter_f *filter,
                                 stackless_hit_f *hits,
                                 size_t hit_stride,
                                 size_t capacity,
                                 size_t *count);

// Finds the first hit after another one of the same ray, in the order of `stackless_all1_f`. So a program can walk
// from hit to hit: none is lost or met again, however close they are. `after` and `hit` may be the same.
stackless_error stackless_next1_f(const stackless_scene_f *scene,
                                  const stackless_ray_f *ray,
                                  const stackless_hit_f *after,
                                  stackless_hit_f *hit);

// Finds the closest hit of each ray, by `stackless_closest1_f`. `filters` may be null. There is one for each ray, or
// with a stride of 0 one for all.
stackless_error stackless_closest_n_f(const stackless_scene_f *scene,
                                      const stackless_ray_f *rays,
                                      size_t ray_stride,
                                      size_t count,
                                      const stackless_filter_f *filters,
                                      size_t filter_stride,
                                      stackless_hit_f *hits,
                                      size_t hit_stride,
                                      uint32_t flags);

// Finds out for each ray whether it hits anything, by `stackless_any1_f`. Filters are as in `stackless_closest_n_f`.
stackless_error stackless_any_n_f(const stackless_scene_f *scene,
                                  const stackless_ray_f *rays,
                                  size_t ray_stride,
                                  size_t count,
                                  const stackless_filter_f *filters,
                                  size_t filter_stride,
                                  bool *is_hit,
                                  size_t is_hit_stride,
                                  uint32_t flags);

// Counts how often each ray crosses a closed mesh. A crossing at an edge or a vertex is one, and touching is none.
stackless_error stackless_crossings_n_f(const stackless_scene_f *scene,
                                        const stackless_ray_f *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        uint32_t *crossings,
                                        size_t crossing_stride,
                                        uint32_t flags);

// Says of each point, three numbers, whether it is inside, outside or on a face: `STACKLESS_INSIDE`,
// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
// looks at all edges.
stackless_error stackless_locate_n_f(const stackless_scene_f *scene,
                                     const float *points,
                                     size_t point_stride,
                                     size_t count,
                                     uint32_t rule,
                                     uint8_t *locations,
                                     size_t location_stride,
                                     uint32_t flags);

// Measures how far each point, three numbers, is from the mesh: the exact distance, rounded once, and negative inside
// by a rule `STACKLESS_RULE_...`.
stackless_error stackless_signed_distances_n_f(const stackless_scene_f *scene,
                                               const float *points,
                                               size_t point_stride,
                                               size_t count,
                                               uint32_t rule,
                                               float *distances,
                                               size_t distance_stride,
                                               uint32_t flags);

// Finds the point of the mesh that is nearest to each point, three numbers, and no farther than the radius, which may
// be infinite. Of equally near faces it is the one of the least index.
stackless_error stackless_nearest_n_f(const stackless_scene_f *scene,
                                      const float *points,
                                      size_t point_stride,
                                      size_t count,
                                      float radius,
                                      stackless_near_f *nears,
                                      size_t near_stride,
                                      uint32_t flags);

// Finds the faces that are nearest to a point, three numbers, and no farther than the radius, which may be infinite: the
// first `capacity` ones in the order of distances and then of indices. Writes to `count` how many it has found.
stackless_error stackless_nearest_k1_f(const stackless_scene_f *scene,
                                       const float *point,
                                       float radius,
                                       stackless_near_f *nears,
                                       size_t near_stride,
                                       size_t capacity,
                                       size_t *count);

// Makes an exact point of three numbers. `*point` is null after an error.
stackless_error stackless_point_new_f(const float *coordinates, stackless_point_f **point);

// Makes the exact point at which a ray hits a face. It is not rounded. `*point` is null after an error.
stackless_error stackless_point_of_hit_f(const stackless_scene_f *scene,
                                         const stackless_ray_f *ray,
                                         uint32_t face,
                                         stackless_point_f **point);

// Destroys a point, which no thread may use any more. Null is ignored. Rays that began there do not need it.
stackless_error stackless_point_free_f(stackless_point_f *point);

// Finds the closest hit of a ray that begins at an exact point, and makes the exact point of the hit: the next ray may
// begin there. `point` may be null. `*point` is null after a miss and after an error.
stackless_error stackless_exact_closest1_f(const stackless_scene_f *scene,
                                           const stackless_exact_ray_f *ray,
                                           stackless_hit_f *hit,
                                           stackless_point_f **point);

// Finds out whether a ray that begins at an exact point hits anything.
stackless_error stackless_exact_any1_f(const stackless_scene_f *scene, const stackless_exact_ray_f *ray, bool *is_hit);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STACKLESS_H */
