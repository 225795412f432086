//! Trees and traversals as text.

use std::fmt::Write as _;

use super::{Page, Recording, Step};

/// Nodes have the names of the pages: their keys as numbers.
impl Page {
    /// Returns the tree, one node a line, indented by its level.
    pub fn tree(&self) -> String {
        let (mut text, mut rest) = (String::new(), vec![(0, 0)]);
        while let Some((node, level)) = rest.pop() {
            let children = self.children[node as usize].as_deref();
            let leaf = if children.is_some() { "" } else { " leaf" };
            let _ = writeln!(text, "{:indent$}{}{leaf}", "", self.name(node), indent = 2 * level);
            rest.extend(children.unwrap_or_default().iter().rev().map(|&child| (child, level + 1)));
        }
        text
    }

    /// Returns the traversals, one visit a line: its number, its node, the state, the oracle's postponed nodes with
    /// the next one last, and a description. Then the omitted traversals, with the reasons.
    pub fn traversals(&self) -> String {
        let traversals = self.methods.iter().map(|recording| self.traversal(recording));
        traversals.chain(self.left_out.iter().map(|reason| format!("omitted: {reason}\n"))).collect()
    }

    fn traversal(&self, Recording { method, about, clause, steps, .. }: &Recording) -> String {
        let mut text = format!("{method} [{clause}]: {about}\n");
        let width = steps.iter().map(|step| self.name(step.node).len()).max().unwrap_or(0);
        for (visit, step) in steps.iter().enumerate() {
            let _ = writeln!(
                text,
                "{visit:4}  {:width$}  {}postponed {}: {}",
                self.name(step.node),
                self.state(step),
                self.names(&step.stack),
                step.text
            );
        }
        text
    }

    /// The parts of the state, each with a comma.
    fn state(&self, step: &Step) -> String {
        let words = [
            ("key", &step.key),
            ("trail", &step.trail),
            ("counter", &step.counter),
            ("disjoint", &step.disjoint),
            ("sets", &step.sets),
        ];
        let words = words.into_iter().filter_map(|(name, word)| Some(format!("{name} {}, ", word.as_deref()?)));
        let rows = step.rows.iter().map(|(name, row)| format!("{name} {}, ", row.join(" ")));
        let register = step.register.map(|node| format!("register {}, ", self.name(node)));
        words.chain(rows).chain(register).collect()
    }

    fn names(&self, nodes: &[u32]) -> String {
        let names: Vec<_> = nodes.iter().map(|&node| self.name(node)).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(" ") }
    }

    fn name(&self, node: u32) -> &str {
        &self.names[node as usize]
    }
}
