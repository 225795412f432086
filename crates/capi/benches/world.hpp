// Assemblies of volumes, particles and their steps, and their exact judge.
#ifndef WORLD_HPP
#define WORLD_HPP

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <random>

#include "../examples/assembly.hpp"

static constexpr double INFINITE = std::numeric_limits<double>::infinity();
static constexpr int LIMIT = 1000;

[[noreturn]] static void fail(const std::string& message)
{
    std::fprintf(stderr, "%s\n", message.c_str());
    std::exit(2);
}

static point minus(const point& a, const point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
static double dot(const point& a, const point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static point along(const point& a, double t, const point& d)
{
    return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}
static point cross(const point& a, const point& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
static scene::ray line(const point& p, const point& d, double tmin, double tmax)
{
    return {{p[0], p[1], p[2]}, tmin, {d[0], d[1], d[2]}, tmax};
}

struct particle {
    point origin, direction;
    volume start;
    bool turns;
    std::uint32_t seed;
};

// The void has steps up to a point far outside.
struct step {
    volume in;
    point from, to;
};

struct track {
    std::vector<step> steps;
    bool is_lost = true;
};

struct world {
    assembly all;
    // All faces.
    scene whole;
    std::vector<cell> cells;
    double size;

    explicit world(assembly from) : all(std::move(from)), whole(all.vertices, all.faces), size(0)
    {
        for (int it = nowhere; it < volumes && (it == nowhere || has(it)); it++) {
            cells.push_back(cut_out(all, static_cast<volume>(it)));
        }
        const auto [low, high] = whole.bounds();
        for (int k = 0; k < 3; k++) {
            size = std::max(size, high[k] - low[k]);
        }
    }

    bool has(int it) const
    {
        return std::any_of(all.sides.begin(), all.sides.end(), [&](auto& s) { return s[0] == it || s[1] == it; });
    }

    // The volume of a line at a distance, or `volumes`.
    volume where(const scene::ray& ray, double from) const
    {
        int it = nowhere;
        while (it < static_cast<int>(cells.size()) && !is_in(cells, static_cast<volume>(it), ray, from)) {
            it++;
        }
        return static_cast<volume>(it < static_cast<int>(cells.size()) ? it : volumes);
    }

    point far(const point& p, const point& d) const { return along(p, 4 * size / std::sqrt(dot(d, d)), d); }

    // Edges of a face from its first corner.
    std::array<point, 2> edges(std::uint32_t number) const
    {
        const auto [a, b, c] = all.faces[number];
        return {minus(all.vertices[b], all.vertices[a]), minus(all.vertices[c], all.vertices[a])};
    }

    // The volumes in front of a hit and behind it, unless it is so near to an edge, or so flat, that rounding matters.
    std::optional<std::array<volume, 2>> around(const scene::hit& hit, const point& d) const
    {
        const auto [e, f] = edges(hit.face);
        const double across = dot(d, cross(e, f)), scale = std::sqrt(dot(d, d) * dot(e, e) * dot(f, f));
        if (std::min({hit.u, hit.v, 1 - hit.u - hit.v}) < 1e-9 || std::abs(across) < 1e-9 * scale) {
            return std::nullopt;
        }
        const auto [front, back] = all.sides[hit.face];
        return across < 0 ? std::array{front, back} : std::array{back, front};
    }

    // A random direction through a face, from a side to the other one.
    point turn(std::minstd_rand& random, std::uint32_t number, volume from) const
    {
        std::uniform_real_distribution<double> within(-1, 1);
        const auto [e, f] = edges(number);
        const point n = all.sides[number][1] == from ? cross(e, f) : cross(f, e);
        for (;;) {
            const point d = {within(random), within(random), within(random)};
            if (dot(d, n) > 1e-3 * std::sqrt(dot(d, d) * dot(n, n))) {
                return d;
            }
        }
    }

    bool are_near(const point& p, const point& q) const
    {
        const point d = minus(p, q);
        return dot(d, d) < 1e-12 * size * size;
    }

    // Judges a step exactly, up to a tolerance.
    bool is_wrong(const step& s) const
    {
        const double tolerance = 1e-5 * size;
        const point d = minus(s.to, s.from);
        const double shortest = 2 * tolerance / std::sqrt(dot(d, d));
        if (!(shortest < 1)) {
            return false;
        }
        const scene& boundary = cells[s.in].boundary;
        std::vector<double> ends = {0};
        for (const auto& hit : boundary.all(line(s.from, d, 0, 1))) {
            ends.push_back(hit.t);
        }
        ends.push_back(1);
        for (std::size_t i = 1; i < ends.size(); i++) {
            const point middle = along(s.from, (ends[i - 1] + ends[i]) / 2, d);
            if (ends[i] - ends[i - 1] > shortest &&
                boundary.locate(middle) == (s.in == nowhere ? stackless::location::inside
                                                            : stackless::location::outside) &&
                boundary.nearest_n(std::array<point, 1>{middle}, tolerance)[0].face == STACKLESS_NO_FACE) {
                return true;
            }
        }
        return false;
    }
};

// The assembly turned, scaled and moved: its coordinates are rounded.
static assembly turned(assembly it)
{
    const point rows[3] = {{-20, 4, 22}, {20, -10, 20}, {10, 28, 4}}, offset = {0.3, 0.7, -0.2};
    for (point& p : it.vertices) {
        const point old = p;
        for (int k = 0; k < 3; k++) {
            p[k] = dot(rows[k], old) / 27 + offset[k];
        }
    }
    return it;
}

// A closed part, in a file of shared/scenes: binary PLY, three floats for a vertex, a count of 3 and three indices for
// a face. Scaled to a size of 10. Equal vertices become one.
static assembly read_part(const char* name)
{
    std::ifstream file(name, std::ios::binary);
    std::string text;
    std::size_t vertex_count = 0, face_count = 0;
    while (std::getline(file, text) && text != "end_header") {
        std::sscanf(text.c_str(), "element vertex %zu", &vertex_count);
        std::sscanf(text.c_str(), "element face %zu", &face_count);
    }
    std::vector<std::array<float, 3>> floats(vertex_count);
    file.read(reinterpret_cast<char*>(floats.data()), static_cast<std::streamsize>(vertex_count * 12));
    double size = 0;
    for (int k = 0; k < 3 && vertex_count > 0; k++) {
        const auto [low, high] = std::minmax_element(floats.begin(), floats.end(),
                                                     [&](auto& a, auto& b) { return a[k] < b[k]; });
        size = std::max(size, double{(*high)[k]} - (*low)[k]);
    }
    assembly made;
    std::map<point, std::uint32_t> known;
    std::map<std::array<std::uint32_t, 2>, int> edges;
    double volume_of_part = 0;
    for (std::size_t i = 0; i < face_count; i++) {
        char record[13];
        std::array<std::uint32_t, 3> corners;
        face it;
        if (!file.read(record, sizeof record)) {
            fail(std::string(name) + " ends before face " + std::to_string(i));
        }
        std::memcpy(corners.data(), record + 1, 12);
        for (int k = 0; k < 3; k++) {
            const auto& v = floats.at(corners[k]);
            const point p = {v[0] * 10.0 / size, v[1] * 10.0 / size, v[2] * 10.0 / size};
            const auto found = known.try_emplace(p, static_cast<std::uint32_t>(made.vertices.size()));
            if (found.second) {
                made.vertices.push_back(p);
            }
            it[k] = found.first->second;
        }
        if (it[0] != it[1] && it[1] != it[2] && it[2] != it[0]) {
            made.add(it, {nowhere, left});
            for (int k = 0; k < 3; k++) {
                edges[{it[k], it[(k + 1) % 3]}]++;
                edges[{it[(k + 1) % 3], it[k]}]--;
            }
            volume_of_part += dot(made.vertices[it[0]], cross(made.vertices[it[1]], made.vertices[it[2]]));
        }
    }
    const auto open = std::count_if(edges.begin(), edges.end(), [](auto& edge) { return edge.second != 0; });
    if (made.faces.empty() || open != 0 || volume_of_part <= 0) {
        fail(std::string(name) + ": " + std::to_string(made.faces.size()) + " faces, " + std::to_string(open / 2) +
             " open edges, volume " + std::to_string(volume_of_part) + ", expected a closed mesh, outside in front");
    }
    return made;
}

#endif
