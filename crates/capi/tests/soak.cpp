// Load: threads query shared scenes for a long time while they build, refit, save and load scenes.
//
//     soak FOLDER SECONDS [CSV]
//
// One thread records the answers first. Every later answer must have the same bits. The program fails if an answer
// differs, if a thread makes no progress for STALL seconds, or if memory grows: after a warm-up of a tenth of the time,
// the median of the last third may exceed that of the first third by MARGIN.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <malloc.h>
#include <mutex>
#include <random>
#include <shared_mutex>
#include <stackless.hpp>
#include <thread>
#include <unistd.h>

static constexpr int THREADS = 8, STALL = 60, RAYS = 600, CELLS = 32;
static const char* const NAMES[] = {"closest1", "any1", "all1", "next1", "closest_n", "any_n", "crossings_n",
    "locate_n", "signed_distances_n", "nearest_n", "nearest_k1", "exact", "refit", "build", "save_and_load", "bytes"};
enum { CLOSEST1, ANY1, ALL1, NEXT1, CLOSEST_N, ANY_N, CROSSINGS_N, LOCATE_N, SIGNED_N, NEAREST_N, NEAREST_K1, EXACT,
    QUERIES };
enum { REFIT = QUERIES, BUILD, SAVE_AND_LOAD, BYTES, COUNTS };
// Rows of a query: with the threads of the scene, without them, one.
static constexpr std::size_t ROWS[][2] = {{0, RAYS}, {100, 140}, {7, 8}};
static constexpr int PARTS = 3, MESHES = 3, MOVING = 2;
static std::atomic<unsigned long long> counts[COUNTS], progress[THREADS];
static std::atomic<bool> stop;
// In MiB, of resident and of used memory. The heap is resident where it was used once, so the former comes to rest late.
static constexpr double MARGIN[] = {16, 1};

static int below(std::minstd_rand& random, int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

[[noreturn]] static void fail(const std::string& message)
{
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", message.c_str());
    std::_Exit(1);
}

// The bits of an answer, without the padding of structures.
struct answer {
    std::string bytes;
    template <class T> void put(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
    template <class T> void put_hit(const T& hit) { put(hit.t), put(hit.u), put(hit.v), put(hit.face); }
    template <class T> void put_near(const T& near) { put(near.point), put(near.distance), put(near.face); }
    template <class T> void put_all(const T& values) { for (const auto& value : values) { put(value); } }
};

template <class Real> class world {
    using scene = stackless::scene<Real>;
    using ray = typename scene::ray;
    using point = std::array<Real, 3>;
    struct mesh {
        std::vector<point> vertices[2];
        std::vector<std::array<std::uint32_t, 3>> faces;
        std::vector<ray> rays;
        std::vector<scene> scenes;
        std::string answers[2][QUERIES][PARTS];
    };
    // A scene that is refitted between queries.
    struct refitted {
        std::optional<scene> held;
        std::shared_mutex lock;
        int state = 0;
    };

    mesh meshes_[MESHES];
    refitted moving_[MOVING];
    std::string folder_;

public:
    explicit world(const std::string& folder) : folder_(folder)
    {
        std::minstd_rand random(1);
        for (int kind = 0; kind < MESHES; kind++) {
            mesh& of = meshes_[kind];
            make(kind, random);
            for (int state = 0; state < 2; state++) {
                of.scenes.emplace_back(of.vertices[state], of.faces);
                for (int i = 0; i < QUERIES * PARTS; i++) {
                    of.answers[state][i / PARTS][i % PARTS] =
                        ask(kind, i / PARTS, i % PARTS, of.scenes[state], stackless::threads::one);
                }
            }
            if (kind < MOVING) {
                moving_[kind].held.emplace(of.vertices[0], of.faces);
            }
        }
    }

    void step(std::minstd_rand& random)
    {
        const int kind = below(random, MESHES), state = below(random, 2), draw = below(random, 100);
        const mesh& of = meshes_[kind];
        const scene& shared = of.scenes[state];
        refitted& moving = moving_[kind % MOVING];
        if (draw < 60) {
            compare(random, kind, state, shared);
        } else if (draw < 90) {
            const std::shared_lock held(moving.lock);
            compare(random, kind % MOVING, moving.state, *moving.held);
        } else if (draw < 93) {
            const std::unique_lock held(moving.lock);
            moving.state = 1 - moving.state;
            moving.held->refit(meshes_[kind % MOVING].vertices[moving.state]);
            counts[REFIT]++;
        } else if (draw < 96) {
            const stackless_options options = {below(random, STACKLESS_QUALITY_SPATIAL + 1) + 0u, 2u * below(random, 2)};
            compare(random, kind, state, scene(of.vertices[state], of.faces, options));
            counts[BUILD]++;
        } else if (draw < 98) {
            // Threads save to a file that other threads load.
            const std::string file = folder_ + "/soak-" + std::to_string(sizeof(Real) * 10 + kind * 2 + state);
            shared.save(file);
            compare(random, kind, state, scene::load(file, below(random, 2)));
            counts[SAVE_AND_LOAD]++;
        } else {
            compare(random, kind, state, scene::from_bytes(shared.to_bytes()));
            counts[BYTES]++;
        }
    }

private:
    void compare(std::minstd_rand& random, int kind, int state, const scene& from) const
    {
        const int query = below(random, QUERIES), part = below(random, PARTS);
        const auto threads = below(random, 2) ? stackless::threads::all : stackless::threads::one;
        if (ask(kind, query, part, from, threads) != meshes_[kind].answers[state][query][part]) {
            fail(std::string("WRONG ANSWER: ") + NAMES[query] + " of mesh " + std::to_string(kind));
        }
        counts[query]++;
    }

    std::string ask(int kind, int query, int part, const scene& from, stackless::threads by) const
    {
        const auto all = meshes_[kind].rays.begin();
        const std::vector<ray> rays(all + ROWS[part][0], all + ROWS[part][1]);
        const auto rule = kind == 2 ? stackless::rule::winding : stackless::rule::parity;
        const Real infinity = std::numeric_limits<Real>::infinity();
        answer made;
        switch (query) {
        case CLOSEST_N: for (const auto& hit : from.closest_n(rays, by)) { made.put_hit(hit); } break;
        case ANY_N: made.put_all(from.any_n(rays, by)); break;
        case CROSSINGS_N: made.put_all(from.crossings_n(rays, by)); break;
        // A ray begins with its origin.
        case LOCATE_N: made.put_all(from.locate_n(rays, rule, by)); break;
        case SIGNED_N: made.put_all(from.signed_distances_n(rays, rule, by)); break;
        case NEAREST_N: for (const auto& near : from.nearest_n(rays, infinity, by)) { made.put_near(near); } break;
        default: for (const ray& one : rays) { ask_one(query, from, one, made); }
        }
        return made.bytes;
    }

    static void ask_one(int query, const scene& from, const ray& one, answer& made)
    {
        const point origin = {one.origin[0], one.origin[1], one.origin[2]};
        std::optional<typename scene::hit> hit;
        switch (query) {
        case CLOSEST1: if ((hit = from.closest(one))) { made.put_hit(*hit); } break;
        case ANY1: made.put(from.any(one)); break;
        case ALL1: for (const auto& found : from.all(one)) { made.put_hit(found); } break;
        case NEXT1: for (hit = from.closest(one); hit; hit = from.next(one, *hit)) { made.put_hit(*hit); } break;
        case NEAREST_K1: for (const auto& near : from.nearest_k(origin, 3, 3)) { made.put_near(near); } break;
        default: if ((hit = from.closest(one))) { back(from, one, hit->face, made); }
        }
        made.put('|');
    }

    // From the exact point of a hit back, and from the exact point that this ray meets to a place outside.
    static void back(const scene& from, const ray& one, std::uint32_t face, answer& made)
    {
        const auto point = from.point_of_hit(one, face);
        const stackless::exact_point<Real> outside({20, 30, 40});
        const Real infinity = std::numeric_limits<Real>::infinity();
        const auto& way = one.direction;
        const auto met = from.exact_closest({point.get(), nullptr, {-way[0], -way[1], -way[2]}, infinity, false});
        if (met) {
            made.put_hit(met->found);
        }
        made.put(from.exact_any({met ? met->point.get() : point.get(), outside.get(), {0, 0, 0}, 0, false}));
    }

    // A torus, a folded sphere, and a sphere without some faces. Both precisions have multiples of 1/256 exactly.
    void make(int kind, std::minstd_rand& random)
    {
        mesh& of = meshes_[kind];
        const std::uint32_t side = CELLS + 1;
        for (std::uint32_t i = 0; i < side * side; i++) {
            const double pi = std::acos(-1), u = 2 * pi * (i / side % CELLS) / CELLS, v = pi * (i % side) / CELLS;
            const double folds = 2 + 0.9 * std::sin(v) * std::cos(7 * u) * std::cos(6 * v);
            const double around = kind ? folds * std::sin(v) : 2 + std::cos(2 * v);
            const double up = kind ? folds * std::cos(v) : std::sin(2 * v);
            const double place[] = {around * std::cos(u), around * std::sin(u), up};
            point vertex, moved;
            for (int k = 0; k < 3; k++) {
                vertex[k] = static_cast<Real>(std::round(256 * place[k]) / 256);
                moved[k] = vertex[k] * Real(1.5) + Real(0.25);
            }
            of.vertices[0].push_back(vertex);
            of.vertices[1].push_back(moved);
            if (i % side < CELLS && i / side < CELLS && (kind < 2 || i % 50)) {
                of.faces.insert(of.faces.end(), {{i, i + side, i + side + 1}, {i, i + side + 1, i + 1}});
            }
        }
        for (int i = 0; i < RAYS; i++) {
            ray one = {{}, 0, {}, std::numeric_limits<Real>::infinity()};
            const point& vertex = of.vertices[0][below(random, side * side)];
            for (int k = 0; k < 3; k++) {
                one.origin[k] = static_cast<Real>(below(random, 1536) - 768) / 256;
                // Half of the rays meet vertices.
                const double away = (below(random, 1536) - 767.5) / 256;
                one.direction[k] = i % 2 ? vertex[k] - one.origin[k] : static_cast<Real>(away);
            }
            of.rays.push_back(one);
        }
    }
};

// In KiB: resident memory, and what was allocated and not freed.
static std::array<double, 2> memory()
{
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages >> pages;
    const auto heap = mallinfo2();
    const auto used = static_cast<double>(heap.uordblks + heap.hblkhd);
    return {pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024, used / 1024};
}

// Looks once a second for threads that make no progress, and returns memory.
static std::vector<std::array<double, 2>> watch(int seconds, std::ofstream csv)
{
    std::vector<std::array<double, 2>> samples;
    unsigned long long before[THREADS] = {};
    int idle[THREADS] = {};
    csv << "seconds,resident_kib,used_kib";
    for (const char* name : NAMES) { csv << ',' << name; }
    for (int second = 1; second <= seconds; second++) {
        std::this_thread::sleep_for(std::chrono::seconds(1));
        for (int i = 0; i < THREADS; i++) {
            idle[i] = progress[i] == before[i] ? idle[i] + 1 : 0;
            before[i] = progress[i];
            if (idle[i] == STALL) { fail("DEADLOCK: no progress for " + std::to_string(STALL) + " s"); }
        }
        samples.push_back(memory());
        csv << '\n' << second << ',' << std::llround(samples.back()[0]) << ',' << std::llround(samples.back()[1]);
        for (const auto& count : counts) { csv << ',' << count; }
    }
    return samples;
}

// The median of some samples in MiB.
template <class Samples> static double median(Samples first, Samples last, int kind)
{
    std::vector<double> values;
    for (; first != last; ++first) { values.push_back((*first)[kind] / 1024); }
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    return values[values.size() / 2];
}

int main(int count, char** arguments)
{
    if (count < 3) { fail("usage: soak FOLDER SECONDS [CSV]"); }
    // Ends the program where no thread watches: before the threads, which is slow on a busy machine, and after them.
    alarm(5 * STALL);
    world<float> single(arguments[1]);
    world<double> twice(arguments[1]);
    alarm(0);
    std::vector<std::thread> threads;
    for (int i = 0; i < THREADS; i++) {
        threads.emplace_back([&, i] {
            for (std::minstd_rand random(i + 1); !stop; progress[i]++) {
                below(random, 2) ? single.step(random) : twice.step(random);
            }
        });
    }
    const auto samples = watch(std::atoi(arguments[2]), std::ofstream(count > 3 ? arguments[3] : "/dev/null"));
    stop = true;
    alarm(5 * STALL);
    for (auto& thread : threads) { thread.join(); }
    for (int i = 0; i < COUNTS; i++) { std::printf("%s %llu\n", NAMES[i], counts[i].load()); }
    if (samples.size() < 60) {
        std::puts("memory: not judged in less than a minute");
        return 0;
    }
    const auto warm = samples.begin() + samples.size() / 10;
    const auto third = (samples.end() - warm) / 3;
    for (int kind = 0; kind < 2; kind++) {
        const double grown = median(samples.end() - third, samples.end(), kind) - median(warm, warm + third, kind);
        std::printf("%s memory: grown by %.2f MiB\n", kind ? "used" : "resident", grown);
        if (grown > MARGIN[kind]) { fail("MEMORY GROWS"); }
    }
}
