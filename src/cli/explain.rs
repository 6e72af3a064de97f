//! `claimcheck explain ID`: all that is known of one claim, with its proof as a person reads it.
//!
//! With the engine the claim is judged, and what is found is explained; the build without it explains
//! the certificates that are saved.

#[cfg(not(feature = "engine"))]
use super::library::Library;
use super::output::{Exit, Failure, to_stdout};
use crate::report::proof;
use clap::Args;
#[cfg(feature = "engine")]
use {
    super::check::{exit, unwritable},
    super::judging::{Judging, Want},
    crate::judge::Report,
    crate::kernel::proof::Certificate,
    crate::report::{human::detail, json},
    clap::ValueEnum,
};

/// Tells all about one claim: statement, verdict, evidence, and the proof with the facts it uses
#[derive(Debug, Args)]
pub(super) struct Explain {
    /// The claim
    id: String,
    #[cfg(feature = "engine")]
    #[arg(long, value_enum, default_value_t = Format::Human)]
    format: Format,
    #[cfg(feature = "engine")]
    #[command(flatten)]
    judging: Judging,
    #[cfg(not(feature = "engine"))]
    #[command(flatten)]
    library: Library,
}

#[cfg(feature = "engine")]
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    Human,
    Json,
}

#[cfg(feature = "engine")]
impl Explain {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let run = self.judging.run(vec![self.id], Want::Evidence)?;
        let text = match self.format {
            Format::Human => run.reports.iter().map(human).collect(),
            Format::Json => json::render(&run).map_err(unwritable)?,
        };
        to_stdout(&text)?;
        Ok(exit(&run))
    }
}

/// The report and the proofs in it. Its witnesses stand in the report itself.
#[cfg(feature = "engine")]
fn human(report: &Report) -> String {
    let mut text = detail::render(report);
    let parts = [
        (proof::PRINTED, Some(&report.printed)),
        (proof::MENDED, report.mended.as_ref()),
    ];
    for (title, answer) in parts {
        let evidence = answer.and_then(|answer| answer.evidence.as_ref());
        if let Some(certificate @ Certificate::Theorem(_)) = evidence {
            text.push('\n');
            text.push_str(&proof::render(title, certificate));
        }
    }
    text
}

#[cfg(not(feature = "engine"))]
impl Explain {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        use crate::corpus::{certificates::text, chosen};
        use crate::kernel::proof::{parse, replay};
        use crate::report::diagnostic;

        let book = self.library.open()?;
        let claims = chosen(&book, &[self.id]).map_err(super::output::of_run)?;
        for claim in claims {
            to_stdout(&proof::head(claim))?;
            let path = self.library.store().path(claim);
            let failure = |message: String, hint| Failure {
                exit: Exit::NotAsExpected,
                text: diagnostic::plain(&message, hint),
            };
            let flawed = |flaw: crate::kernel::proof::Flaw| {
                let place = format!("{}:{}", path.display(), flaw.line.max(1));
                failure(format!("{place}: {}", flaw.message), None)
            };
            let Some(text) = text(&path).map_err(flawed)? else {
                let message = format!("there is no certificate {}", path.display());
                let hint = "a build with the feature `engine` judges the claim and saves one";
                return Err(failure(message, Some(hint)));
            };
            replay(&text).map_err(flawed)?;
            for certificate in parse(&text).map_err(flawed)? {
                let title = proof::title(claim, &certificate);
                to_stdout(&format!("\n{}", proof::render(title, &certificate)))?;
            }
        }
        Ok(Exit::AsExpected)
    }
}
