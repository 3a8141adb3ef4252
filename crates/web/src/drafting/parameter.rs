//! The form by which a parameter is defined, or said anew: what is typed is understood at once, and what is wrong is said
//! below its field.

use crate::keyboard::focus;
use crate::lab::Lab;
use crate::words;
use leptos::prelude::*;
use session::drafting::view::{NewParameter, ParameterField, ParameterReading, StepsView};

/// The classes of parameters that can be chosen instead of the example's own.
const CLASSES: [&str; 11] = [
    "Length", "Angle", "Real", "Integer", "Bool", "Text", "Point", "Line", "Axis", "Circle", "Arc",
];

/// The fields in which something can be wrong, with the names of their inputs.
const FIELDS: [(ParameterField, &str); 3] = [
    (ParameterField::Name, "parameter"),
    (ParameterField::Example, "example"),
    (ParameterField::Allowed, "range"),
];

/// What the parts of the form share.
#[derive(Clone, Copy)]
struct Form {
    new: RwSignal<NewParameter>,
    reading: Memo<ParameterReading>,
    /// The fields that were left, or sent off: what is wrong in them is said.
    left: RwSignal<Vec<ParameterField>>,
}

impl Form {
    fn leave(self, field: ParameterField) {
        self.left.update(|left| {
            if !left.contains(&field) {
                left.push(field);
            }
        });
    }

    fn wrong(self, field: ParameterField) -> Option<String> {
        let is_left = self.left.with(|left| left.contains(&field));
        let of = |reading: &ParameterReading| {
            let mut all = reading.wrong.iter();
            all.find(|(at, _)| *at == field).map(|(_, why)| why.clone())
        };
        self.reading.with(of).filter(|_| is_left)
    }
}

/// Defines a parameter by its example, or says one anew.
#[component]
pub fn Define(
    /// The lab.
    lab: Lab,
    /// The program.
    steps: Memo<Option<StepsView>>,
) -> impl IntoView {
    let of_program = move |is_it: fn(&StepsView) -> bool| {
        Memo::new(move |_| steps.with(|steps| steps.as_ref().is_some_and(is_it)))
    };
    // what is drawn already wants the room
    let is_drawn = of_program(|steps| steps.has_steps);
    let is_first = of_program(|steps| steps.parameters.is_empty());
    let new = lab.drafting.parameter;
    let folded = RwSignal::new(false);
    let other = Memo::new(move |_| new.with(|n| n.instead_of.clone()));
    let is_other = Memo::new(move |_| other.with(|name| !name.is_empty()));
    Effect::new(move |_| folded.set(is_drawn.get()));
    // one that was refused and folded since may be changed again
    Effect::new(move |_| {
        if new.with(|n| !n.instead_of.is_empty()) {
            folded.set(false);
        }
    });
    let (reading, look_again) = read(lab);
    let form = Form { new, reading, left: RwSignal::new(Vec::new()) };
    // the next one is not wrong before it is typed
    Effect::new(move |_| {
        if new.with(|n| n.name.is_empty() && n.example.is_empty()) {
            form.left.set(Vec::new());
        }
    });
    let define = move |e: leptos::ev::SubmitEvent| {
        e.prevent_default();
        let first = reading.with_untracked(|r| r.wrong.first().map(|(field, _)| *field));
        match FIELDS.iter().find(|(field, _)| Some(*field) == first) {
            Some((field, input)) => {
                form.leave(*field);
                if *field == ParameterField::Allowed {
                    // what is wrong is seen, and may be right by now
                    unfold(true);
                    look_again();
                }
                focus(&format!(".define input[name='{input}']"));
            }
            None => {
                lab.define_parameter();
                // of one that was refused what is said further is in sight
                unfold(new.with_untracked(is_said_further));
            }
        }
    };
    // what is said of one that is changed is in sight
    Effect::new(move |_| {
        if other.with(|name| !name.is_empty()) && new.with_untracked(is_said_further) {
            unfold(true);
        }
    });
    let cancel = move |_| {
        new.set(NewParameter::default());
        unfold(false);
    };
    view! {
        <button type="button" class="unfold" data-draft="unfold" aria-expanded=move || (!folded.get()).to_string()
            on:click=move |_| {
                folded.update(|folded| *folded = !*folded);
                request_animation_frame(|| focus(".define input[name='parameter']"));
            }>{words::NEW_PARAMETER}</button>
        <form class="define" aria-label=words::DEFINE hidden=move || folded.get() on:submit=define>
            <Show when=move || is_first.get()><p class="quiet">{words::FIRST_PARAMETER}</p></Show>
            <Field form=form at=ParameterField::Name input="parameter" label=words::PARAMETER_NAME
                hint=words::NAME_HINT get=|n| &n.name set=|n, typed| n.name = typed />
            <Field form=form at=ParameterField::Example input="example" label=words::EXAMPLE
                hint=words::EXAMPLE_HINT get=|n| &n.example set=|n, typed| n.example = typed />
            <output class="understood" name="understood">
                {move || form.reading.with(|r| words::understood(&r.class, &r.value))}
            </output>
            <label><span>{words::QUESTION}</span>
                <input name="question" autocomplete="off" placeholder=words::QUESTION_HINT
                    prop:value=move || new.with(|n| n.prompt.clone())
                    on:input=move |e| new.update(|n| n.prompt = event_target_value(&e)) />
            </label>
            <Further form=form />
            <div class="line">
                <button class="primary" data-draft="define">
                    {move || if is_other.get() { words::CHANGE } else { words::DEFINE }}
                </button>
                <Show when=move || is_other.get()>
                    <button type="button" data-draft="keep-parameter"
                        on:click=cancel>{words::CANCEL}</button>
                    <button type="button" data-draft="remove-parameter"
                        on:click=move |_| lab.remove_parameter()>{words::REMOVE_PARAMETER}</button>
                </Show>
            </div>
        </form>
    }
}

/// Returns how what is typed is understood, which changes with the document and with the tables that come; and what has
/// a table looked for again.
fn read(lab: Lab) -> (Memo<ParameterReading>, impl Fn() + Copy) {
    let new = lab.drafting.parameter;
    let come = RwSignal::new(0_u32);
    let reading = Memo::new(move |_| {
        lab.drafting.turned.track();
        come.track();
        let typed = new.get();
        lab.tell(|session, id| session.read_parameter(id, &typed)).unwrap_or_default()
    });
    // a table that is named is looked for, and looked for again once another word is said of it
    let range = Memo::new(move |_| new.with(|n| n.range.clone()));
    let look_again = move || {
        lab.forget_missing_tables();
        come.update(|n| *n += 1);
    };
    Effect::new(move |_| {
        range.track();
        look_again();
    });
    Effect::new(move |_| {
        lab.drafting.turned.track();
        come.track();
        reading.track();
        lab.fetch_table(move || come.update(|n| *n += 1));
    });
    (reading, look_again)
}

/// Whether of a parameter a class or what is allowed is said.
fn is_said_further(new: &NewParameter) -> bool {
    !new.range.is_empty() || !new.class.is_empty()
}

/// Opens what else is said of a parameter, or shuts it.
fn unfold(is_open: bool) {
    let details = document().query_selector(".define details").ok().flatten();
    if let Some(details) = details {
        // It takes the attribute, or its field is found as well.
        let _ = details.toggle_attribute_with_force("open", is_open);
    }
}

/// The class, where it is another than the example's, and the values that are allowed.
#[component]
fn Further(form: Form) -> impl IntoView {
    let new = form.new;
    let class = move || match new.with(|n| n.class.is_empty()) {
        true => form.reading.with(|r| words::class_of_example(&r.class)),
        false => words::class_of_example(""),
    };
    view! {
        <details>
            <summary data-draft="further">{words::FURTHER}</summary>
            <label><span>{words::PARAMETER_CLASS}</span>
                <select name="class" prop:value=move || new.with(|n| n.class.clone())
                    on:change=move |e| new.update(|n| n.class = event_target_value(&e))>
                    <option value="">{class}</option>
                    {CLASSES.map(|class| view! { <option value=class>{words::class_of_parameter(class)}</option> }).into_iter().collect_view()}
                </select>
            </label>
            <Field form=form at=ParameterField::Allowed input="range" label=words::RANGE
                hint=words::RANGE_HINT get=|n| &n.range set=|n, typed| n.range = typed />
            <output class="understood">{move || form.reading.with(|r| r.allowed.clone())}</output>
            <p class="quiet">{words::RANGE_HELP}</p>
        </details>
    }
}

/// A field with its label, and what is wrong in it.
#[component]
fn Field(
    form: Form,
    at: ParameterField,
    /// The name of its input.
    input: &'static str,
    label: &'static str,
    /// What may be typed, for example.
    hint: &'static str,
    get: fn(&NewParameter) -> &String,
    set: fn(&mut NewParameter, String),
) -> impl IntoView {
    let wrong = Memo::new(move |_| form.wrong(at));
    let id = format!("wrong-{input}");
    view! {
        <label><span>{label}</span>
            <input name=input autocomplete="off" placeholder=hint
                aria-invalid=move || wrong.with(Option::is_some).to_string() aria-describedby=id.clone()
                prop:value=move || form.new.with(|n| get(n).clone())
                on:input=move |e| form.new.update(|n| set(n, event_target_value(&e)))
                on:change=move |_| form.leave(at) />
        </label>
        <p class="wrong" id=id role="status">{move || wrong.get()}</p>
    }
}
