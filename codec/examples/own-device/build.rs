//! Turns `gripper.yaml` into the module `gripper`. A defect in it ends the build, with line and
//! column.

fn main() -> std::io::Result<()> {
    actucheck_spec::generate::build_script("gripper.yaml")
}
