//! Long jobs: questions that a worker answers while the page goes on, one after the other.
//!
//! In: a question of a panel. Out: its answers as they come, whether it goes on, and how far it is. A question that is
//! asked again takes the place of the one before; edits wait for each other. Where the browser refuses a worker the page
//! answers itself, part by part, and says so once; what nobody waits for is not answered there.

use super::{Lab, Notice};
use crate::js::{self, Worker};
use crate::words;
use js_sys::Uint8Array;
use leptos::prelude::*;
use session::DocumentId;
use session::jobs::{LongAnswer, LongQuestion};
use session::plain::{read, written};
use std::fmt;
use std::time::Duration;
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// A job that has gone on for so many milliseconds is ended where its question is asked again.
const LONG: f64 = 400.0;

/// Which questions there are: of each one goes on or waits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// What is free, superfluous, contradictory.
    Analysis,
    /// What a command would come to.
    Foreseen,
    /// Where else the selection could be.
    Elsewhere,
    /// How much is free, where that was not said at once; nobody waits for it.
    Freedom,
    /// An edit: each is done, in the order in which they were asked for.
    Edit,
    /// What comes of the rows of a family.
    Rows,
    /// The map of a program.
    Map,
    /// The files of a family's rows, each kind for itself.
    Svg,
    /// In millimetres.
    Dxf,
}

impl Kind {
    /// Whether nobody waits any more for a question of another kind once one of this kind is asked.
    fn displaces(self, other: Self) -> bool {
        let is_passing = matches!(other, Self::Freedom | Self::Foreseen | Self::Elsewhere);
        other == self || other == Self::Freedom || self == Self::Edit && is_passing
    }
}

/// What is told of a job.
#[derive(Debug)]
pub enum Told {
    /// An answer, or a part of one.
    Part(LongAnswer),
    /// That was the last.
    Over,
    /// Somebody has stopped it.
    Stopped,
    /// It came to no end, and why.
    Failed(String),
}

/// A job that goes on.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Going {
    /// What it is.
    pub kind: Kind,
    /// How many parts are answered.
    pub done: usize,
    /// How many there are.
    pub all: usize,
    /// When it began.
    pub begun: f64,
}

/// The jobs of a lab.
#[derive(Clone, Copy, Debug)]
pub struct Jobs {
    /// The one that goes on.
    pub going: RwSignal<Option<Going>>,
    queue: StoredValue<Queue, LocalStorage>,
}

impl Default for Jobs {
    fn default() -> Self {
        Self { going: RwSignal::new(None), queue: StoredValue::new_local(Queue::default()) }
    }
}

#[derive(Debug, Default)]
struct Queue {
    worker: Option<Worker>,
    is_ready: bool,
    /// Counts the workers: what an older one says is not heard.
    number: u32,
    /// How many jobs it was handed of which no answer is wanted any more.
    stale: u32,
    /// Whether it was handed the job that goes on.
    is_handed: bool,
    /// The browser has refused a worker.
    is_refused: bool,
    /// The first is the one that goes on.
    tasks: Vec<Task>,
}

struct Task {
    kind: Kind,
    of: DocumentId,
    question: LongQuestion,
    tell: Box<dyn Fn(Told)>,
}

impl fmt::Debug for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Task").field("kind", &self.kind).finish_non_exhaustive()
    }
}

impl Lab {
    /// Asks something of the shown document that may take long.
    pub fn ask_long(self, kind: Kind, question: LongQuestion, tell: impl Fn(Told) + 'static) {
        let Some(of) = self.id() else { return };
        if kind == Kind::Freedom && self.jobs.queue.with_value(|queue| queue.is_refused) {
            return;
        }
        let going = self.jobs.going.get_untracked();
        if let Some(going) = going.filter(|g| g.kind != Kind::Edit && kind.displaces(g.kind)) {
            // nobody waits for the count: whoever asks something else does not either; an edit goes on from the copy
            if going.kind != kind && kind != Kind::Edit {
                self.end_worker();
            }
            self.give_up(going);
        }
        let task = Task { kind, of, question, tell: Box::new(tell) };
        self.jobs.queue.update_value(|queue| {
            queue.tasks.retain(|task| task.kind == Kind::Edit || !kind.displaces(task.kind));
            queue.tasks.push(task);
            queue.tasks.sort_by_key(|task| match task.kind {
                Kind::Edit => 0,
                Kind::Freedom => 2,
                _ => 1,
            });
        });
        self.next_job();
    }

    /// Whether the worker is at an edit.
    pub fn is_editing(self) -> bool {
        self.jobs.going.with(|going| going.as_ref().is_some_and(|g| g.kind == Kind::Edit))
    }

    /// Whether a worker would do an edit next: it is not refused, and nothing that somebody waits for goes on.
    pub fn is_worker_free(self) -> bool {
        let is_idle = |kind: Kind| kind == Kind::Edit || Kind::Edit.displaces(kind);
        let going = self.jobs.going.get_untracked();
        going.is_none_or(|going| is_idle(going.kind))
            && self
                .jobs
                .queue
                .with_value(|q| !q.is_refused && q.tasks.iter().all(|t| is_idle(t.kind)))
    }

    /// Ends the edits that a worker has not done yet: they are told so. Returns whether there were any.
    pub(super) fn end_edits(self, how: impl Fn() -> Told) -> bool {
        let is_edit = |task: &Task| task.kind == Kind::Edit;
        if !self.jobs.queue.with_value(|queue| queue.tasks.iter().any(is_edit)) {
            return false;
        }
        let edits = self.jobs.queue.try_update_value(|queue| {
            let (edits, others) = std::mem::take(&mut queue.tasks).into_iter().partition(is_edit);
            queue.tasks = others;
            edits
        });
        let going = self.jobs.going.get_untracked();
        if let Some(going) = going.filter(|going| going.kind == Kind::Edit) {
            self.give_up(going);
        }
        let edits: Vec<Task> = edits.unwrap_or_default();
        edits.iter().for_each(|task| (task.tell)(how()));
        self.next_job();
        true
    }

    /// Gives up a question whose answer nobody waits for any more.
    pub fn forget_long(self, kind: Kind) {
        let going = self.jobs.going.try_get_untracked().flatten().filter(|g| g.kind == kind);
        let _ = self.jobs.queue.try_update_value(|queue| queue.tasks.retain(|t| t.kind != kind));
        if let Some(going) = going {
            self.give_up(going);
            self.next_job();
        }
    }

    /// Waits no more for the job that goes on. A worker that has been at it for long is ended, as is one that does not
    /// come to its end soon.
    fn give_up(self, going: Going) {
        self.jobs.going.set(None);
        if js::now() - going.begun > LONG {
            return self.end_worker();
        }
        let number = self.jobs.queue.try_update_value(|queue| {
            queue.stale += u32::from(std::mem::take(&mut queue.is_handed));
            queue.number
        });
        let look = move || {
            let lags = self.jobs.queue.try_with_value(|q| Some(q.number) == number && q.stale > 0);
            if lags == Some(true) {
                self.end_worker();
                if self.jobs.going.get_untracked().is_some() {
                    self.start_worker();
                }
            }
        };
        set_timeout(look, Duration::from_millis(LONG as u64));
    }

    /// Stops what goes on; returns whether there was something.
    pub fn stop_job(self) -> bool {
        if self.jobs.going.get_untracked().is_none_or(|going| going.kind == Kind::Freedom) {
            return false;
        }
        self.end_worker();
        self.end_job(Told::Stopped);
        self.notice.set(Some(Notice::Said(String::from(words::JOB_STOPPED))));
        true
    }

    fn end_worker(self) {
        self.jobs.queue.update_value(|queue| {
            queue.worker.take().inspect(Worker::end);
            (queue.is_ready, queue.is_handed, queue.stale) = (false, false, 0);
            queue.number += 1;
        });
    }

    /// Begins the first job that waits, unless one goes on.
    fn next_job(self) {
        if self.jobs.going.get_untracked().is_some() {
            return;
        }
        let first = self.jobs.queue.with_value(|queue| {
            let task = queue.tasks.first()?;
            Some((task.kind, task.question.clone(), queue.is_refused))
        });
        let Some((kind, question, is_refused)) = first else { return };
        let all = question.parts();
        self.jobs.going.set(Some(Going { kind, done: 0, all, begun: js::now() }));
        if is_refused {
            let number = self.jobs.queue.with_value(|queue| queue.number);
            return self.answer_here(number, question, 0);
        }
        if self.jobs.queue.with_value(|queue| queue.worker.is_none()) {
            return self.start_worker();
        }
        if self.jobs.queue.with_value(|queue| queue.is_ready) {
            self.hand_over();
        }
    }

    /// Hands the worker the first job.
    fn hand_over(self) {
        let first = |queue: &Queue| queue.tasks.first().map(|t| (t.of, t.question.clone()));
        let Some((of, question)) = self.jobs.queue.with_value(first) else { return };
        let job = self.ask(|session| session.job(of, question));
        let bytes = Uint8Array::from(&written(&job)[..]);
        self.jobs.queue.update_value(|queue| {
            queue.is_handed = true;
            queue.worker.as_ref().inspect(|worker| worker.ask(&bytes));
        });
    }

    fn start_worker(self) {
        self.jobs.queue.update_value(|queue| queue.number += 1);
        let number = self.jobs.queue.with_value(|queue| queue.number);
        let said = Closure::<dyn FnMut(String, JsValue)>::new(move |word: String, what| {
            let is_it = self.jobs.queue.try_with_value(|queue| queue.number == number);
            if is_it == Some(true) {
                self.hear(&word, &what);
            }
        });
        let worker = js::start_worker(said.into_js_value().unchecked_ref());
        if worker.is_undefined() {
            return self.do_without_worker();
        }
        self.jobs.queue.update_value(|queue| queue.worker = Some(worker.unchecked_into()));
    }

    /// From now on the page answers itself.
    fn do_without_worker(self) {
        self.end_worker();
        self.jobs.going.set(None);
        let is_awaited = self.jobs.queue.try_update_value(|queue| {
            queue.tasks.retain(|task| task.kind != Kind::Freedom);
            queue.is_refused = !queue.tasks.is_empty();
            queue.is_refused
        });
        if is_awaited == Some(true) {
            self.notice.set(Some(Notice::Said(String::from(words::NO_WORKER))));
            self.next_job();
        }
    }

    fn hear(self, word: &str, what: &JsValue) {
        match word {
            "ready" => {
                self.jobs.queue.update_value(|queue| queue.is_ready = true);
                if self.jobs.going.get_untracked().is_some() {
                    self.hand_over();
                }
            }
            "over" if self.jobs.queue.with_value(|queue| queue.stale > 0) => {
                self.jobs.queue.update_value(|queue| queue.stale -= 1);
            }
            "part" if self.jobs.queue.with_value(|queue| queue.stale > 0) => {}
            "part" => {
                let bytes = what.unchecked_ref::<Uint8Array>().to_vec();
                if let Some(answer) = read::<LongAnswer>(&bytes) {
                    self.tell_part(answer);
                }
            }
            "over" => self.end_job(Told::Over),
            _ if !self.jobs.queue.with_value(|queue| queue.is_ready) => self.do_without_worker(),
            _ => {
                self.end_worker();
                self.end_job(Told::Failed(what.as_string().unwrap_or_default()));
            }
        }
    }

    fn tell_part(self, answer: LongAnswer) {
        let kind = self.jobs.going.get_untracked().map(|going| going.kind);
        self.jobs.queue.with_value(|queue| {
            let first = queue.tasks.first().filter(|task| Some(task.kind) == kind);
            first.inspect(|task| (task.tell)(Told::Part(answer)));
        });
        self.jobs.going.update(|going| {
            if let Some(going) = going {
                going.done += 1;
            }
        });
    }

    fn end_job(self, how: Told) {
        let kind = self.jobs.going.get_untracked().map(|going| going.kind);
        self.jobs.going.set(None);
        let task = self.jobs.queue.try_update_value(|queue| {
            queue.is_handed = false;
            let is_it = queue.tasks.first().is_some_and(|task| Some(task.kind) == kind);
            is_it.then(|| queue.tasks.remove(0))
        });
        if let Some(task) = task.flatten() {
            (task.tell)(how);
        }
        self.next_job();
    }

    /// Answers a part of a question in the page, and goes on later.
    fn answer_here(self, number: u32, question: LongQuestion, part: usize) {
        set_timeout(
            move || {
                let is_it = self.jobs.queue.try_with_value(|queue| queue.number == number);
                if is_it != Some(true) {
                    return;
                }
                match self.tell(|session, id| session.answer(id, &question, part)).flatten() {
                    Some(answer) => {
                        // an analysis has counted what is free
                        self.id().into_iter().for_each(|id| self.tell_freedom(id));
                        self.tell_part(answer);
                        self.answer_here(number, question, part + 1);
                    }
                    None => self.end_job(Told::Over),
                }
            },
            Duration::ZERO,
        );
    }
}
