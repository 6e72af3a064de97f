//! Where text goes and how a command ends.

use crate::corpus;
use crate::report::diagnostic;
use std::io::{self, Write};

/// How a command ends; the numbers are the exit codes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Exit {
    AsExpected = 0,
    NotAsExpected = 1,
    Input = 2,
    Internal = 3,
}

/// A command that cannot do its work: the exit code and what to print on stderr.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Failure {
    pub(super) exit: Exit,
    pub(super) text: String,
}

impl Failure {
    /// A usage or input error, rendered already.
    pub(super) fn rendered(text: String) -> Failure {
        Failure {
            exit: Exit::Input,
            text,
        }
    }

    /// A usage or input error without a place.
    pub(super) fn input(message: &str, hint: Option<&str>) -> Failure {
        Failure::rendered(diagnostic::plain(message, hint))
    }

    /// An error in the text of an argument.
    #[cfg(feature = "engine")]
    pub(super) fn at(argument: &str, text: &str, error: &crate::formula::Diagnostic) -> Failure {
        Failure::rendered(diagnostic::render(argument, text, error))
    }
}

/// A run that came to no reports.
pub(super) fn of_run(error: corpus::Error) -> Failure {
    let hint = match &error {
        corpus::Error::UnknownId { nearest, .. } => {
            nearest.as_ref().map(|id| format!("did you mean `{id}`?"))
        }
        _ => None,
    };
    let exit = match error {
        corpus::Error::UnknownId { .. } | corpus::Error::Unwritable(_) => Exit::Input,
        corpus::Error::Internal { .. } | corpus::Error::Threads(_) => Exit::Internal,
    };
    let text = diagnostic::plain(&error.to_string(), hint.as_deref());
    Failure { exit, text }
}

/// A fault of ours, not of the user's.
pub(super) fn internal(message: &str) -> Failure {
    Failure {
        exit: Exit::Internal,
        ..Failure::input(&format!("internal fault: {message}"), None)
    }
}

/// Writes a file that an option names.
#[cfg(feature = "engine")]
pub(super) fn write_file(path: &std::path::Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(|error| {
        Failure::input(
            &format!("{} cannot be written: {error}", path.display()),
            None,
        )
    })
}

/// Writes a file whole: a new one takes the place of the old one, so that nobody finds half of it.
#[cfg(feature = "engine")]
pub(super) fn replace_file(path: &std::path::Path, text: &str) -> Result<(), Failure> {
    corpus::file::replace(path, text).map_err(|error| {
        Failure::input(
            &format!("{} cannot be written: {error}", path.display()),
            Some("name a place that can be written to"),
        )
    })
}

/// Prints a report on stdout. A reader who has seen enough (`| head`) is no error.
pub(super) fn to_stdout(text: &str) -> Result<(), Failure> {
    let mut stream = anstream::stdout().lock();
    match stream
        .write_all(text.as_bytes())
        .and_then(|()| stream.flush())
    {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::input(
            &format!("the report cannot be written: {error}"),
            None,
        )),
        _ => Ok(()),
    }
}

/// Prints an error on stderr; when even that is closed, nobody is left to tell.
pub(super) fn to_stderr(text: &str) {
    let _ = writeln!(anstream::stderr().lock(), "{text}");
}

/// Prints an error without a place on stderr.
pub(super) fn error(message: &str, hint: Option<&str>) {
    to_stderr(&diagnostic::plain(message, hint));
}
