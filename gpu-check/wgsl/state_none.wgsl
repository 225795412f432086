// Of a traversal whose state has none of what an event can show.

fn cursor_levels() -> u32 {
    return 0u;
}

fn cursor_key() -> Word {
    return WORD_ZERO;
}

fn cursor_trail() -> Word {
    return WORD_ZERO;
}

fn cursor_register() -> u32 {
    return 0u;
}
