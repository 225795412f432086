// Every function of stackless.hpp, in single and in double precision.
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stackless.hpp>

#define CHECK(condition) check_that((condition), #condition, __LINE__)

static void check_that(bool holds, const char* text, int line)
{
    if (!holds) {
        std::fprintf(stderr, "wrapper.cpp:%d: %s does not hold\n", line, text);
        std::exit(1);
    }
}

template <class Work> static void refused(stackless_error code, const std::string& text, Work work)
{
    try {
        work();
    } catch (const stackless::error& error) {
        if (error.code() == code && std::string(error.what()).find(text) != std::string::npos) {
            return;
        }
        std::fprintf(stderr, "refused with %d: %s\n", int{error.code()}, error.what());
    }
    std::fprintf(stderr, "not refused with %d: %s\n", int{code}, text.c_str());
    std::exit(1);
}

template <class Real> struct vertex {
    Real x, y, z;
    char colour;
};

template <class Real> static void run(const std::string& file)
{
    using stackless::location;
    using scene = stackless::scene<Real>;
    using ray = typename scene::ray;
    const Real infinity = std::numeric_limits<Real>::infinity();
    // A tetrahedron.
    std::vector<vertex<Real>> vertices = {{0, 0, 0, 'a'}, {4, 0, 0, 'b'}, {0, 4, 0, 'c'}, {0, 0, 4, 'd'}};
    const std::array<std::array<std::uint32_t, 3>, 4> faces = {{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
    scene made(vertices, faces, {STACKLESS_QUALITY_HIGH, 2});
    made.save(file);
    scene moved = scene::load(file);
    made = scene::from_bytes(moved.to_bytes());
    CHECK(made.face_count() == 4 && made.bounds()[0][0] == 0 && made.bounds()[1][2] == 4);

    const ray up = {{1, 1, -1}, 0, {0, 0, 1}, infinity}, away = {{1, 1, -1}, 0, {0, 0, -1}, infinity};
    const std::vector<ray> rays = {up, away, up};
    CHECK(made.closest(up)->face == 0 && made.closest(up)->t == 1 && !made.closest(away));
    CHECK(made.any(up) && !made.any(away) && made.all(up).size() == 2 && made.all(away).empty());
    CHECK(made.next(up, *made.closest(up))->t == 3 && !made.next(up, made.all(up)[1]));
    CHECK(made.crossings(up) == 2 && made.crossings(away) == 0);
    for (const auto by : {stackless::threads::one, stackless::threads::all}) {
        CHECK(made.closest_n(rays, by)[2].face == 0 && made.closest_n(rays, by)[1].face == STACKLESS_NO_FACE);
        CHECK((made.any_n(rays, by) == std::vector<std::uint8_t>{1, 0, 1}));
        CHECK((made.crossings_n(rays, by) == std::vector<std::uint32_t>{2, 0, 2}));
    }
    CHECK(made.closest_n(std::vector<ray>()).empty() && made.any_n(std::vector<ray>()).empty());
    const std::vector<std::array<Real, 3>> points = {{1, 1, 1}, {9, 9, 9}, {1, 1, 0}};
    CHECK((made.locate_n(points) == std::vector<location>{location::inside, location::outside, location::surface}));
    CHECK(made.locate({1, 1, 1}, stackless::rule::winding) == location::inside);
    const auto distances = made.signed_distances_n(points);
    CHECK(distances[0] > -0.58 && distances[0] < -0.57 && distances[1] > 13 && distances[2] == 0);
    const auto nears = made.nearest_n(points, 2);
    CHECK(nears[2].distance == 0 && nears[2].face == 0 && nears[1].face == STACKLESS_NO_FACE);
    CHECK(made.nearest_k({1, 1, 1}, infinity, 9).size() == 4 && made.nearest_k({1, 1, 1}, infinity, 2)[1].distance == 1);

    made.set_masks({1, 2, 4, 8});
    const auto is_far = [](const ray&, const typename scene::hit& hit) { return hit.t > 2; };
    const auto far = scene::accepting(is_far), no_sides = scene::accepting(is_far, 7);
    CHECK(made.closest(up, &far)->t == 3 && made.all(up, &far).size() == 1 && made.any(up, &far));
    CHECK(!made.any(up, &no_sides) && made.closest_n(rays, stackless::threads::all, &far)[2].t == 3);
    CHECK((made.any_n(rays, stackless::threads::all, &no_sides) == std::vector<std::uint8_t>{0, 0, 0}));

    const auto bottom = made.point_of_hit(up, 0);
    const auto side = made.exact_closest({bottom.get(), nullptr, {0, 0, 1}, infinity, false});
    CHECK(side->found.t == 2 && side->found.face == 3);
    CHECK(!made.exact_any({bottom.get(), side->point.get(), {}, 0, false}));
    CHECK(!made.exact_closest({side->point.get(), nullptr, {0, 0, 1}, infinity, false}));
    CHECK(made.exact_any({stackless::exact_point<Real>({1, 1, 1}).get(), bottom.get(), {}, 0, true}));

    // More hits than the first buffer holds.
    const std::vector<std::array<std::uint32_t, 3>> many(100, faces[0]);
    CHECK(scene(vertices, many).all(up).size() == 100);

    vertices[3].z = 8;
    made.refit(vertices);
    CHECK(made.all(up)[1].t == 5);
    vertices[2].y = infinity;
    refused(STACKLESS_ERROR_INVALID_ARGUMENT, "vertices[2]: [0, inf, 0]", [&] { made.refit(vertices); });
    refused(STACKLESS_ERROR_INVALID_ARGUMENT, "vertices[2]", [&] { scene(vertices, faces); });
    refused(STACKLESS_ERROR_FILE, "no such folder/x", [&] { scene::load("no such folder/x"); });
    refused(STACKLESS_ERROR_INVALID_DATA, "does not begin", [&] { scene::from_bytes({1, 2, 3}); });
    const std::vector<std::array<std::uint32_t, 3>> open = {{0, 1, 2}};
    refused(STACKLESS_ERROR_UNSUITABLE_MESH, "open", [&] { scene(points, open).locate({0, 0, 0}); });
}

int main(int count, char** arguments)
{
    CHECK(count == 2);
    run<float>(arguments[1]);
    run<double>(arguments[1]);
}
