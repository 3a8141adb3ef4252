//! The dock's plot: what is shown, over what, and the chart of it; loci lie in the picture as well.
//!
//! In: what a person names. Out: a request to the session, and the plot that comes of it. A sweep is made anew
//! after every command; a drag is followed while it goes on.

use crate::actions::{Action, Context, Group};
use crate::dock::Tab;
use crate::lab::{Lab, Notice};
use crate::sheet::bounds;
use crate::{icons, js, values, words};
use chart::Chart;
use leptos::ev::KeyboardEvent;
use leptos::prelude::*;
use presentation::numbers::slider_range;
use session::Session;
use session::plotting::{Plot, Request, Sweep, Sweeping};
use session::view::{PlotEntry, Refusal, ValueRow};

pub mod chart;

/// So many steps a sweep has in the page.
const STEPS: u32 = 200;
/// A sweep goes on for so many milliseconds before the page has its turn.
const A_WHILE: f64 = 24.0;
/// How large a chart is that leaves the page, in pixels.
const EXPORTED: (f64, f64) = (720.0, 420.0);
/// So many values are offered while a path is typed.
const MOST_OFFERED: usize = 400;

/// Sweeps the selected number.
pub(crate) const SWEEP: Action = Action {
    id: "sweep",
    group: Group::View,
    contexts: &[Context::Value],
    label: words::SWEEP_SELECTION,
    keys: &[],
    enabled: |lab| if lab.playable().is_some() { Ok(()) } else { Err(words::NO_NUMBER) },
    run: |lab| {
        if let Some(path) = lab.selected.get_untracked() {
            lab.sweep(&path);
            lab.open_dock(Tab::Plot);
        }
    },
};

/// What is plotted of the shown document.
#[derive(Clone, Copy, Debug)]
pub struct Plotting {
    /// Paths and expressions.
    pub show: RwSignal<Vec<String>>,
    /// What is swept; where it is empty, drags are followed.
    pub of: RwSignal<String>,
    /// Where the sweep begins.
    pub from: RwSignal<String>,
    /// Where it ends.
    pub to: RwSignal<String>,
    /// What the curves are over, where it is not what is swept.
    pub over: RwSignal<String>,
    /// What came of it.
    pub plot: RwSignal<Plot>,
    /// Why nothing did.
    pub refused: RwSignal<Option<String>>,
    /// How many values of a sweep that goes on are done, and how many there are.
    pub progress: RwSignal<Option<(u32, u32)>>,
    /// That sweep, and which one of the page's it is.
    sweeping: StoredValue<(u32, Option<Sweeping>), LocalStorage>,
}

impl Default for Plotting {
    fn default() -> Self {
        let empty = || RwSignal::new(String::new());
        Self {
            show: RwSignal::new(Vec::new()),
            of: empty(),
            from: empty(),
            to: empty(),
            over: empty(),
            plot: RwSignal::new(Plot::default()),
            refused: RwSignal::new(None),
            progress: RwSignal::new(None),
            sweeping: StoredValue::new_local((0, None)),
        }
    }
}

impl Plotting {
    /// What the session is asked for; nothing where nothing is shown.
    fn request(self) -> Option<Request> {
        let typed = |signal: RwSignal<String>| signal.with(|text| String::from(text.trim()));
        let (of, over) = (typed(self.of), typed(self.over));
        let sweep = (!of.is_empty()).then(|| Sweep {
            of,
            from: typed(self.from),
            to: typed(self.to),
            steps: STEPS,
        });
        let show = self.show.get();
        (!show.is_empty()).then(|| Request {
            show,
            over: Some(over).filter(|o| !o.is_empty()),
            sweep,
        })
    }
    /// Forgets what was plotted of another document.
    pub fn clear(self) {
        self.show.set(Vec::new());
        [self.of, self.from, self.to, self.over].into_iter().for_each(|s| s.set(String::new()));
        self.plot.set(Plot::default());
        self.refused.set(None);
        self.put_sweep(None);
    }
    /// Goes on with this sweep from now on, instead of any other; returns its number.
    fn put_sweep(self, sweeping: Option<Sweeping>) -> u32 {
        self.progress.set(sweeping.as_ref().map(Sweeping::progress));
        self.sweeping.update_value(|kept| *kept = (kept.0 + 1, sweeping));
        self.sweeping.with_value(|kept| kept.0)
    }
}

impl Lab {
    /// Plots what is selected besides what is plotted already, and opens the dock.
    pub fn plot_selection(self) {
        let chosen = self.selection_untracked();
        self.plotting.show.update(|show| {
            for path in chosen {
                if !show.contains(&path) {
                    show.push(path);
                }
            }
        });
        self.open_dock(Tab::Plot);
    }

    /// Shows a view that a class defines.
    fn plot_view(self, request: &Request) {
        let plotting = self.plotting;
        let Some(sweep) = &request.sweep else { return };
        plotting.show.set(request.show.clone());
        plotting.of.set(sweep.of.clone());
        plotting.from.set(sweep.from.clone());
        plotting.to.set(sweep.to.clone());
        plotting.over.set(request.over.clone().unwrap_or_default());
        self.open_dock(Tab::Plot);
    }

    /// Takes over what the session has sampled of the drag that goes on.
    pub fn follow_plot(self) {
        if self.dock.get_untracked() != Some(Tab::Plot)
            || !self.plotting.of.with_untracked(String::is_empty)
        {
            return;
        }
        if let Some(Ok(plot)) =
            self.ask_of_shown(|session, id| session.plot(id, &Request::default()))
        {
            self.plotting.plot.set(plot);
        }
    }

    /// Asks for a plot, and shows it or why there is none.
    fn ask_for_plot(self, request: Option<&Request>) {
        let follow = request.filter(|request| request.sweep.is_none());
        let watched = self.tell(|session, id| session.watch(id, follow));
        self.plotting.put_sweep(None);
        match (request, watched) {
            (None, _) | (_, None) => self.show_plot(Ok(Plot::default())),
            (Some(_), Some(Err(refusal))) => self.show_plot(Err(refusal)),
            (Some(request), Some(Ok(()))) if request.sweep.is_some() => {
                match self.ask_of_shown(|session, id| session.begin_sweep(id, request)) {
                    Some(Ok(sweeping)) => {
                        let number = self.plotting.put_sweep(Some(sweeping));
                        self.go_on_sweeping(number);
                    }
                    Some(Err(refusal)) => self.show_plot(Err(refusal)),
                    None => {}
                }
            }
            (Some(request), Some(Ok(()))) => {
                let made = self.ask_of_shown(|session, id| session.plot(id, request));
                self.show_plot(made.unwrap_or_else(|| Ok(Plot::default())));
            }
        }
    }

    fn show_plot(self, made: Result<Plot, Refusal>) {
        let (plot, refused) = match made {
            Ok(plot) => (plot, None),
            Err(refusal) => (Plot::default(), Some(refusal.in_a_line())),
        };
        self.plotting.refused.set(refused);
        self.plotting.plot.set(plot);
    }

    /// Goes on with a sweep for a while, and again in the next frame until it is over or another has taken its place.
    fn go_on_sweeping(self, number: u32) {
        let mut kept = None;
        self.plotting.sweeping.try_update_value(|(at, sweeping)| {
            if *at == number {
                kept = sweeping.take();
            }
        });
        let Some(mut sweeping) = kept else { return };
        let begun = js::now();
        let went = loop {
            let went = self.ask_of_shown(|session, id| session.go_on(id, &mut sweeping));
            let is_over = !matches!(went, Some(Ok(true)));
            if is_over || js::now() - begun > A_WHILE {
                break went;
            }
        };
        match went {
            Some(Ok(true)) => {
                self.show_plot(Ok(sweeping.plot()));
                self.plotting.progress.set(Some(sweeping.progress()));
                self.plotting.sweeping.update_value(|kept| kept.1 = Some(sweeping));
                request_animation_frame(move || self.go_on_sweeping(number));
                return;
            }
            Some(Ok(false)) => self.show_plot(sweeping.finished()),
            Some(Err(refusal)) => self.show_plot(Err(refusal)),
            None => {}
        }
        self.plotting.progress.set(None);
    }

    /// Ends a sweep that goes on where it is; returns whether there was one.
    pub fn stop_sweeping(self) -> bool {
        let was = self.plotting.progress.with_untracked(Option::is_some);
        if was {
            self.plotting.put_sweep(None);
            self.notice.set(Some(Notice::Said(String::from(words::SWEEP_STOPPED))));
        }
        was
    }

    /// Sweeps a value through a range around where it is now.
    fn sweep(self, path: &str) {
        self.list();
        let range = self.values.with_untracked(|rows| {
            let row = rows.iter().find(|row| row.path == path || row.shortest == path)?;
            let number = row.exact.parse::<f64>().ok()?;
            // as the number is shown: an angle in degrees, unless a unit says otherwise
            let scale = if row.unit == "deg" { 180.0 / std::f64::consts::PI } else { 1.0 };
            let turn = values::whole_turn(row).map(|ends| (ends.0 * scale, ends.1 * scale));
            let drawn = self.drawn_range(row).filter(|_| turn.is_none());
            let (number, natural, unit) = match drawn {
                Some((now, ends, unit)) => (now, Some(ends), unit),
                None => (number, turn, row.unit.clone()),
            };
            let (least, most) = slider_range(number, natural, None);
            let end = |x: f64| words::with_unit(&base::number::significant(x, 6), &unit);
            Some((end(least), end(most)))
        });
        if let Some((least, most)) = range {
            self.plotting.from.set(least);
            self.plotting.to.set(most);
        }
        self.plotting.of.set(String::from(path));
    }

    /// What a coordinate of a point is, the range in which something is drawn, and the unit of the sheet, in which these
    /// are; nothing where the coordinate has a unit and the sheet has none.
    fn drawn_range(self, row: &ValueRow) -> Option<(f64, (f64, f64), String)> {
        let (place, coordinate) = row.path.rsplit_once('.')?;
        self.picture.with_untracked(|picture| {
            let grip = picture.grips.iter().find(|grip| grip.path == place)?;
            let drawn = bounds(&picture.drawing);
            let (now, least, most) = match coordinate {
                "x" => (grip.x, drawn.least.x, drawn.most.x),
                "y" => (grip.y, drawn.least.y, drawn.most.y),
                _ => return None,
            };
            let unit = match (&picture.unit, row.unit.is_empty()) {
                (_, true) => String::new(),
                (Some(unit), false) => unit.name.clone(),
                (None, false) => return None,
            };
            (least < most).then_some((now, (least, most), unit))
        })
    }
}

/// The plot.
#[component]
pub fn PlotPane(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let plotting = lab.plotting;
    let request = Memo::new(move |_| plotting.request());
    Effect::new(move |_| {
        lab.current.track();
        request.with(|request| lab.ask_for_plot(request.as_ref()));
    });
    // a sweep is of the document as it is after each command
    Effect::new(move |before: Option<()>| {
        lab.text.track();
        let is_sweep = request.with_untracked(|r| r.as_ref().is_some_and(|r| r.sweep.is_some()));
        if before.is_some() && is_sweep {
            request.with_untracked(|request| lab.ask_for_plot(request.as_ref()));
        }
    });
    on_cleanup(move || {
        lab.tell(|session: &mut Session, id| session.watch(id, None));
        plotting.put_sweep(None);
        plotting.plot.set(Plot::default());
    });
    let is_swept = Memo::new(move |_| plotting.of.with(|of| !of.trim().is_empty()));
    let hint = move || match (plotting.refused.get(), plotting.show.with(Vec::is_empty)) {
        (Some(why), _) => Some((true, why)),
        (None, true) => Some((false, String::from(words::PLOT_NOTHING))),
        (None, false) if is_swept.get() => {
            let notes = plotting.plot.with(|plot| plot.notes.join("; "));
            (!notes.is_empty()).then(|| (false, words::plot_ends(&notes)))
        }
        (None, false) => {
            plotting.plot.with(Plot::is_empty).then(|| (false, String::from(words::PLOT_DRAG)))
        }
    };
    view! {
        <section class="panel plot" aria-label=words::PLOT>
            <div class="plot-form">
                <Offered lab=lab />
                <Shown lab=lab />
                <label>{words::PLOT_SWEEP}
                    <input class="sweep" list="plot-values" autocomplete="off" spellcheck="false" placeholder=words::PLOT_THE_DRAG
                        prop:value=plotting.of
                        on:change=move |e| lab.sweep(event_target_value(&e).trim()) />
                </label>
                <Show when=move || is_swept.get()>
                    <End label=words::PLOT_FROM value=plotting.from />
                    <End label=words::PLOT_TO value=plotting.to />
                </Show>
                <label>{words::PLOT_OVER}
                    <input list="plot-values" autocomplete="off" spellcheck="false"
                        placeholder=move || if is_swept.get() { words::PLOT_OVER_SWEPT } else { words::PLOT_OVER_EVENT }
                        prop:value=plotting.over
                        on:change=move |e| plotting.over.set(event_target_value(&e)) />
                </label>
                <Export lab=lab />
            </div>
            {move || hint().map(|(is_wrong, words)| view! {
                <p class="quiet" class:error=is_wrong role="status">{words}</p>
            })}
            <Show when=move || plotting.plot.with(|plot| !plot.is_empty())>
                <Chart plot=plotting.plot colors=lab.colors />
            </Show>
        </section>
    }
}

/// The values that can be named, for every field of the form.
#[component]
fn Offered(lab: Lab) -> impl IntoView {
    let paths = Memo::new(move |_| {
        lab.structure.track();
        let is_shown = |row: &&ValueRow| row.number.is_some() && !row.is_layout;
        lab.values.with_untracked(|rows| {
            let rows = rows.iter().filter(is_shown).take(MOST_OFFERED);
            rows.map(|row| row.shortest.clone()).collect::<Vec<_>>()
        })
    });
    let option = |path: String| view! { <option value=path></option> };
    view! { <datalist id="plot-values">{move || paths.get().into_iter().map(option).collect_view()}</datalist> }
}

/// What is shown, and a field for more.
#[component]
fn Shown(lab: Lab) -> impl IntoView {
    let show = lab.plotting.show;
    let typed = RwSignal::new(String::new());
    let add = move || {
        let text = typed.get_untracked();
        let text = text.trim();
        if text.is_empty() {
            return;
        }
        match lab.ask_of_shown(|session, id| session.understand(id, text)) {
            Some(Err(refusal)) => lab.plotting.refused.set(Some(refusal.in_a_line())),
            _ => {
                show.update(|show| show.push(String::from(text)));
                typed.set(String::new());
            }
        }
    };
    let chip = move |(at, path): (usize, String)| {
        let label = words::plot_without(&path);
        view! {
            <li class="chip"><span>{path}</span>
                <button class="bare" aria-label=label.clone() title=label
                    on:click=move |_| show.update(|show| { if at < show.len() { show.remove(at); } })>
                    {icons::close()}</button>
            </li>
        }
    };
    view! {
        <ul class="chips" aria-label=words::PLOT_SHOWN>
            {move || show.get().into_iter().enumerate().map(chip).collect_view()}
        </ul>
        <label>{words::PLOT_SHOW}
            <input class="add" list="plot-values" autocomplete="off" spellcheck="false" placeholder=words::PLOT_ANY
                prop:value=typed
                on:input=move |e| typed.set(event_target_value(&e))
                on:change=move |_| add()
                on:keydown=move |e: KeyboardEvent| if e.key() == "Enter" { add() } />
        </label>
        <button on:click=move |_| lab.plot_selection()
            aria-disabled=move || lab.selected.with(Option::is_none).to_string()>{words::PLOT_SELECTION}</button>
    }
}

/// An end of the range.
#[component]
fn End(label: &'static str, value: RwSignal<String>) -> impl IntoView {
    view! {
        <label>{label}
            <input class="end" autocomplete="off" spellcheck="false" prop:value=value
                on:change=move |e| value.set(event_target_value(&e)) />
        </label>
    }
}

/// The plot as files.
#[component]
fn Export(lab: Lab) -> impl IntoView {
    let plot = lab.plotting.plot;
    let name = move |ending: &str| {
        let path = lab.current.get_untracked().unwrap_or_default();
        let name = path.rsplit('/').next().unwrap_or_default().trim_end_matches(".thing");
        format!("{name}-plot.{ending}")
    };
    view! {
        <Show when=move || plot.with(|plot| !plot.is_empty())>
            <button on:click=move |_| js::download(&name("csv"), &plot.with_untracked(Plot::csv))>"CSV"</button>
            <button on:click=move |_| js::download(&name("svg"), &plot.with_untracked(|p| p.svg(EXPORTED)))>"SVG"</button>
        </Show>
    }
}

/// The views that the class of what is selected defines, as buttons that plot them.
#[component]
pub fn ViewsOf(
    /// The lab.
    lab: Lab,
    /// Whose views.
    path: Memo<String>,
) -> impl IntoView {
    let views = Memo::new(move |_| {
        lab.structure.track();
        let path = session::parse_path(&path.get()).unwrap_or_default();
        lab.ask_of_shown(|session, id| session.views_of(id, &path)).unwrap_or_default()
    });
    let button = move |entry: PlotEntry| {
        let PlotEntry { title, doc, request } = entry;
        view! { <button title=doc on:click=move |_| lab.plot_view(&request)>{title}</button> }
    };
    view! {
        <Show when=move || views.with(|views| !views.is_empty())>
            <h3>{words::VIEWS_OF}</h3>
            <div class="choices views-of">{move || views.get().into_iter().map(button).collect_view()}</div>
        </Show>
    }
}
