#include <cstdio>
#include <limits>
#include <stackless.hpp>

int main()
{
    // A tetrahedron, seen counterclockwise from outside.
    const std::vector<std::array<double, 3>> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    try {
        const stackless::scene<double> scene(vertices, faces);
        const double infinity = std::numeric_limits<double>::infinity();
        if (const auto hit = scene.closest({{0.25, 0.25, -1}, 0, {0, 0, 1}, infinity})) {
            std::printf("face %u at distance %g\n", hit->face, hit->t);
        }
        const bool is_inside = scene.locate({0.25, 0.25, 0.25}) == stackless::location::inside;
        std::printf("the middle is %s\n", is_inside ? "inside" : "outside");
        // The ray has no direction.
        scene.any({{0, 0, 0}, 0, {0, 0, 0}, infinity});
    } catch (const stackless::error& error) {
        std::printf("refused: %s\n", error.what());
    }
}
