// For traversals without the state that events record.

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
