/*
 * A small implementation of the specification, which answers the cases of the conformance suite:
 *
 *     cc -std=c11 -Wall -Wextra -Werror -O2 -o traverse spec/suite/adapters/traverse.c
 *     stackless conform -- ./traverse
 *
 * It is the traversal of Binder & Keller 2016 (HASHED-1): a key, a trail, a register for the node postponed last,
 * records that name uncle and grand uncle, and a table of all keys for what these do not name. (Theirs is a perfect
 * hash of few of them.) Keys and trails have 64 bits, so trees are at most 63 deep.
 */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    MAX_LINE = 1 << 20,
    MAX_TOKENS = 1 << 17,
    MAX_NESTING = 8,
    MAX_NODES = 1 << 14,
    MAX_DEPTH = 63,
    MAX_SLOTS = 8,
    MAX_LEVELS = 63, /* of leaves: a key has 64 bits */
    ROOT = 0,
    NONE = -1,
};

/* Words. */

static int trailing_zeros(uint64_t word) { /* TRAIL-3; the word is not 0 */
    int n = 0;
    while ((word >> n & 1) == 0)
        n++;
    return n;
}

static int depth_of(uint64_t key) { /* KEY-5; the key is not 0 */
    int depth = 0;
    while (key >>= 1)
        depth++;
    return depth;
}

static void back(uint64_t *key, uint64_t *trail) { /* TRAIL-4; the trail is not 0 */
    int n = trailing_zeros(*trail);
    *key = *key >> n ^ 1;
    *trail = *trail >> n ^ 1;
}

static uint64_t complement(uint64_t trail, int depth) { /* TRAIL-6 */
    return trail ^ (depth == 64 ? UINT64_MAX : ((uint64_t)1 << depth) - 1);
}

/* JSON: a line becomes a list of tokens, each value before what is in it. Nothing that is asked here is negative, has a
 * fraction, or has an escape in it. */

typedef struct {
    char kind; /* its first character */
    const char *text;
    size_t length;
    int after; /* the first token that is not in this one */
} Token;

static Token tokens[MAX_TOKENS];
static int token_count;

static const char *skip_space(const char *at) {
    while (*at == ' ' || *at == '\t' || *at == '\r' || *at == '\n')
        at++;
    return at;
}

/* Reads a value; returns where it ends, or NULL if it is not JSON, or more of it than we take. Commas and colons are
 * taken for each other: whoever asks writes JSON, and what else comes only must do no harm. */
static const char *parse(const char *at, int nesting) {
    if (nesting == 0 || token_count == MAX_TOKENS)
        return NULL;
    Token *token = &tokens[token_count++];
    *token = (Token){.kind = *at, .text = at};
    if (*at == '{' || *at == '[') {
        char close = *at == '{' ? '}' : ']';
        at = skip_space(at + 1);
        while (*at != close) {
            if (!(at = parse(at, nesting - 1)))
                return NULL;
            at = skip_space(at);
            if (*at == ',' || *at == ':')
                at = skip_space(at + 1);
            else if (*at != close)
                return NULL;
        }
        at++;
    } else if (*at == '"') {
        token->text = ++at;
        at = strchr(at, '"');
        if (!at)
            return NULL;
        token->length = (size_t)(at++ - token->text);
    } else if (strchr("0123456789tfn", *at) && *at != '\0') {
        while (strchr("0123456789truefalsn", *at) && *at != '\0')
            at++;
    } else {
        return NULL;
    }
    token->after = token_count;
    return at;
}

static bool is_text(int token, const char *text) {
    const Token *it = &tokens[token];
    return it->kind == '"' && it->length == strlen(text) && memcmp(it->text, text, it->length) == 0;
}

/* The value of a field of an object, or NONE. */
static int field(int object, const char *name) {
    if (object == NONE || tokens[object].kind != '{')
        return NONE;
    for (int i = object + 1; i + 1 < tokens[object].after; i = tokens[i + 1].after)
        if (is_text(i, name))
            return i + 1;
    return NONE;
}

/* The value of a digit, or NONE. */
static int hex(char digit) {
    const char *all = "0123456789abcdef", *at = digit == '\0' ? NULL : strchr(all, digit);
    return at ? (int)(at - all) : NONE;
}

/* A word of so many bits: lower-case hexadecimal without leading zeros. */
static bool get_word(int object, const char *name, int bits, uint64_t *word) {
    int token = field(object, name);
    if (token == NONE || tokens[token].kind != '"')
        return false;
    const char *digits = tokens[token].text;
    size_t length = tokens[token].length;
    if (length == 0 || length > 16 || (digits[0] == '0' && length > 1))
        return false;
    *word = 0;
    for (size_t i = 0; i < length; i++) {
        if (hex(digits[i]) == NONE)
            return false;
        *word = *word << 4 | (uint64_t)hex(digits[i]);
    }
    return bits == 64 || *word >> bits == 0;
}

/* A whole number from 0 to 2^31 - 1. */
static bool number(int token, int *value) {
    if (token == NONE || tokens[token].kind < '0' || tokens[token].kind > '9')
        return false;
    int64_t sum = 0;
    for (const char *digit = tokens[token].text; *digit >= '0' && *digit <= '9' && sum <= INT32_MAX; digit++)
        sum = 10 * sum + (*digit - '0');
    *value = (int)sum;
    return sum <= INT32_MAX;
}

static bool get_number(int object, const char *name, int *value) {
    return number(field(object, name), value);
}

static bool get_pair(int token, int values[2]) {
    bool is_pair = token != NONE && tokens[token].kind == '[' && tokens[token].after == token + 3;
    return is_pair && number(token + 1, &values[0]) && number(token + 2, &values[1]);
}

static bool get_bool(int object, const char *name, bool *value) {
    int token = field(object, name);
    *value = token != NONE && tokens[token].kind == 't';
    return *value || (token != NONE && tokens[token].kind == 'f');
}

/* Level key. Each operation says whether it has understood its input, and has then answered. */

/* Writes an answer, or the last part of it. */
#define ANSWER(...) (printf(__VA_ARGS__) > 0)

static bool answer_word(const char *name, uint64_t word) {
    return ANSWER("\"result\":{\"%s\":\"%" PRIx64 "\"}", name, word);
}

static bool answer_levels(uint64_t trail) {
    if (trail == 0)
        return ANSWER("\"result\":{\"levels\":null}");
    return ANSWER("\"result\":{\"levels\":%d}", trailing_zeros(trail));
}

static bool answer_key(int input, int op, int bits) {
    uint64_t ones = bits == 64 ? UINT64_MAX : UINT32_MAX;
    uint64_t key = 0, trail = 0, other = 0;
    bool flag = false;
    int depth = 0;
    bool has_key = get_word(input, "key", bits, &key), has_trail = get_word(input, "trail", bits, &trail);
    bool has_depth = get_number(input, "depth", &depth) && depth <= bits;
    if (is_text(op, "child") && has_key && get_bool(input, "right", &flag))
        return answer_word("key", (key << 1 | flag) & ones); /* KEY-2 */
    if (is_text(op, "parent") && has_key)
        return answer_word("key", key >> 1); /* KEY-3 */
    if (is_text(op, "sibling") && has_key)
        return answer_word("key", key ^ 1); /* KEY-4 */
    if (is_text(op, "depth") && has_key && key != 0)
        return ANSWER("\"result\":{\"depth\":%d}", depth_of(key));
    if (is_text(op, "level-start") && has_key && key != 0)
        return answer_word("key", (uint64_t)1 << depth_of(key)); /* KEY-6 */
    if (is_text(op, "descend") && has_trail && get_bool(input, "both", &flag))
        return answer_word("trail", (trail << 1 | flag) & ones); /* TRAIL-2 */
    if (is_text(op, "levels") && has_trail)
        return answer_levels(trail);
    if (is_text(op, "backtrack") && has_key && has_trail && trail != 0) {
        int levels = trailing_zeros(trail);
        back(&key, &trail);
        return ANSWER("\"result\":{\"levels\":%d,\"key\":\"%" PRIx64 "\",\"trail\":\"%" PRIx64 "\"}", levels, key,
                      trail);
    }
    if (is_text(op, "counter") && has_trail && has_depth)
        return answer_word("counter", complement(trail, depth));
    if (is_text(op, "counter-levels") && has_depth && get_word(input, "counter", bits, &other))
        return answer_levels(complement(other, depth));
    if (is_text(op, "swap") && get_word(input, "index", bits, &key) && get_word(input, "mask", bits, &other))
        return answer_word("index", key ^ other); /* SWAP-3 */
    return false;
}

/* Trees. */

typedef struct {
    bool is_leaf;
    int child[2];
    int sibling, uncle, grand_uncle; /* NONE where there is none */
    uint64_t key;
} Node;

static Node nodes[MAX_NODES];
static int node_count;
static int depth; /* of the tree */
static int met[MAX_NODES]; /* its nodes, level by level */

typedef enum { UNKNOWN, NOT_A_TREE, TREE } Tree;

/* Reads the children, then walks down from the root: each node must be met once. */
static Tree read_tree(int input) {
    int list = field(input, "children");
    if (list == NONE || tokens[list].kind != '[')
        return UNKNOWN;
    node_count = 0;
    for (int i = list + 1; i < tokens[list].after; i = tokens[i].after) {
        if (node_count == MAX_NODES)
            return UNKNOWN;
        Node *node = &nodes[node_count++];
        *node = (Node){.is_leaf = tokens[i].kind == 'n', .sibling = NONE, .uncle = NONE, .grand_uncle = NONE};
        if (!node->is_leaf && !get_pair(i, node->child))
            return UNKNOWN;
    }
    static int depths[MAX_NODES];
    int met_count = 1;
    if (node_count == 0)
        return NOT_A_TREE;
    met[0] = ROOT;
    depths[ROOT] = depth = 0;
    nodes[ROOT].key = 1;
    for (int i = 0; i < met_count; i++) {
        const Node *node = &nodes[met[i]];
        for (int right = 0; right < 2 && !node->is_leaf; right++) {
            int child = node->child[right];
            if (child >= node_count || child == ROOT || nodes[child].sibling != NONE)
                return NOT_A_TREE;
            Node *at = &nodes[child];
            at->sibling = node->child[!right];
            at->uncle = node->sibling;
            at->grand_uncle = node->uncle;
            at->key = node->key << 1 | (uint64_t)right; /* of no use in a tree that is too deep */
            depths[child] = depths[met[i]] + 1;
            depth = depths[child] > depth ? depths[child] : depth;
            met[met_count++] = child;
        }
    }
    return met_count == node_count ? TREE : NOT_A_TREE;
}

/* The table of all keys, by open addressing: it has twice as many places. */

static uint64_t mix(uint64_t key, uint64_t seed, bool narrow) { /* HASH-7 */
    static const int shifts[2][3] = {{30, 27, 31}, {16, 15, 16}};
    static const uint64_t factors[2][3] = {{UINT64_C(0xbf58476d1ce4e5b9), UINT64_C(0x94d049bb133111eb), 1},
                                           {UINT64_C(0x7feb352d), UINT64_C(0x846ca68b), 1}};
    uint64_t ones = narrow ? UINT32_MAX : UINT64_MAX;
    key = (key ^ seed) & ones;
    for (int i = 0; i < 3; i++)
        key = (key ^ key >> shifts[narrow][i]) * factors[narrow][i] & ones;
    return key;
}

static int table[2 * MAX_NODES];

/* The place of a key: that of its node, or the free one where it belongs. */
static int *place_of(uint64_t key) {
    uint64_t places = 2 * (uint64_t)node_count, at = mix(key, 0, false) % places;
    while (table[at] != NONE && nodes[table[at]].key != key)
        at = (at + 1) % places;
    return &table[at];
}

static void fill_table(void) {
    for (int i = 0; i < 2 * node_count; i++)
        table[i] = NONE;
    for (int node = 0; node < node_count; node++)
        *place_of(nodes[node].key) = node;
}

/* Level hash. */

static bool answer_hash(int input, int op) {
    uint64_t key = 0, word = 0;
    int displacements = 0, cells = 0, displacement = 0, index = 0, bits = 0;
    bool leaf = false;
    bool has_key = get_word(input, "key", 64, &key);
    bool has_sizes = get_number(input, "displacements", &displacements) && get_number(input, "cells", &cells);
    if (is_text(op, "cell") && has_key && has_sizes && displacements > 0 && cells > 0 &&
        get_number(input, "displacement", &displacement)) { /* HASH-1 */
        uint64_t bucket = key % (uint64_t)displacements;
        uint64_t cell = (key % (uint64_t)cells + (uint64_t)displacement) % (uint64_t)cells;
        return ANSWER("\"result\":{\"bucket\":%" PRIu64 ",\"cell\":%" PRIu64 "}", bucket, cell);
    }
    if (is_text(op, "mix") && has_key && get_word(input, "seed", 64, &word) && get_number(input, "bits", &bits) &&
        (bits == 32 || bits == 64))
        return answer_word("key", mix(key, word, bits == 32));
    if (is_text(op, "encode") && get_bool(input, "leaf", &leaf) && get_number(input, "index", &index)) /* HASH-5 */
        return answer_word("word", leaf ? UINT32_MAX - (uint32_t)index : UINT32_C(0x80000000) + (uint32_t)index);
    if (is_text(op, "decode") && get_word(input, "word", 32, &word)) {
        if (word >> 31 == 0)
            return ANSWER("\"result\":{\"displacement\":%" PRIu64 "}", word);
        leaf = word >> 30 == 3;
        index = (int)((leaf ? ~word : word) & 0x3fffffff);
        return ANSWER("\"result\":{\"leaf\":%s,\"index\":%d}", leaf ? "true" : "false", index);
    }
    return false;
}

/* Level trace. */

typedef struct {
    int levels; /* up to the sibling of what was postponed last; NONE if it was a step down that led here */
    int node, postponed;
    uint64_t key, trail;
} Visit;

static Visit visits[MAX_NODES];

/* One character for each node, and one that it can have. */
static bool is_script(int script) {
    if (script == NONE || tokens[script].kind != '"' || tokens[script].length != (size_t)node_count)
        return false;
    for (int i = 0; i < node_count; i++)
        if (!memchr(nodes[i].is_leaf ? ".!..." : "nlrLR", tokens[script].text[i], 5))
            return false;
    return true;
}

/* HASHED-1: returns the number of visits. The register is the node postponed last, or NONE; it is set whenever bit 0 of
 * the trail is. */
static int traverse(const char *script) {
    uint64_t key = 1, trail = 0;
    int node = ROOT, postponed = NONE, levels = NONE, count = 0;
    for (;;) {
        visits[count++] = (Visit){levels, node, postponed, key, trail};
        const Node *at = &nodes[node];
        char decision = script[node];
        if (!at->is_leaf && decision != 'n') {
            bool both = decision == 'L' || decision == 'R', right = decision == 'r' || decision == 'R';
            levels = NONE;
            node = at->child[right];
            key = key << 1 | right; /* KEY-2 */
            trail = trail << 1 | both; /* TRAIL-2 */
            if (both)
                postponed = at->child[!right];
            else if (postponed == NONE && trail != 0 && trailing_zeros(trail) == 3)
                postponed = at->grand_uncle; /* REGISTER-2: the child's record names it no more */
            continue;
        }
        if (decision == '!' || trail == 0)
            return count;
        levels = trailing_zeros(trail);
        back(&key, &trail);
        if (postponed != NONE)
            node = postponed;
        else if (levels == 1)
            node = at->uncle;
        else if (levels == 2)
            node = at->grand_uncle;
        else
            node = *place_of(key);
        postponed = NONE;
    }
}

static void print_visit(uint64_t key, int levels, bool is_leaf) {
    if (levels != NONE)
        printf("\"backtrack %" PRIx64 " %d\",", key, levels);
    printf("\"%s %" PRIx64 "\",", is_leaf ? "leaf" : "enter", key);
}

static bool answer_trace(int input) {
    Tree tree = read_tree(input);
    if (tree == NOT_A_TREE)
        return ANSWER("\"reject\":\"not-a-tree\"");
    if (tree == TREE && depth > MAX_DEPTH)
        return ANSWER("\"reject\":\"too-deep\"");
    int script = field(input, "script");
    if (tree != TREE || !is_script(script))
        return false;
    fill_table();
    int count = traverse(tokens[script].text);
    printf("\"result\":{\"events\":[");
    for (int i = 0; i < count; i++)
        print_visit(visits[i].key, visits[i].levels, nodes[visits[i].node].is_leaf);
    printf("\"end\"],\"trails\":[");
    for (int i = 0; i < count; i++)
        printf("%s\"%" PRIx64 "\"", i == 0 ? "" : ",", visits[i].trail);
    printf("],\"registers\":[");
    for (int i = 0; i < count; i++)
        if (visits[i].postponed == NONE)
            printf("%snull", i == 0 ? "" : ",");
        else
            printf("%s\"%" PRIx64 "\"", i == 0 ? "" : ",", nodes[visits[i].postponed].key);
    return ANSWER("]}");
}

/* Wide trees: for each level above the node the set of pending slots, the ancestor by parents, and the order by looking
 * at the ranks again (WTRAIL-1). */

typedef struct {
    bool is_leaf, is_met;
    int level, parent, count, child[MAX_SLOTS];
    uint64_t key; /* of no use in a tree that is too deep */
    int told; /* the set of slots that have a rank */
    uint32_t rank[MAX_SLOTS];
    int64_t hit; /* NONE where nothing is hit */
} WideNode;

typedef struct {
    int levels, node; /* levels as in Visit */
    uint8_t pending[MAX_LEVELS]; /* for each level above */
} WideVisit;

static WideNode wide_nodes[MAX_NODES];
static WideVisit wide_visits[MAX_NODES];
static int slots, slot_bits;
static bool is_sorted, is_any;
static uint32_t end;
static int best; /* the leaf of the best hit, or NONE */

static bool get_u32(int token, uint32_t *value) {
    if (token == NONE || tokens[token].kind < '0' || tokens[token].kind > '9')
        return false;
    uint64_t sum = 0;
    for (const char *digit = tokens[token].text; *digit >= '0' && *digit <= '9' && sum <= UINT32_MAX; digit++)
        sum = 10 * sum + (uint64_t)(*digit - '0');
    *value = (uint32_t)sum;
    return sum <= UINT32_MAX;
}

/* Reads the children, then walks down from the root: each node must be met once (WIDE-1). */
static Tree read_wide_tree(int input) {
    int list = field(input, "children");
    if (list == NONE || tokens[list].kind != '[' || !get_number(input, "slots", &slots))
        return UNKNOWN;
    if (slots != 2 && slots != 4 && slots != MAX_SLOTS)
        return UNKNOWN;
    slot_bits = trailing_zeros((uint64_t)slots);
    Tree tree = TREE;
    node_count = 0;
    for (int i = list + 1; i < tokens[list].after; i = tokens[i].after) {
        if (node_count == MAX_NODES)
            return UNKNOWN;
        WideNode *node = &wide_nodes[node_count++];
        *node = (WideNode){.is_leaf = tokens[i].kind == 'n', .hit = NONE};
        for (int j = i + 1; j < tokens[i].after; j++, node->count++) {
            if (node->count == slots) {
                tree = NOT_A_TREE;
                break;
            }
            if (!number(j, &node->child[node->count]))
                return UNKNOWN;
        }
        if (!node->is_leaf && node->count == 0 && node_count > 1)
            tree = NOT_A_TREE;
    }
    if (node_count == 0 || wide_nodes[ROOT].is_leaf || tree == NOT_A_TREE)
        return NOT_A_TREE;
    int met_count = 1;
    met[0] = ROOT;
    wide_nodes[ROOT].is_met = true;
    wide_nodes[ROOT].key = 1;
    depth = 0;
    for (int i = 0; i < met_count; i++) {
        const WideNode *node = &wide_nodes[met[i]];
        for (int slot = 0; slot < node->count; slot++) {
            int child = node->child[slot];
            if (child >= node_count || wide_nodes[child].is_met)
                return NOT_A_TREE;
            WideNode *at = &wide_nodes[child];
            at->is_met = true;
            at->parent = met[i];
            at->level = node->level + 1;
            at->key = node->key << slot_bits | (uint64_t)slot; /* WIDE-9 */
            if (!at->is_leaf)
                depth = at->level; /* of inner nodes */
            met[met_count++] = child;
        }
    }
    return met_count < node_count ? NOT_A_TREE : TREE;
}

/* Reads ranks and hits, one for each child and for each node. */
static bool read_wide_search(int input) {
    int ranks = field(input, "ranks"), hits = field(input, "hits"), node = 0;
    is_sorted = field(input, "sorted") == NONE || tokens[field(input, "sorted")].kind == 't';
    is_any = field(input, "any") != NONE && tokens[field(input, "any")].kind == 't';
    end = UINT32_MAX;
    best = NONE;
    if (ranks == NONE || (field(input, "end") != NONE && !get_u32(field(input, "end"), &end)))
        return false;
    for (int i = ranks + 1; i < tokens[ranks].after; i = tokens[i].after, node++) {
        int slot = 0;
        for (int j = i + 1; node < node_count && j < tokens[i].after; j++, slot++) {
            if (slot == wide_nodes[node].count)
                return false;
            if (get_u32(j, &wide_nodes[node].rank[slot]))
                wide_nodes[node].told |= 1 << slot;
        }
    }
    if (node != node_count || hits == NONE)
        return node == node_count;
    node = 0;
    for (int i = hits + 1; i < tokens[hits].after; i++, node++) {
        uint32_t hit = 0;
        if (node < node_count && get_u32(i, &hit))
            wide_nodes[node].hit = hit;
    }
    return node == node_count;
}

static bool is_beyond(uint32_t rank) { /* WIDE-3 */
    return is_sorted && rank - rank % (uint32_t)slots > end;
}

static int wanted(const WideNode *node) { /* WIDE-2 */
    int set = 0;
    for (int slot = 0; slot < node->count; slot++)
        if ((node->told >> slot & 1) && !is_beyond(node->rank[slot]))
            set |= 1 << slot;
    return set;
}

/* The pending slot that comes next; NONE if there is none, or if all that is left is beyond. */
static int next_slot(const WideNode *node, int pending) {
    int next = NONE;
    for (int slot = 0; slot < node->count; slot++) {
        if (!(pending >> slot & 1))
            continue;
        bool is_less = next != NONE && node->rank[slot] < node->rank[next]; /* WIDE-5 */
        if (next != NONE && !is_sorted) /* WIDE-6 */
            is_less = wide_nodes[node->child[slot]].is_leaf && !wide_nodes[node->child[next]].is_leaf;
        if (next == NONE || is_less)
            next = slot;
    }
    return next != NONE && is_beyond(node->rank[next]) ? NONE : next;
}

/* Whether the search ends here. */
static bool visit_leaf(int leaf) {
    int64_t hit = wide_nodes[leaf].hit;
    if (hit == NONE || hit > end)
        return false;
    if (best == NONE || hit < wide_nodes[best].hit || leaf < best)
        best = leaf;
    end = (uint32_t)hit;
    return is_any;
}

/* Reads where the search begins: at the root, or at the node of a key. There a trail says what is pending, with a bit for
 * each slot of each level, the root's first (WIDE-10). */
static bool read_wide_state(int input, WideVisit *state) {
    int trail = field(input, "trail"), hit = field(input, "hit");
    uint64_t key = 1;
    uint32_t distance = 0;
    *state = (WideVisit){.levels = NONE, .node = ROOT};
    if (trail == NONE)
        return true;
    if (!get_word(input, "key", 64, &key))
        return false;
    while (wide_nodes[state->node].key != key)
        if (++state->node == node_count)
            return false;
    int level = wide_nodes[state->node].level, digits = (int)tokens[trail].length;
    for (int bit = 0; bit < slots * level && bit < 4 * digits; bit++)
        if (hex(tokens[trail].text[digits - 1 - bit / 4]) >> bit % 4 & 1)
            state->pending[level - 1 - bit / slots] |= (uint8_t)(1 << bit % slots);
    if (hit == NONE)
        return true;
    if (!get_number(hit, "node", &best) || best >= node_count || !get_u32(field(hit, "t"), &distance))
        return false;
    wide_nodes[best].hit = distance;
    return true;
}

/* Goes on from a state, whose node may have been visited; returns the number of visits. A trail that is made up may lead
 * to nodes more than once. */
static int traverse_wide(WideVisit now, bool is_visited) {
    int count = 0;
    while (count < MAX_NODES) {
        int level = wide_nodes[now.node].level, at = level, pending = 0;
        if (!is_visited) {
            wide_visits[count++] = now;
            if (!wide_nodes[now.node].is_leaf)
                pending = wanted(&wide_nodes[now.node]);
            else if (visit_leaf(now.node))
                break;
        }
        is_visited = false;
        int slot = next_slot(&wide_nodes[now.node], pending);
        while (slot == NONE && at > 0) { /* WIDE-11, a level at a time */
            now.node = wide_nodes[now.node].parent;
            pending = now.pending[--at];
            slot = next_slot(&wide_nodes[now.node], pending);
        }
        if (slot == NONE)
            break;
        now.levels = at == level ? NONE : level - at - 1;
        now.pending[at] = (uint8_t)(pending & ~(1 << slot)); /* WIDE-10 */
        now.node = wide_nodes[now.node].child[slot];
    }
    return count;
}

static void print_wide_trail(const WideVisit *visit) { /* WIDE-10 */
    int level = wide_nodes[visit->node].level;
    bool is_begun = false;
    for (int digit = (slots * level - 1) / 4; digit >= 0; digit--) {
        int value = 0;
        for (int bit = 4 * digit + 3; bit >= 4 * digit; bit--) {
            int above = bit / slots, slot = bit % slots;
            value = 2 * value + (above < level ? visit->pending[level - 1 - above] >> slot & 1 : 0);
        }
        is_begun |= value != 0;
        if (is_begun || digit == 0)
            printf("%x", (unsigned)value);
    }
}

static bool answer_wide(int input) {
    Tree tree = read_wide_tree(input);
    if (tree == NOT_A_TREE)
        return ANSWER("\"reject\":\"not-a-tree\"");
    if (tree == TREE && depth > MAX_LEVELS / slot_bits - 1)
        return ANSWER("\"reject\":\"too-deep\"");
    WideVisit state;
    if (tree != TREE || !read_wide_search(input) || !read_wide_state(input, &state))
        return false;
    int next = field(input, "next"), count = traverse_wide(state, next != NONE && is_text(next, "backtrack"));
    printf("\"result\":{\"events\":[");
    for (int i = 0; i < count; i++) {
        const WideNode *node = &wide_nodes[wide_visits[i].node];
        print_visit(node->key, wide_visits[i].levels, node->is_leaf);
    }
    printf("\"end\"]");
    if (field(input, "hits") == NONE && next == NONE) {
        printf(",\"trails\":[");
        for (int i = 0; i < count; i++) {
            printf(i == 0 ? "\"" : ",\"");
            print_wide_trail(&wide_visits[i]);
            printf("\"");
        }
        printf("]");
    } else if (field(input, "hits") != NONE && best == NONE)
        printf(",\"hit\":null");
    else if (field(input, "hits") != NONE)
        printf(",\"hit\":{\"t\":%" PRId64 ",\"node\":%d}", wide_nodes[best].hit, best);
    return ANSWER("}");
}

static bool answer_hashed_keys_wide(int input) { /* WIDE-16 */
    if (read_wide_tree(input) != TREE || depth > MAX_LEVELS / slot_bits)
        return false;
    const char *before = "";
    printf("\"result\":{\"keys\":[");
    for (int i = 0; i < node_count; i++) { /* keys ascend */
        const WideNode *node = &wide_nodes[met[i]];
        bool has_inner = false;
        for (int slot = 0; slot < node->count; slot++)
            has_inner |= !wide_nodes[node->child[slot]].is_leaf;
        if (!has_inner || node->count == 1)
            continue;
        printf("%s\"%" PRIx64 "\"", before, node->key);
        before = ",";
    }
    return ANSWER("]}");
}

/* Protocol. */

static const char HELLO[] =
    "{\"protocol\":1,\"name\":\"traverse.c\",\"version\":\"1.0\",\"profiles\":[\"key/u32\",\"key/u64\","
    "\"hash/function\",\"hash/address\",\"trace/script\",\"trace/complete\",\"trace/invalid\","
    "\"trace/wide\",\"trace/wide-invalid\",\"resume/wide\",\"hash/wide\"],\"features\":[\"trails\",\"registers\",\"changing\"],"
    "\"limits\":{\"max_depth\":%d,\"wide\":{\"2\":%d,\"4\":%d,\"8\":%d}}}\n";

static bool answer_case(int request) {
    int seq = 0, level = field(request, "level"), profile = field(request, "profile"), input = field(request, "input");
    int op = field(input, "op");
    if (!get_number(request, "seq", &seq) || level == NONE || profile == NONE || op == NONE)
        return false;
    printf("{\"seq\":%d,", seq);
    bool is_answered = false;
    if (is_text(level, "key") && (is_text(profile, "u32") || is_text(profile, "u64")))
        is_answered = answer_key(input, op, is_text(profile, "u32") ? 32 : 64);
    else if (is_text(level, "hash") && is_text(op, "hashed-keys-wide"))
        is_answered = answer_hashed_keys_wide(input);
    else if (is_text(level, "hash"))
        is_answered = answer_hash(input, op);
    else if (is_text(level, "trace") && is_text(op, "trace"))
        is_answered = answer_trace(input);
    else if (is_text(op, "trace-wide") || is_text(op, "resume-wide"))
        is_answered = answer_wide(input);
    if (!is_answered)
        printf("\"unsupported\":\"not asked for here, too large, or not as it must be\"");
    printf("}\n");
    return true;
}

int main(void) {
    static char line[MAX_LINE];
    while (fgets(line, sizeof line, stdin)) {
        token_count = 0;
        const char *end = strchr(line, '\n') ? parse(skip_space(line), MAX_NESTING) : NULL;
        int cmd = end && *skip_space(end) == '\0' ? field(0, "cmd") : NONE;
        if (cmd != NONE && is_text(cmd, "bye"))
            break;
        bool is_answered = false;
        if (cmd != NONE && is_text(cmd, "hello"))
            is_answered = ANSWER(HELLO, MAX_DEPTH, MAX_LEVELS - 1, MAX_LEVELS / 2 - 1, MAX_LEVELS / 3 - 1);
        else if (cmd != NONE && is_text(cmd, "case"))
            is_answered = answer_case(0);
        if (!is_answered) {
            fprintf(stderr, "traverse: a line that is not of the protocol\n");
            return EXIT_FAILURE;
        }
        fflush(stdout);
    }
    return EXIT_SUCCESS;
}
