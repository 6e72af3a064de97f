//! Reports of earlier runs, so that a claim that has not changed need not be judged again.
//!
//! A report is kept under the hash of all that it depends on: the claim and its statements unfolded,
//! the link to the claim that its `after` names, its certificates, the settings. The folder is the
//! hash of the running program, so no program sees what another one found. The hash proves nothing
//! and is proof against accidents only; who may write into the user's cache may change the program
//! as well. Nothing rests on the cache: a run without it says the same.
//!
//! Each entry is a file that is written whole as its claim is done, so a killed run loses none that
//! is finished, and runs beside each other do not disturb one another. It opens with a checksum: an
//! entry that was cut or altered is noticed, counted and judged anew.

use super::certificates::{Store, text};
use super::file::replace;
use crate::book::{Claim, IllTyped};
use crate::formula::Proposition;
use crate::judge::{Report, Settings};
use std::fs::{self, File};
use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The entries of so many programs are kept, those in use longest ago are removed first.
const MOST_PROGRAMS: usize = 4;
/// A program that has more entries starts again with none; and no run adds more.
pub const MOST_ENTRIES: usize = 10_000;

/// The entries of the running program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cache {
    folder: PathBuf,
}

/// What a look into the cache gave.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    Report(Box<Report>),
    Nothing,
    /// There is an entry, but not as it was written.
    Damaged,
}

impl Cache {
    /// The cache of the user, `$XDG_CACHE_HOME/claimcheck` or `~/.cache/claimcheck`; none without a
    /// home, or where the program cannot be read.
    pub fn of_user() -> Option<Cache> {
        let absolute = |name: &str| {
            let path = std::env::var_os(name).map(PathBuf::from);
            path.filter(|path| path.is_absolute())
        };
        let caches = absolute("XDG_CACHE_HOME").or_else(|| Some(absolute("HOME")?.join(".cache")));
        Cache::within(&caches?.join("claimcheck")).ok()
    }

    /// A cache in this folder, which need not be there yet. What is too much in it is removed.
    ///
    /// # Errors
    /// Those of reading the program's own file.
    pub fn within(folder: &Path) -> io::Result<Cache> {
        let program = program()?;
        let own = folder.join(&program);
        tidy(folder, &own);
        Ok(Cache { folder: own })
    }

    /// The entry for the report on a claim, whether it is there or not.
    pub fn entry(
        &self,
        claim: &Claim,
        previous: Option<&Claim>,
        store: Option<&Store>,
        settings: &Settings,
    ) -> Entry {
        let canonical = |statement: Result<Proposition, IllTyped>| match statement {
            Ok(proposition) => Ok(proposition.to_string()),
            Err(illtyped) => Err(illtyped.to_string()),
        };
        let link = previous.and_then(|previous| {
            let link = claim.link(previous)?;
            Some((&previous.id, link.to_string()))
        });
        let needs = claim.needs.as_ref();
        // Debug text tells apart what is different: strings are quoted in it.
        let statements = (
            canonical(claim.printed()),
            claim.mended().map(canonical),
            link,
            &claim.says_text,
            &claim.mend_text,
            needs.map(|needs| (&needs.text, needs.sufficient)),
        );
        let words = (
            &claim.id,
            &claim.page,
            &claim.quote,
            &claim.slip,
            &claim.scan,
            &claim.like,
            &claim.why,
            &claim.expect_text,
        );
        let certificates = store.map(|store| (store.shown(claim), text(&store.path(claim))));
        let all = format!("{statements:?}\n{words:?}\n{certificates:?}\n{settings:?}");
        let mut digest = Digest::new();
        digest.write(all.as_bytes());
        Entry(self.folder.join(digest.hex()))
    }
}

/// The file of a report that is kept, or is to be.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry(PathBuf);

impl Entry {
    /// The report, now of the claim at its present place. Its evidence is not kept.
    pub fn read(&self, claim: &Claim) -> Found {
        // What cannot be read is as good as not there; what cannot be replaced either is told then.
        let entry = match text(&self.0) {
            Ok(Some(entry)) => entry,
            Err(_) if self.0.is_file() => return Found::Damaged,
            Ok(None) | Err(_) => return Found::Nothing,
        };
        let Some(mut report) = self.unsealed(&entry) else {
            return Found::Damaged;
        };
        report.file = claim.file.display().to_string();
        report.line = claim.line;
        Found::Report(Box::new(report))
    }

    /// Keeps a report.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn write(&self, report: &Report) -> io::Result<()> {
        let json = serde_json::to_string(report)?;
        replace(&self.0, &format!("{}\n{json}", self.checksum(&json)))
    }

    fn unsealed(&self, entry: &str) -> Option<Report> {
        let (checksum, json) = entry.split_once('\n')?;
        match checksum == self.checksum(json) {
            true => serde_json::from_str(json).ok(),
            false => None,
        }
    }

    /// Of the entry's name too: in the place of another it is damaged.
    fn checksum(&self, json: &str) -> String {
        let mut digest = Digest::new();
        let name = self.0.file_name().unwrap_or_default();
        digest.write(name.as_encoded_bytes());
        digest.write(json.as_bytes());
        digest.hex()
    }
}

/// 128 bits: the hash of the standard library twice, with different beginnings. It may be another one
/// in another version of the compiler, but then so is the program.
struct Digest([DefaultHasher; 2]);

impl Digest {
    fn new() -> Digest {
        let mut second = DefaultHasher::new();
        second.write_u8(1);
        Digest([DefaultHasher::new(), second])
    }

    fn write(&mut self, bytes: &[u8]) {
        for hasher in &mut self.0 {
            hasher.write(bytes);
        }
    }

    fn hex(&self) -> String {
        let [first, second] = &self.0;
        format!("{:016x}{:016x}", first.finish(), second.finish())
    }
}

/// The hash of the running program.
fn program() -> io::Result<String> {
    // On Linux this is the file that runs, even if another one has taken its place since.
    let running = File::open("/proc/self/exe");
    let mut file = running.or_else(|_| File::open(std::env::current_exe()?))?;
    let mut digest = Digest::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(digest.hex()),
            count => digest.write(&buffer[..count]),
        }
    }
}

/// Removes the entries of programs that were used longest ago, and those of this one where there are
/// too many. What cannot be removed stays: it does no harm.
fn tidy(folder: &Path, own: &Path) {
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let hex = name.len() == 32 && name.bytes().all(|byte| byte.is_ascii_hexdigit());
        hex && path != own && path.is_dir()
    };
    let age = |path: &PathBuf| {
        let used = fs::metadata(path).and_then(|data| data.modified());
        used.unwrap_or(SystemTime::UNIX_EPOCH)
    };
    let mut others: Vec<PathBuf> = paths(folder).filter(is_ours).collect();
    others.sort_by_key(age);
    let too_many = (others.len() + 1).saturating_sub(MOST_PROGRAMS);
    for other in &others[..too_many] {
        let _ = fs::remove_dir_all(other);
    }
    if paths(own).count() > MOST_ENTRIES {
        let _ = fs::remove_dir_all(own);
    }
}

/// What is in a folder; nothing, if it is not there.
fn paths(folder: &Path) -> impl Iterator<Item = PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    entries.filter_map(|entry| Some(entry.ok()?.path()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::{Book, read_text};
    use crate::judge::judge;

    const BOOK: &str = "\
```claim a
given  int k with k >= 1
says   k^2 == 2*k
mend   k^2 == k*k
expect printed refuted, mended proved
```

```claim b
given  int k with k >= 1
after  a
says   2*k == k + k == k
why    it goes on
```
";

    fn book(text: &str) -> Book {
        read_text("chapter.md", text).expect("a book")
    }

    /// An empty cache, and the folder it is in.
    fn cache(name: &str) -> (Cache, PathBuf) {
        let name = format!("claimcheck-cache-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let _ = fs::remove_dir_all(&folder);
        (
            Cache::within(&folder).expect("the program is there"),
            folder,
        )
    }

    fn entry_of(cache: &Cache, text: &str, id: &str, settings: &Settings) -> Entry {
        let book = book(text);
        let claims = book.by_id();
        let previous = claims[id].after.as_ref().map(|id| claims[&**id]);
        cache.entry(claims[id], previous, None, settings)
    }

    #[test]
    fn a_report_comes_back_as_it_was() {
        let (cache, folder) = cache("same");
        let settings = Settings::default();
        let book = book(BOOK);
        for claim in &book.claims {
            let entry = cache.entry(claim, None, None, &settings);
            assert_eq!(entry.read(claim), Found::Nothing);
            let mut report = judge(claim, None, &settings);
            entry.write(&report).expect("can be written");
            report.printed.evidence = None;
            if let Some(mended) = &mut report.mended {
                mended.evidence = None;
            }
            let found = Found::Report(Box::new(report));
            assert_eq!(entry.read(claim), found);
        }
        fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn a_claim_that_has_only_moved_is_the_same() {
        let (cache, _) = cache("moved");
        let settings = Settings::default();
        let entry = |text: &str| entry_of(&cache, text, "b", &settings);
        let moved = format!("# A title\n\n{BOOK}");
        assert_eq!(entry(BOOK), entry(&moved));
        let other = book(&moved);
        let claim = &other.claims[0];
        let entry = cache.entry(claim, None, None, &settings);
        let report = judge(&book(BOOK).claims[0], None, &settings);
        entry.write(&report).expect("can be written");
        let Found::Report(found) = entry.read(claim) else {
            panic!("it is there");
        };
        assert_eq!((report.line, found.line), (1, 3));
        fs::remove_dir_all(cache.folder.parent().expect("a folder")).expect("it is there");
    }

    #[test]
    fn whatever_a_report_depends_on_changes_its_name() {
        let (cache, _) = cache("keys");
        let usual = Settings::default();
        let kept = entry_of(&cache, BOOK, "b", &usual);
        let changes = [
            ("k >= 1\nafter", "k >= 2\nafter"),
            ("== k\n", "== k + 0\n"),
            ("says   k^2 == 2*k\n", "says   k^2 == k*2\n"),
            ("it goes on", "it goes  further"),
            ("why ", "slip"),
            ("why ", "scan"),
            ("why    it goes on\n", "why    it goes on\npage 22\n"),
            ("why    it goes on\n", "why    it goes on\nquote 22\n"),
            ("why    it goes on\n", "why    it goes on\nlike a\n"),
            ("why    it goes on\n", "why    it goes on\nexpect refuted\n"),
            ("why    it goes on\n", "why    it goes on\nmend 1 == 1\n"),
            ("why    it goes on\n", "why    it goes on\nneeds k == 1\n"),
        ];
        for (old, new) in changes {
            let changed = BOOK.replacen(old, new, 1);
            assert_ne!(changed, BOOK, "{old}");
            assert_ne!(entry_of(&cache, &changed, "b", &usual), kept, "{new}");
        }
        let others = [
            Settings { seed: 2, ..usual },
            Settings {
                digits: 40,
                ..usual
            },
            Settings { budget: 7, ..usual },
            Settings { points: 7, ..usual },
        ];
        for other in others {
            assert_ne!(entry_of(&cache, BOOK, "b", &other), kept, "{other:?}");
        }
        let book = book(BOOK);
        let claim = &book.claims[0];
        let folder = std::env::temp_dir().join(format!("claimcheck-kept-{}", std::process::id()));
        let store = Store::at(&folder);
        let entry = || cache.entry(claim, None, Some(&store), &usual);
        let before = entry();
        replace(&store.path(claim), "theorem\n").expect("can be written");
        assert_ne!(entry(), before, "a certificate");
        fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn an_entry_that_was_altered_is_noticed() {
        let (cache, folder) = cache("damaged");
        let book = book(BOOK);
        let claim = &book.claims[0];
        let settings = Settings::default();
        let entry = cache.entry(claim, None, None, &settings);
        entry
            .write(&judge(claim, None, &settings))
            .expect("can be written");
        let whole = fs::read_to_string(&entry.0).expect("it is there");
        let altered = [
            String::new(),
            whole[..whole.len() - 1].to_owned(),
            whole[..20].to_owned(),
            whole.replacen("refuted", "proved", 1),
            whole.replacen("\"k\":\"1\"", "\"k\":\"2\"", 1),
            format!("{whole} "),
            "{}".to_owned(),
        ];
        for text in altered {
            assert_ne!(text, whole);
            fs::write(&entry.0, &text).expect("can be written");
            assert_eq!(entry.read(claim), Found::Damaged, "{text}");
        }
        // The entry of another claim, whole.
        let other = cache.entry(&book.claims[1], None, None, &settings);
        fs::write(&other.0, &whole).expect("can be written");
        assert_eq!(other.read(&book.claims[1]), Found::Damaged);
        fs::write(&entry.0, b"\xff\n").expect("can be written");
        assert_eq!(entry.read(claim), Found::Damaged);
        fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn the_entries_of_many_programs_are_not_kept() {
        let (cache, folder) = cache("bound");
        for program in 0..9 {
            let other = folder.join(format!("{program:032x}"));
            fs::create_dir_all(&other).expect("can be made");
        }
        fs::create_dir_all(folder.join("not-ours")).expect("can be made");
        fs::create_dir_all(&cache.folder).expect("can be made");
        Cache::within(&folder).expect("the program is there");
        // This one's, three of others, and what is not ours.
        assert_eq!(paths(&folder).count(), MOST_PROGRAMS + 1);
        assert!(cache.folder.is_dir() && folder.join("not-ours").is_dir());
        fs::remove_dir_all(&folder).expect("it is there");
    }
}
