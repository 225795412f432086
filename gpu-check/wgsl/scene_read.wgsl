// The parameters of a scene after the rays, for kernels that are compiled once for all scenes.

fn begin_scene() {
    read_head(3u * params.x);
}
