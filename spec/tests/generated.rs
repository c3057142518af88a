//! The generated module of one device, kept in the tree for readers.

use actucheck_spec::{Spec, generate};

#[test]
fn the_ja40_module_is_the_one_in_the_tree() {
    let spec = Spec::embedded().expect("the spec is free of defects");
    let device = spec.device("ja40").expect("the JA40 is there");
    let module = generate::device(&spec, device).expect("its names are Rust names");
    insta::assert_snapshot!("ja40", module.source);
}
