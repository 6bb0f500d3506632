//! Mutations by rule: every expression of a source that a rule replaces by a wrong one.
//!
//! Tests, constants, `const fn`, types, array lengths, patterns, attributes and macros stay as they are, so assertions do too; only the
//! expressions of `vec!` are read. What a rule gives may still not compile: the compiler decides (`draw`).

use super::record::{Mutation, SourceReplacement};
use std::ops::Range;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{Attribute, BinOp, Expr, Lit, Meta, Token, UnOp};

/// `+` for `-`, `*` for `/`, `&&` for `||`, and each the other way round.
const OPERATOR: &str = "operator";
/// `<` for `≤`, `<` for `>`, `==` for `!=`.
const COMPARISON: &str = "comparison";
/// A sign or a `!` that is dropped or added.
const SIGN: &str = "sign";
/// 1 for 0, 0 for 1, twice or half of any other number, twice a named constant.
const CONSTANT: &str = "constant";
/// One of two terms or factors alone, or a value without its bound or its absolute value.
const DROPPED_TERM: &str = "dropped term";
/// `min` for `max`.
const EXTREMUM: &str = "extremum";
/// `[j]` for `[i]`, `[1]` for `[0]`.
const INDEX: &str = "index";
/// The condition of an `if` or a `while`, negated.
const CONDITION: &str = "condition";

/// An expression of a source and a wrong one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    /// File below `solver/src`.
    pub(super) file: String,
    /// Bytes of the expression in its file.
    pub(super) range: Range<usize>,
    rule: &'static str,
    wrong: String,
}

impl Candidate {
    /// As a record of a mutation that no case is named for; `text` is that of the file.
    pub(super) fn mutation(&self, name: String, text: &str) -> Mutation {
        let right = &text[self.range.clone()];
        let shown = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let line = 1 + text[..self.range.start].matches('\n').count();
        let description = format!("{}:{line}: {}: {} → {}", self.file, self.rule, shown(right), shown(&self.wrong));
        // as much of what stands before as makes the text the only one in its file
        let mut starts = (0..=self.range.start).rev().filter(|start| text.is_char_boundary(*start));
        let is_alone = |start: &usize| text.match_indices(&text[*start..self.range.end]).nth(1).is_none();
        let start = starts.find(is_alone).unwrap_or(0);
        let place = SourceReplacement {
            file: self.file.clone(),
            after: text[start..self.range.start].to_owned(),
            text: right.to_owned(),
            instead: self.wrong.clone(),
        };
        Mutation { name, description, cases: Vec::new(), tests: Vec::new(), generated: true, places: vec![place] }
    }
}

/// All candidates of a source, in the order of its text.
///
/// # Errors
/// A text that is no Rust.
pub(super) fn candidates(file: &str, text: &str) -> Result<Vec<Candidate>, syn::Error> {
    let mut finder = Finder { file, text, found: Vec::new() };
    finder.visit_file(&syn::parse_file(text)?);
    finder.found.sort_by_key(|candidate| (candidate.range.start, candidate.range.end));
    Ok(finder.found)
}

struct Finder<'a> {
    file: &'a str,
    text: &'a str,
    found: Vec<Candidate>,
}

impl<'a> Finder<'a> {
    fn text(&self, node: &impl Spanned) -> &'a str {
        &self.text[node.span().byte_range()]
    }

    fn replace(&mut self, node: &impl Spanned, rule: &'static str, wrong: impl Into<String>) {
        let (file, range) = (self.file.to_owned(), node.span().byte_range());
        self.found.push(Candidate { file, range, rule, wrong: wrong.into() });
    }

    fn binary(&mut self, binary: &syn::ExprBinary) {
        if has_let(&binary.left) || has_let(&binary.right) {
            return;
        }
        let (left, right) = (self.text(&binary.left), self.text(&binary.right));
        let (rule, others, kept): (&str, &[&str], &[&str]) = match binary.op {
            BinOp::Add(_) => (OPERATOR, &["-"], &[left, right]),
            BinOp::Sub(_) => (OPERATOR, &["+"], &[left]),
            BinOp::Mul(_) => (OPERATOR, &["/"], &[left, right]),
            BinOp::Div(_) => (OPERATOR, &["*"], &[left]),
            BinOp::And(_) => (OPERATOR, &["||"], &[left, right]),
            BinOp::Or(_) => (OPERATOR, &["&&"], &[left, right]),
            BinOp::Lt(_) => (COMPARISON, &["<=", ">"], &[]),
            BinOp::Le(_) => (COMPARISON, &["<", ">="], &[]),
            BinOp::Gt(_) => (COMPARISON, &[">=", "<"], &[]),
            BinOp::Ge(_) => (COMPARISON, &[">", "<="], &[]),
            BinOp::Eq(_) => (COMPARISON, &["!="], &[]),
            BinOp::Ne(_) => (COMPARISON, &["=="], &[]),
            BinOp::AddAssign(_) => (OPERATOR, &["-="], &["()"]),
            BinOp::SubAssign(_) => (OPERATOR, &["+="], &["()"]),
            BinOp::MulAssign(_) => (OPERATOR, &["/="], &["()"]),
            BinOp::DivAssign(_) => (OPERATOR, &["*="], &["()"]),
            _ => return,
        };
        let is_logical = matches!(binary.op, BinOp::And(_) | BinOp::Or(_));
        for other in others {
            let wrong =
                if is_logical { format!("({left}) {other} ({right})") } else { format!("{left} {other} {right}") };
            self.replace(binary, rule, wrong);
        }
        for term in kept {
            self.replace(binary, DROPPED_TERM, *term);
        }
        if matches!(binary.op, BinOp::Mul(_) | BinOp::Div(_)) {
            self.replace(binary, SIGN, format!("-({})", self.text(binary)));
        }
    }

    fn literal(&mut self, literal: &syn::ExprLit) {
        let text = self.text(literal);
        let (value, zero, one, two) = match &literal.lit {
            Lit::Float(float) => (float.base10_parse::<f64>(), "0.0", "1.0", "2.0"),
            Lit::Int(integer) => (integer.base10_parse::<f64>(), "0", "1", "2"),
            _ => return,
        };
        match value {
            Ok(0.0) => self.replace(literal, CONSTANT, one),
            Ok(1.0) => self.replace(literal, CONSTANT, zero),
            Ok(_) => {
                self.replace(literal, CONSTANT, format!("{two} * {text}"));
                self.replace(literal, CONSTANT, format!("{text} / {two}"));
            }
            Err(_) => {}
        }
    }

    fn method(&mut self, call: &syn::ExprMethodCall) {
        let name = call.method.to_string();
        let other = match (name.as_str(), call.args.len()) {
            ("min", 1) => Some("max"),
            ("max", 1) => Some("min"),
            ("abs", 0) | ("clamp", 2) => None,
            _ => return,
        };
        let receiver = self.text(&call.receiver);
        if let Some(other) = other {
            let (whole, name) = (call.span().byte_range(), call.method.span().byte_range());
            let wrong = format!("{}{other}{}", &self.text[whole.start..name.start], &self.text[name.end..whole.end]);
            self.replace(call, EXTREMUM, wrong);
        }
        self.replace(call, DROPPED_TERM, receiver);
    }

    /// Whether the index is one that has a counterpart.
    fn index(&mut self, index: &Expr) -> bool {
        let other = match self.text(index) {
            "i" => "j",
            "j" => "i",
            "0" => "1",
            "1" => "0",
            _ => return false,
        };
        self.replace(index, INDEX, other);
        true
    }

    fn condition(&mut self, condition: &Expr) {
        if !has_let(condition) {
            self.replace(condition, CONDITION, format!("!({})", self.text(condition)));
        }
    }
}

/// Whether a condition binds a name, so that it is no expression of its own.
fn has_let(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(binary) => has_let(&binary.left) || has_let(&binary.right),
        _ => false,
    }
}

/// Whether an item is for tests only.
fn is_for_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| match &attribute.meta {
        Meta::List(list) => list.path.is_ident("cfg") && list.tokens.to_string().contains("test"),
        meta => meta.path().is_ident("test"),
    })
}

impl<'ast> Visit<'ast> for Finder<'_> {
    fn visit_expr(&mut self, expr: &'ast Expr) {
        match expr {
            Expr::Binary(binary) => self.binary(binary),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_) | UnOp::Not(_)) => {
                self.replace(unary, SIGN, self.text(&unary.expr));
            }
            Expr::Lit(literal) => self.literal(literal),
            Expr::Path(path) => {
                let name = path.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
                if name.len() > 1 && name.chars().all(|letter| letter.is_ascii_uppercase() || letter == '_') {
                    self.replace(path, CONSTANT, format!("{0} + {0}", self.text(path)));
                }
            }
            Expr::MethodCall(call) => self.method(call),
            Expr::Index(indexed) => {
                self.visit_expr(&indexed.expr);
                if !self.index(&indexed.index) {
                    self.visit_expr(&indexed.index);
                }
                return;
            }
            Expr::If(choice) => self.condition(&choice.cond),
            Expr::While(repeated) => self.condition(&repeated.cond),
            Expr::Const(_) => return,
            _ => {}
        }
        visit::visit_expr(self, expr);
    }

    fn visit_expr_repeat(&mut self, repeated: &'ast syn::ExprRepeat) {
        self.visit_expr(&repeated.expr);
    }

    fn visit_macro(&mut self, invoked: &'ast syn::Macro) {
        let list = invoked.parse_body_with(Punctuated::<Expr, Token![,]>::parse_terminated);
        if let (true, Ok(list)) = (invoked.path.is_ident("vec"), list) {
            // not as nodes of the file's tree: they live as long as this visit
            list.iter().for_each(|item| Finder::visit_expr(self, item));
        }
    }

    fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
        if !is_for_tests(&function.attrs) && function.sig.constness.is_none() {
            self.visit_block(&function.block);
        }
    }

    fn visit_impl_item_fn(&mut self, function: &'ast syn::ImplItemFn) {
        if !is_for_tests(&function.attrs) && function.sig.constness.is_none() {
            self.visit_block(&function.block);
        }
    }

    fn visit_item_mod(&mut self, module: &'ast syn::ItemMod) {
        if !is_for_tests(&module.attrs) {
            visit::visit_item_mod(self, module);
        }
    }

    fn visit_item_impl(&mut self, block: &'ast syn::ItemImpl) {
        if !is_for_tests(&block.attrs) {
            block.items.iter().for_each(|item| self.visit_impl_item(item));
        }
    }

    fn visit_field_value(&mut self, field: &'ast syn::FieldValue) {
        if field.colon_token.is_some() {
            self.visit_expr(&field.expr);
        }
    }

    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_item_enum(&mut self, _: &'ast syn::ItemEnum) {}
    fn visit_item_struct(&mut self, _: &'ast syn::ItemStruct) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_trait_item_const(&mut self, _: &'ast syn::TraitItemConst) {}
    fn visit_generics(&mut self, _: &'ast syn::Generics) {}
    fn visit_angle_bracketed_generic_arguments(&mut self, _: &'ast syn::AngleBracketedGenericArguments) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_attribute(&mut self, _: &'ast Attribute) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `rule: right → wrong` of the body of a function.
    fn of(body: &str) -> Vec<String> {
        let text = format!("fn f() {{ {body} }}");
        let shown = |candidate: Candidate| {
            format!("{}: {} → {}", candidate.rule, &text[candidate.range.clone()], candidate.wrong)
        };
        candidates("f.rs", &text).expect("Rust").into_iter().map(shown).collect()
    }

    #[test]
    fn each_rule_replaces_its_expressions() {
        for (body, expected) in [
            ("a + b", &["operator: a + b → a - b", "dropped term: a + b → a", "dropped term: a + b → b"][..]),
            ("a - b", &["operator: a - b → a + b", "dropped term: a - b → a"]),
            ("a / b", &["operator: a / b → a * b", "dropped term: a / b → a", "sign: a / b → -(a / b)"]),
            ("a += b;", &["operator: a += b → a -= b", "dropped term: a += b → ()"]),
            ("a < b", &["comparison: a < b → a <= b", "comparison: a < b → a > b"]),
            ("a == b", &["comparison: a == b → a != b"]),
            ("a || b", &["operator: a || b → (a) && (b)", "dropped term: a || b → a", "dropped term: a || b → b"]),
            ("-a", &["sign: -a → a"]),
            ("!a", &["sign: !a → a"]),
            ("0.0", &["constant: 0.0 → 1.0"]),
            ("1", &["constant: 1 → 0"]),
            ("0.5", &["constant: 0.5 → 2.0 * 0.5", "constant: 0.5 → 0.5 / 2.0"]),
            ("own::MOST", &["constant: own::MOST → own::MOST + own::MOST"]),
            ("a.max(b)", &["extremum: a.max(b) → a.min(b)", "dropped term: a.max(b) → a"]),
            ("a.abs()", &["dropped term: a.abs() → a"]),
            ("a[i][j]", &["index: i → j", "index: j → i"]),
            ("a[0]", &["index: 0 → 1"]),
            ("if a { b }", &["condition: a → !(a)"]),
            ("while a {}", &["condition: a → !(a)"]),
            ("vec![-a, b]", &["sign: -a → a"]),
        ] {
            assert_eq!(of(body), expected, "{body}");
        }
    }

    #[test]
    fn tests_assertions_constants_types_and_patterns_stay() {
        let text = "const A: f64 = 2.0 + 3.0; static B: [f64; 2] = [0.0; 2]; #[cfg(test)] mod tests { fn f() { 1 + 2; } }
            #[test] fn g() { 1 + 2; } const fn h() -> f64 { 2.0 * 3.0 } enum E { X = 3 }
            #[deprecated(note = \"1 + 2\")] fn k(a: [f64; 4]) -> Option<[u8; 5]> { assert!(a < 1); format!(\"{}\", 1 + 2); }
            fn l() { match a { 1 => f::<3>(), 2..=4 => g, _ => [b; 7] } if let Some(2) = a && b {} const { 1 + 2 }; F { AB } }";
        assert_eq!(candidates("f.rs", text).expect("Rust"), []);
        assert!(candidates("f.rs", "fn f( {").is_err());
    }

    #[test]
    fn a_candidate_becomes_a_record_whose_text_stands_once() {
        let text = "fn f() { let a = µ + b;\n let c = µ + b; }";
        let second = candidates("f.rs", text).expect("Rust").into_iter().rev().find(|one| one.rule == OPERATOR);
        let mutation = second.expect("a sum").mutation("drawn-7".to_owned(), text);
        assert_eq!(mutation.description, "f.rs:2: operator: µ + b → µ - b");
        let place = &mutation.places[0];
        assert_eq!((place.after.as_str(), place.text.as_str(), place.instead.as_str()), ("c = ", "µ + b", "µ - b"));
        assert_eq!(text.matches(&place.needle()).count(), 1);
    }
}
