// Links to ancestors without any state.

fn link_clear() {}

fn link_enter(slot: u32) {}

fn link_key() -> Word {
    return WORD_ZERO;
}
