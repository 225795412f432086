// The head of a scene behind the rays, for kernels that are compiled once for all scenes.

fn begin_scene() {
    read_head(3u * params.x);
}
