// Volumes that share faces, as in programs for particle transport, and a scene for the boundary of each.
#ifndef ASSEMBLY_HPP
#define ASSEMBLY_HPP

#include <cmath>
#include <map>
#include <stackless.hpp>

using point = std::array<double, 3>;
using face = std::array<std::uint32_t, 3>;
using scene = stackless::scene<double>;

// Three blocks in a row: a tube and a rod in the left one, a shell and a core in the middle one, a torus in the right
// one, and the void around all volumes.
enum volume : int { nowhere, left, middle, right, tube, rod, shell, core, torus, volumes };

// The coordinates of `make_assembly` are multiples of this, so differences of points are exact, and rays can be aimed
// exactly at vertices.
constexpr double grid = 1.0 / 1024;

// Faces over common vertices, each with the volumes at its front and at its back.
struct assembly {
    std::vector<point> vertices;
    std::vector<face> faces;
    std::vector<std::array<volume, 2>> sides;

    void add(const face& it, std::array<volume, 2> between)
    {
        faces.push_back(it);
        sides.push_back(between);
    }
};

inline double rounded(double x) { return std::round(x / grid) * grid; }

// A side of a box, at the coordinate `at` of an axis, of many small faces.
inline void add_wall(assembly& made, std::map<point, std::uint32_t>& known, int axis, double at,
                     std::array<double, 2> from, std::array<double, 2> to, std::array<volume, 2> sides)
{
    constexpr int cells = 6;
    const auto vertex = [&](int i, int j) {
        point p;
        p[axis] = at;
        p[(axis + 1) % 3] = from[0] + rounded((to[0] - from[0]) / cells * i);
        p[(axis + 2) % 3] = from[1] + rounded((to[1] - from[1]) / cells * j);
        const auto found = known.try_emplace(p, static_cast<std::uint32_t>(made.vertices.size()));
        if (found.second) {
            made.vertices.push_back(p);
        }
        return found.first->second;
    };
    for (int i = 0; i < cells; i++) {
        for (int j = 0; j < cells; j++) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            made.add({a, b, c}, sides);
            made.add({a, c, d}, sides);
        }
    }
}

// A surface of revolution around an axis through (x, 0, 0), parallel to z. The profile has radii and heights, from the
// top down along the outside. It ends on the axis, or is a ring.
inline void add_revolution(assembly& made, double x, const std::vector<std::array<double, 2>>& profile,
                           std::array<volume, 2> sides)
{
    constexpr int around = 48;
    const double pi = std::acos(-1.0);
    std::vector<std::uint32_t> first;
    for (const auto& [radius, height] : profile) {
        first.push_back(static_cast<std::uint32_t>(made.vertices.size()));
        for (int j = 0; j < (radius == 0 ? 1 : around); j++) {
            const double angle = 2 * pi * j / around;
            made.vertices.push_back(
                {x + rounded(radius * std::cos(angle)), rounded(radius * std::sin(angle)), rounded(height)});
        }
    }
    const std::size_t count = profile.size();
    const auto vertex = [&](std::size_t i, int j) {
        return first[i % count] + static_cast<std::uint32_t>(profile[i % count][0] == 0 ? 0 : j % around);
    };
    for (std::size_t i = 0; i < (profile[0][0] == 0 ? count - 1 : count); i++) {
        for (int j = 0; j < around; j++) {
            const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            if (b != c) {
                made.add({a, b, c}, sides);
            }
            if (a != d) {
                made.add({a, c, d}, sides);
            }
        }
    }
}

// Half a circle, or a ring at a distance from the axis.
inline std::vector<std::array<double, 2>> arc(double distance, double radius)
{
    constexpr int across = 24;
    const double pi = std::acos(-1.0);
    std::vector<std::array<double, 2>> profile;
    for (int i = 0; i < across; i++) {
        const double angle = (distance == 0 ? 1 : 2) * pi * i / across;
        profile.push_back({distance + radius * std::sin(angle), radius * std::cos(angle)});
    }
    if (distance == 0) {
        profile.push_back({0, -radius});
    }
    return profile;
}

inline std::vector<std::array<double, 2>> cylinder(double radius, double half)
{
    return {{0, half}, {radius, half}, {radius, -half}, {0, -half}};
}

inline assembly make_assembly()
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
    add_revolution(made, -2, cylinder(0.75, 0.875), {left, tube});
    add_revolution(made, -2, cylinder(0.375, 0.75), {tube, rod});
    add_revolution(made, 0, arc(0, 0.875), {middle, shell});
    add_revolution(made, 0, arc(0, 0.5), {shell, core});
    add_revolution(made, 2, arc(0.625, 0.25), {right, torus});
    return made;
}

// A volume: the faces around it, and for each face its number in the assembly and the volume behind it.
struct cell {
    scene boundary;
    std::vector<std::uint32_t> faces;
    std::vector<volume> behind;
};

inline cell cut_out(const assembly& all, volume it)
{
    std::vector<face> faces;
    std::vector<std::uint32_t> numbers;
    std::vector<volume> behind;
    for (std::uint32_t i = 0; i < all.faces.size(); i++) {
        const auto [front, back] = all.sides[i];
        if (front == it || back == it) {
            faces.push_back(all.faces[i]);
            numbers.push_back(i);
            behind.push_back(front == it ? back : front);
        }
    }
    return {scene(all.vertices, faces), numbers, behind};
}

// Whether a particle at distance `from` of its start is in a volume: exactly, by counting how often the rest of its
// line crosses the boundary. The last part of every line is in the void.
inline bool is_in(const std::vector<cell>& cells, volume it, scene::ray ray, double from)
{
    ray.tmin = from;
    return cells[it].boundary.crossings(ray) % 2 == (it == nowhere ? 0 : 1);
}

#endif
