//! The attributes of Kani that the harnesses use.

use proc_macro::{TokenStream, TokenTree};

/// Exports the function from the WebAssembly module, by its name.
#[proc_macro_attribute]
pub fn proof(_: TokenStream, item: TokenStream) -> TokenStream {
    let mut exported: TokenStream = "#[unsafe(no_mangle)]".parse().unwrap();
    for token in item {
        if matches!(&token, TokenTree::Ident(ident) if ident.to_string() == "fn") {
            exported.extend("pub extern \"C\"".parse::<TokenStream>().unwrap());
        }
        exported.extend([token]);
    }
    exported
}

/// The bound is passed to CBMC on its command line. It must be a bare number: what a macro has parsed comes in a group,
/// which Kani may refuse.
#[proc_macro_attribute]
pub fn unwind(bound: TokenStream, item: TokenStream) -> TokenStream {
    let bound: Vec<_> = bound.into_iter().collect();
    assert!(matches!(bound[..], [TokenTree::Literal(_)]), "not a bare number: {bound:?}");
    item
}

/// Whether the function panics is judged from CBMC's answer.
#[proc_macro_attribute]
pub fn should_panic(_: TokenStream, item: TokenStream) -> TokenStream {
    item
}
