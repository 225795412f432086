// A first adapter in C++17:
//
//     c++ -std=c++17 -Wall -Wextra -Werror -O2 -o skeleton spec/suite/adapters/skeleton.cpp
//     stackless conform -- ./skeleton
//
// It answers `key/u32`, with as little of JSON as that takes: fields are found by their names. To go on, take a JSON library,
// add a profile to HELLO and an operation to answer() (INTERPRETING.md); for `trace/script` see the loop in README.md.
#include <cstdint>
#include <iostream>
#include <sstream>
#include <string>

static const char *const HELLO = R"({"protocol":1,"name":"skeleton.cpp","version":"0.1","profiles":["key/u32"]})";

// The text after "name":, up to the next comma or brace, without quotes.
static std::string field(const std::string &line, const std::string &name) {
    auto at = line.find("\"" + name + "\":");
    if (at == std::string::npos)
        return "";
    at = line.find_first_not_of(' ', at + name.size() + 3);
    const auto end = line.find_first_of(",}", at);
    std::string text = line.substr(at, end - at);
    return text.size() >= 2 && text.front() == '"' ? text.substr(1, text.size() - 2) : text;
}

static std::uint32_t word(const std::string &line, const std::string &name) {
    return static_cast<std::uint32_t>(std::stoull(field(line, name), nullptr, 16));
}

static int zeros(std::uint32_t trail) { // TRAIL-3; the trail is not 0
    int n = 0;
    while ((trail >> n & 1) == 0)
        ++n;
    return n;
}

static int depth(std::uint32_t key) { // KEY-5
    int depth = 0;
    while (key >>= 1)
        ++depth;
    return depth;
}

static std::uint32_t below(int bits) { return static_cast<std::uint32_t>((std::uint64_t(1) << bits) - 1); }

static std::string result(const char *name, std::uint32_t word) {
    std::ostringstream text;
    text << "\"result\":{\"" << name << "\":\"" << std::hex << word << "\"}";
    return text.str();
}

static std::string levels(std::uint32_t trail) {
    return "\"result\":{\"levels\":" + (trail == 0 ? "null" : std::to_string(zeros(trail))) + "}";
}

static std::string answer(const std::string &line) {
    const std::string op = field(line, "op");
    const auto key = [&] { return word(line, "key"); };
    const auto trail = [&] { return word(line, "trail"); };
    const auto is = [&](const char *name) { return field(line, name) == "true"; };
    const auto mask = [&] { return below(std::stoi(field(line, "depth"))); };
    if (op == "child")
        return result("key", key() << 1 | is("right")); // KEY-2
    if (op == "parent")
        return result("key", key() >> 1); // KEY-3
    if (op == "sibling")
        return result("key", key() ^ 1); // KEY-4
    if (op == "level-start")
        return result("key", std::uint32_t(1) << depth(key())); // KEY-6
    if (op == "depth")
        return "\"result\":{\"depth\":" + std::to_string(depth(key())) + "}";
    if (op == "descend")
        return result("trail", trail() << 1 | is("both")); // TRAIL-2
    if (op == "levels")
        return levels(trail());
    if (op == "backtrack") {
        const int n = zeros(trail());
        std::ostringstream text; // TRAIL-4
        text << "\"result\":{\"levels\":" << n << std::hex << ",\"key\":\"" << (key() >> n ^ 1) << "\",\"trail\":\""
             << (trail() >> n ^ 1) << "\"}";
        return text.str();
    }
    if (op == "counter")
        return result("counter", trail() ^ mask()); // TRAIL-6
    if (op == "counter-levels")
        return levels(word(line, "counter") ^ mask());
    if (op == "swap")
        return result("index", word(line, "index") ^ word(line, "mask")); // SWAP-3
    return "\"unsupported\":\"no such operation here\"";
}

int main() {
    for (std::string line; std::getline(std::cin, line);) {
        const std::string cmd = field(line, "cmd");
        if (cmd == "bye")
            break;
        if (cmd == "hello")
            std::cout << HELLO << std::endl;
        else // std::endl flushes
            std::cout << "{\"seq\":" << field(line, "seq") << "," << answer(line) << "}" << std::endl;
    }
}
