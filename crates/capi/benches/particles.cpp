// Lost particles: tracks particles through volumes by libstackless, by Embree in single precision (robust), and by
// Embree's boxes with triangles in double precision, as double-down does for DAGMC and OpenMC. Counts lost particles.
//
//     [EMBREE_LIBRARY=libembree4.so.4] [SHOW=3] particles PARTICLES [ASSEMBLY...]
//
// ASSEMBLY is `blocks` (see assembly.hpp), `turned` (the blocks with rounded coordinates), or a closed part in a PLY
// file. SHOW prints the first lost particles of each tracker.
//
// The particles, of each kind: in a random direction, aimed at vertices, between vertices (along edges and within
// walls), and in a new random direction after each crossing. All trackers begin in the true volume.
//
// Embree's trackers follow DAGMC: find the nearest face around the current volume that the ray leaves by (a filter
// compares its normal with the direction), move to the rounded point of the hit, cross into the volume behind, and skip
// all faces that were crossed on this line (the ray history; after a turn only the last face). Positions are doubles.
// libstackless needs no filter and no history. On lines it continues at the next double after the hit; a particle that
// turns starts at the exact point of the hit. It searches one scene of all faces, and takes the volumes from the sides
// of the face, or at an edge from the number of crossings behind it.
//
// A particle is lost if no face is found outside the void, or after 1000 steps: the tracker notices it. It is wrong if
// the tracker does not notice, but a part of a step is in another volume, deeper than 1e-5 of the size of the assembly.
// libstackless judges the steps of all trackers: it finds all hits of the step with the boundary of the volume, and
// locates the middle of each part. Fails if libstackless loses a particle.
#include <ctime>

#include "embree.hpp"

enum kind { RANDOM, AIMED, BETWEEN, TURNING, KINDS };
static const char* const kind_names[KINDS] = {"random", "aimed at vertices", "between vertices", "turning"};

// The faces tell the volumes, except at edges: there crossings are counted. All distances are exact, so a face without
// an edge nearby also corrects the volume, if two faces have the same double as their distance.
static void follow_line(const world& w, const particle& p, track& out)
{
    const scene::ray start = line(p.origin, p.direction, 0, INFINITE);
    scene::ray ray = start;
    point from = p.origin;
    volume now = p.start;
    bool is_sure = true;
    for (int i = 0; i < LIMIT; i++) {
        const auto hit = w.whole.closest(ray);
        const auto known = hit ? w.around(*hit, p.direction) : std::nullopt;
        if (known) {
            now = (*known)[0];
        } else if (!is_sure || (!hit && now != nowhere)) {
            now = w.where(start, ray.tmin);
        }
        if (!hit || now == volumes) {
            out.is_lost = now != nowhere;
            out.steps.push_back({nowhere, from, w.far(from, p.direction)});
            return;
        }
        out.steps.push_back({now, from, along(p.origin, hit->t, p.direction)});
        from = out.steps.back().to;
        // The exact distance of the hit is less than the next number.
        ray.tmin = std::nextafter(hit->t, INFINITE);
        is_sure = known.has_value();
        now = is_sure ? (*known)[1] : now;
    }
}

// Starts at the exact point of each hit.
static void follow_turns(const world& w, const particle& p, track& out)
{
    std::minstd_rand random(p.seed);
    stackless::exact_point<double> at(p.origin);
    point from = p.origin, d = p.direction;
    volume now = p.start;
    for (int i = 0; i < LIMIT; i++) {
        auto hit = w.whole.exact_closest({at.get(), nullptr, {d[0], d[1], d[2]}, INFINITE, false});
        out.steps.push_back({now, from, hit ? along(from, hit->found.t, d) : w.far(from, d)});
        const auto known = hit ? w.around(hit->found, d) : std::nullopt;
        if (!known || (*known)[0] != now) {
            out.is_lost = hit || now != nowhere;
            return;
        }
        at = std::move(hit->point);
        from = out.steps.back().to;
        d = w.turn(random, hit->found.face, now);
        now = (*known)[1];
    }
}

static particle make_particle(const world& w, kind of, double unit, std::mt19937_64& random)
{
    std::uniform_real_distribution<double> within(0, 1);
    const auto vertex = [&] { return w.all.vertices[random() % w.all.vertices.size()]; };
    const auto [low, high] = w.whole.bounds();
    particle p = {{}, {}, nowhere, of == TURNING, static_cast<std::uint32_t>(random())};
    do {
        for (int k = 0; k < 3; k++) {
            p.origin[k] = low[k] + (high[k] - low[k]) * within(random);
            if (of == AIMED && unit > 0) {
                p.origin[k] = std::round(p.origin[k] / unit) * unit;
            }
            p.direction[k] = 2 * within(random) - 1;
        }
        if (of == BETWEEN) {
            p.origin = vertex();
        }
        if (of == AIMED || of == BETWEEN) {
            p.direction = minus(vertex(), p.origin);
        }
    } while (dot(p.direction, p.direction) == 0);
    // The volume just behind the start.
    const auto ray = line(p.origin, p.direction, std::numeric_limits<double>::denorm_min(), INFINITE);
    const auto hit = w.whole.closest(ray);
    const auto known = hit ? w.around(*hit, p.direction) : std::nullopt;
    p.start = known ? (*known)[0] : w.where(ray, ray.tmin);
    if (p.start == volumes) {
        fail("a particle starts in no volume");
    }
    return p;
}

static double processor_seconds()
{
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Prints a step, and the exact volumes on its line.
static void show(const world& w, const char* who, const particle& p, const track& t, const step& s)
{
    const auto print = [](const char* what, const point& x) {
        std::printf(" %s (%.17g, %.17g, %.17g)", what, x[0], x[1], x[2]);
    };
    const point d = minus(s.to, s.from);
    const double length = std::sqrt(dot(d, d));
    std::printf("  %s: %s,", who, t.is_lost ? "lost" : "wrong");
    print("from", p.origin);
    print("direction", p.direction);
    std::printf("\n    step %td of %zu: %g in volume %d", &s - t.steps.data() + 1, t.steps.size(), length, s.in);
    print("from", s.from);
    std::printf(", volumes:");
    double at = 0;
    while (at < 1) {
        const volume it = w.where(line(s.from, d, 0, INFINITE), at);
        const auto hit = it == volumes ? std::nullopt : w.cells[it].boundary.closest(line(s.from, d, at, INFINITE));
        at = hit ? std::nextafter(hit->t, INFINITE) : 1;
        std::printf(" %d up to %g", it, at * length);
    }
    std::printf("\n");
}

struct counts {
    long steps = 0, lost = 0, wrong = 0;
    double seconds = 0;
};

// The first step that is not right, or null. Steps near those of a right track are right.
static const step* first_wrong(const world& w, const track& t, const track* right)
{
    for (std::size_t i = 0; i < t.steps.size(); i++) {
        const step& s = t.steps[i];
        const bool is_near = right != nullptr && i < right->steps.size() && right->steps[i].in == s.in &&
                             w.are_near(right->steps[i].from, s.from) && w.are_near(right->steps[i].to, s.to);
        if (!is_near && w.is_wrong(s)) {
            return &s;
        }
    }
    return nullptr;
}

// Returns the number of particles that libstackless loses.
static long compare(const char* name, assembly from, double unit, handle device, long particles)
{
    const world w(std::move(from));
    std::vector<embree_scenes> peers;
    std::vector<const char*> names = {"libstackless"};
    if (device != nullptr) {
        peers.reserve(2);
        peers.emplace_back(device, w, false);
        peers.emplace_back(device, w, true);
        names.insert(names.end(), {"Embree, robust", "Embree, double triangles"});
    }
    const long most = std::getenv("SHOW") != nullptr ? std::atol(std::getenv("SHOW")) : 0;
    std::printf("\n%s: %zu faces, %zu volumes\n", name, w.all.faces.size(), w.cells.size());
    long failures = 0;
    for (int of = RANDOM; of < KINDS; of++) {
        std::mt19937_64 random(of + 1);
        std::vector<counts> found(names.size());
        for (long done = 0; done < particles;) {
            std::vector<particle> batch;
            for (; batch.size() < 1000 && done < particles; done++) {
                batch.push_back(make_particle(w, static_cast<kind>(of), unit, random));
            }
            // Of libstackless, if they are right.
            std::vector<track> right;
            for (std::size_t i = 0; i < names.size(); i++) {
                std::vector<track> tracks(batch.size());
                counts& sum = found[i];
                const double before = processor_seconds();
                for (std::size_t j = 0; j < batch.size(); j++) {
                    if (i > 0) {
                        peers[i - 1].follow(batch[j], tracks[j]);
                    } else {
                        (of == TURNING ? follow_turns : follow_line)(w, batch[j], tracks[j]);
                    }
                }
                sum.seconds += processor_seconds() - before;
                for (std::size_t j = 0; j < batch.size(); j++) {
                    track& t = tracks[j];
                    const step* const wrong = first_wrong(w, t, i > 0 ? &right[j] : nullptr);
                    sum.steps += static_cast<long>(t.steps.size());
                    sum.lost += t.is_lost;
                    sum.wrong += wrong != nullptr && !t.is_lost;
                    if ((wrong != nullptr || t.is_lost) && sum.lost + sum.wrong <= most) {
                        show(w, names[i], batch[j], t, wrong != nullptr ? *wrong : t.steps.back());
                    }
                    if (i == 0 && (wrong != nullptr || t.is_lost)) {
                        t.steps.clear();
                    }
                }
                if (i == 0) {
                    right = std::move(tracks);
                }
            }
        }
        for (std::size_t i = 0; i < names.size(); i++) {
            const counts& sum = found[i];
            std::printf("%-16s %-24s %9ld particles %10ld steps %7ld lost %7ld wrong %6.0f ns/step\n", kind_names[of],
                        names[i], particles, sum.steps, sum.lost, sum.wrong,
                        1e9 * sum.seconds / static_cast<double>(sum.steps));
        }
        std::fflush(stdout);
        failures += found[0].lost + found[0].wrong;
    }
    return failures;
}

int main(int count, char** arguments)
{
    const long particles = count > 1 ? std::atol(arguments[1]) : 0;
    if (particles <= 0) {
        fail("usage: particles PARTICLES [blocks|turned|PART.ply]..., PARTICLES at least 1");
    }
    handle device = nullptr;
    if (const char* const name = std::getenv("EMBREE_LIBRARY")) {
        library = dlopen(name, RTLD_NOW);
        if (library == nullptr) {
            fail(dlerror());
        }
        device = embree<handle>("rtcNewDevice", "threads=1");
        const long version = device == nullptr ? 0 : embree<long>("rtcGetDeviceProperty", device, 0);
        if (version < 40400) {
            fail("Embree has version " + std::to_string(version) + ", expected 40400 or newer");
        }
    } else {
        std::printf("Embree is skipped: EMBREE_LIBRARY is not set\n");
    }
    long failures = 0;
    const std::vector<std::string> names = count > 2 ? std::vector<std::string>(arguments + 2, arguments + count)
                                                     : std::vector<std::string>{"blocks", "turned"};
    for (const std::string& name : names) {
        assembly made = name == "blocks"   ? make_assembly()
                        : name == "turned" ? turned(make_assembly())
                                           : read_part(name.c_str());
        failures += compare(name.c_str(), std::move(made), name == "blocks" ? grid : 0, device, particles);
    }
    return failures != 0;
}
