// The judge, for whoever embeds the files under vectors/ in tests of their own: judge(test, reply, hello) says what is wrong with
// a reply ({"result": ...} or {"reject": ...}) to a case, or nothing. `hello` holds features and limits, as in INTERPRETING.md.
// `Json` is nlohmann::json, or another class with its interface. C++17.
//
// Not judged here: counters and registers, which are in no file, and tables (`hash/build`), where any right one will do. Look up
// every key of these.
#pragma once
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

namespace stackless_suite {

template <class Json> bool has(const Json &hello, const char *feature) {
    const auto features = hello.value("features", Json::array());
    return std::find(features.begin(), features.end(), feature) != features.end();
}

template <class Json> int depth(const Json &children, bool wide, std::size_t node = 0) { // edges, or the level of an inner node
    int deepest = 0;
    if (!children[node].is_null())
        for (const auto &child : children[node])
            if (!children[child.template get<std::size_t>()].is_null() || !wide)
                deepest = std::max(deepest, 1 + depth(children, wide, child.template get<std::size_t>()));
    return deepest;
}

template <class Json> bool is_too_deep(const Json &test, const Json &hello) {
    const auto id = test["id"].template get<std::string>();
    if ((id.rfind("trace/", 0) != 0 && id.rfind("resume/", 0) != 0) || test["expect"].contains("reject"))
        return false;
    const auto limits = hello.value("limits", Json::object());
    const auto &input = test["input"];
    const bool wide = input.contains("slots");
    const auto all = wide ? limits.value("wide", Json::object()) : limits;
    const auto name = wide ? input["slots"].dump() : "max_depth";
    return all.contains(name) && depth(input["children"], wide) > all[name].template get<int>();
}

// Zeros of either sign are one, and weights are there only where they are asked for.
template <class Json> Json plain(Json hits, bool weights) {
    for (auto &hit : hits)
        if (hit.is_object()) {
            for (const char *weight : {"u", "v"})
                if (!weights)
                    hit.erase(weight);
            for (auto &bits : hit)
                if (bits == "80000000")
                    bits = "00000000";
        }
    return hits;
}

template <class Json> bool is_near(const Json &expected, const Json &found, long ulps) {
    if (expected.is_null() || !found.is_object())
        return expected.is_null() && found.is_null();
    const auto &prims = expected["prims"];
    const auto bits = [](const Json &hit) { return std::strtol(hit["t"].template get<std::string>().c_str(), nullptr, 16); };
    return std::find(prims.begin(), prims.end(), found["prim"]) != prims.end() && std::abs(bits(expected) - bits(found)) <= ulps;
}

template <class Json> std::optional<std::string> judge(const Json &test, const Json &reply, const Json &hello) {
    const Json expect = is_too_deep(test, hello) ? Json{{"reject", "too-deep"}} : test["expect"];
    if (expect.contains("reject"))
        return reply.value("reject", Json()) == expect["reject"] ? std::nullopt : std::optional("expected " + expect.dump());
    if (!reply.contains("result"))
        return "expected an answer, not " + reply.dump();
    const auto &found = reply["result"];
    if (expect.contains("near")) {
        if (!found.contains("hits"))
            return "no hits";
        const auto &near = expect["near"], &hits = near["hits"];
        for (std::size_t i = 0; i < std::max(hits.size(), found["hits"].size()); ++i)
            if (i >= hits.size() || i >= found["hits"].size() || !is_near(hits[i], found["hits"][i], near["ulps"].template get<long>()))
                return "hits[" + std::to_string(i) + "] differs";
        return found.size() == 1 ? std::nullopt : std::optional<std::string>("expected hits and no more");
    }
    if (expect.contains("valid"))
        return std::nullopt;
    for (const auto &[name, value] : expect["result"].items()) {
        if (name == "trails" && !has(hello, "trails"))
            continue;
        const auto other = found.value(name, Json("is not there"));
        const bool weights = has(hello, "weights");
        if (name == "hits" ? plain(value, weights) != plain(other, weights) : value != other)
            return name + " differs";
    }
    for (const auto &[name, value] : found.items())
        if (!(expect["result"].contains(name) && (name != "trails" || has(hello, "trails"))) &&
            !((name == "counters" || name == "registers") && has(hello, name.c_str())))
            return "unknown field " + name;
    return std::nullopt;
}

} // namespace stackless_suite
