#include <stdio.h>
#include <stackless.h>

int main(void)
{
    /* A tetrahedron, seen counterclockwise from outside. */
    const double vertices[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    stackless_scene_d *scene;
    if (stackless_scene_new_d(vertices[0], sizeof vertices[0], 4, faces[0], sizeof faces[0], 4, NULL, &scene)) {
        fprintf(stderr, "%s\n", stackless_error_message());
        return 1;
    }
    const stackless_ray_d ray = {.origin = {0.25, 0.25, -1}, .direction = {0, 0, 1}, .tmax = 100};
    stackless_hit_d hit;
    if (stackless_closest1_d(scene, &ray, NULL, &hit)) {
        fprintf(stderr, "%s\n", stackless_error_message());
        return 1;
    }
    printf("face %u at distance %g\n", hit.face, hit.t);
    return stackless_scene_free_d(scene);
}
