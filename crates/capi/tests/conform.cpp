// An adapter of the conformance suite, for all profiles of the level `ray`. It shows that the C interface changes no
// answer of the library.
//
//     python3 spec/suite/conform.py -- ./conform
//     python3 spec/suite/conform.py -- ./conform double
//
// It asks several functions and several scenes for each answer, and ends if their answers differ. With `double` the
// library computes in double precision, and the adapter rounds to single precision. Some numbers of `ray/exact`
// differ if they are rounded twice, so this profile is then omitted.
#include <cstdio>
#include <cstring>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stackless.hpp>

using nlohmann::json;
using stackless::threads;

static std::string digits(float number)
{
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    char text[9];
    std::snprintf(text, sizeof text, "%08x", bits);
    return text;
}

// Rows of `Count` floats, given by their bits.
template <class Real, std::size_t Count> static std::vector<std::array<Real, Count>> rows(const json& texts)
{
    std::vector<std::array<Real, Count>> rows;
    for (const std::string text : texts) {
        std::istringstream words(text);
        words.exceptions(std::ios::failbit);
        for (Real& it : rows.emplace_back()) {
            std::uint32_t bits = 0;
            words >> std::hex >> bits;
            float number = 0;
            std::memcpy(&number, &bits, sizeof number);
            it = number;
        }
    }
    return rows;
}

// The suite's code for an error. The library has one code for all invalid arguments, so the message decides.
static std::string rejection(const stackless::error& error)
{
    static const std::pair<const char*, const char*> codes[] = {{"expected finite numbers", "not-finite"},
        {": index ", "index"}, {"direction: [0, 0, 0]", "no-direction"}, {"tmin", "interval"}};
    for (const auto& [part, code] : codes) {
        if (error.code() == STACKLESS_ERROR_INVALID_ARGUMENT && std::strstr(error.what(), part) != nullptr) {
            return code;
        }
    }
    throw std::runtime_error(error.what());
}

// Returns the result of `work`, or the rejection for its error.
template <class Work> static json unless_refused(Work work)
{
    try {
        return work();
    } catch (const stackless::error& error) {
        return {{"reject", rejection(error)}};
    }
}

template <class Real> class adapter {
    using scene = stackless::scene<Real>;
    using ray = typename scene::ray;
    using rays = std::vector<ray>;
    using method = std::function<json(const scene&, const rays&)>;

    // Hits, and numbers of crossings or of hits.
    template <class Answer> static json shown(const Answer& it)
    {
        if constexpr (std::is_integral_v<Answer>) {
            return it % 2 == 1;
        } else if (it.face == STACKLESS_NO_FACE) {
            return nullptr;
        } else {
            const auto text = [](Real number) { return digits(static_cast<float>(number)); };
            return {{"prim", it.face}, {"t", text(it.t)}, {"u", text(it.u)}, {"v", text(it.v)}};
        }
    }
    static json shown(const typename scene::exact_hit& it) { return shown(it.found); }
    template <class Hit> static json shown(const std::optional<Hit>& it) { return it ? shown(*it) : json(); }
    template <class Answer> static json shown(const std::vector<Answer>& answers)
    {
        json list = json::array();
        for (const Answer& it : answers) {
            list.push_back(shown(it));
        }
        return list;
    }

    // Asks for one ray at a time.
    template <class Ask> static method each(Ask ask)
    {
        return [ask](const scene& s, const rays& all) {
            json list = json::array();
            for (const ray& r : all) {
                list.push_back(ask(s, r));
            }
            return list;
        };
    }

    static std::vector<method> methods(const std::string& query)
    {
        if (query == "parity") {
            return {[](const scene& s, const rays& all) { return shown(s.crossings_n(all)); },
                [](const scene& s, const rays& all) { return shown(s.crossings_n(all, threads::all)); },
                each([](const scene& s, const ray& r) { return shown(s.crossings(r)); })};
        }
        const bool any = query == "any";
        const auto batch = [any](const auto& in, const rays& all, threads by) {
            return any ? shown(in.any_n(all, by)) : shown(in.closest_n(all, by));
        };
        return {[batch](const scene& s, const rays& all) { return batch(s, all, threads::one); },
            [batch](const scene& s, const rays& all) { return batch(s, all, threads::all); },
            [batch](const scene& s, const rays& all) { return batch(placed(s), all, threads::all); },
            each([any](const scene& s, const ray& r) { return any ? shown(s.any(r)) : shown(s.closest(r)); }),
            each([any](const scene& s, const ray& r) { return from_point(s, r, any); }),
            each([any](const scene& s, const ray& r) {
                const json hits = first_hits(s, r);
                return any ? json(!hits.empty()) : hits.empty() ? json() : hits[0];
            })};
    }

    // The scene as an instance that is not moved.
    static auto placed(const scene& s)
    {
        const std::array<std::array<Real, 12>, 1> identity = {{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}};
        return stackless::instances<Real>({stackless::instances<Real>::of(s)}, {0}, identity);
    }

    // Rays from exact points have no tmin.
    static json from_point(const scene& s, const ray& r, bool any)
    {
        const auto& [x, y, z] = r.origin;
        const auto& [dx, dy, dz] = r.direction;
        const stackless::exact_point<Real> origin({x, y, z});
        const typename scene::exact_ray exact = {origin.get(), nullptr, {dx, dy, dz}, r.tmax, true};
        if (r.tmin != 0) {
            return any ? shown(s.any(r)) : shown(s.closest(r));
        }
        return any ? shown(s.exact_any(exact)) : shown(s.exact_closest(exact));
    }

    // The walk from hit to hit must find all hits. It takes long, so it stops early.
    static json first_hits(const scene& s, const ray& r)
    {
        std::vector<typename scene::hit> all = s.all(r), walked;
        all.resize(std::min<std::size_t>(all.size(), 4));
        for (auto it = s.closest(r); it && walked.size() < 4; it = s.next(r, *it)) {
            walked.push_back(*it);
        }
        if (shown(all) != shown(walked)) {
            throw std::runtime_error("all hits: " + shown(all).dump() + ", by next: " + shown(walked).dump());
        }
        return shown(all);
    }

    // Of a mesh in three qualities, then saved and loaded.
    template <class Points, class Faces> static std::vector<scene> scenes(const Points& vertices, const Faces& faces)
    {
        std::vector<scene> made;
        for (std::uint32_t quality = STACKLESS_QUALITY_STANDARD; quality <= STACKLESS_QUALITY_SPATIAL; quality++) {
            made.emplace_back(vertices, faces, stackless_options{quality, 0});
        }
        made.push_back(scene::from_bytes(made[0].to_bytes()));
        return made;
    }

public:
    static json answer(const json& input)
    {
        auto vertices = rows<Real, 3>(input["vertices"]);
        auto faces = input["triangles"].get<std::vector<std::array<std::uint32_t, 3>>>();
        // The library requires a face. This one has no area, so nothing hits it.
        if (faces.empty()) {
            vertices.resize(std::max<std::size_t>(vertices.size(), 1));
            faces.push_back({0, 0, 0});
        }
        rays all;
        std::vector<std::size_t> nowhere;
        for (const auto& [x, y, z, dx, dy, dz, tmin, tmax] : rows<Real, 8>(input["rays"])) {
            all.push_back({{x, y, z}, tmin, {dx, dy, dz}, tmax});
            // The library requires a finite tmin. No distance is infinite, so this ray misses if the rest is valid.
            if (tmin == tmax && tmin == std::numeric_limits<Real>::infinity()) {
                nowhere.push_back(all.size() - 1);
                all.back().tmin = 0;
            }
        }
        const json missed = input["query"] == "closest" ? json() : json(false);
        const auto reply = [&](const scene& s, const method& ask) -> json {
            json hits = ask(s, all);
            for (const std::size_t i : nowhere) {
                hits[i] = missed;
            }
            return {{"result", {{"hits", hits}}}};
        };
        return unless_refused([&] {
            json first;
            for (const scene& s : scenes(vertices, faces)) {
                for (const method& ask : methods(input["query"])) {
                    const json found = unless_refused([&] { return reply(s, ask); });
                    if (!first.is_null() && found != first) {
                        throw std::runtime_error("different answers: " + first.dump() + " and " + found.dump());
                    }
                    first = found;
                }
            }
            return first;
        });
    }
};

int main(int count, char** arguments)
{
    const bool is_double = count == 2 && arguments[1] == std::string("double");
    json profiles = {"ray/grid", "ray/watertight", "ray/parity", "ray/ulp-8", "ray/ulp-256", "ray/invalid"};
    if (!is_double) {
        profiles.push_back("ray/exact");
    }
    const json hello = {{"protocol", 1}, {"name", is_double ? "libstackless, double" : "libstackless"},
        {"version", "0.1"}, {"profiles", profiles}, {"features", json::array({"weights"})}};
    try {
        for (std::string line; std::getline(std::cin, line);) {
            const json request = json::parse(line);
            if (request["cmd"] == "bye") {
                break;
            }
            json reply = hello;
            if (request["cmd"] == "case") {
                const json& input = request["input"];
                reply = is_double ? adapter<double>::answer(input) : adapter<float>::answer(input);
                reply["seq"] = request["seq"];
            }
            std::cout << reply << std::endl;
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "conform.cpp: %s\n", error.what());
        return 1;
    }
}
