// Tracks particles through volumes that share faces, like programs for particle transport, and counts lost particles.
// Half of the particles are aimed exactly at vertices, along edges and within walls, where rounding trackers lose
// particles.
//
//     tracker [PARTICLES]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <random>
#include <stackless.hpp>

using point = std::array<double, 3>;
using face = std::array<std::uint32_t, 3>;
using scene = stackless::scene<double>;

// Three blocks in a row, a shell in the middle block, a core in the shell, and the void around all volumes.
enum volume : int { nowhere, left, middle, right, shell, core, volumes };
const char* const names[volumes] = {"void", "left block", "middle block", "right block", "shell", "core"};

// All coordinates are multiples of this, so differences of points are exact, and rays can be aimed exactly at vertices.
constexpr double grid = 1.0 / 1024;

// Faces over common vertices, each with the volumes at its front and at its back.
struct assembly {
    std::vector<point> vertices;
    std::vector<face> faces;
    std::vector<std::array<volume, 2>> sides;
};

// A side of a box, at the coordinate `at` of an axis, of many small faces.
void add_wall(assembly& made, std::map<point, std::uint32_t>& known, int axis, double at, std::array<double, 2> from,
              std::array<double, 2> to, std::array<volume, 2> sides)
{
    constexpr int cells = 6;
    const auto vertex = [&](int i, int j) {
        point p;
        p[axis] = at;
        p[(axis + 1) % 3] = from[0] + std::round((to[0] - from[0]) / cells * i / grid) * grid;
        p[(axis + 2) % 3] = from[1] + std::round((to[1] - from[1]) / cells * j / grid) * grid;
        const auto found = known.try_emplace(p, static_cast<std::uint32_t>(made.vertices.size()));
        if (found.second) {
            made.vertices.push_back(p);
        }
        return found.first->second;
    };
    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < cells; j++) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            made.faces.insert(made.faces.end(), {face{a, b, c}, face{a, c, d}});
            made.sides.insert(made.sides.end(), 2, sides);
        }
    }
}

// A sphere around the origin, of meridians and circles of latitude.
void add_sphere(assembly& made, double radius, std::array<volume, 2> sides)
{
    constexpr int around = 48, across = 24;
    const double pi = std::acos(-1.0);
    const auto first = static_cast<std::uint32_t>(made.vertices.size());
    for (int i = 0; i <= across; i++) {
        for (int j = 0; j < (i % across == 0 ? 1 : around); j++) {
            const double a = pi * i / across, b = 2 * pi * j / around;
            const point exact = {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
            point rounded;
            for (int k = 0; k < 3; k++) {
                rounded[k] = std::round(radius * exact[k] / grid) * grid;
            }
            made.vertices.push_back(rounded);
        }
    }
    const auto vertex = [&](int i, int j) {
        const int place = i == 0 ? 0 : i == across ? 1 + (across - 1) * around : 1 + (i - 1) * around + j % around;
        return first + static_cast<std::uint32_t>(place);
    };
    for (int i = 0; i < across; i++) {
        for (int j = 0; j < around; j++) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            if (i + 1 < across) {
                made.faces.push_back({a, b, c});
                made.sides.push_back(sides);
            }
            if (i > 0) {
                made.faces.push_back({a, c, d});
                made.sides.push_back(sides);
            }
        }
    }
}

assembly make()
{
    assembly made;
    std::map<point, std::uint32_t> known;
    for (int block = 0; block < 3; block++) {
        const double x = 2 * block - 3;
        const auto it = static_cast<volume>(left + block);
        add_wall(made, known, 0, x, {-1, -1}, {1, 1}, {it, block == 0 ? nowhere : static_cast<volume>(it - 1)});
        for (const double at : {-1.0, 1.0}) {
            add_wall(made, known, 1, at, {-1, x}, {1, x + 2}, {at < 0 ? it : nowhere, at < 0 ? nowhere : it});
            add_wall(made, known, 2, at, {x, -1}, {x + 2, 1}, {at < 0 ? it : nowhere, at < 0 ? nowhere : it});
        }
    }
    add_wall(made, known, 0, 3, {-1, -1}, {1, 1}, {nowhere, right});
    add_sphere(made, 0.875, {middle, shell});
    add_sphere(made, 0.5, {shell, core});
    return made;
}

// A volume: the faces around it, and for each face the volume behind it.
struct cell {
    scene boundary;
    std::vector<volume> behind;
};

cell cut_out(const assembly& all, volume it)
{
    std::vector<face> faces;
    std::vector<volume> behind;
    for (std::size_t i = 0; i < all.faces.size(); i++) {
        const auto [front, back] = all.sides[i];
        if (front == it || back == it) {
            faces.push_back(all.faces[i]);
            behind.push_back(front == it ? back : front);
        }
    }
    return {scene(all.vertices, faces), behind};
}

// Whether a particle at distance `from` of its start is in a volume: exactly, by counting how often the rest of its
// line crosses the boundary. The last part of every line is in the void.
bool is_in(const std::vector<cell>& cells, volume it, scene::ray ray, double from)
{
    ray.tmin = from;
    return cells[it].boundary.crossings(ray) % 2 == (it == nowhere ? 0 : 1);
}

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
    const assembly all = make();
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
