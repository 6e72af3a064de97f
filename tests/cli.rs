//! The program from outside: exit codes, what goes where, what a pipe sees.
#![cfg(feature = "engine")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

const RIGHT: &str = "\
# Right

```claim right-1
given  int k with k >= 2
says   1/(k-1) - 1/k == 1/(k*(k-1))
```

```claim right-2
given  real x > 0
says   ln(x^2) == 2*ln(x)
```
";

const WRONG: &str = "\
# Wrong

```claim wrong-1
given  int k with k >= 1
says   k^2 == 2*k
```
";

const PINNED: &str = "\
```claim pinned-1
given  int k with k >= 1
says   k/(k-1) == 1 + 1/(k-1) - 1/k
mend   k/(k-1) == 1 + 1/(k-1)
needs  k >= 2
expect printed refuted statement, mended certified
```
";

fn program() -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_claimcheck"));
    // Every test judges for itself; those of the cache give a folder for it.
    program.env_remove("XDG_CACHE_HOME").env_remove("HOME");
    program
}

/// A folder of this name with one chapter.
fn book(name: &str, chapter: &str) -> PathBuf {
    // In a folder of its own: certificates are looked for beside a book, too.
    let own = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("cli")
        .join(name);
    let folder = own.join("book");
    fs::create_dir_all(&folder).expect("the folder for temporary files is there");
    fs::write(folder.join("chapter.md"), chapter).expect("it can be written to");
    folder
}

struct Seen {
    code: Option<i32>,
    out: String,
    err: String,
}

fn see(output: Output) -> Seen {
    let text = |bytes| String::from_utf8(bytes).expect("output is UTF-8");
    let seen = Seen {
        code: output.status.code(),
        out: text(output.stdout),
        err: text(output.stderr),
    };
    assert!(
        !seen.out.contains('\u{1b}') && !seen.err.contains('\u{1b}'),
        "colours in a pipe"
    );
    assert!(!seen.err.contains("internal fault"), "{}", seen.err);
    seen
}

fn run(arguments: &[&str]) -> Seen {
    see(program()
        .args(arguments)
        .output()
        .expect("the program starts"))
}

fn check(folder: &Path, options: &[&str]) -> Seen {
    let output = program().arg("check").arg(folder).args(options).output();
    see(output.expect("the program starts"))
}

#[test]
fn help_is_no_error_and_no_command_is() {
    let help = run(&["--help"]);
    assert_eq!(help.code, Some(0));
    assert!(help.out.contains("check") && help.err.is_empty());
    let nothing = run(&[]);
    assert_eq!(nothing.code, Some(2));
    assert!(nothing.out.is_empty() && nothing.err.contains("Usage"));
    assert_eq!(run(&["check", "--jobs", "0"]).code, Some(2));
    assert_eq!(run(&["check", "--digits", "0"]).code, Some(2));
}

#[test]
fn a_book_that_is_right() {
    let seen = check(&book("right", RIGHT), &[]);
    assert_eq!(seen.code, Some(0), "{}{}", seen.out, seen.err);
    assert!(seen.out.contains("2 claims: 2 proved"), "{}", seen.out);
    assert!(
        seen.out.contains("all as expected (seed 1, 50 digits)"),
        "{}",
        seen.out
    );
    assert!(seen.err.is_empty(), "{}", seen.err);
    for line in seen.out.lines().filter(|line| !line.contains(".md")) {
        assert!(line.chars().count() <= 100, "{line}");
    }
}

#[test]
fn a_book_with_a_wrong_claim() {
    let folder = book("wrong", WRONG);
    let seen = check(&folder, &[]);
    assert_eq!(seen.code, Some(1));
    assert!(seen.out.contains("1 not as expected"), "{}", seen.out);
    assert!(
        seen.out.contains("k = 1"),
        "the smallest witness: {}",
        seen.out
    );
    let explained = see(program()
        .args(["explain", "wrong-1"])
        .arg(&folder)
        .output()
        .expect("starts"));
    assert_eq!(explained.code, Some(1));
    assert!(explained.out.contains("k^2 == 2*k"), "{}", explained.out);
}

#[test]
fn a_wrong_claim_that_is_expected() {
    let folder = book("pinned", PINNED);
    let seen = check(&folder, &[]);
    assert_eq!(seen.code, Some(0), "{}{}", seen.out, seen.err);
    let quiet = check(&folder, &["--quiet"]);
    assert!(!quiet.out.contains("pinned-1"), "{}", quiet.out);
    let sheet = see(program()
        .arg("errata")
        .arg(&folder)
        .output()
        .expect("starts"));
    assert_eq!(sheet.code, Some(0));
    assert!(
        sheet.out.contains("## Wrong statements\n\nEach fails")
            && sheet.out.contains("### pinned-1"),
        "{}",
        sheet.out
    );
    let latex = see(program()
        .args(["errata", "--format", "latex"])
        .arg(&folder)
        .output()
        .expect("starts"));
    assert!(latex.out.starts_with("\\documentclass"), "{}", latex.out);
}

/// The JSON of a run without its times, which are the only thing that may differ.
fn timeless(folder: &Path, options: &[&str]) -> serde_json::Value {
    let seen = check(folder, options);
    let mut value: serde_json::Value = serde_json::from_str(&seen.out).expect("is JSON");
    for claim in value["claims"].as_array_mut().expect("an array") {
        claim["seconds"] = 0.into();
    }
    value
}

#[test]
fn any_number_of_threads_gives_the_same_report() {
    let folder = book("threads", &[RIGHT, WRONG, PINNED].join("\n"));
    let one = timeless(&folder, &["--format", "json", "--jobs", "1"]);
    let many = timeless(&folder, &["--format", "json", "--jobs", "8"]);
    assert_eq!(one, many);
    assert_eq!(one["claims"].as_array().map(Vec::len), Some(4));
    assert_eq!(one["summary"]["not_as_expected"], 1);
}

#[test]
fn other_formats() {
    let folder = book("formats", &[RIGHT, WRONG].join("\n"));
    let junit = check(&folder, &["--format", "junit"]);
    assert!(
        junit.out.starts_with("<?xml") && junit.out.contains("failures=\"1\""),
        "{}",
        junit.out
    );
    let sarif = check(&folder, &["--format", "sarif"]);
    let value: serde_json::Value = serde_json::from_str(&sarif.out).expect("is JSON");
    assert_eq!(value["runs"][0]["results"][0]["ruleId"], "refuted");
}

#[test]
fn only_some_claims() {
    let folder = book("only", &[RIGHT, WRONG].join("\n"));
    assert_eq!(check(&folder, &["--only", "right-1,right-2"]).code, Some(0));
    let unknown = check(&folder, &["--only", "rigt-1"]);
    assert_eq!(unknown.code, Some(2));
    assert!(
        unknown.err.contains("did you mean `right-1`?"),
        "{}",
        unknown.err
    );
}

#[test]
fn without_a_book() {
    let nowhere = Path::new(env!("CARGO_TARGET_TMPDIR")).join("nowhere");
    fs::create_dir_all(&nowhere).expect("can be made");
    let seen = see(program()
        .arg("check")
        .current_dir(&nowhere)
        .output()
        .expect("starts"));
    assert_eq!(seen.code, Some(2));
    assert!(
        seen.err.contains("proofs") && seen.err.contains("help:"),
        "{}",
        seen.err
    );
    assert_eq!(
        check(&nowhere, &[]).code,
        Some(2),
        "a folder without claims"
    );
    let missing = check(&nowhere.join("missing.md"), &[]);
    assert_eq!(missing.code, Some(2));
    assert!(missing.err.contains("missing.md"), "{}", missing.err);
}

#[test]
fn errors_show_their_place() {
    let text = "# A\n\n```claim a\ngiven  int k\nsays   2k == 3\n```\n";
    let seen = check(&book("place", text), &[]);
    assert_eq!(seen.code, Some(2));
    assert!(seen.out.is_empty());
    for part in [
        "chapter.md:5:8",
        "says   2k == 3",
        "^^",
        "help: write `2*k`",
    ] {
        assert!(seen.err.contains(part), "no {part} in {}", seen.err);
    }
}

#[test]
fn bytes_that_are_no_text() {
    let folder = book("bytes", RIGHT);
    fs::write(folder.join("other.md"), [0xff, 0xfe, b'\n']).expect("can be written");
    let seen = check(&folder, &[]);
    assert_eq!(seen.code, Some(2));
    assert!(seen.err.contains("other.md"), "{}", seen.err);
}

#[test]
fn a_reader_who_leaves_early_is_no_fault() {
    let folder = book("pipe", RIGHT);
    let mut child = program()
        .args(["check", "--format", "json"])
        .arg(&folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    drop(child.stdout.take());
    let seen = see(child.wait_with_output().expect("the program ends"));
    assert_eq!(seen.code, Some(0));
    assert!(seen.err.is_empty(), "{}", seen.err);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .expect("Linux has it");
    let output = program()
        .arg("check")
        .arg(book("full", RIGHT))
        .stdout(full)
        .output();
    let seen = see(output.expect("the program starts"));
    assert_eq!(seen.code, Some(2));
    assert!(seen.err.contains("cannot be written"), "{}", seen.err);
}

#[test]
fn values_with_proved_digits() {
    let third = run(&["eval", "1/3", "--digits", "5"]);
    assert_eq!((third.code, &*third.out), (Some(0), "0.33333\n= 1/3\n"));
    let log = run(&["eval", "k*ln(k/(k-1))", "--set", "k=2", "--digits", "20"]);
    assert_eq!(
        (log.code, &*log.out),
        (Some(0), "1.3862943611198906188\n= 2*ln(2)\n")
    );
    let mean = run(&["eval", "mean(1/x)", "--draw", "x ~ beta(2, 3)"]);
    assert_eq!((mean.code, &*mean.out), (Some(0), "4\n"));
    let none = run(&["eval", "1/(k-1)", "--set", "k=1"]);
    assert_eq!((none.code, &*none.out), (Some(2), ""));
    assert!(
        none.err.contains("the divisor `k - 1` is 0"),
        "{}",
        none.err
    );
    let large = run(&["eval", "2^2^100"]);
    assert_eq!((large.code, &*large.out), (Some(1), ""));
    assert!(large.err.contains("too large"), "{}", large.err);
    let json = run(&["eval", "pi", "--digits", "3", "--format", "json"]);
    let value: serde_json::Value = serde_json::from_str(&json.out).expect("is JSON");
    assert_eq!(value["value"], "3.14");
}

#[test]
fn what_cannot_be_evaluated_is_told() {
    let unset = run(&["eval", "k + n", "--set", "k=2"]);
    assert_eq!(unset.code, Some(2));
    assert!(unset.err.contains("`n` has no value"), "{}", unset.err);
    assert_eq!(run(&["eval", "2k"]).code, Some(2));
    assert_eq!(run(&["eval", "k", "--set", "k"]).code, Some(2));
    assert_eq!(run(&["eval", "k", "--set", "k=n"]).code, Some(2));
    assert_eq!(run(&["eval", "k", "--draw", "k"]).code, Some(2));
    let huge = run(&["eval", "2^2^100"]);
    assert_eq!(huge.code, Some(1));
    assert!(huge.err.contains("cannot be told"), "{}", huge.err);
    let deep = "(".repeat(100_000);
    assert_eq!(run(&["eval", &deep]).code, Some(2));
}

#[test]
fn witnesses_are_replayed_by_the_kernel() {
    let folder = book("recheck", &[WRONG, PINNED].join("\n"));
    let report = check(&folder, &["--format", "json"]).out;
    let recheck = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).expect("can be written");
        see(program()
            .arg("recheck")
            .arg(&folder)
            .arg("--report")
            .arg(&path)
            .output()
            .expect("starts"))
    };
    let good = recheck("good.json", &report);
    assert_eq!(good.code, Some(0), "{}{}", good.out, good.err);
    assert!(
        good.out
            .contains("2 witnesses replayed by the kernel, 0 failed"),
        "{}",
        good.out
    );
    // At k = 2 the wrong claim holds: an altered witness is found out.
    let altered = recheck(
        "altered.json",
        &report.replace("\"k\": \"1\"", "\"k\": \"2\""),
    );
    assert_eq!(altered.code, Some(1), "{}", altered.out);
    let truncated = recheck("truncated.json", &report[..report.len() / 2]);
    assert_eq!(truncated.code, Some(2));
    assert!(truncated.err.contains("not a report"), "{}", truncated.err);
}

/// Runs a command on a book.
fn on(command: &str, folder: &Path, options: &[&str]) -> Seen {
    let output = program().arg(command).args(options).arg(folder).output();
    see(output.expect("the program starts"))
}

/// Both statements of the first claim are proved, the print of the second is refuted.
const CERTIFIED: &str = "\
```claim square
given  int k
says   (k + 1)^2 == k^2 + 2*k + 1
needs  k >= 0 sufficient
expect printed proved, mended proved
```

```claim twice
given  int k with k >= 1
says   k^2 == 2*k
expect refuted
```
";

#[test]
fn certificates_are_saved_and_rechecked() {
    let folder = book("certificates", CERTIFIED);
    let _ = fs::remove_dir_all(folder.join("certificates"));
    let missing = on("recheck", &folder, &[]);
    assert_eq!(missing.code, Some(1));
    assert!(
        missing
            .out
            .contains("chapter.md:1: square: expected printed proved"),
        "{}",
        missing.out
    );

    let first = check(&folder, &["--save"]);
    assert_eq!(first.code, Some(0), "{}{}", first.out, first.err);
    assert!(
        first.err.contains("2 written, 0 unchanged"),
        "{}",
        first.err
    );
    let second = check(&folder, &["--save", "--format", "json"]);
    assert!(
        second.err.contains("0 written, 2 unchanged"),
        "{}",
        second.err
    );
    let report: serde_json::Value = serde_json::from_str(&second.out).expect("is JSON");
    let printed = &report["claims"][0]["printed"];
    assert_eq!(printed["verdict"], "proved");
    assert_eq!(printed["certificate"], "certificates/square.proof");
    assert_eq!(printed["proved_links"], serde_json::json!([1]));

    let good = on("recheck", &folder, &[]);
    assert_eq!(good.code, Some(0), "{}{}", good.out, good.err);
    assert!(
        good.out.starts_with("2 theorems and 1 refutation"),
        "{}",
        good.out
    );
    assert_eq!(on("recheck", &folder.join("chapter.md"), &[]).code, Some(0));
}

#[test]
fn a_certificate_that_is_altered_is_found_out_and_renewed() {
    let folder = book("altered", CERTIFIED);
    let _ = fs::remove_dir_all(folder.join("certificates"));
    assert_eq!(check(&folder, &["--save"]).code, Some(0));
    let file = folder.join("certificates/square.proof");
    let right = fs::read_to_string(&file).expect("it is saved");
    let altered = [
        right.replace("2*k", "3*k"),
        right[..right.len() / 2].to_owned(),
        right.replace("(k + 1)^2 ==", "(1 + k)^2 =="),
        "((((".repeat(100_000),
        "theorem\n".repeat(600_000),
        String::new(),
    ];
    for text in altered {
        fs::write(&file, &text).expect("can be written");
        let seen = on("recheck", &folder, &[]);
        assert_eq!(seen.code, Some(1), "{}{}", seen.out, seen.err);
        assert!(seen.out.contains("square.proof:"), "{}", seen.out);
        let checked = check(&folder, &[]);
        assert_eq!(checked.code, Some(0), "{}{}", checked.out, checked.err);
        assert!(!checked.err.contains("written"), "{}", checked.err);
    }
    assert_eq!(check(&folder, &["--save"]).code, Some(0));
    assert_eq!(fs::read_to_string(&file).expect("it is saved"), right);
}

#[test]
fn the_folder_of_certificates_can_be_named() {
    let folder = book("named", CERTIFIED);
    let certificates = folder.join("elsewhere");
    let _ = fs::remove_dir_all(&certificates);
    let certificates = certificates.display().to_string();
    let options = ["--certificates", &certificates];
    let nowhere = on("recheck", &folder, &options);
    assert_eq!(nowhere.code, Some(2));
    assert!(nowhere.err.contains("check --save"), "{}", nowhere.err);
    assert_eq!(
        check(&folder, &["--save", options[0], options[1]]).code,
        Some(0)
    );
    assert_eq!(on("recheck", &folder, &options).code, Some(0));
    // A file in the place of the folder.
    let chapter = folder.join("chapter.md").display().to_string();
    let blocked = check(&folder, &["--save", "--certificates", &chapter]);
    assert_eq!(blocked.code, Some(2), "{}", blocked.err);
    assert!(blocked.err.contains("cannot be written"), "{}", blocked.err);
}

#[test]
fn a_proof_is_explained() {
    let folder = book("explained", CERTIFIED);
    let seen = see(program()
        .args(["explain", "square"])
        .arg(&folder)
        .output()
        .expect("starts"));
    assert_eq!(seen.code, Some(0), "{}{}", seen.out, seen.err);
    for part in [
        "Proof of the statement as printed",
        "Proof of the mended statement",
        "says (k + 1)^2 == k^2 + 2*k + 1",
        "Facts used",
    ] {
        assert!(seen.out.contains(part), "no {part} in {}", seen.out);
    }
    assert!(seen.out.lines().all(|line| line.chars().count() <= 100));
}

#[test]
fn the_report_is_one_page() {
    let chapter = PINNED.replace("says ", "why    <script>alert(1)</script>\nsays ");
    let folder = book("page", &chapter);
    let out = folder.join("report/of/it");
    let report = |out: &Path| {
        let mut program = program();
        program.arg("report").arg(&folder).arg("--out").arg(out);
        see(program.output().expect("starts"))
    };
    let seen = report(&out);
    assert_eq!(seen.code, Some(0), "{}", seen.err);
    assert_eq!(seen.out, format!("{}\n", out.join("index.html").display()));
    let page = fs::read_to_string(out.join("index.html")).expect("a page");
    assert!(page.starts_with("<!DOCTYPE html>") && page.ends_with("</html>\n"));
    assert!(
        page.contains("pinned-1") && !page.contains("<script"),
        "{page}"
    );
    let files = fs::read_dir(&out).expect("a folder").count();
    assert_eq!(files, 1, "no draft is left");
    let no_folder = report(&folder.join("chapter.md/report"));
    assert_eq!(no_folder.code, Some(2));
    assert!(no_folder.err.contains("chapter.md"), "{}", no_folder.err);
    assert!(no_folder.err.contains("--out"), "{}", no_folder.err);
}

/// The JSON of a check with this cache, and what was told.
fn cached(folder: &Path, cache: &Path, options: &[&str]) -> (serde_json::Value, String) {
    let mut program = program();
    program
        .env("XDG_CACHE_HOME", cache)
        .arg("check")
        .arg(folder);
    program.args(["--format", "json"]).args(options);
    let seen = see(program.output().expect("starts"));
    let value = serde_json::from_str(&seen.out).expect("is JSON");
    (value, seen.err)
}

#[test]
fn what_has_not_changed_is_not_judged_again() {
    let folder = book("cached", PINNED);
    let cache = folder.join("cache");
    let _ = fs::remove_dir_all(&cache);
    let entries = || {
        let programs = fs::read_dir(cache.join("claimcheck")).expect("a cache");
        let files = programs.flat_map(|p| fs::read_dir(p.expect("an entry").path()).expect("one"));
        files
            .map(|file| file.expect("an entry").path())
            .collect::<Vec<PathBuf>>()
    };
    let first = cached(&folder, &cache, &[]);
    assert!(first.1.is_empty(), "{}", first.1);
    assert_eq!(entries().len(), 1);
    // The times, too, are those of the first run.
    assert_eq!(cached(&folder, &cache, &[]), first);
    let anew = cached(&folder, &cache, &["--no-cache"]).0;
    assert_eq!(
        anew["claims"][0]["printed"],
        first.0["claims"][0]["printed"]
    );

    let entry = entries().remove(0);
    let text = fs::read_to_string(&entry).expect("it is there");
    fs::write(&entry, text.replace("refuted", "proved")).expect("can be written");
    let (rebuilt, told) = cached(&folder, &cache, &[]);
    assert_eq!(
        rebuilt["claims"][0]["printed"],
        first.0["claims"][0]["printed"]
    );
    assert!(told.contains("1 report damaged in the cache"), "{told}");
    assert!(cached(&folder, &cache, &[]).1.is_empty());

    let fewer = cached(&folder, &cache, &["--digits", "20"]).0;
    assert_eq!(fewer["digits"], 20);
    assert_eq!(entries().len(), 2);
    let right = "says   k/(k-1) == 1 + 1/(k-1)\n";
    let chapter = PINNED.replace("says   k/(k-1) == 1 + 1/(k-1) - 1/k\n", right);
    fs::write(folder.join("chapter.md"), chapter).expect("can be written");
    let changed = cached(&folder, &cache, &[]).0;
    assert_eq!(changed["claims"][0]["printed"]["verdict"], "proved");
    assert_eq!(entries().len(), 3);
}

#[test]
fn a_cache_that_cannot_be_written_is_no_error() {
    let folder = book("no-cache", RIGHT);
    let (value, told) = cached(&folder, &folder.join("chapter.md"), &[]);
    assert_eq!(value["summary"]["proved"], 2);
    assert_eq!(told, "note: 2 reports could not be kept in the cache\n");
    assert!(
        cached(&folder, &folder.join("chapter.md"), &["-q"])
            .1
            .is_empty()
    );
}

#[test]
fn a_probe_tells_holds_fails_and_bad_questions_apart() {
    let probe = |rest: &[&str]| run(&[&["probe"], rest].concat());
    let claim = "1 + 1/k^2 < E_k < 1 + 1/k";
    let seen = probe(&["--k", "4..1e4", "--claim", claim]);
    assert_eq!(seen.code, Some(0), "{}", seen.err);
    for line in [
        "layout triangular, k = 4..10000: 9997 of 9997 photons asked; 0 values needed more than doubles",
        "1 + 1/k^2 < E_k: holds for every k asked",
        "least margin of E_k < 1 + 1/k",
        "  k = 1000..9999                       6.98458e-7               near k = 9870",
        "  k = 10000..10000                     ",
    ] {
        assert!(seen.out.contains(line), "{line}\n{}", seen.out);
    }
    let seen = probe(&["--k", "1..10", "--claim", claim]);
    assert_eq!(seen.code, Some(1));
    let fails = "E_k < 1 + 1/k: fails at 1 photon: k = 3; E_k or Var_k infinite at 1 photon: k = 1";
    assert!(seen.out.contains(fails), "{}", seen.out);
    for (rest, told) in [
        (&["--k", "4..9"][..], "nothing is asked"),
        (&["--k", "9..4", "--quantity", "k"], "is no range"),
        (
            &["--k", "4..9", "--quantity", "E_j"],
            "the model has k, l, m",
        ),
        (&["--k", "4..9", "--quantity", "gamma(k)"], "a probe knows"),
        (&["--k", "4..9", "--claim", "E_k <"], "--claim"),
        (
            &["--k", "4..9", "--quantity", "k", "--shard", "1/2"],
            "--journal",
        ),
        (&["--merge", "nowhere"], "nowhere"),
    ] {
        let seen = probe(rest);
        assert_eq!(seen.code, Some(2), "{rest:?}");
        assert!(seen.err.contains(told), "{rest:?}: {}", seen.err);
    }
}

const DRAWN: &str = "\
```claim drawn-1
given  int l, m with 1 <= l <= m
draw   x ~ beta(l, m - l + 1)
says   mean(x) == l/(m + 1)
```

```claim drawn-2
given  int l, m with 1 <= l <= m
draw   x ~ beta(l, m - l + 1)
says   mean(x) == l/m
mend   mean(x) == l/(m + 1)
expect printed refuted, mended proved
```
";

#[test]
fn claims_are_simulated_from_their_draws() {
    let folder = book("drawn", DRAWN);
    let path = folder.to_str().expect("UTF-8");
    let seen = run(&["simulate", "drawn-1", path, "--runs", "20000"]);
    assert_eq!(seen.code, Some(0), "{}{}", seen.out, seen.err);
    assert!(
        seen.out.contains("agrees") && !seen.out.contains("contradicts\n  "),
        "{}",
        seen.out
    );
    let point = ["--set", "l=2,m=3"];
    let seen = run(&[&["simulate", "drawn-2", path], &point[..]].concat());
    assert_eq!(seen.code, Some(1));
    assert!(seen.out.contains("contradicts"), "{}", seen.out);
    for (point, told) in [
        ("l=2", "`m`"),
        ("l=3,m=2", "outside"),
        ("l=1,m=2,q=1", "`q`"),
    ] {
        let seen = run(&["simulate", "drawn-1", path, "--set", point]);
        assert_eq!(seen.code, Some(2));
        assert!(seen.err.contains(told), "{}", seen.err);
    }
    let seen = run(&["check", path, "--simulate", "--format", "json"]);
    assert_eq!(seen.code, Some(0), "{}", seen.err);
    let value: serde_json::Value = serde_json::from_str(&seen.out).expect("JSON");
    assert!(value["claims"][0]["printed"]["simulation"]["z"].is_f64());
    assert!(value["claims"][1]["printed"]["simulation"].is_null());
    assert!(value["claims"][1]["mended"]["simulation"]["runs"].is_u64());
}

#[test]
fn photons_are_simulated_and_faults_are_found() {
    let simulate = |rest: &[&str]| {
        let scene = ["simulate", "--photons", "300", "--runs", "2000", "--quiet"];
        run(&[&scene[..], rest].concat())
    };
    for strategy in ["none", "1", "2", "listing", "100,1,199"] {
        for rest in [&[][..], &["--dim", "3"], &["--mode", "sorted"]] {
            let seen = simulate(&[&["--strategy", strategy], rest].concat());
            assert_eq!(seen.code, Some(0), "{strategy}: {}{}", seen.out, seen.err);
            assert!(seen.out.contains("simulation and theory agree"));
        }
    }
    let seen = simulate(&["--fault", "estimator"]);
    assert_eq!(seen.code, Some(1));
    assert!(seen.out.contains("CONTRADICT") && seen.out.contains("ON PURPOSE"));
    let seen = simulate(&["--law", "5,150", "--fault", "unsorted"]);
    assert!(
        seen.out.contains("law of U at k = 5: CONTRADICTS"),
        "{}",
        seen.out
    );
    for (rest, told) in [
        (&["--strategy", "7,x"][..], "is no strategy"),
        (&["--dim", "0"], "dimension 0"),
        (&["--k", "301"], "photon 301"),
        (&["--level", "2"], "between 0 and 1"),
        (&["--until", "1e-3"], "--k"),
        (&["--mode", "beta", "--fault", "unsorted"], "mode sorted"),
    ] {
        let seen = simulate(rest);
        assert_eq!(seen.code, Some(2), "{rest:?}: {}", seen.out);
        assert!(seen.err.contains(told), "{rest:?}: {}", seen.err);
    }
}

#[test]
fn a_simulation_is_the_same_bytes_for_any_number_of_threads() {
    let folder = book("same-bytes", RIGHT);
    let simulated = |jobs: &str, name: &str| {
        let csv = folder.join(name);
        let path = csv.to_str().expect("UTF-8");
        let scene = ["simulate", "--photons", "5050", "--runs", "5000", "-q"];
        let seen = run(&[&scene[..], &["--jobs", jobs, "--csv", path]].concat());
        assert_eq!(seen.code, Some(0), "{}", seen.err);
        fs::read(csv).expect("written")
    };
    assert_eq!(simulated("1", "one.csv"), simulated("2", "two.csv"));
}
