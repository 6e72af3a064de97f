//! The build without the engine: what it lacks, it says.
#![cfg(not(feature = "engine"))]

use std::process::Command;

#[test]
fn commands_of_the_engine_are_absent_with_a_clear_message() {
    let output = Command::new(env!("CARGO_BIN_EXE_claimcheck"))
        .args(["check", "x"])
        .output();
    let output = output.expect("the program starts");
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(
        message.contains("no command `check`") && message.contains("engine"),
        "{message}"
    );
}
