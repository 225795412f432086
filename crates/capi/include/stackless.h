/* libstackless: exact ray tracing on triangle meshes.
 *
 * Every answer is computed exactly from the given numbers, then rounded once. Names ending with _d have double
 * precision, names ending with _f single precision. A scene takes rays, points and vertices of its precision.
 *
 * Pointers. A pointer is null, or points to the number of values in the call. No other thread changes these values
 * during the call. Results need not be initialised. They may be in one structure with the arguments, but must not
 * overlap them. Scenes, points and instances must come from this library, and must not be freed. The library cannot
 * check these conditions. It refuses null pointers (unless null is allowed, or the array has 0 elements), misaligned
 * pointers, strides that are smaller than an element or would misalign one, sizes beyond the address space, numbers
 * that are not finite, and indices without an element.
 *
 * Arrays. The stride is the distance in bytes from one element to the next: sizeof(stackless_ray_d) for an array of
 * rays.
 *
 * Threads. Any number of threads may query a scene or instances at the same time, also while other threads build
 * scenes. A scene must not be in use while it is refitted or freed.
 *
 * Floats. Each calling thread must round to nearest and keep subnormal numbers. This is the default;
 * _MM_SET_FLUSH_ZERO_MODE and -ffast-math change it. Otherwise calls fail with STACKLESS_ERROR_FLOAT_ENVIRONMENT.
 *
 * cbindgen generates this file from crates/capi/src. */

#ifndef STACKLESS_H
#define STACKLESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The index that means no face, for a ray that misses.
#define STACKLESS_NO_FACE UINT32_MAX

// The greatest number of groups that contain each other: the length of a path.
#define STACKLESS_MAX_LEVELS 8

// Build quality: a short build, and nearly the fastest queries.
#define STACKLESS_QUALITY_STANDARD 0

// Build quality: a long build.
#define STACKLESS_QUALITY_HIGH 1

// Build quality: a long build, with long and thin triangles split between leaves. It takes more memory.
#define STACKLESS_QUALITY_SPATIAL 2

// The calling thread answers a batch.
#define STACKLESS_SERIAL 0

// The threads of the scene answer a batch, with equal answers.
#define STACKLESS_PARALLEL 1

// Points with an odd number of crossings are inside. The mesh must be closed.
#define STACKLESS_RULE_PARITY 0

// Points with a winding number other than 0 are inside. The mesh must be closed and oriented. Overlapping parts unite.
#define STACKLESS_RULE_NONZERO 1

// Points with a winding number above 1/2 are inside. Any mesh is suitable; near holes the result is a good guess.
#define STACKLESS_RULE_WINDING 2

// The point is outside.
#define STACKLESS_OUTSIDE 0

// The point is inside.
#define STACKLESS_INSIDE 1

// The point is on a face, exactly.
#define STACKLESS_SURFACE 2

// The result of a function. After any code except `STACKLESS_ERROR_NONE`, `stackless_error_message` gives details, and
// the outputs of the function are unspecified.
typedef enum {
    // Success.
    STACKLESS_ERROR_NONE = 0,
    // A pointer is null or misaligned, or a number is out of range.
    STACKLESS_ERROR_INVALID_ARGUMENT = 1,
    // There is not enough memory, or no thread could be started.
    STACKLESS_ERROR_OUT_OF_MEMORY = 2,
    // A thread violates IEEE 754: it flushes subnormal numbers, or does not round to nearest.
    STACKLESS_ERROR_FLOAT_ENVIRONMENT = 3,
    // A file cannot be read or written.
    STACKLESS_ERROR_FILE = 4,
    // Bytes are not a saved scene of this precision.
    STACKLESS_ERROR_INVALID_DATA = 5,
    // The mesh is open or not oriented, and the function or the rule needs a closed or an oriented mesh.
    STACKLESS_ERROR_UNSUITABLE_MESH = 6,
    // A bug in this library. Destroy the scene.
    STACKLESS_ERROR_INTERNAL = 7,
} stackless_error;

// Scenes and other instances, placed by affine maps. They share the hierarchies of their scenes. Any number of threads
// may query them at the same time.
typedef struct stackless_instances_d stackless_instances_d;

// Scenes and other instances, placed by affine maps. They share the hierarchies of their scenes. Any number of threads
// may query them at the same time.
typedef struct stackless_instances_f stackless_instances_f;

// An exact point: of floats, or of a hit. Any number of threads may use it at the same time.
typedef struct stackless_point_d stackless_point_d;

// An exact point: of floats, or of a hit. Any number of threads may use it at the same time.
typedef struct stackless_point_f stackless_point_f;

// A mesh with its hierarchy. Any number of threads may query it at the same time.
typedef struct stackless_scene_d stackless_scene_d;

// A mesh with its hierarchy. Any number of threads may query it at the same time.
typedef struct stackless_scene_f stackless_scene_f;

// Options of a scene. All zeros are the defaults.
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
    // The minimum distance of a hit, at least 0.
    double tmin;
    // Finite, nonzero. It need not have length 1.
    double direction[3];
    // The maximum distance of a hit, at least `tmin`. May be infinite.
    double tmax;
} stackless_ray_d;

// The hit of a ray with a face.
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

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const uint32_t *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_ray_d *ray, const stackless_hit_d *hit);
    // Passed to `accepts`.
    void *user;
} stackless_filter_d;

// The nearest point of the mesh.
typedef struct {
    // Its coordinates; NaN if there is none.
    double point[3];
    // Its distance; infinite if there is none.
    double distance;
    // Index of its face; `STACKLESS_NO_FACE` if there is none.
    uint32_t face;
} stackless_near_d;

// A ray that starts at an exact point, such as the point of a hit.
typedef struct {
    // The start point.
    const stackless_point_d *origin;
    // The end point, at t = 1. If null, the ray has the direction and the end below.
    const stackless_point_d *target;
    // Finite and nonzero.
    double direction[3];
    // The maximum distance of a hit, at least 0. May be infinite.
    double tmax;
    // Whether the ends belong to the ray. If not, hits have 0 < t < tmax: the ray does not hit the face that it
    // leaves, nor any other face that contains the origin.
    bool is_closed;
} stackless_exact_ray_d;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const uint32_t *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_exact_ray_d *ray, const stackless_hit_d *hit);
    // Passed to `accepts`.
    void *user;
} stackless_exact_filter_d;

// The hit of a ray with a face of an instance.
typedef struct {
    // Distance in lengths of the direction; infinite for a miss.
    double t;
    // Weight of the face's second vertex; NaN for a miss.
    double u;
    // Weight of the face's third vertex; NaN for a miss.
    double v;
    // Index of the face in its scene; `STACKLESS_NO_FACE` for a miss.
    uint32_t face;
    // Number of groups that contain the face; 0 for a miss.
    uint32_t levels;
    // The index of the instance in each of these groups, outermost first. The other numbers are `UINT32_MAX`.
    uint32_t path[STACKLESS_MAX_LEVELS];
} stackless_instance_hit_d;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const stackless_instance_hit_d *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_exact_ray_d *ray, const stackless_instance_hit_d *hit);
    // Passed to `accepts`.
    void *user;
} stackless_instances_exact_filter_d;

// A scene or a group of instances. Of the two pointers, one is null.
typedef struct {
    // A scene, or null.
    const stackless_scene_d *scene;
    // Instances, or null.
    const stackless_instances_d *instances;
} stackless_object_d;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const stackless_instance_hit_d *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_ray_d *ray, const stackless_instance_hit_d *hit);
    // Passed to `accepts`.
    void *user;
} stackless_instances_filter_d;

// The points `origin + t * direction` with `tmin <= t <= tmax`.
typedef struct {
    // Finite.
    float origin[3];
    // The minimum distance of a hit, at least 0.
    float tmin;
    // Finite, nonzero. It need not have length 1.
    float direction[3];
    // The maximum distance of a hit, at least `tmin`. May be infinite.
    float tmax;
} stackless_ray_f;

// The hit of a ray with a face.
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

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const uint32_t *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_ray_f *ray, const stackless_hit_f *hit);
    // Passed to `accepts`.
    void *user;
} stackless_filter_f;

// The nearest point of the mesh.
typedef struct {
    // Its coordinates; NaN if there is none.
    float point[3];
    // Its distance; infinite if there is none.
    float distance;
    // Index of its face; `STACKLESS_NO_FACE` if there is none.
    uint32_t face;
} stackless_near_f;

// A ray that starts at an exact point, such as the point of a hit.
typedef struct {
    // The start point.
    const stackless_point_f *origin;
    // The end point, at t = 1. If null, the ray has the direction and the end below.
    const stackless_point_f *target;
    // Finite and nonzero.
    float direction[3];
    // The maximum distance of a hit, at least 0. May be infinite.
    float tmax;
    // Whether the ends belong to the ray. If not, hits have 0 < t < tmax: the ray does not hit the face that it
    // leaves, nor any other face that contains the origin.
    bool is_closed;
} stackless_exact_ray_f;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const uint32_t *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_exact_ray_f *ray, const stackless_hit_f *hit);
    // Passed to `accepts`.
    void *user;
} stackless_exact_filter_f;

// The hit of a ray with a face of an instance.
typedef struct {
    // Distance in lengths of the direction; infinite for a miss.
    float t;
    // Weight of the face's second vertex; NaN for a miss.
    float u;
    // Weight of the face's third vertex; NaN for a miss.
    float v;
    // Index of the face in its scene; `STACKLESS_NO_FACE` for a miss.
    uint32_t face;
    // Number of groups that contain the face; 0 for a miss.
    uint32_t levels;
    // The index of the instance in each of these groups, outermost first. The other numbers are `UINT32_MAX`.
    uint32_t path[STACKLESS_MAX_LEVELS];
} stackless_instance_hit_f;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const stackless_instance_hit_f *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_exact_ray_f *ray, const stackless_instance_hit_f *hit);
    // Passed to `accepts`.
    void *user;
} stackless_instances_exact_filter_f;

// A scene or a group of instances. Of the two pointers, one is null.
typedef struct {
    // A scene, or null.
    const stackless_scene_f *scene;
    // Instances, or null.
    const stackless_instances_f *instances;
} stackless_object_f;

// A filter for hits. A query finds the first accepted hit. Masked and skipped faces are not tested.
typedef struct {
    // Hits of a face are accepted if its mask and this mask have a bit in common. In a new scene the masks of all
    // faces have all bits set.
    uint32_t mask;
    // The index of a face whose hits are not accepted; for instances, a hit of this face. May be null.
    const stackless_instance_hit_f *skip;
    // Returns whether a hit is accepted, for example for transparency or for sides of faces. May be null. `ray` is the
    // ray of the call, at the program's address. The function must always return the same value for a hit. It is
    // called in no particular order, possibly several times for one face, and by several threads at once in parallel
    // batches. It must return: it must neither throw an exception nor jump. It may run queries.
    bool (*accepts)(void *user, const stackless_ray_f *ray, const stackless_instance_hit_f *hit);
    // Passed to `accepts`.
    void *user;
} stackless_instances_filter_f;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Returns the reason why the last failed call of this thread failed: one line that names the element, the found and the
// expected value. Empty if no call has failed. Valid until the next failure of this thread.
const char *stackless_error_message(void);

// Builds a scene in double precision. Vertices and faces are copied. Strides are in bytes; the strides and addresses
// of these arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null
// after an error.
stackless_error stackless_scene_new_d(const double *vertices,
                                      size_t vertex_stride,
                                      size_t vertex_count,
                                      const uint32_t *faces,
                                      size_t face_stride,
                                      size_t face_count,
                                      const stackless_options *options,
                                      stackless_scene_d **scene);

// Destroys a scene. No thread may use it any more. Null is ignored.
stackless_error stackless_scene_free_d(stackless_scene_d *scene);

// Moves the vertices. The faces and the number of vertices stay. Much faster than a new scene, but queries become
// slower the more the vertices move relative to each other. No other thread may use the scene during the call.
stackless_error stackless_scene_refit_d(stackless_scene_d *scene,
                                        const double *vertices,
                                        size_t vertex_stride,
                                        size_t vertex_count);

// Sets the mask of each face. Filters of rays are compared with these masks. Masks are not saved. No other thread may
// use the scene during the call.
stackless_error stackless_scene_set_masks_d(stackless_scene_d *scene,
                                            const uint32_t *masks,
                                            size_t mask_stride,
                                            size_t face_count);

// Writes the numbers of vertices and of faces. Each pointer except the first may be null.
stackless_error stackless_scene_counts_d(const stackless_scene_d *scene, size_t *vertex_count, size_t *face_count);

// Writes the least and the greatest coordinates of the corners of faces, three numbers each.
stackless_error stackless_scene_bounds_d(const stackless_scene_d *scene, double *lower, double *upper);

// Writes a scene to a file, atomically. The path is UTF-8. Files are portable between machines, and compatible with
// the Python package.
stackless_error stackless_scene_save_d(const stackless_scene_d *scene, const char *file);

// Reads a scene from a file, and checks its content. `threads` is as in `stackless_options`. `*scene` is null after an
// error.
stackless_error stackless_scene_load_d(const char *file, uint32_t threads, stackless_scene_d **scene);

// Writes the bytes of a scene, up to the capacity. `size` receives the total number. With a capacity of 0, `bytes` may
// be null.
stackless_error stackless_scene_to_bytes_d(const stackless_scene_d *scene,
                                           uint8_t *bytes,
                                           size_t capacity,
                                           size_t *size);

// Reads a scene from bytes, like `stackless_scene_load_d`.
stackless_error stackless_scene_from_bytes_d(const uint8_t *bytes,
                                             size_t size,
                                             uint32_t threads,
                                             stackless_scene_d **scene);

// Finds the closest hit of a ray: the hit with the least exact distance, and of equal distances the least index of a
// face. With a filter, which may be null, finds the first accepted hit.
stackless_error stackless_closest1_d(const stackless_scene_d *scene,
                                     const stackless_ray_d *ray,
                                     const stackless_filter_d *filter,
                                     stackless_hit_d *hit);

// Finds whether a ray has a hit; with a filter, which may be null, an accepted hit.
stackless_error stackless_any1_d(const stackless_scene_d *scene,
                                 const stackless_ray_d *ray,
                                 const stackless_filter_d *filter,
                                 bool *is_hit);

// Finds all hits of a ray, each face once, in the order of exact distances, then of indices. With a filter, which may
// be null, finds all accepted hits. Writes the first hits, up to the capacity. `count` receives the total number. With
// a capacity of 0, `hits` may be null.
stackless_error stackless_all1_d(const stackless_scene_d *scene,
                                 const stackless_ray_d *ray,
                                 const stackless_filter_d *filter,
                                 stackless_hit_d *hits,
                                 size_t hit_stride,
                                 size_t capacity,
                                 size_t *count);

// Finds the first hit after another hit of the ray, in the order of `stackless_all1_d`. So a program can walk from hit
// to hit: no hit is lost or repeated, however close the hits are. `after` and `hit` may point to the same hit.
stackless_error stackless_next1_d(const stackless_scene_d *scene,
                                  const stackless_ray_d *ray,
                                  const stackless_hit_d *after,
                                  stackless_hit_d *hit);

// Finds the closest hit of each ray, by `stackless_closest1_d`. `filters` may be null. It has a filter for each ray;
// with a stride of 0, one filter for all rays.
stackless_error stackless_closest_n_d(const stackless_scene_d *scene,
                                      const stackless_ray_d *rays,
                                      size_t ray_stride,
                                      size_t count,
                                      const stackless_filter_d *filters,
                                      size_t filter_stride,
                                      stackless_hit_d *hits,
                                      size_t hit_stride,
                                      uint32_t flags);

// Finds whether each ray has a hit, by `stackless_any1_d`. Filters are as in `stackless_closest_n_d`.
stackless_error stackless_any_n_d(const stackless_scene_d *scene,
                                  const stackless_ray_d *rays,
                                  size_t ray_stride,
                                  size_t count,
                                  const stackless_filter_d *filters,
                                  size_t filter_stride,
                                  bool *is_hit,
                                  size_t is_hit_stride,
                                  uint32_t flags);

// Counts how often each ray crosses a closed mesh. A crossing at an edge or a vertex counts once, and touching does
// not count.
stackless_error stackless_crossings_n_d(const stackless_scene_d *scene,
                                        const stackless_ray_d *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        uint32_t *crossings,
                                        size_t crossing_stride,
                                        uint32_t flags);

// Classifies each point, given by three numbers, as inside, outside or on a face: `STACKLESS_INSIDE`,
// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
// examines all edges.
stackless_error stackless_locate_n_d(const stackless_scene_d *scene,
                                     const double *points,
                                     size_t point_stride,
                                     size_t count,
                                     uint32_t rule,
                                     uint8_t *locations,
                                     size_t location_stride,
                                     uint32_t flags);

// Computes the distance of each point, given by three numbers, from the mesh. It is exact, then rounded once, and
// negative inside by a rule `STACKLESS_RULE_...`. It is also 0 on faces without area, which are no surface to
// `stackless_locate_n_d`.
stackless_error stackless_signed_distances_n_d(const stackless_scene_d *scene,
                                               const double *points,
                                               size_t point_stride,
                                               size_t count,
                                               uint32_t rule,
                                               double *distances,
                                               size_t distance_stride,
                                               uint32_t flags);

// Finds the point of the mesh that is nearest to each point, given by three numbers, within the radius, which may be
// infinite. Of equally near faces it returns the face with the least index.
stackless_error stackless_nearest_n_d(const stackless_scene_d *scene,
                                      const double *points,
                                      size_t point_stride,
                                      size_t count,
                                      double radius,
                                      stackless_near_d *nears,
                                      size_t near_stride,
                                      uint32_t flags);

// Finds the faces that are nearest to a point, given by three numbers, within the radius, which may be infinite.
// Writes the first `capacity` faces in the order of distances, then of indices. `count` receives the number of written
// faces.
stackless_error stackless_nearest_k1_d(const stackless_scene_d *scene,
                                       const double *point,
                                       double radius,
                                       stackless_near_d *nears,
                                       size_t near_stride,
                                       size_t capacity,
                                       size_t *count);

// Creates an exact point from three numbers. `*point` is null after an error.
stackless_error stackless_point_new_d(const double *coordinates, stackless_point_d **point);

// Creates the exact point at which a ray hits a face. It is not rounded. `*point` is null after an error.
stackless_error stackless_point_of_hit_d(const stackless_scene_d *scene,
                                         const stackless_ray_d *ray,
                                         uint32_t face,
                                         stackless_point_d **point);

// Destroys a point. No thread may use it any more. Null is ignored. Rays that started there do not need it.
stackless_error stackless_point_free_d(stackless_point_d *point);

// Finds the closest hit of a ray that starts at an exact point, and creates the exact point of the hit, at which the
// next ray may start. With a filter, which may be null, finds the first accepted hit. `point` may be null. `*point` is
// null after a miss and after an error.
stackless_error stackless_exact_closest1_d(const stackless_scene_d *scene,
                                           const stackless_exact_ray_d *ray,
                                           const stackless_exact_filter_d *filter,
                                           stackless_hit_d *hit,
                                           stackless_point_d **point);

// Finds whether a ray that starts at an exact point hits any face; with a filter, which may be null, whether it has an
// accepted hit.
stackless_error stackless_exact_any1_d(const stackless_scene_d *scene,
                                       const stackless_exact_ray_d *ray,
                                       const stackless_exact_filter_d *filter,
                                       bool *is_hit);

// Finds the closest hit of each ray, by `stackless_exact_closest1_d`. Filters are as in `stackless_closest_n_d`.
// `points` may be null. Each of its pointers is null after a miss, and all are null after an error.
stackless_error stackless_exact_closest_n_d(const stackless_scene_d *scene,
                                            const stackless_exact_ray_d *rays,
                                            size_t ray_stride,
                                            size_t count,
                                            const stackless_exact_filter_d *filters,
                                            size_t filter_stride,
                                            stackless_hit_d *hits,
                                            size_t hit_stride,
                                            stackless_point_d **points,
                                            size_t point_stride,
                                            uint32_t flags);

// Finds whether each ray has a hit, by `stackless_exact_any1_d`. Filters are as in `stackless_closest_n_d`.
stackless_error stackless_exact_any_n_d(const stackless_scene_d *scene,
                                        const stackless_exact_ray_d *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        const stackless_exact_filter_d *filters,
                                        size_t filter_stride,
                                        bool *is_hit,
                                        size_t is_hit_stride,
                                        uint32_t flags);

// Finds the closest hit of a ray that starts at an exact point, like `stackless_exact_closest1_d`. The point of the hit
// may be the start of rays of these instances, of other instances and of scenes.
stackless_error stackless_instances_exact_closest1_d(const stackless_instances_d *instances,
                                                     const stackless_exact_ray_d *ray,
                                                     const stackless_instances_exact_filter_d *filter,
                                                     stackless_instance_hit_d *hit,
                                                     stackless_point_d **point);

// Finds whether a ray that starts at an exact point has a hit, like `stackless_exact_any1_d`.
stackless_error stackless_instances_exact_any1_d(const stackless_instances_d *instances,
                                                 const stackless_exact_ray_d *ray,
                                                 const stackless_instances_exact_filter_d *filter,
                                                 bool *is_hit);

// Finds the closest hit of each ray, like `stackless_exact_closest_n_d`.
stackless_error stackless_instances_exact_closest_n_d(const stackless_instances_d *instances,
                                                      const stackless_exact_ray_d *rays,
                                                      size_t ray_stride,
                                                      size_t count,
                                                      const stackless_instances_exact_filter_d *filters,
                                                      size_t filter_stride,
                                                      stackless_instance_hit_d *hits,
                                                      size_t hit_stride,
                                                      stackless_point_d **points,
                                                      size_t point_stride,
                                                      uint32_t flags);

// Finds whether each ray has a hit, like `stackless_exact_any_n_d`.
stackless_error stackless_instances_exact_any_n_d(const stackless_instances_d *instances,
                                                  const stackless_exact_ray_d *rays,
                                                  size_t ray_stride,
                                                  size_t count,
                                                  const stackless_instances_exact_filter_d *filters,
                                                  size_t filter_stride,
                                                  bool *is_hit,
                                                  size_t is_hit_stride,
                                                  uint32_t flags);

// Places scenes, and other instances, by affine maps. Instance i is `objects[indices[i]]`, placed by `transforms[i]`:
// three rows of four numbers, the translation last. Maps are exact: no transformed vertex is rounded. They must have an
// inverse. Strides are in bytes; the stride and the address of the transforms need not be aligned. `options` may be
// null. `*instances` is null after an error.
//
// Instances do not need their objects any more: these may be refitted or destroyed. Instances keep the vertices and the
// masks that their scenes had.
stackless_error stackless_instances_new_d(const stackless_object_d *objects,
                                          size_t object_stride,
                                          size_t object_count,
                                          const uint32_t *indices,
                                          size_t index_stride,
                                          const double *transforms,
                                          size_t transform_stride,
                                          size_t count,
                                          const stackless_options *options,
                                          stackless_instances_d **instances);

// Destroys instances. No thread may use them any more. Null is ignored.
stackless_error stackless_instances_free_d(stackless_instances_d *instances);

// Writes the least and the greatest coordinates of a box that contains all faces, three numbers each. The box may be
// larger than necessary.
stackless_error stackless_instances_bounds_d(const stackless_instances_d *instances, double *lower, double *upper);

// Finds the closest hit of a ray: the hit with the least exact distance, of equal distances the least path, and of
// equal paths the least index of a face. With a filter, which may be null, finds the first accepted hit.
stackless_error stackless_instances_closest1_d(const stackless_instances_d *instances,
                                               const stackless_ray_d *ray,
                                               const stackless_instances_filter_d *filter,
                                               stackless_instance_hit_d *hit);

// Finds whether a ray has a hit; with a filter, which may be null, an accepted hit.
stackless_error stackless_instances_any1_d(const stackless_instances_d *instances,
                                           const stackless_ray_d *ray,
                                           const stackless_instances_filter_d *filter,
                                           bool *is_hit);

// Finds all hits of a ray, each face of each instance once, in the order of exact distances, then of paths and
// indices. The other arguments are those of `stackless_all1_d`.
stackless_error stackless_instances_all1_d(const stackless_instances_d *instances,
                                           const stackless_ray_d *ray,
                                           const stackless_instances_filter_d *filter,
                                           stackless_instance_hit_d *hits,
                                           size_t hit_stride,
                                           size_t capacity,
                                           size_t *count);

// Finds the closest hit of each ray, by `stackless_instances_closest1_d`. Filters are as in `stackless_closest_n_d`.
stackless_error stackless_instances_closest_n_d(const stackless_instances_d *instances,
                                                const stackless_ray_d *rays,
                                                size_t ray_stride,
                                                size_t count,
                                                const stackless_instances_filter_d *filters,
                                                size_t filter_stride,
                                                stackless_instance_hit_d *hits,
                                                size_t hit_stride,
                                                uint32_t flags);

// Finds whether each ray has a hit, by `stackless_instances_any1_d`. Filters are as in `stackless_closest_n_d`.
stackless_error stackless_instances_any_n_d(const stackless_instances_d *instances,
                                            const stackless_ray_d *rays,
                                            size_t ray_stride,
                                            size_t count,
                                            const stackless_instances_filter_d *filters,
                                            size_t filter_stride,
                                            bool *is_hit,
                                            size_t is_hit_stride,
                                            uint32_t flags);

// Builds a scene in single precision. Vertices and faces are copied. Strides are in bytes; the strides and addresses
// of these arrays need not be aligned. A face is three indices of vertices. `options` may be null. `*scene` is null
// after an error.
stackless_error stackless_scene_new_f(const float *vertices,
                                      size_t vertex_stride,
                                      size_t vertex_count,
                                      const uint32_t *faces,
                                      size_t face_stride,
                                      size_t face_count,
                                      const stackless_options *options,
                                      stackless_scene_f **scene);

// Destroys a scene. No thread may use it any more. Null is ignored.
stackless_error stackless_scene_free_f(stackless_scene_f *scene);

// Moves the vertices. The faces and the number of vertices stay. Much faster than a new scene, but queries become
// slower the more the vertices move relative to each other. No other thread may use the scene during the call.
stackless_error stackless_scene_refit_f(stackless_scene_f *scene,
                                        const float *vertices,
                                        size_t vertex_stride,
                                        size_t vertex_count);

// Sets the mask of each face. Filters of rays are compared with these masks. Masks are not saved. No other thread may
// use the scene during the call.
stackless_error stackless_scene_set_masks_f(stackless_scene_f *scene,
                                            const uint32_t *masks,
                                            size_t mask_stride,
                                            size_t face_count);

// Writes the numbers of vertices and of faces. Each pointer except the first may be null.
stackless_error stackless_scene_counts_f(const stackless_scene_f *scene, size_t *vertex_count, size_t *face_count);

// Writes the least and the greatest coordinates of the corners of faces, three numbers each.
stackless_error stackless_scene_bounds_f(const stackless_scene_f *scene, float *lower, float *upper);

// Writes a scene to a file, atomically. The path is UTF-8. Files are portable between machines, and compatible with
// the Python package.
stackless_error stackless_scene_save_f(const stackless_scene_f *scene, const char *file);

// Reads a scene from a file, and checks its content. `threads` is as in `stackless_options`. `*scene` is null after an
// error.
stackless_error stackless_scene_load_f(const char *file, uint32_t threads, stackless_scene_f **scene);

// Writes the bytes of a scene, up to the capacity. `size` receives the total number. With a capacity of 0, `bytes` may
// be null.
stackless_error stackless_scene_to_bytes_f(const stackless_scene_f *scene,
                                           uint8_t *bytes,
                                           size_t capacity,
                                           size_t *size);

// Reads a scene from bytes, like `stackless_scene_load_f`.
stackless_error stackless_scene_from_bytes_f(const uint8_t *bytes,
                                             size_t size,
                                             uint32_t threads,
                                             stackless_scene_f **scene);

// Finds the closest hit of a ray: the hit with the least exact distance, and of equal distances the least index of a
// face. With a filter, which may be null, finds the first accepted hit.
stackless_error stackless_closest1_f(const stackless_scene_f *scene,
                                     const stackless_ray_f *ray,
                                     const stackless_filter_f *filter,
                                     stackless_hit_f *hit);

// Finds whether a ray has a hit; with a filter, which may be null, an accepted hit.
stackless_error stackless_any1_f(const stackless_scene_f *scene,
                                 const stackless_ray_f *ray,
                                 const stackless_filter_f *filter,
                                 bool *is_hit);

// Finds all hits of a ray, each face once, in the order of exact distances, then of indices. With a filter, which may
// be null, finds all accepted hits. Writes the first hits, up to the capacity. `count` receives the total number. With
// a capacity of 0, `hits` may be null.
stackless_error stackless_all1_f(const stackless_scene_f *scene,
                                 const stackless_ray_f *ray,
                                 const stackless_filter_f *filter,
                                 stackless_hit_f *hits,
                                 size_t hit_stride,
                                 size_t capacity,
                                 size_t *count);

// Finds the first hit after another hit of the ray, in the order of `stackless_all1_f`. So a program can walk from hit
// to hit: no hit is lost or repeated, however close the hits are. `after` and `hit` may point to the same hit.
stackless_error stackless_next1_f(const stackless_scene_f *scene,
                                  const stackless_ray_f *ray,
                                  const stackless_hit_f *after,
                                  stackless_hit_f *hit);

// Finds the closest hit of each ray, by `stackless_closest1_f`. `filters` may be null. It has a filter for each ray;
// with a stride of 0, one filter for all rays.
stackless_error stackless_closest_n_f(const stackless_scene_f *scene,
                                      const stackless_ray_f *rays,
                                      size_t ray_stride,
                                      size_t count,
                                      const stackless_filter_f *filters,
                                      size_t filter_stride,
                                      stackless_hit_f *hits,
                                      size_t hit_stride,
                                      uint32_t flags);

// Finds whether each ray has a hit, by `stackless_any1_f`. Filters are as in `stackless_closest_n_f`.
stackless_error stackless_any_n_f(const stackless_scene_f *scene,
                                  const stackless_ray_f *rays,
                                  size_t ray_stride,
                                  size_t count,
                                  const stackless_filter_f *filters,
                                  size_t filter_stride,
                                  bool *is_hit,
                                  size_t is_hit_stride,
                                  uint32_t flags);

// Counts how often each ray crosses a closed mesh. A crossing at an edge or a vertex counts once, and touching does
// not count.
stackless_error stackless_crossings_n_f(const stackless_scene_f *scene,
                                        const stackless_ray_f *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        uint32_t *crossings,
                                        size_t crossing_stride,
                                        uint32_t flags);

// Classifies each point, given by three numbers, as inside, outside or on a face: `STACKLESS_INSIDE`,
// `STACKLESS_OUTSIDE` or `STACKLESS_SURFACE`, by a rule `STACKLESS_RULE_...`. The first call after a build or a refit
// examines all edges.
stackless_error stackless_locate_n_f(const stackless_scene_f *scene,
                                     const float *points,
                                     size_t point_stride,
                                     size_t count,
                                     uint32_t rule,
                                     uint8_t *locations,
                                     size_t location_stride,
                                     uint32_t flags);

// Computes the distance of each point, given by three numbers, from the mesh. It is exact, then rounded once, and
// negative inside by a rule `STACKLESS_RULE_...`. It is also 0 on faces without area, which are no surface to
// `stackless_locate_n_f`.
stackless_error stackless_signed_distances_n_f(const stackless_scene_f *scene,
                                               const float *points,
                                               size_t point_stride,
                                               size_t count,
                                               uint32_t rule,
                                               float *distances,
                                               size_t distance_stride,
                                               uint32_t flags);

// Finds the point of the mesh that is nearest to each point, given by three numbers, within the radius, which may be
// infinite. Of equally near faces it returns the face with the least index.
stackless_error stackless_nearest_n_f(const stackless_scene_f *scene,
                                      const float *points,
                                      size_t point_stride,
                                      size_t count,
                                      float radius,
                                      stackless_near_f *nears,
                                      size_t near_stride,
                                      uint32_t flags);

// Finds the faces that are nearest to a point, given by three numbers, within the radius, which may be infinite.
// Writes the first `capacity` faces in the order of distances, then of indices. `count` receives the number of written
// faces.
stackless_error stackless_nearest_k1_f(const stackless_scene_f *scene,
                                       const float *point,
                                       float radius,
                                       stackless_near_f *nears,
                                       size_t near_stride,
                                       size_t capacity,
                                       size_t *count);

// Creates an exact point from three numbers. `*point` is null after an error.
stackless_error stackless_point_new_f(const float *coordinates, stackless_point_f **point);

// Creates the exact point at which a ray hits a face. It is not rounded. `*point` is null after an error.
stackless_error stackless_point_of_hit_f(const stackless_scene_f *scene,
                                         const stackless_ray_f *ray,
                                         uint32_t face,
                                         stackless_point_f **point);

// Destroys a point. No thread may use it any more. Null is ignored. Rays that started there do not need it.
stackless_error stackless_point_free_f(stackless_point_f *point);

// Finds the closest hit of a ray that starts at an exact point, and creates the exact point of the hit, at which the
// next ray may start. With a filter, which may be null, finds the first accepted hit. `point` may be null. `*point` is
// null after a miss and after an error.
stackless_error stackless_exact_closest1_f(const stackless_scene_f *scene,
                                           const stackless_exact_ray_f *ray,
                                           const stackless_exact_filter_f *filter,
                                           stackless_hit_f *hit,
                                           stackless_point_f **point);

// Finds whether a ray that starts at an exact point hits any face; with a filter, which may be null, whether it has an
// accepted hit.
stackless_error stackless_exact_any1_f(const stackless_scene_f *scene,
                                       const stackless_exact_ray_f *ray,
                                       const stackless_exact_filter_f *filter,
                                       bool *is_hit);

// Finds the closest hit of each ray, by `stackless_exact_closest1_f`. Filters are as in `stackless_closest_n_f`.
// `points` may be null. Each of its pointers is null after a miss, and all are null after an error.
stackless_error stackless_exact_closest_n_f(const stackless_scene_f *scene,
                                            const stackless_exact_ray_f *rays,
                                            size_t ray_stride,
                                            size_t count,
                                            const stackless_exact_filter_f *filters,
                                            size_t filter_stride,
                                            stackless_hit_f *hits,
                                            size_t hit_stride,
                                            stackless_point_f **points,
                                            size_t point_stride,
                                            uint32_t flags);

// Finds whether each ray has a hit, by `stackless_exact_any1_f`. Filters are as in `stackless_closest_n_f`.
stackless_error stackless_exact_any_n_f(const stackless_scene_f *scene,
                                        const stackless_exact_ray_f *rays,
                                        size_t ray_stride,
                                        size_t count,
                                        const stackless_exact_filter_f *filters,
                                        size_t filter_stride,
                                        bool *is_hit,
                                        size_t is_hit_stride,
                                        uint32_t flags);

// Finds the closest hit of a ray that starts at an exact point, like `stackless_exact_closest1_f`. The point of the hit
// may be the start of rays of these instances, of other instances and of scenes.
stackless_error stackless_instances_exact_closest1_f(const stackless_instances_f *instances,
                                                     const stackless_exact_ray_f *ray,
                                                     const stackless_instances_exact_filter_f *filter,
                                                     stackless_instance_hit_f *hit,
                                                     stackless_point_f **point);

// Finds whether a ray that starts at an exact point has a hit, like `stackless_exact_any1_f`.
stackless_error stackless_instances_exact_any1_f(const stackless_instances_f *instances,
                                                 const stackless_exact_ray_f *ray,
                                                 const stackless_instances_exact_filter_f *filter,
                                                 bool *is_hit);

// Finds the closest hit of each ray, like `stackless_exact_closest_n_f`.
stackless_error stackless_instances_exact_closest_n_f(const stackless_instances_f *instances,
                                                      const stackless_exact_ray_f *rays,
                                                      size_t ray_stride,
                                                      size_t count,
                                                      const stackless_instances_exact_filter_f *filters,
                                                      size_t filter_stride,
                                                      stackless_instance_hit_f *hits,
                                                      size_t hit_stride,
                                                      stackless_point_f **points,
                                                      size_t point_stride,
                                                      uint32_t flags);

// Finds whether each ray has a hit, like `stackless_exact_any_n_f`.
stackless_error stackless_instances_exact_any_n_f(const stackless_instances_f *instances,
                                                  const stackless_exact_ray_f *rays,
                                                  size_t ray_stride,
                                                  size_t count,
                                                  const stackless_instances_exact_filter_f *filters,
                                                  size_t filter_stride,
                                                  bool *is_hit,
                                                  size_t is_hit_stride,
                                                  uint32_t flags);

// Places scenes, and other instances, by affine maps. Instance i is `objects[indices[i]]`, placed by `transforms[i]`:
// three rows of four numbers, the translation last. Maps are exact: no transformed vertex is rounded. They must have an
// inverse. Strides are in bytes; the stride and the address of the transforms need not be aligned. `options` may be
// null. `*instances` is null after an error.
//
// Instances do not need their objects any more: these may be refitted or destroyed. Instances keep the vertices and the
// masks that their scenes had.
stackless_error stackless_instances_new_f(const stackless_object_f *objects,
                                          size_t object_stride,
                                          size_t object_count,
                                          const uint32_t *indices,
                                          size_t index_stride,
                                          const float *transforms,
                                          size_t transform_stride,
                                          size_t count,
                                          const stackless_options *options,
                                          stackless_instances_f **instances);

// Destroys instances. No thread may use them any more. Null is ignored.
stackless_error stackless_instances_free_f(stackless_instances_f *instances);

// Writes the least and the greatest coordinates of a box that contains all faces, three numbers each. The box may be
// larger than necessary.
stackless_error stackless_instances_bounds_f(const stackless_instances_f *instances, float *lower, float *upper);

// Finds the closest hit of a ray: the hit with the least exact distance, of equal distances the least path, and of
// equal paths the least index of a face. With a filter, which may be null, finds the first accepted hit.
stackless_error stackless_instances_closest1_f(const stackless_instances_f *instances,
                                               const stackless_ray_f *ray,
                                               const stackless_instances_filter_f *filter,
                                               stackless_instance_hit_f *hit);

// Finds whether a ray has a hit; with a filter, which may be null, an accepted hit.
stackless_error stackless_instances_any1_f(const stackless_instances_f *instances,
                                           const stackless_ray_f *ray,
                                           const stackless_instances_filter_f *filter,
                                           bool *is_hit);

// Finds all hits of a ray, each face of each instance once, in the order of exact distances, then of paths and
// indices. The other arguments are those of `stackless_all1_f`.
stackless_error stackless_instances_all1_f(const stackless_instances_f *instances,
                                           const stackless_ray_f *ray,
                                           const stackless_instances_filter_f *filter,
                                           stackless_instance_hit_f *hits,
                                           size_t hit_stride,
                                           size_t capacity,
                                           size_t *count);

// Finds the closest hit of each ray, by `stackless_instances_closest1_f`. Filters are as in `stackless_closest_n_f`.
stackless_error stackless_instances_closest_n_f(const stackless_instances_f *instances,
                                                const stackless_ray_f *rays,
                                                size_t ray_stride,
                                                size_t count,
                                                const stackless_instances_filter_f *filters,
                                                size_t filter_stride,
                                                stackless_instance_hit_f *hits,
                                                size_t hit_stride,
                                                uint32_t flags);

// Finds whether each ray has a hit, by `stackless_instances_any1_f`. Filters are as in `stackless_closest_n_f`.
stackless_error stackless_instances_any_n_f(const stackless_instances_f *instances,
                                            const stackless_ray_f *rays,
                                            size_t ray_stride,
                                            size_t count,
                                            const stackless_instances_filter_f *filters,
                                            size_t filter_stride,
                                            bool *is_hit,
                                            size_t is_hit_stride,
                                            uint32_t flags);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* STACKLESS_H */
