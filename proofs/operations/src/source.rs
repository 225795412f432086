//! The source files, with lookup by name.

use std::path::Path;

use quote::ToTokens;
use syn::{FnArg, ImplItem, Item, TraitItem, UseTree};

/// The library's files, relative to the root of the repository.
const FILES: &[&str] = &[
    "src/geom/aabb.rs",
    "src/geom/fine.rs",
    "src/geom/frame.rs",
    "src/geom/interval.rs",
    "src/geom/kernel/bounds.rs",
    "src/geom/kernel/exact/double.rs",
    "src/geom/kernel/exact/filter.rs",
    "src/geom/kernel/exact/fine.rs",
    "src/geom/kernel/exact/mod.rs",
    "src/geom/kernel/exact/predicates.rs",
    "src/geom/kernel/exact/single.rs",
    "src/geom/kernel/exact/sum.rs",
    "src/geom/lanes/block.rs",
    "src/geom/lanes/boxes.rs",
    "src/geom/lanes/precision.rs",
    "src/geom/lanes/triangles.rs",
    "src/geom/nearest.rs",
    "src/geom/ray.rs",
    "src/geom/region.rs",
    "src/geom/slabs/centred.rs",
    "src/geom/slabs/directed.rs",
    "src/geom/slabs/doubled.rs",
    "src/geom/slabs/mod.rs",
    "src/geom/slabs/slabs64.rs",
    "src/geom/triangle.rs",
    "src/geom/vector.rs",
];

/// The content of all files.
pub(crate) struct Source {
    pub(crate) functions: Vec<Function>,
    pub(crate) constants: Vec<Constant>,
    pub(crate) structs: Vec<Struct>,
    pub(crate) aliases: Vec<(String, syn::Type)>,
    /// Imported names of a file, with the module that they come from.
    imports: Vec<(String, String, String)>,
}

/// The place of an item, and its owner.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) file: String,
    /// The type of the `impl`, or the trait; empty for items of a module.
    pub(crate) owner: String,
}

#[derive(Clone)]
pub(crate) struct Function {
    pub(crate) place: Place,
    pub(crate) name: String,
    /// The operand's type of an operator's trait, if it names one.
    pub(crate) operand: String,
    pub(crate) inputs: Vec<FnArg>,
    pub(crate) output: Option<syn::Type>,
    pub(crate) body: syn::Block,
}

#[derive(Clone)]
pub(crate) struct Constant {
    pub(crate) place: Place,
    pub(crate) name: String,
    pub(crate) ty: syn::Type,
    pub(crate) value: syn::Expr,
}

pub(crate) struct Struct {
    pub(crate) name: String,
    pub(crate) fields: Vec<(String, syn::Type)>,
}

impl Source {
    /// Reads the library's files, and the meaning of glam.
    pub(crate) fn read(root: &Path) -> Result<Self, String> {
        let mut source = Self {
            functions: Vec::new(),
            constants: Vec::new(),
            structs: Vec::new(),
            aliases: Vec::new(),
            imports: Vec::new(),
        };
        for file in FILES {
            let text = std::fs::read_to_string(root.join(file)).map_err(|error| format!("{file}: {error}"))?;
            source.add(file, &text)?;
        }
        source.add("glam", include_str!("glam.rs"))?;
        for [vector, number] in [["Vec3", "f32"], ["DVec3", "f64"]] {
            let text = include_str!("glam/vector.rs").replace("Vector", vector).replace("Number", number);
            source.add("glam", &text)?;
        }
        Ok(source)
    }

    fn add(&mut self, file: &str, text: &str) -> Result<(), String> {
        let parsed = syn::parse_file(text).map_err(|error| format!("{file}: {error}"))?;
        parsed.items.iter().for_each(|item| self.add_item(file, item));
        Ok(())
    }

    fn add_item(&mut self, file: &str, item: &Item) {
        let place = |owner: &str| Place { file: file.into(), owner: owner.into() };
        match item {
            // Code for particular machines is ignored.
            Item::Fn(syn::ItemFn { attrs, .. })
            | Item::Const(syn::ItemConst { attrs, .. })
            | Item::Struct(syn::ItemStruct { attrs, .. })
            | Item::Impl(syn::ItemImpl { attrs, .. })
                if is_conditional(attrs) => {}
            Item::Fn(item) => self.add_function(place(""), "", &item.sig, &item.block),
            Item::Const(item) => self.add_constant(place(""), &item.ident, &item.ty, &item.expr),
            Item::Type(item) => self.aliases.push((item.ident.to_string(), (*item.ty).clone())),
            Item::Struct(item) => {
                let name = |(at, field): (usize, &syn::Field)| {
                    (field.ident.as_ref().map_or_else(|| at.to_string(), ToString::to_string), field.ty.clone())
                };
                let fields = item.fields.iter().enumerate().map(name).collect();
                self.structs.push(Struct { name: item.ident.to_string(), fields });
            }
            Item::Use(item) => self.add_imports(file, "", &item.tree),
            Item::Impl(item) => {
                let owner = last_name(&item.self_ty);
                let operand = item.trait_.as_ref().map(|(path, _)| operand_of(path)).unwrap_or_default();
                for inner in &item.items {
                    match inner {
                        ImplItem::Fn(syn::ImplItemFn { attrs, .. })
                        | ImplItem::Const(syn::ImplItemConst { attrs, .. })
                            if is_conditional(attrs) => {}
                        ImplItem::Fn(inner) => self.add_function(place(&owner), &operand, &inner.sig, &inner.block),
                        ImplItem::Const(inner) => {
                            self.add_constant(place(&owner), &inner.ident, &inner.ty, &inner.expr);
                        }
                        _ => {}
                    }
                }
            }
            Item::Trait(item) => {
                for inner in &item.items {
                    if let TraitItem::Fn(inner) = inner
                        && let Some(body) = &inner.default
                    {
                        self.add_function(place(&item.ident.to_string()), "", &inner.sig, body);
                    }
                }
            }
            _ => {}
        }
    }

    fn add_function(&mut self, place: Place, operand: &str, signature: &syn::Signature, body: &syn::Block) {
        let output = match &signature.output {
            syn::ReturnType::Type(_, ty) => Some((**ty).clone()),
            syn::ReturnType::Default => None,
        };
        let inputs = signature.inputs.iter().cloned().collect();
        let (name, operand) = (signature.ident.to_string(), operand.to_owned());
        self.functions.push(Function { place, name, operand, inputs, output, body: body.clone() });
    }

    fn add_constant(&mut self, place: Place, name: &syn::Ident, ty: &syn::Type, value: &syn::Expr) {
        self.constants.push(Constant { place, name: name.to_string(), ty: ty.clone(), value: value.clone() });
    }

    fn add_imports(&mut self, file: &str, module: &str, tree: &UseTree) {
        match tree {
            UseTree::Path(path) => self.add_imports(file, &inside(file, module, &path.ident.to_string()), &path.tree),
            UseTree::Name(name) => self.imports.push((file.into(), name.ident.to_string(), module.into())),
            UseTree::Group(group) => group.items.iter().for_each(|tree| self.add_imports(file, module, tree)),
            _ => {}
        }
    }

    /// Finds a function of a type by its name, and by the operand's type if there are several.
    pub(crate) fn method(&self, owner: &str, name: &str, operand: &str) -> Result<&Function, String> {
        let found = self.functions.iter().filter(|f| f.place.owner == owner && f.name == name);
        let found: Vec<_> = found.collect();
        let fitting = |f: &&&Function| f.operand == operand || f.operand.is_empty() && operand == owner;
        match found[..] {
            [one] if one.operand.is_empty() || operand.is_empty() => Ok(one),
            _ => only(&format!("{owner}::{name} ({operand})"), found.iter().filter(fitting).copied()),
        }
    }

    /// Finds a function of a module by its name in a file.
    pub(crate) fn function(&self, file: &str, name: &str) -> Result<&Function, String> {
        let found = self.functions.iter().filter(|f| f.place.owner.is_empty() && f.name == name);
        self.visible(file, name, found, |f| &f.place.file)
    }

    /// Finds a constant by its name in a file.
    pub(crate) fn constant(&self, file: &str, owner: &str, name: &str) -> Result<&Constant, String> {
        let found = self.constants.iter().filter(|c| c.place.owner == owner && c.name == name);
        self.visible(file, name, found, |c| &c.place.file)
    }

    /// Selects the item in the same file. Otherwise selects the one in the module that the name is imported from, or
    /// the only one in a submodule, or the only one at all.
    fn visible<'s, T>(
        &self,
        file: &str,
        name: &str,
        found: impl Iterator<Item = &'s T>,
        file_of: impl Fn(&T) -> &str,
    ) -> Result<&'s T, String> {
        let found: Vec<&T> = found.collect();
        if let Some(here) = found.iter().find(|item| file_of(item) == file) {
            return Ok(here);
        }
        let from = self.imports.iter().find(|(by, what, _)| by == file && what == name).map(|(_, _, module)| module);
        if let Some(there) = found.iter().find(|item| from.is_some_and(|from| *from == module_of(file_of(item)))) {
            return Ok(there);
        }
        let below = |item: &&T| from.is_some_and(|from| module_of(file_of(item)).starts_with(&format!("{from}/")));
        if let [there] = found.iter().copied().filter(below).collect::<Vec<_>>()[..] {
            return Ok(there);
        }
        only(name, found.into_iter())
    }

    pub(crate) fn structure(&self, name: &str) -> Result<&Struct, String> {
        only(name, self.structs.iter().filter(|s| s.name == name))
    }
}

fn only<'s, T>(name: &str, found: impl Iterator<Item = &'s T>) -> Result<&'s T, String> {
    let found: Vec<_> = found.collect();
    match found[..] {
        [one] => Ok(one),
        _ => Err(format!("{name} is the name of {} items", found.len())),
    }
}

fn is_conditional(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| attribute.path().is_ident("cfg") || attribute.path().is_ident("cfg_attr"))
}

/// Returns the path of a file's module: `geom/slabs` for `src/geom/slabs/mod.rs`.
pub(crate) fn module_of(file: &str) -> String {
    let path = file.trim_start_matches("src/").trim_end_matches(".rs");
    path.trim_end_matches("/mod").to_owned()
}

/// Resolves a step of a path in `use`.
fn inside(file: &str, module: &str, step: &str) -> String {
    let up = |path: &str| path.rsplit_once('/').map(|(above, _)| above.to_owned()).unwrap_or_default();
    match (step, module) {
        ("crate", _) => String::new(),
        ("super", "") => up(&module_of(file)),
        ("super", module) => up(module),
        (step, "") => step.to_owned(),
        (step, module) => format!("{module}/{step}"),
    }
}

/// Returns the name of a type without its path and its parameters.
pub(crate) fn last_name(ty: &syn::Type) -> String {
    match ty {
        syn::Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default(),
        other => text(other),
    }
}

fn operand_of(path: &syn::Path) -> String {
    match path.segments.last().map(|last| &last.arguments) {
        Some(syn::PathArguments::AngleBracketed(arguments)) => {
            text(&arguments.args).trim_start_matches("Self").to_owned()
        }
        _ => String::new(),
    }
}

/// Returns tokens without spaces.
pub(crate) fn text(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string().split_whitespace().collect()
}
