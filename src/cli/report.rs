//! `claimcheck report`: the book's report as a page to look at.

use super::check::exit;
use super::judging::{Judging, Want};
use super::output::{Exit, Failure, to_stdout};
use crate::corpus::file::replace;
use crate::report::html;
use clap::Args;
use std::path::{Path, PathBuf};

/// The page's name in its folder.
const PAGE: &str = "index.html";

/// Writes the report as one page of HTML, which needs nothing else: index.html in the folder
#[derive(Debug, Args)]
pub(super) struct Report {
    /// The folder for the page; it is made where it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    #[command(flatten)]
    judging: Judging,
}

impl Report {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        // Before the claims are judged, which may take long.
        std::fs::create_dir_all(&self.out).map_err(|error| unwritable(&self.out, &error))?;
        let run = self.judging.run(Vec::new(), Want::Reports)?;
        let page = self.out.join(PAGE);
        replace(&page, &html::render(&run)).map_err(|error| unwritable(&page, &error))?;
        if !self.judging.quiet {
            to_stdout(&format!("{}\n", page.display()))?;
        }
        Ok(exit(&run))
    }
}

fn unwritable(path: &Path, error: &std::io::Error) -> Failure {
    let message = format!("{} cannot be written: {error}", path.display());
    Failure::input(&message, Some("name another folder with `--out`"))
}
