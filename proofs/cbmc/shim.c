/* What the compiled harnesses import, as CBMC understands it, and what wasm2c's runtime does, as far as they need it. */
#include <stdint.h>
#include "harnesses.h"

extern uint64_t nondet_uint64(void);

u64 Z_vfZ_nondet_u64(struct Z_vf_instance_t *vf) {
    uint64_t any = nondet_uint64();
    return any;
}

void Z_vfZ_assume(struct Z_vf_instance_t *vf, u32 condition) {
    __CPROVER_assume(condition != 0);
}

/* Each name is a property of its own, that the condition never holds: it is reached where this is refuted. */
void Z_vfZ_cover(struct Z_vf_instance_t *vf, u32 number, u32 condition) {
#define COVER(own, name) if (number == own) __CPROVER_assert(condition == 0, "cover: " name);
#include "covers.inc"
}

/* What the harness claims and its twin breaks. What comes after it is not asked where it does not hold. */
void Z_vfZ_claim(struct Z_vf_instance_t *vf, u32 condition) {
    __CPROVER_assert(condition != 0, "claim");
    __CPROVER_assume(condition != 0);
}

/* Panic, overflow, index out of bounds, and memory outside of the module's. */
void wasm_rt_trap(wasm_rt_trap_t trap) {
    __CPROVER_assert(0, "trap");
    __CPROVER_assume(0);
}

bool wasm_rt_is_initialized(void) {
    return 1;
}

uint32_t wasm_rt_register_func_type(uint32_t parameters, uint32_t results, ...) {
    static uint32_t types;
    return ++types;
}

/* Less memory than a page is less to reason about; an access beyond it is a trap. */
#define BYTES 4096
static uint8_t bytes[BYTES];

void wasm_rt_allocate_memory(wasm_rt_memory_t *memory, uint32_t pages, uint32_t most) {
    memory->data = bytes;
    memory->pages = 1;
    memory->max_pages = 1;
    memory->size = BYTES;
}

void wasm_rt_free_memory(wasm_rt_memory_t *memory) {}

#define FUNCTIONS 64
static wasm_rt_funcref_t functions[FUNCTIONS];

void wasm_rt_allocate_funcref_table(wasm_rt_funcref_table_t *table, uint32_t size, uint32_t most) {
    __CPROVER_assert(size <= FUNCTIONS, "the table of functions is large enough");
    table->data = functions;
    table->size = size;
    table->max_size = most;
}

void wasm_rt_free_funcref_table(wasm_rt_funcref_table_t *table) {}

#define HARNESS(name)                    \
    void prove_##name(void) {            \
        static Z_harnesses_instance_t i; \
        Z_harnesses_init_module();       \
        Z_harnesses_instantiate(&i, 0);  \
        Z_harnessesZ_##name(&i);         \
    }
PROVED
