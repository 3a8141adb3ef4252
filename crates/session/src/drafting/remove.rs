//! A step deleted: for each step that speaks of it another object is asked for, or it goes too; one by one.

use super::view::{Prompt, Wants};
use super::{
    Home, blocks, catalogue, hands, outcome, patterns, recording, scene, steps, text, typed, visit,
};
use crate::document::Open;
use crate::host::Host;
use crate::view::{Change, Pointer, Refusal};
use crate::words;
use base::Name;
use syntax::ast::AstNode;

/// A deletion whose dependents are asked about.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Removing {
    /// The steps that go, by address, the first of them the one that was meant.
    gone: Vec<String>,
    /// What speaks of one that goes: the step, what it speaks of, and what it shall speak of instead.
    asked: Vec<Asked>,
}

#[derive(Clone, PartialEq, Debug)]
struct Asked {
    step: String,
    of: String,
    answer: Option<Answer>,
}

impl Asked {
    /// Whether it was asked, and somebody answered.
    fn is_answered(&self) -> bool {
        !matches!(self.answer, None | Some(Answer::LeftOut))
    }
}

#[derive(Clone, PartialEq, Debug)]
enum Answer {
    /// It goes, too.
    Along,
    /// It is a loop over a set, which goes on over the rest of it.
    LeftOut,
    /// Another object, as it is written.
    Instead(String),
}

impl Removing {
    fn open_question(&self) -> Option<usize> {
        self.asked.iter().position(|asked| asked.answer.is_none())
    }

    /// Lists what speaks of a step that goes, once.
    fn go_along(&mut self, source: &text::Source, program: &str, address: &str) {
        self.gone.push(address.to_string());
        let of = address.rsplit('.').next().unwrap_or_default().to_string();
        for user in steps::users(source, program, address) {
            let is_in = |gone: &String| *gone == user || user.starts_with(&format!("{gone}."));
            if !self.gone.iter().any(is_in) {
                let answer =
                    self.is_of_set(source, program, (&user, address)).then_some(Answer::LeftOut);
                self.asked.push(Asked { step: user, of: of.clone(), answer });
            }
        }
        let gone = self.gone.clone();
        self.asked.retain(|asked| asked.answer.is_some() || !gone.contains(&asked.step));
    }

    /// Whether all that a step says of something is that it is in the set that it goes over, and more of the set stays.
    fn is_of_set(
        &self,
        source: &text::Source,
        program: &str,
        (step, address): (&str, &str),
    ) -> bool {
        let of = address.rsplit('.').next().unwrap_or_default();
        let goes = |name: &String| self.gone.iter().any(|gone| gone == name);
        let set = super::repeat::set_of(source, program, step);
        let Some(text) = super::repeat::without_figure(source, (program, step), of) else {
            return false;
        };
        let left = text::Source::of(text);
        set.is_some_and(|(set, _)| set.iter().any(|name| !goes(name)))
            && !steps::users(&left, program, address).iter().any(|user| user == step)
    }

    /// Makes sure that what is demonstrated stays, and what it was begun by: a condition, a set.
    fn leaves_whole(&self, demonstrated: &[(String, bool)]) -> Result<(), Refusal> {
        for (step, _) in demonstrated {
            let told = text::told(step);
            let end_first = "is still being drawn: end it first, or undo it";
            if self.gone.iter().any(|gone| step == gone || step.starts_with(&format!("{gone}."))) {
                return Err(words::refuse(format!("{told} {end_first}")));
            }
            if let Some(asked) = self.asked.iter().find(|asked| asked.step == *step) {
                let message = format!("{told} was begun by {}, and {end_first}", asked.of);
                return Err(words::refuse(message));
            }
        }
        Ok(())
    }

    /// Whether what goes first stands in a step: what that says of it stands behind its turn.
    fn is_around(&self, step: &str) -> bool {
        self.gone[0].strip_prefix(step).is_some_and(|rest| rest.starts_with('.'))
    }

    /// Where a step reads the names of what it speaks of.
    fn home(&self, source: &text::Source, of: (&Name, &Name), step: &str) -> Option<Home> {
        if !self.is_around(step) {
            return visit::home_of(source, of, step, &[]);
        }
        let rest = self.gone[0][step.len() + 1..].split('.').next()?;
        let mut home = visit::home_of(source, of, &text::joined(step, rest), &[])?;
        if let Home::Program { before, .. } = &mut home {
            *before = None;
        }
        Some(home)
    }

    /// What is waited for.
    pub(crate) fn prompt(&self) -> Option<Prompt> {
        let at = self.open_question()?;
        let Asked { step, of, .. } = &self.asked[at];
        let told = text::told(step);
        let is_asked = |asked: &&Asked| asked.answer != Some(Answer::LeftOut);
        let so_many = |asked: &[Asked]| asked.iter().filter(is_asked).count();
        Some(Prompt {
            label: format!(
                "Delete {}, {} of {}",
                text::told(&self.gone[0]),
                so_many(&self.asked[..=at]),
                so_many(&self.asked)
            ),
            words: match self.is_around(step) {
                true => format!(
                    "what {told} carries on, or ends by, is drawn from {of}: pick or type another object for it, or delete all of {told}"
                ),
                false => format!(
                    "{told} is drawn from {of}: pick or type another object for it, or delete it too"
                ),
            },
            takes_sets: true,
            goes_wider: true,
            wants: Wants::Substitute { step: step.clone(), gone: of.clone() },
            ..Prompt::default()
        })
    }
}

/// Begins to delete a step; what speaks of it is asked about. Where nothing does, it goes at once.
///
/// # Errors
/// Nothing is recorded, there is no such step; it is demonstrated, or what is was begun by it.
pub(crate) fn begin(
    open: &mut Open,
    host: &dyn Host,
    address: &str,
) -> Result<Option<Change>, Refusal> {
    let recording = blocks::changeable(open, address)?;
    let (program, demonstrated) = (recording.program.clone(), recording.demonstrated());
    let source = text::Source::now(&open.state);
    let none = || words::refuse(format!("{program} has no step {address}"));
    text::step_at(&source, &program, address).ok_or_else(none)?;
    let mut removing = Removing { gone: Vec::new(), asked: Vec::new() };
    removing.go_along(&source, &program, address);
    removing.leaves_whole(&demonstrated)?;
    open.dialogue = None;
    keep(open, Some(removing));
    finish(open, host)
}

fn keep(open: &mut Open, removing: Option<Removing>) {
    if let Some(recording) = &mut open.recording {
        recording.removing = removing;
    }
}

fn opened(open: &mut Open) -> Result<(Removing, Name, Name), Refusal> {
    let none = || words::refuse("nothing is deleted".into());
    let recording = blocks::recorded(open)?;
    let (program, example) = (recording.program.clone(), recording.example.clone());
    Ok((recording.removing.clone().ok_or_else(none)?, program, example))
}

/// Takes the latest answer back; without one nothing is deleted.
pub(crate) fn back(open: &mut Open) {
    let Ok((mut removing, program, _)) = opened(open) else { return };
    match removing.asked.iter().rposition(Asked::is_answered) {
        Some(at) => {
            let first = removing.gone[0].clone();
            let kept = removing.asked[..at].iter().filter(|asked| asked.is_answered()).cloned();
            let kept: Vec<Asked> = kept.collect();
            let source = text::Source::now(&open.state);
            let mut again = Removing { gone: Vec::new(), asked: Vec::new() };
            again.go_along(&source, &program, &first);
            for answered in kept {
                if let (Some(place), Some(answer)) = (again.open_question(), answered.answer) {
                    answer_at(&mut again, (&source, &program), place, &answer);
                }
            }
            removing = again;
            keep(open, Some(removing));
        }
        None => keep(open, None),
    }
}

fn answer_at(
    removing: &mut Removing,
    (source, program): (&text::Source, &str),
    at: usize,
    answer: &Answer,
) {
    let step = removing.asked[at].step.clone();
    removing.asked[at].answer = Some(answer.clone());
    if *answer == Answer::Along {
        removing.go_along(source, program, &step);
    }
}

/// The step that is asked about goes, too.
///
/// # Errors
/// Nothing is asked.
pub(crate) fn along(open: &mut Open, host: &dyn Host) -> Result<Option<Change>, Refusal> {
    let (mut removing, program, _) = opened(open)?;
    let none = || words::refuse("nothing is asked".into());
    let at = removing.open_question().ok_or_else(none)?;
    let source = text::Source::now(&open.state);
    answer_at(&mut removing, (&source, &program), at, &Answer::Along);
    removing.leaves_whole(&blocks::recorded(open)?.demonstrated())?;
    keep(open, Some(removing));
    finish(open, host)
}

/// Why a step cannot speak of what lies under a pointer.
pub(super) fn why_nothing(open: &Open, step: &str, pointer: &Pointer) -> String {
    let all = scene::scene(&open.state, &hands::home(open));
    let own = |text: &str| {
        // `column[0].ring` is what the step `column.ring` drew
        let parts = text.split('.').map(|part| part.split('[').next().unwrap_or_default());
        let named = step.split('.').filter(|s| text::is_name(s));
        parts.take(named.clone().count()).eq(named)
    };
    let told = text::told(step);
    match scene::nearest(all.iter(), pointer) {
        Some(found) if own(&found.text) => {
            format!("{told} would be drawn from itself: pick something that was drawn before it")
        }
        Some(later) => format!("{} is drawn after {told}: pick something before it", later.text),
        None => format!(
            "nothing that {told} can be drawn from lies here: it must have been drawn before"
        ),
    }
}

/// Whether a pointer is at anything that is drawn.
pub(super) fn lies_there(open: &Open, pointer: &Pointer) -> bool {
    let all = scene::scene(&open.state, &hands::home(open));
    scene::nearest(all.iter(), pointer).is_some()
}

/// Where the step that is asked about reads its names.
pub(super) fn home(open: &Open) -> Option<Home> {
    let recording = open.recording.as_ref()?;
    let removing = recording.removing.as_ref()?;
    let step = &removing.asked[removing.open_question()?].step;
    let of = (&recording.program, &recording.example);
    removing.home(&text::Source::now(&open.state), of, step)
}

/// Gives another object for what goes: as it is typed, or as a pointer finds it.
///
/// # Errors
/// Nothing is asked; it is made after the step, or goes itself; the step would have no outcome with it.
pub(crate) fn instead(
    open: &mut Open,
    host: &dyn Host,
    (typed, picked): (&str, Option<(&Pointer, usize)>),
) -> Result<Option<Change>, Refusal> {
    let (mut removing, program, example) = opened(open)?;
    let none = || words::refuse("nothing is asked".into());
    let at = removing.open_question().ok_or_else(none)?;
    let Asked { step, of, .. } = removing.asked[at].clone();
    let source = text::Source::now(&open.state);
    let home = removing.home(&source, (&program, &example), &step).ok_or_else(none)?;
    let found = match picked {
        Some((pointer, level)) => {
            let all = scene::scene(&open.state, &home);
            let is_gone = |text: &str| {
                removing.gone.iter().any(|gone| {
                    let name = gone.rsplit('.').next().unwrap_or_default();
                    !text::places_of(text, name).is_empty()
                })
            };
            let left = all.iter().filter(|f| !is_gone(&f.text));
            let found = scene::nearest_instead(left, &of, pointer);
            let nothing = || {
                let gone = scene::nearest(all.iter(), pointer).map(|f| format!("{} goes", f.text));
                words::refuse(gone.unwrap_or_else(|| why_nothing(open, &step, pointer)))
            };
            found.map(|found| found.at_level(level, false)).ok_or_else(nothing)?
        }
        None if outcome::place(&open.state, &home, &of).is_some() => {
            if typed::goes_from(typed) {
                return Err(words::refuse(format!("{of} goes: {typed} cannot go on from it")));
            }
            typed::at(typed, "")?
        }
        None => typed.trim().to_string(),
    };
    if found.is_empty() {
        let told = text::told(&step);
        return Err(words::refuse(format!("pick or type what {told} is drawn from instead")));
    }
    outcome::worth(&open.state, &home, &found)?;
    // the step must have an outcome with it
    let edited = substituted(&source, &program, (&step, &of), &found)?;
    let (tried, _) =
        crate::state::State::of(edited, Some(&open.state), host, plan::Plans::default());
    if let Some(wrong) = recording::new_error(&open.state, &tried) {
        return Err(words::refuse(wrong));
    }
    answer_at(&mut removing, (&source, &program), at, &Answer::Instead(found));
    keep(open, Some(removing));
    finish(open, host)
}

/// Returns a text in which a step speaks of something else; the steps in it speak as before.
fn substituted(
    source: &text::Source,
    program: &str,
    (step, of): (&str, &str),
    found: &str,
) -> Result<String, Refusal> {
    let none = || words::refuse(format!("{program} has no step {step}"));
    let value = text::step_at(source, program, step).and_then(|s| s.value).ok_or_else(none)?;
    let (start, end) = (value.span().start as usize, value.span().end as usize);
    let written = catalogue::bracketed(found);
    let inner = text::inner_steps(&value).into_iter().flat_map(|(_, steps)| steps);
    let mut inner: Vec<_> = inner.map(|s| (s.span.start as usize, s.span.end as usize)).collect();
    inner.sort_unstable();
    let (mut text, mut at) = (source[..start].to_string(), start);
    for (from, to) in inner {
        text += &text::renamed(&source[at..from], of, &written);
        text += &source[from..to];
        at = to;
    }
    text += &text::renamed(&source[at..end], of, &written);
    Ok(text + &source[end..])
}

/// Deletes once everything is answered.
fn finish(open: &mut Open, host: &dyn Host) -> Result<Option<Change>, Refusal> {
    let (removing, program, _) = opened(open)?;
    if removing.open_question().is_some() {
        return Ok(None);
    }
    // what is refused from here on has no question left that could be answered otherwise
    keep(open, None);
    let mut edited = open.state.text.clone();
    let mut resettled: Vec<String> = Vec::new();
    for asked in &removing.asked {
        if asked.answer == Some(Answer::LeftOut)
            && let source = text::Source::of(edited.clone())
            && let Some(less) =
                super::repeat::without_figure(&source, (&program, &asked.step), &asked.of)
        {
            edited = less;
        }
        if let Some(Answer::Instead(found)) = &asked.answer
            && !removing.gone.contains(&asked.step)
        {
            let source = text::Source::of(edited);
            let step = std::slice::from_ref(&asked.step);
            resettled.extend(patterns::among(&source, &program, (step, &asked.of)));
            edited = substituted(&source, &program, (&asked.step, &asked.of), found)?;
        }
    }
    let edited = patterns::settled(open, host, &program, (edited, &resettled))?;
    let edited = steps::without(&text::Source::of(edited), &program, &removing.gone)?;
    let gone: Vec<&str> = removing.gone.iter().map(|gone| text::told(gone)).collect();
    let label = format!("delete {}", gone.join(", "));
    let source = text::Source::now(&open.state);
    let mut left = blocks::recorded(open)?.clone();
    left.leave_out(&source, &removing.gone);
    let change = recording::retext(open, host, edited, label)?;
    open.recording = Some(left);
    Ok(Some(change))
}
