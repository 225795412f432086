// Tracks particles through volumes that share faces, like programs for particle transport, and counts lost particles.
// Half of the particles are aimed exactly at vertices, along edges and within walls, where rounding trackers lose
// particles.
//
//     tracker [PARTICLES]
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "assembly.hpp"

const char* const names[volumes] = {"void", "left block", "middle block", "right block", "tube",
                                    "rod",  "shell",      "core",         "torus"};

// Tracks a particle to the void. A particle is lost if it is in no volume or in two volumes, or does not reach the
// void.
bool is_lost(const std::vector<cell>& cells, const scene::ray& start, long& events)
{
    scene::ray ray = start;
    for (int steps = 0; steps < 1000; steps++, events++) {
        int claims = 0;
        volume now = nowhere;
        for (int it = nowhere; it < volumes; it++) {
            if (is_in(cells, static_cast<volume>(it), ray, ray.tmin)) {
                now = static_cast<volume>(it);
                claims++;
            }
        }
        if (claims != 1) {
            std::printf("at %.17g in %d volumes, the last one %s\n", ray.tmin, claims, names[now]);
            return true;
        }
        const auto hit = cells[now].boundary.closest(ray);
        if (!hit) {
            return now != nowhere;
        }
        // The exact distance of the hit is less than the next number.
        ray.tmin = std::nextafter(hit->t, ray.tmax);
    }
    return true;
}

int main(int count, char** arguments)
{
    const long particles = count > 1 ? std::atol(arguments[1]) : 20000;
    const assembly all = make_assembly();
    std::vector<cell> cells;
    for (int it = nowhere; it < volumes; it++) {
        cells.push_back(cut_out(all, static_cast<volume>(it)));
    }
    std::mt19937_64 random(1);
    const auto below = [&](std::size_t n) { return random() % n; };
    const auto coordinate = [&](int half) {
        return (static_cast<double>(below(2048 * half + 1)) - 1024 * half) * grid;
    };
    long lost = 0, events = 0;
    for (long i = 0; i < particles; i++) {
        scene::ray ray = {{coordinate(3), coordinate(1), coordinate(1)}, 0, {0, 0, 0},
                          std::numeric_limits<double>::infinity()};
        const point& aim = all.vertices[below(all.vertices.size())];
        const point& from = all.vertices[below(all.vertices.size())];
        switch (i % 4) {
        case 0: // Aimed at a vertex.
            for (int k = 0; k < 3; k++) {
                ray.direction[k] = aim[k] - ray.origin[k];
            }
            break;
        case 1: // Between vertices: along edges, and within walls.
            for (int k = 0; k < 3; k++) {
                ray.origin[k] = from[k];
                ray.direction[k] = aim[k] - from[k];
            }
            break;
        default: // In a random direction.
            for (double& x : ray.direction) {
                x = std::uniform_real_distribution<double>(-1, 1)(random);
            }
        }
        if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0) {
            ray.direction[0] = 1;
        }
        lost += is_lost(cells, ray, events);
    }
    std::printf("%zu faces, %d volumes, %ld particles, %ld steps, %ld lost\n", all.faces.size(), int{volumes},
                particles, events, lost);
    return lost != 0;
}
