//! Jobs: questions whose answers may take long, so that they are asked of a copy of the document in a worker.
//!
//! In: a document's text and a question. Out: the answers, part by part. All of it is plain data; the same question
//! may be asked of an open document where there is no worker.

use crate::host::Host;
use crate::plain::{plain_enum, plain_struct};
use crate::remote::{Executed, LongEdit};
use crate::session::Session;
use crate::view::{
    Analysis, DocumentId, FamilyAxis, FamilyMap, FamilyRow, Foreseen, Ghost, RowFormats, RowOutcome,
};
use kernel::{Command, Path};

/// A question, with all that its answer follows from.
#[derive(Clone, PartialEq, Debug)]
pub struct Job {
    /// The document's name.
    pub name: String,
    /// Its text: a state is made from its text alone.
    pub text: String,
    /// What it uses, by name.
    pub files: Vec<(String, String)>,
    /// What is asked.
    pub question: LongQuestion,
}

/// What may take long.
#[derive(Clone, PartialEq, Debug)]
pub enum LongQuestion {
    /// What is free, superfluous and contradictory.
    Analysis,
    /// How much more is free than the form says.
    More,
    /// What comes of rows of a family.
    Rows {
        /// The family.
        family: String,
        /// The rows.
        rows: Vec<FamilyRow>,
        /// What they are written as.
        formats: RowFormats,
    },
    /// What a command would come to.
    Foreseen(Command),
    /// Where else the thing at a path could be.
    Elsewhere(Path),
    /// Where in two parameters a program draws.
    Map {
        /// The family or program.
        family: String,
        /// The thing whose values count for the other parameters.
        thing: Option<String>,
        /// The two parameters.
        axes: [FamilyAxis; 2],
    },
    /// To do an edit in the copy, so that the document can take it over; asked of the document itself it is nothing.
    Edit(LongEdit),
    /// What hands do first, in the document of [`Job::rehearsal`]; an answer says only that something of it was refused.
    Rehearsal,
}

/// An answer, or a part of one.
#[derive(Clone, PartialEq, Debug)]
pub enum LongAnswer {
    /// To [`LongQuestion::Analysis`].
    Analysis(Analysis),
    /// To [`LongQuestion::More`].
    More {
        /// How much is free by the form of what was counted.
        form: u32,
        /// How much more is.
        more: u32,
    },
    /// Of [`LongQuestion::Rows`] the next one.
    Row(RowOutcome),
    /// To [`LongQuestion::Foreseen`]; or why it would be refused, in one line.
    Foreseen(Result<Foreseen, String>),
    /// To [`LongQuestion::Elsewhere`].
    Elsewhere(Vec<Ghost>),
    /// To [`LongQuestion::Edit`].
    Edited(Box<Executed>),
    /// To [`LongQuestion::Map`]; or why there is none.
    Map(Result<FamilyMap, String>),
    /// To [`LongQuestion::Rehearsal`]: why it could not go on.
    Refused(String),
}

plain_struct!(Job { name, text, files, question });
plain_enum!(LongQuestion {
    0: Analysis,
    1: Rows { family, rows, formats },
    2: Map { family, thing, axes },
    3: More,
    4: Rehearsal,
    5: Foreseen(command),
    6: Elsewhere(about),
    7: Edit(edit)
});
plain_enum!(LongAnswer {
    0: Analysis(analysis),
    1: Row(outcome),
    2: Map(map),
    3: More { form, more },
    4: Refused(why),
    5: Foreseen(found),
    6: Elsewhere(ghosts),
    7: Edited(executed)
});

impl LongQuestion {
    /// In how many parts it is answered.
    pub fn parts(&self) -> usize {
        match self {
            Self::Rows { rows, .. } => rows.len(),
            Self::Analysis
            | Self::More
            | Self::Map { .. }
            | Self::Rehearsal
            | Self::Foreseen(_)
            | Self::Elsewhere(_)
            | Self::Edit(_) => 1,
        }
    }
}

/// Who answers jobs, one after the other: the document of the last one stays open.
#[derive(Debug, Default)]
pub struct Desk {
    open: Option<(Session, DocumentId, Job)>,
}

/// The texts that a job brings along.
struct Brought(Vec<(String, String)>);

impl Host for Brought {
    fn read(&self, name: &str) -> Option<String> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, text)| text.clone())
    }
}

impl Desk {
    /// Takes up a job; its answers come part by part.
    pub fn take(&mut self, job: Job) {
        let is_same = |open: &Job| {
            (&open.name, &open.text, &open.files) == (&job.name, &job.text, &job.files)
        };
        match &mut self.open {
            Some((_, _, open)) if is_same(open) => *open = job,
            _ => {
                let mut session = Session::new(Box::new(Brought(job.files.clone())));
                let id = session.open(&job.name, &job.text);
                self.open = Some((session, id, job));
            }
        }
    }
    /// Returns a part of the answer by its number; nothing after the last.
    pub fn answer(&mut self, part: usize) -> Option<LongAnswer> {
        let (session, id, job) = self.open.as_mut()?;
        let LongQuestion::Edit(edit) = &job.question else {
            return session.answer(*id, &job.question, part);
        };
        if part > 0 {
            return None;
        }
        let executed = session.execute(*id, edit);
        let open = session.document(*id);
        job.text.clone_from(&open.state.text);
        // opened again, the text would come to something else
        if open.done.last().is_some_and(|step| step.came.is_some()) {
            self.open = None;
        }
        Some(LongAnswer::Edited(Box::new(executed)))
    }
}

impl Session {
    /// Returns the job of a question about a document.
    pub fn job(&self, id: DocumentId, question: LongQuestion) -> Job {
        let open = self.document(id);
        let files = open.state.lowered.files.iter().map(|(_, file)| file);
        let used = files.filter(|file| !file.name.is_empty());
        Job {
            name: open.name.clone(),
            text: open.state.text.clone(),
            files: used.map(|file| (file.name.to_string(), file.text.to_string())).collect(),
            question,
        }
    }
    /// Returns a part of the answer to a question about a document as its text says it, by its number.
    pub fn answer(
        &mut self,
        id: DocumentId,
        question: &LongQuestion,
        part: usize,
    ) -> Option<LongAnswer> {
        match question {
            _ if part >= question.parts() => None,
            LongQuestion::Analysis => Some(LongAnswer::Analysis(self.analysis(id))),
            LongQuestion::More => {
                let open = self.document_mut(id);
                let (all, form) = (open.counted(), open.status.freedom);
                Some(LongAnswer::More { form: form as u32, more: (all - form) as u32 })
            }
            LongQuestion::Rows { family, rows, formats } => {
                let drawn = self.draw_row(id, family, rows.get(part)?, *formats);
                Some(LongAnswer::Row(drawn.unwrap_or_default()))
            }
            LongQuestion::Map { family, thing, axes: [across, up] } => {
                let map = self.family_map(id, (family, thing.as_deref()), [across, up]);
                Some(LongAnswer::Map(map.map_err(|refusal| refusal.message)))
            }
            LongQuestion::Foreseen(command) => {
                let found = self.foreseen(id, command).map_err(|refusal| refusal.in_a_line());
                Some(LongAnswer::Foreseen(found))
            }
            LongQuestion::Elsewhere(about) => {
                Some(LongAnswer::Elsewhere(self.ghosts(id, about).unwrap_or_default()))
            }
            LongQuestion::Edit(_) => None,
            LongQuestion::Rehearsal => {
                self.rehearse(id).err().map(|refusal| LongAnswer::Refused(refusal.message))
            }
        }
    }
}
