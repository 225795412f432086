// The judge, for whoever embeds the files under vectors/ in tests of their own: judge(test, reply, hello) says what is wrong with
// a reply ({"result": ...} or {"reject": ...}) to a case, or nothing. `hello` holds features and limits, as in INTERPRETING.md.
// `Json` is nlohmann::json, whose exceptions say of what kind a field must be. C++17. Not judged here: counters and registers,
// which are in no file, and tables (`hash/build`), where any right one will do. Look up every key of these.
#pragma once
#include <algorithm>
#include <climits>
#include <optional>
#include <string>

namespace stackless_suite {

template <class Json> int depth(const Json &children, bool wide, std::size_t node = 0) { // in edges, or of the deepest inner node
    int deepest = 0;
    for (const std::size_t child : children[node])
        deepest = std::max(deepest, wide && children[child].is_null() ? 0 : 1 + depth(children, wide, child));
    return deepest;
}

template <class Json> bool is_too_deep(const Json &test, const Json &hello) {
    const std::string id = test["id"], slots = test["input"].value("slots", Json()).dump();
    if ((id.rfind("trace/", 0) && id.rfind("resume/", 0)) || test["expect"].contains("reject"))
        return false;
    const typename Json::json_pointer limit(slots == "null" ? "/limits/max_depth" : "/limits/wide/" + slots);
    return depth(test["input"]["children"], slots != "null") > hello.value(limit, INT_MAX);
}

template <class Json> Json plain(Json hits, bool weights) { // zeros of either sign are one; weights only where they are asked for
    for (auto &hit : hits)
        for (const std::string name : {"u", "v", "t"})
            if (hit.is_object() && name != "t" && !weights)
                hit.erase(name);
            else if (hit.is_object() && hit.value(name, "") == "80000000")
                hit[name] = "00000000";
    return hits;
}

template <class Json> bool is_near(const Json &expected, const Json &found, long long ulps) {
    const auto bits = [](const Json &hit) { return std::stoll(hit["t"].template get<std::string>(), nullptr, 16); };
    if (expected.is_null() || found.is_null())
        return expected == found;
    const auto &prims = expected["prims"];
    return std::count(prims.begin(), prims.end(), found["prim"]) && std::abs(bits(expected) - bits(found)) <= ulps;
}

template <class Json> std::optional<std::string> judge(const Json &test, const Json &reply, const Json &hello) {
    const auto has = [features = hello.value("features", Json::array())](const std::string &name) {
        return std::count(features.begin(), features.end(), name) > 0;
    };
    const Json expect = is_too_deep(test, hello) ? Json{{"reject", "too-deep"}} : test["expect"], answer = reply.value("result", Json());
    if (expect.contains("reject") ? reply.value("reject", Json()) != expect["reject"] : !answer.is_object())
        return "expected " + expect.dump();
    if (expect.contains("near")) {
        const Json hits = expect["near"]["hits"], found = answer.value("hits", Json());
        const auto alike = [&](const Json &a, const Json &b) { return is_near(a, b, expect["near"]["ulps"].template get<long long>()); };
        if (answer.size() != 1 || !std::equal(hits.begin(), hits.end(), found.begin(), found.end(), alike))
            return "hits differ from " + hits.dump();
    }
    Json result = expect.value("result", Json());
    if (!has("trails") && result.is_object())
        result.erase("trails");
    for (const auto &[name, value] : result.items())
        if (plain(value, name != "hits" || has("weights")) != plain(answer.value(name, Json()), name != "hits" || has("weights")))
            return name + " differs";
    for (const auto &[name, value] : answer.items())
        if (!result.is_null() && !result.contains(name) && !((name == "counters" || name == "registers") && has(name)))
            return "unknown field " + name;
    return std::nullopt;
}

} // namespace stackless_suite
