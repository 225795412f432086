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

    const std::vector<typename scene::exact_ray> ways = {{bottom.get(), nullptr, {0, 0, 1}, infinity, false},
                                                         {bottom.get(), nullptr, {0, 0, -1}, infinity, false}};
    const auto is_low = [](const typename scene::exact_ray&, const typename scene::hit& hit) { return hit.t < 1; };
    const auto low = scene::exact_accepting(is_low);
    for (const auto by : {stackless::threads::one, stackless::threads::all}) {
        const auto met = made.exact_closest_n(ways, by);
        CHECK(met[0]->found.t == 2 && !met[1] && !made.exact_any({met[0]->point.get(), bottom.get(), {}, 0, false}));
        CHECK((made.exact_any_n(ways, by) == std::vector<std::uint8_t>{1, 0}));
        CHECK(!made.exact_closest_n(ways, by, &low)[0] && !made.exact_any_n(ways, by, &low)[0]);
    }
    CHECK(!made.exact_closest(ways[0], &low) && !made.exact_any(ways[0], &low));

    // Two tetrahedra, one above the other, and twice as large.
    using instances = stackless::instances<Real>;
    using map = std::array<std::array<Real, 4>, 3>;
    const std::vector<map> maps = {{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 8}}},
                                   {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}}};
    const std::vector<map> twice = {{{{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}}}};
    const instances row({instances::of(made)}, {0, 0}, maps);
    const instances nest({instances::of(row)}, {0}, twice, {STACKLESS_QUALITY_HIGH, 1});
    const auto lowest = nest.closest(up);
    CHECK(lowest->t == 1 && lowest->face == 0 && lowest->levels == 2 && lowest->path[0] == 0 && lowest->path[1] == 1);
    CHECK(nest.all(up).size() == 4 && nest.any(up) && !nest.any(away) && !nest.closest(away));
    CHECK(nest.bounds()[0][2] <= 0 && nest.bounds()[1][2] >= 24 && nest.bounds()[1][2] < 24.01);
    const auto is_above = [](const ray&, const typename instances::hit& hit) { return hit.path[1] == 0; };
    const auto above = instances::accepting(is_above), no_bottoms = instances::accepting(is_above, 8);
    CHECK(nest.closest(up, &above)->t == 17 && nest.all(up, &no_bottoms).size() == 1 && nest.any(up, &above));
    for (const auto by : {stackless::threads::one, stackless::threads::all}) {
        CHECK(nest.closest_n(rays, by)[2].t == 1 && nest.closest_n(rays, by, &above)[0].t == 17);
        CHECK((nest.any_n(rays, by, &above) == std::vector<std::uint8_t>{1, 0, 1}));
    }
    // From the lowest bottom, to the side above it, which is the side of the same tetrahedron.
    const stackless::exact_point<Real> below({1, 1, -1});
    const auto base = nest.exact_closest({below.get(), nullptr, {0, 0, 1}, infinity, false});
    CHECK(base->found.t == 1 && base->found.path[1] == 1);
    const auto from = base->point.get();
    const std::vector<typename instances::exact_ray> onward = {{from, nullptr, {0, 0, 1}, infinity, false},
                                                               {from, nullptr, {0, 0, -1}, infinity, false}};
    const auto is_on_top = [](const typename instances::exact_ray&, const typename instances::hit& hit) {
        return hit.path[1] == 0;
    };
    const auto on_top = instances::exact_accepting(is_on_top), others = instances::exact_accepting(is_on_top, 0);
    for (const auto by : {stackless::threads::one, stackless::threads::all}) {
        const auto met = nest.exact_closest_n(onward, by);
        CHECK(met[0]->found.face == 3 && met[0]->found.t == 6 && !met[1]);
        CHECK(nest.exact_closest_n(onward, by, &on_top)[0]->found.t == 16 && !nest.exact_any_n(onward, by, &others)[0]);
        CHECK((nest.exact_any_n(onward, by) == std::vector<std::uint8_t>{1, 0}));
    }
    CHECK(nest.exact_any(onward[0], &on_top) && !nest.exact_any(onward[1]));
    refused(STACKLESS_ERROR_INVALID_ARGUMENT, "indices[1]: 1", [&] { instances({instances::of(made)}, {0, 1}, maps); });

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
