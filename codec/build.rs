//! Generates the tables from the documents' YAML. A defect in the YAML ends the build with file,
//! line and column.

use std::path::PathBuf;
use std::{env, fs, io};

use actucheck_spec::{Spec, generate, load};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    let spec = match Spec::read(&load::embedded()) {
        Ok(spec) => spec,
        Err(defects) => {
            generate::report(&defects);
            return Ok(());
        }
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for module in generate::codec(&spec).map_err(io::Error::other)? {
        fs::write(out.join(module.name).with_extension("rs"), module.source)?;
    }
    Ok(())
}
