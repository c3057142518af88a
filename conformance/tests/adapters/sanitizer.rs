//! A library in C that writes past the end of its buffer, built with `AddressSanitizer`.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::libraries::C_LIBRARY;
use super::templates::{compile, template, there_is};

/// Takes a quarter more for enough. It is a byte short for a body of little but patterns.
const C_STUFFING: &str = r#"
static void crc(const char *request)
{
    size_t count;
    unsigned char *data = bytes(field(request, "bytes"), &count);
    ok("{\"crc\":%u}", my_library_crc(data, count));
    free(data);
}

static void stuff(const char *request)
{
    size_t count, i, length = 0;
    unsigned char *data = bytes(field(request, "bytes"), &count);
    unsigned char *stuffed = malloc(count + count / 4);
    char *text;
    for (i = 0; i < count; i++) {
        stuffed[length++] = data[i];
        if (i >= 2 && data[i - 2] == 0xFF && data[i - 1] == 0xFF && data[i] == 0xFD)
            stuffed[length++] = 0xFD;
    }
    text = hex(stuffed, length);
    ok("{\"bytes\":\"%s\"}", text);
    free(text);
    free(stuffed);
    free(data);
}
"#;

/// How many checks have a body with more patterns than a quarter of its bytes: those of one pattern,
/// of two, and of two and another byte.
const OVERFLOWS: u64 = 16;

#[test]
fn each_overflow_is_a_finding_and_the_rest_is_judged() {
    const FLAGS: [&str; 3] = ["-std=c99", "-g", "-fsanitize=address"];
    let folder = tempfile::tempdir().unwrap();
    if !there_is("cc") || !can_sanitize(folder.path()) {
        return;
    }
    let library = [C_LIBRARY, C_STUFFING, "\nstatic const struct op"].concat();
    let text = template("c").replace("\nstatic const struct op", &library);
    let text = text.replace("OPS[] = {", "OPS[] = {\n    {\"crc\", crc},\n    {\"stuff\", stuff},");
    compile(folder.path(), "cc", &FLAGS, "adapter.c", &text);

    let report = folder.path().join("report.json");
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["codec", "--timeout", "10", "--select", "*/stuff", "--select", "*/crc"])
        .args(["--wire", "dynamixel2", "-v", "--report=text=-"])
        .arg(format!("--report=json={}", report.display()))
        .arg("--")
        .arg(folder.path().join("adapter"))
        .output()
        .unwrap();
    let printed = String::from_utf8([output.stdout, output.stderr].concat()).unwrap();
    assert_eq!(output.status.code(), Some(1), "{printed}");
    let report: Value = serde_json::from_slice(&std::fs::read(report).unwrap()).unwrap();
    let good = ["pass", "recorded"].map(|verdict| report["totals"][verdict].as_u64().unwrap());
    let all: u64 = report["totals"].as_object().unwrap().values().filter_map(Value::as_u64).sum();
    assert!(all > 2000, "{}", report["totals"]);
    assert_eq!(report["totals"]["crash"], OVERFLOWS, "{}", report["totals"]);
    assert_eq!(good.iter().sum::<u64>(), all - OVERFLOWS, "{}", report["totals"]);
    assert!(printed.contains("AddressSanitizer: heap-buffer-overflow"), "{printed}");
}

/// Whether the compiler's sanitizer is installed too, which is a package of its own.
fn can_sanitize(folder: &Path) -> bool {
    std::fs::write(folder.join("empty.c"), "int main(void) { return 0; }\n").unwrap();
    let built = Command::new("cc")
        .args(["-fsanitize=address", "-o", "empty", "empty.c"])
        .current_dir(folder)
        .output()
        .unwrap();
    let can = built.status.success();
    if !can {
        eprintln!("SKIPPED: cc has no AddressSanitizer");
    }
    can
}
