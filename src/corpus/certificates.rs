//! The certificates of a book on disk: one file a claim, `ID.proof`.
//!
//! The folder is `certificates` in the folder of the book, or beside the file of a chapter, or
//! beside the folder of that. An id is letters, digits, `.` and `-`, so it is safe as the name of a file.

use super::file::replace;
use crate::book::Claim;
use crate::kernel::proof::{Certificate, Flaw, parse};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The folder's name.
const FOLDER: &str = "certificates";
/// How a certificate's file name ends.
const ENDING: &str = "proof";
/// No longer file is read; the longest of a thesis is a small part of it.
const MOST_BYTES: u64 = 4 << 20;

/// Where the certificates of some chapters are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Store {
    shelves: Vec<Shelf>,
}

/// The folder for the claims of one path of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Shelf {
    book: PathBuf,
    folder: PathBuf,
    /// The folder as reports name it.
    shown: PathBuf,
}

impl Store {
    /// The certificates beside chapters: in the folder of the path itself, or else beside that folder, for
    /// a chapter or some of them in a folder of a book. Where there are none yet they belong into the first.
    pub fn beside(paths: &[PathBuf]) -> Store {
        let shelf = |path: &PathBuf| {
            let home = match path.is_dir() {
                true => path,
                false => path.parent().unwrap_or(path),
            };
            let own = home.join(FOLDER);
            let around = home.parent().map(|book| book.join(FOLDER));
            let around = around.filter(|around| !own.is_dir() && around.is_dir());
            Shelf {
                book: path.clone(),
                folder: around.unwrap_or(own),
                shown: FOLDER.into(),
            }
        };
        Store {
            shelves: paths.iter().map(shelf).collect(),
        }
    }

    /// All certificates in one folder.
    pub fn at(folder: &Path) -> Store {
        Store {
            shelves: vec![Shelf {
                book: PathBuf::new(),
                folder: folder.to_path_buf(),
                shown: folder.to_path_buf(),
            }],
        }
    }

    /// The folders, each once.
    pub fn folders(&self) -> Vec<&Path> {
        let mut folders: Vec<&Path> = self.shelves.iter().map(|shelf| &*shelf.folder).collect();
        folders.sort();
        folders.dedup();
        folders
    }

    /// The file for a claim's certificates, whether it is there or not.
    pub fn path(&self, claim: &Claim) -> PathBuf {
        self.shelf(claim).map_or_else(PathBuf::new, |shelf| {
            shelf.folder.join(file_name(&claim.id))
        })
    }

    /// The same file as reports name it: relative to the book.
    pub fn shown(&self, claim: &Claim) -> String {
        let path = self
            .shelf(claim)
            .map(|shelf| shelf.shown.join(file_name(&claim.id)));
        path.unwrap_or_default().display().to_string()
    }

    /// The shelf of the most particular path that the claim is under.
    fn shelf(&self, claim: &Claim) -> Option<&Shelf> {
        let shelves = self.shelves.iter();
        let of_claim = shelves.filter(|shelf| claim.file.starts_with(&shelf.book));
        of_claim.max_by_key(|shelf| shelf.book.components().count())
    }

    /// The certificates of a claim, not checked; none where there is no file.
    ///
    /// # Errors
    /// A [`Flaw`] of the file or of its notation.
    pub fn read(&self, claim: &Claim) -> Result<Vec<Certificate>, Flaw> {
        match text(&self.path(claim))? {
            Some(text) => parse(&text),
            None => Ok(Vec::new()),
        }
    }

    /// Writes the certificates of a claim; tells whether that changed the file.
    ///
    /// # Errors
    /// Those of the file system; the old file is then as it was.
    pub fn write(&self, claim: &Claim, certificates: &[Certificate]) -> io::Result<bool> {
        let path = self.path(claim);
        let texts: Vec<String> = certificates.iter().map(ToString::to_string).collect();
        let new = texts.join("\n");
        if text(&path).is_ok_and(|old| old.as_deref() == Some(&*new)) {
            return Ok(false);
        }
        replace(&path, &new)?;
        Ok(true)
    }

    /// The files of certificates that are there, sorted.
    ///
    /// # Errors
    /// Those of the file system; a folder that is not there has no files.
    pub fn files(&self) -> io::Result<Vec<PathBuf>> {
        let mut files = Vec::new();
        for folder in self.folders() {
            let entries = match fs::read_dir(folder) {
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                entries => entries?,
            };
            for entry in entries {
                let path = entry?.path();
                if path.extension().is_some_and(|ending| ending == ENDING) {
                    files.push(path);
                }
            }
        }
        files.sort();
        Ok(files)
    }
}

fn file_name(id: &str) -> String {
    format!("{id}.{ENDING}")
}

/// The text of a certificate's file; none where it is not there.
///
/// # Errors
/// A [`Flaw`] for what is no text, too long or not to be read.
pub fn text(path: &Path) -> Result<Option<String>, Flaw> {
    let flaw = |line, message: &str| {
        let message = message.to_owned();
        Err(Flaw { line, message })
    };
    match bytes(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => flaw(1, &format!("the certificate cannot be read: {error}")),
        Ok(bytes) if bytes.len() as u64 > MOST_BYTES => flaw(1, "the certificate is too long"),
        Ok(bytes) => match String::from_utf8(bytes) {
            Ok(text) => Ok(Some(text)),
            Err(error) => {
                let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
                let line = 1 + valid.iter().filter(|byte| **byte == b'\n').count();
                flaw(line, "the certificate is not UTF-8 text")
            }
        },
    }
}

/// The bytes of a file, at most one more than a certificate may have. What is no file (a pipe would
/// never end) is not opened.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("this is no file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?
        .take(MOST_BYTES + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::{Book, read_text};

    const BOOK: &str = "```claim a-1\ngiven int k\nsays (k + 1)^2 == k^2 + 2*k + 1\n```\n";
    const THEOREM: &str = "theorem\ngiven int k\nsays (k + 1)^2 == k^2 + 2*k + 1\nexample k = 1\n\
        proof\n1: (k + 1)^2 == k^2 + 2*k + 1 | ring\nqed 1\n";

    fn book() -> Book {
        read_text("proofs/chapter.md", BOOK).expect("a book")
    }

    /// An empty folder of this name.
    fn store(name: &str) -> (Store, PathBuf) {
        let folder = std::env::temp_dir().join(format!("claimcheck-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        (Store::at(&folder), folder)
    }

    #[test]
    fn what_is_written_is_read_and_only_written_when_it_changes() {
        let (store, folder) = store("round-trip");
        let book = book();
        let claim = &book.claims[0];
        assert_eq!(store.read(claim), Ok(Vec::new()));
        assert_eq!(store.files().expect("no folder, no files").len(), 0);
        let certificates = parse(THEOREM).expect("a certificate");
        assert!(store.write(claim, &certificates).expect("written"));
        assert!(!store.write(claim, &certificates).expect("unchanged"));
        assert_eq!(store.read(claim), Ok(certificates));
        assert_eq!(store.files().expect("a folder"), [folder.join("a-1.proof")]);
        fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn what_is_no_certificate_is_told_with_its_line() {
        let (store, folder) = store("bad");
        let book = book();
        let (claim, path) = (&book.claims[0], store.path(&book.claims[0]));
        fs::create_dir_all(&folder).expect("can be made");
        let long = "\n".repeat((4 << 20) + 1);
        let cases: [(&[u8], usize, &str); 5] = [
            (b"theorem\n\xff\n", 2, "UTF-8"),
            (long.as_bytes(), 1, "too long"),
            (b"", 0, "no certificate"),
            (&THEOREM.as_bytes()[..THEOREM.len() - 6], 6, "qed"),
            (b"\0\0\0", 1, "expected"),
        ];
        for (bytes, line, message) in cases {
            fs::write(&path, bytes).expect("can be written");
            let flaw = store.read(claim).expect_err("no certificate");
            assert_eq!(flaw.line, line, "{flaw}");
            assert!(flaw.message.contains(message), "{flaw}");
        }
        fs::remove_file(&path).expect("it is there");
        fs::create_dir(&path).expect("can be made");
        assert!(store.read(claim).is_err(), "a folder");
        fs::remove_dir_all(&folder).expect("it is there");
    }

    #[test]
    fn the_folder_is_in_the_book_or_beside_the_chapter() {
        let book = book();
        let path = |paths: &[&str]| {
            let paths: Vec<PathBuf> = paths.iter().map(PathBuf::from).collect();
            Store::beside(&paths).path(&book.claims[0])
        };
        let beside = Path::new("proofs/certificates/a-1.proof");
        assert_eq!(path(&["other", "proofs/chapter.md"]), beside);
        // The folder `proofs` of this repository.
        assert_eq!(path(&["proofs"]), beside);
        for around in ["proofs/thesis/chapter.md", "proofs/thesis"] {
            let around = Store::beside(&[around.into()]);
            assert_eq!(around.folders(), [Path::new("proofs/certificates")]);
        }
        assert_eq!(
            Store::beside(&["proofs".into()]).shown(&book.claims[0]),
            "certificates/a-1.proof"
        );
    }
}
