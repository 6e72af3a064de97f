//! Finding chapters and loading their texts.

use super::FileError;
use crate::formula::{Diagnostic, Span};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn unreadable(path: &Path, text: Arc<str>, message: String) -> FileError {
    let end = text.len();
    FileError {
        file: path.to_path_buf(),
        text,
        diagnostic: Diagnostic {
            span: Span { start: end, end },
            message,
            hint: None,
        },
    }
}

/// The files of a path, sorted.
pub(super) fn chapters(path: &Path, files: &mut Vec<PathBuf>, errors: &mut Vec<FileError>) {
    let mut waiting = vec![path.to_path_buf()];
    while let Some(next) = waiting.pop() {
        // A link is followed where it is named on the command line only: no loops.
        let is_folder = match next == path {
            true => next.is_dir(),
            false => next.symlink_metadata().is_ok_and(|data| data.is_dir()),
        };
        if !is_folder {
            files.push(next);
            continue;
        }
        match entries(&next) {
            Ok(inner) => waiting.extend(inner.into_iter().rev()),
            Err(error) => errors.push(unreadable(
                &next,
                "".into(),
                format!("this folder cannot be read: {error}"),
            )),
        }
    }
}

/// The chapters and folders of a folder, sorted.
fn entries(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .unwrap_or("");
        // A linked folder is neither: `chapters` says why.
        let folder = path.is_dir() && !path.is_symlink() && name != "certificates";
        let chapter = path.extension().is_some_and(|ending| ending == "md") && !path.is_dir();
        if !name.starts_with('.') && (folder || chapter) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

pub(super) fn load(path: &Path) -> Result<Arc<str>, FileError> {
    let bytes = fs::read(path).map_err(|error| {
        unreadable(
            path,
            "".into(),
            format!("this file cannot be read: {error}"),
        )
    })?;
    match String::from_utf8(bytes) {
        Ok(text) => Ok(text.into()),
        Err(error) => {
            let valid = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(&error.as_bytes()[..valid]).into();
            let message = "from here on the file is not UTF-8 text".to_string();
            Err(unreadable(path, text, message))
        }
    }
}
