//! `bagnold judge` and `bagnold export`: other codes' results, and what they need for them.

use super::arguments::{ExportArguments, JudgeArguments, LeagueArguments};
use super::error::ProgramError;
use super::{Exit, Session, decks, simulation, terminal};
use crate::case::{Changes, ParameterError};
use crate::judge::{self, CaseSubmissions, CodeComparison};
use crate::league;
use crate::metric::{Metric, Verdict};
use crate::output::{FileError, OutputFolder, write_whole};
use crate::report::{self, Severity, Tally};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Gates without data, or that pass, which are named on the terminal.
const MOST_NAMES: usize = 6;

/// Judges submissions, or prints an empty one.
pub(super) fn judge(command: &JudgeArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    if let Some(case) = &command.template {
        session.say(&judge::blank(session.registry.find(case)?, command.tier)?);
        return Ok(Exit::Held);
    }
    let CaseSubmissions { prepared, entries } = CaseSubmissions::read(&command.files, session.registry)?;
    let folder = command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/judged/{}", prepared.name())));
    let claimed = OutputFolder::claim(&folder)?;
    let results = simulation::simulate(vec![prepared], &command.work.open_store(), session.quiet, None, None)?;
    let exit = Exit::of_runs(&results);
    let Some(own) = results.into_iter().next() else { return Ok(exit) };
    let judgement = judge::judge(own, &entries)?;
    judge::write(&judgement, claimed.staging(), command.figures.format(), command.junit.as_deref())?;
    claimed.publish()?;
    session.say(&verdicts(&judgement));
    let all = Tally(judgement.codes.iter().flat_map(|judged| judged.tally().0).collect());
    session.say(&format!("{}. Report: {}\n", all.in_words(), folder.join("index.html").display()));
    // what was not judged is no success either
    let mut tallies = judgement.codes.iter().map(judge::JudgedCode::tally);
    let fails = tallies.any(|own| own.of(Severity::NewFailure) > 0 || own.of(Severity::Pass) == 0);
    Ok(if exit == Exit::Held && fails { Exit::GateFailed } else { exit })
}

/// Judges all submissions of a folder and writes one page.
pub(super) fn league(command: &LeagueArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let own = || {
        let place = Path::new("validation").join("league");
        let current = std::env::current_dir().unwrap_or_default();
        current.ancestors().map(|root| root.join(&place)).find(|league| league.is_dir()).unwrap_or(place)
    };
    let folder = command.folder.clone().unwrap_or_else(own);
    if command.folder.is_none() && !folder.is_dir() {
        let (rule, remedy) =
            ("an existing folder", "name the folder of results; a checkout of bagnold has them in validation/league");
        return Err(ParameterError::field("FOLDER", folder.display(), rule, remedy).into());
    }
    let files = league::submissions(&folder)?;
    let studies = league::studies::studies(&folder)?;
    let claimed = OutputFolder::claim(&command.out)?;
    let (prepared, entries) = league::split(league::read(&files, session.registry)?);
    let results = simulation::simulate(prepared, &command.work.open_store(), session.quiet, None, None)?;
    let judged = results.into_iter().zip(&entries).map(|(own, entries)| judge::judge(own, entries));
    let judged: Vec<CodeComparison> = judged.collect::<Result<_, _>>()?;
    league::write(&league::league(&judged), &studies, claimed.staging())?;
    claimed.publish()?;
    let mut case = "";
    for judgement in &judged {
        if judgement.own.name != case {
            case = &judgement.own.name;
            session.say(&format!("{case}\n"));
        }
        session.say(&verdicts(judgement));
    }
    session.say(&format!("Report: {}\n", command.out.join("index.html").display()));
    Ok(Exit::Held)
}

/// A line for each code, and a table of its gates that fail.
fn verdicts(judgement: &CodeComparison) -> String {
    let line = |judged: &judge::JudgedCode| {
        let tally = judged.tally();
        let name = format!("{} {}", judged.submission.code.name, judged.submission.code.version);
        let foreign = || judged.metrics.iter().filter_map(|one| one.foreign.as_ref());
        let passes = || foreign().filter(|own| own.verdict() == Verdict::Pass).count();
        // few gates are shown as they are
        let is_shown = |own: &&Metric| match own.verdict() {
            Verdict::Fail => true,
            Verdict::Pass => passes() <= MOST_NAMES,
            _ => false,
        };
        let table = report::of_metrics(foreign().filter(is_shown), terminal::shape());
        let nothing = match tally.all() - tally.of(Severity::NotJudged) {
            0 if tally.all() == 0 => {
                "no gate was judged: the case has none; a scene has one for each [[measured]] with a `limit`\n"
            }
            0 => "no gate was judged; the page lists the data that each gate needs\n",
            _ => "",
        };
        let gated = judged.metrics.iter().filter(|one| one.own.verdict() != Verdict::Observed);
        let open: BTreeSet<&str> =
            gated.filter(|one| one.verdict().is_none()).map(|one| one.own.name.as_str()).collect();
        let more = if open.len() > MOST_NAMES { ", …" } else { "" };
        let open: Vec<&str> = open.into_iter().take(MOST_NAMES).collect();
        let open = if open.is_empty() { String::new() } else { format!("; not judged: {}{more}", open.join(", ")) };
        let moved = judged.moved.as_ref().map(|notice| format!("{notice}\n")).unwrap_or_default();
        format!("{}, {}{open}\n{moved}{nothing}{table}", name.trim(), tally.in_words())
    };
    judgement.codes.iter().map(line).collect()
}

/// Writes what another code needs to run a case.
pub(super) fn export(command: &ExportArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let case = session.registry.find(&command.case)?;
    let deck = command.code.as_ref().map_or(Ok(Vec::new()), |code| decks::find(code, case, command.tier))?;
    let prepare = || case.prepare(command.tier, &Changes::default());
    let (prepared, claimed) = (prepare()?, OutputFolder::claim(&command.out)?);
    let results = if command.simulate {
        simulation::simulate(vec![prepare()?], &command.work.open_store(), session.quiet, None, None)?
    } else {
        Vec::new()
    };
    let exit = Exit::of_runs(&results);
    judge::export(case, &*prepared, command.tier, results.first(), claimed.staging())?;
    for (name, text) in deck {
        write_whole(&claimed.staging().join(name), text.as_bytes())
            .map_err(|error| FileError::unwritable(&command.out, &error))?;
    }
    claimed.publish()?;
    session.say(&format!("written to {}\n", command.out.display()));
    Ok(exit)
}
