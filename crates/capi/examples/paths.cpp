// The loop of a path tracer in a closed sphere, with a lamp in the middle. Each hit has a shadow ray to the lamp, and
// the next ray of the path. Rays start at the exact point of the hit, so no ray hits the face that it leaves, and no
// ray leaks out. Paths from rounded points show the errors that an offset would have to hide. Prints counts, and fails
// if exact rays err.
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <stackless.hpp>

using scene = stackless::scene<double>;
using vector = std::array<double, 3>;

static const double INFINITE = std::numeric_limits<double>::infinity();

struct mesh {
    std::vector<vector> vertices;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

static vector unit(const vector& v)
{
    const double length = std::hypot(v[0], v[1], v[2]);
    return {v[0] / length, v[1] / length, v[2] / length};
}

// An octahedron with `rows` rows of triangles in each face. Each face has its own vertices, equal at the seams.
static mesh sphere(int rows)
{
    mesh made;
    const auto corner = [&](int octant, int i, int j) {
        const vector v = unit({double(i), double(j), double(rows - i - j)});
        made.vertices.push_back({octant & 1 ? -v[0] : v[0], octant & 2 ? -v[1] : v[1], octant & 4 ? -v[2] : v[2]});
        return std::uint32_t(made.vertices.size() - 1);
    };
    for (int octant = 0; octant < 8; octant++) {
        for (int i = 0; i < rows; i++) {
            for (int j = 0; i + j < rows; j++) {
                made.faces.push_back({corner(octant, i, j), corner(octant, i + 1, j), corner(octant, i, j + 1)});
                if (i + j + 1 < rows) {
                    made.faces.push_back(
                        {corner(octant, i + 1, j), corner(octant, i + 1, j + 1), corner(octant, i, j + 1)});
                }
            }
        }
    }
    return made;
}

struct counts {
    long bounces = 0, self_hits = 0, escaped = 0, blocked = 0;

    bool are_right() const { return self_hits == 0 && escaped == 0 && blocked == 0; }

    void print(const char* name) const
    {
        std::printf("%-14s %7ld bounces: %5ld self-hits, %5ld escaped, %5ld shadow rays blocked\n", name, bounces,
                    self_hits, escaped, blocked);
    }
};

// The rounded point of a hit.
static vector place(const mesh& m, const scene::hit& hit)
{
    const auto& face = m.faces[hit.face];
    vector p{};
    for (int k = 0; k < 3; k++) {
        p[k] = (1 - hit.u - hit.v) * m.vertices[face[0]][k] + hit.u * m.vertices[face[1]][k] +
               hit.v * m.vertices[face[2]][k];
    }
    return p;
}

static scene::ray ray(const vector& from, const vector& direction, double tmax)
{
    return {{from[0], from[1], from[2]}, 0, {direction[0], direction[1], direction[2]}, tmax};
}

int main()
{
    const int paths = 1000, bounces = 20;
    const mesh m = sphere(24);
    const scene walls(m.vertices, m.faces);
    const vector lamp = {0.1, 0.2, 0.3};
    const stackless::exact_point<double> exact_lamp(lamp);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> within(-0.5, 0.5);
    counts exact, rounded;
    for (int i = 0; i < paths; i++) {
        auto hit = walls.exact_closest({exact_lamp.get(), nullptr, {within(random), within(random), 1}, INFINITE, false});
        for (int bounce = 0; hit && bounce < bounces; bounce++) {
            // Towards a point inside.
            const vector from = place(m, hit->found);
            vector direction = {within(random), within(random), within(random)}, to_lamp{};
            for (int k = 0; k < 3; k++) {
                direction[k] -= from[k];
                to_lamp[k] = lamp[k] - from[k];
            }
            const auto face = hit->found.face;
            const auto [x, y, z] = direction;
            exact.blocked += walls.exact_any({hit->point.get(), exact_lamp.get(), {}, 0, false});
            auto next = walls.exact_closest({hit->point.get(), nullptr, {x, y, z}, INFINITE, false});
            exact.bounces++;
            exact.escaped += !next;
            exact.self_hits += next && next->found.face == face;

            rounded.blocked += walls.any(ray(from, to_lamp, 1));
            const auto usual = walls.closest(ray(from, direction, INFINITE));
            rounded.bounces++;
            rounded.escaped += !usual;
            rounded.self_hits += usual && usual->face == face;
            hit = std::move(next);
        }
    }
    exact.print("exact points");
    rounded.print("rounded points");
    return exact.are_right() && exact.bounces == long{paths} * bounces ? 0 : 1;
}
