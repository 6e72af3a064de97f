//! The build without the engine: what it lacks, it says; what is saved, it replays and explains.
#![cfg(not(feature = "engine"))]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn run(arguments: &[&str], path: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_claimcheck"))
        .args(arguments)
        .arg(path)
        .output()
        .expect("the program starts")
}

#[test]
fn commands_of_the_engine_are_absent_with_a_clear_message() {
    let output = run(&["check"], Path::new("x"));
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("no command `check`") && message.contains("engine"),
        "{message}"
    );
}

const CHAPTER: &str = "\
```claim square
given  int k
says   (k + 1)^2 == k^2 + 2*k + 1
expect proved
```

```claim open
given  int k
says   k == k + 0
```
";

const PROOF: &str = "\
theorem
given int k
says (k + 1)^2 == k^2 + 2*k + 1
example k = 1
proof
1: (k + 1)^2 == k^2 + 2*k + 1 | ring
qed 1
";

/// A book with this certificate of its first claim.
fn book(name: &str, certificate: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("certificates")).expect("can be made");
    fs::write(folder.join("chapter.md"), CHAPTER).expect("can be written");
    let file = folder.join("certificates/square.proof");
    fs::write(file, certificate).expect("can be written");
    folder
}

#[test]
fn certificates_are_replayed_and_explained() {
    let folder = book("pure", PROOF);
    assert_eq!(run(&["recheck"], &folder).status.code(), Some(0));
    let explained = run(&["explain", "square"], &folder);
    assert_eq!(explained.status.code(), Some(0));
    let text = String::from_utf8_lossy(&explained.stdout);
    assert!(text.contains("Proof of the statement as printed"), "{text}");
    let open = run(&["explain", "open"], &folder);
    assert_eq!(open.status.code(), Some(1));
    let message = String::from_utf8_lossy(&open.stderr);
    assert!(message.contains("open.proof"), "{message}");
}

#[test]
fn a_broken_certificate_is_told_with_its_place() {
    let folder = book("pure-broken", &PROOF.replace("2*k", "3*k"));
    for command in [&["recheck"][..], &["explain", "square"]] {
        let output = run(command, &folder);
        assert_eq!(output.status.code(), Some(1));
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8_lossy(&told);
        assert!(told.contains("square.proof:6: "), "{told}");
    }
}
