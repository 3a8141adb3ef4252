//! The table of what can be done.

use super::conditions::{
    class, constraint, document, drawn, instance, is_own, is_thing, lockable, selected, several,
};
use super::{Action, Context, Group, of_class, recording};
use crate::dialog::Wish;
use crate::dock::{Sheet, Tab};
use crate::keyboard::focus;
use crate::lab::{Drawer, Lab, Zoom};
use crate::{drafting, js, route, structure, words};
use leptos::prelude::*;
use session::view::RowKind;
use session::{Command, Path, Relations};

/// Everything that can be done, in the order of the menu.
pub const ACTIONS: &[Action] = &[
    Action {
        id: "new",
        group: Group::File,
        contexts: &[],
        label: words::NEW,
        keys: &["Alt+N"],
        enabled: |_| Ok(()),
        run: Lab::begin_new,
    },
    Action {
        id: "open",
        group: Group::File,
        contexts: &[],
        label: words::OPEN_FILE,
        keys: &["Ctrl+O"],
        enabled: |_| Ok(()),
        run: Lab::open_file,
    },
    Action {
        id: "save",
        group: Group::File,
        contexts: &[Context::Sheet],
        label: words::SAVE,
        keys: &["Ctrl+S"],
        enabled: |lab| {
            document(lab)?;
            let to_save = lab.document.with(|d| d.as_ref().is_some_and(|d| d.dirty || d.is_new()));
            if to_save { Ok(()) } else { Err(words::NOTHING_TO_SAVE) }
        },
        run: Lab::save,
    },
    Action {
        id: "save-as",
        group: Group::File,
        contexts: &[],
        label: words::SAVE_AS,
        keys: &["Ctrl+Shift+S"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.wish.set(Some(Wish::SaveAs)),
    },
    Action {
        id: "undo",
        group: Group::Edit,
        contexts: &[Context::Sheet],
        label: words::UNDO,
        keys: &["Ctrl+Z"],
        enabled: |lab| {
            let step = lab.status.with(|status| status.undo.is_some());
            let step = step || lab.dragging.with(Option::is_some) || lab.is_editing();
            document(lab).and(if step { Ok(()) } else { Err(words::NOTHING_TO_UNDO) })
        },
        run: |lab| lab.undo(),
    },
    Action {
        id: "redo",
        group: Group::Edit,
        contexts: &[Context::Sheet],
        label: words::REDO,
        keys: &["Ctrl+Shift+Z", "Ctrl+Y"],
        enabled: |lab| {
            let step = lab.status.with(|status| status.redo.is_some());
            document(lab).and(if step { Ok(()) } else { Err(words::NOTHING_TO_REDO) })
        },
        run: |lab| apply(lab, &Command::Redo),
    },
    Action {
        id: "explain",
        group: Group::Edit,
        contexts: &[Context::Sheet, Context::Thing],
        label: words::EXPLAIN,
        keys: &["W"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.why.update(|why| *why = !*why),
    },
    Action {
        id: "play",
        group: Group::Edit,
        contexts: &[Context::Thing, Context::Value],
        label: words::PLAY,
        keys: &["Alt+P"],
        enabled: |lab| {
            document(lab)?;
            let plays = lab.player.now.with(Option::is_some);
            if plays || lab.playable().is_some() { Ok(()) } else { Err(words::NO_NUMBER) }
        },
        run: Lab::play_selection,
    },
    Action {
        id: "lock",
        group: Group::Edit,
        contexts: &[Context::Thing, Context::Value],
        label: words::LOCK,
        keys: &["Shift+L"],
        enabled: |lab| lockable(lab).map(drop),
        run: |lab| {
            if let Ok(paths) = untrack(|| lockable(lab)) {
                structure::toggle_lock(lab, &paths);
            }
        },
    },
    Action {
        id: "merge",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::MERGE,
        keys: &["M"],
        enabled: |lab| match several(lab)?.len() {
            0 | 1 => Err(words::ONE_SELECTED),
            _ => Ok(()),
        },
        run: Lab::join_selection,
    },
    Action {
        id: "recognise",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::RECOGNISE,
        keys: &["Shift+R"],
        enabled: |lab| several(lab).map(drop),
        run: Lab::recognise,
    },
    Action {
        id: "hold-place",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::HOLD_PLACE,
        keys: &[],
        enabled: |lab| instance(lab).map(drop),
        run: Lab::hold_in_place,
    },
    Action {
        id: "unlink",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::UNLINK,
        keys: &[],
        enabled: |lab| drawn(lab).map(drop),
        run: Lab::unlink,
    },
    Action {
        id: "class-of",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::CLASS_OF,
        keys: &["Shift+C"],
        enabled: |lab| several(lab).map(drop),
        run: Lab::begin_class,
    },
    Action {
        id: "edit-class",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::EDIT_CLASS,
        keys: &["Shift+E"],
        enabled: |lab| {
            document(lab)?;
            match lab.class_around_selection() {
                Some(_) => Ok(()),
                None if lab.selected.with(Option::is_none) => Err(words::NOTHING_SELECTED),
                None => Err(words::NO_OWN_CLASS),
            }
        },
        run: |lab| {
            if let Some(class) = untrack(|| lab.class_around_selection()) {
                lab.edit_class(&class);
            }
        },
    },
    Action {
        id: "leave-class",
        group: Group::Join,
        contexts: &[Context::Sheet],
        label: words::LEAVE_CLASS,
        keys: &["Alt+ArrowUp"],
        enabled: |lab| match lab.prototype.with(Option::is_some) {
            true => Ok(()),
            false => Err(words::NO_CLASS_SHOWN),
        },
        run: Lab::leave_class,
    },
    Action {
        id: "kind-of",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::KIND_OF,
        keys: &["Shift+K"],
        enabled: |lab| match selected(lab)? {
            row if is_thing(&row) => Ok(()),
            _ => Err(words::NOT_A_WHOLE),
        },
        run: |lab| {
            if let Some(path) = lab.selected.get_untracked() {
                lab.wish.set(Some(Wish::Kind(path)));
            }
        },
    },
    Action {
        id: "promote",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::OF_EVERY,
        keys: &[],
        enabled: |lab| match selected(lab)? {
            row if row.kind == RowKind::Constraint => Ok(()),
            row if row.kind == RowKind::Part && row.depth > 1 => Ok(()),
            _ => Err(words::NOT_OF_ONE),
        },
        run: Lab::say_of_every,
    },
    Action {
        id: "unmerge",
        group: Group::Join,
        contexts: &[Context::Thing],
        label: words::UNMERGE,
        keys: &[],
        enabled: |lab| {
            let row = selected(lab)?;
            let merged = row.merged_with.is_some()
                || lab.structure.with(|rows| {
                    rows.iter().any(|other| other.merged_with.as_deref() == Some(&row.path))
                });
            if merged { Ok(()) } else { Err(words::NOT_MERGED) }
        },
        run: |lab| on_selection(lab, Command::Unmerge),
    },
    Action {
        id: "enable",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::ENABLE,
        keys: &[],
        enabled: |lab| constraint(lab, false),
        run: |lab| on_selection(lab, |path| Command::Enable { path, on: true }),
    },
    Action {
        id: "disable",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::DISABLE,
        keys: &[],
        enabled: |lab| constraint(lab, true),
        run: |lab| on_selection(lab, |path| Command::Enable { path, on: false }),
    },
    Action {
        id: "delete",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::DELETE,
        keys: &["Delete"],
        enabled: |lab| match several(lab)?.len() {
            1 => selected(lab).map(drop),
            _ => Ok(()),
        },
        run: Lab::delete_selection,
    },
    Action {
        id: "duplicate",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::DUPLICATE,
        keys: &["Ctrl+D"],
        enabled: |lab| several(lab).map(drop),
        run: |lab| lab.duplicate_selection(Relations::Own),
    },
    Action {
        id: "duplicate-joined",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::DUPLICATE_JOINED,
        keys: &["Ctrl+Shift+D"],
        enabled: |lab| several(lab).map(drop),
        run: |lab| lab.duplicate_selection(Relations::All),
    },
    Action {
        id: "copy",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::COPY,
        keys: &["Ctrl+C"],
        enabled: |lab| several(lab).map(drop),
        run: |lab| to_clipboard(lab.copy_selection()),
    },
    Action {
        id: "cut",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::CUT,
        keys: &["Ctrl+X"],
        enabled: |lab| several(lab).map(drop),
        run: |lab| to_clipboard(lab.cut_selection()),
    },
    Action {
        id: "paste",
        group: Group::Edit,
        contexts: &[Context::Sheet],
        label: words::PASTE,
        keys: &["Ctrl+V"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::paste_from_clipboard,
    },
    Action {
        id: "select-all",
        group: Group::Edit,
        contexts: &[Context::Sheet],
        label: words::SELECT_ALL,
        keys: &["Ctrl+A"],
        enabled: |lab| {
            document(lab)?;
            let is_something = lab.structure.with(|rows| rows.iter().any(is_own));
            if is_something { Ok(()) } else { Err(words::NOTHING_THERE) }
        },
        run: |lab| {
            lab.list();
            let things = lab.structure.with_untracked(|rows| {
                rows.iter()
                    .filter(|row| is_own(row))
                    .map(|row| row.path.clone())
                    .collect::<Vec<_>>()
            });
            lab.select_all(&things);
        },
    },
    Action {
        id: "history",
        group: Group::Edit,
        contexts: &[Context::Sheet],
        label: words::HISTORY,
        keys: &["Alt+H"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.open_drawer(Drawer::History);
            request_animation_frame(|| focus(".history [aria-current]"));
        },
    },
    Action {
        id: "rename",
        group: Group::Edit,
        contexts: &[Context::Thing],
        label: words::RENAME,
        keys: &["F2"],
        enabled: |lab| selected(lab).map(drop),
        run: |lab| {
            if let Some(path) = lab.selected.get_untracked() {
                lab.wish.set(Some(Wish::Rename(path)));
            }
        },
    },
    Action {
        id: "menu",
        group: Group::Go,
        contexts: &[],
        label: words::MENU,
        keys: &["Shift+F10", "ContextMenu"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::open_menu_at_selection,
    },
    Action {
        id: "select",
        group: Group::Tool,
        contexts: &[],
        label: words::SELECT,
        keys: &["V"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.end_constructions();
            lab.drop_tool();
            focus("#picture");
        },
    },
    Action {
        id: "tool-point",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_POINT,
        keys: &["P"],
        enabled: |lab| class(lab, "Point"),
        run: |lab| hold(lab, "Point"),
    },
    Action {
        id: "tool-line",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_LINE,
        keys: &["L"],
        enabled: |lab| class(lab, "Line"),
        run: |lab| hold(lab, "Line"),
    },
    Action {
        id: "tool-circle",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_CIRCLE,
        keys: &["C"],
        enabled: |lab| class(lab, "Circle"),
        run: |lab| hold(lab, "Circle"),
    },
    Action {
        id: "tool-arc",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_ARC,
        keys: &["A"],
        enabled: |lab| class(lab, "Arc"),
        run: |lab| hold(lab, "Arc"),
    },
    Action {
        id: "tool-rectangle",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_RECTANGLE,
        keys: &["R"],
        enabled: |lab| class(lab, "Rectangle"),
        run: |lab| hold(lab, "Rectangle"),
    },
    Action {
        id: "tool-regularpolygon",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_POLYGON,
        keys: &["N"],
        enabled: |lab| class(lab, "RegularPolygon"),
        run: |lab| hold(lab, "RegularPolygon"),
    },
    Action {
        id: "tool-caption",
        group: Group::Tool,
        contexts: &[],
        label: words::TOOL_TEXT,
        keys: &["T"],
        enabled: |lab| class(lab, "Caption"),
        run: |lab| hold(lab, "Caption"),
    },
    Action {
        id: "dimension",
        group: Group::Tool,
        contexts: &[Context::Thing],
        label: words::DIMENSION,
        keys: &["D"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::dimension,
    },
    Action {
        id: "constrain",
        group: Group::Tool,
        contexts: &[Context::Thing],
        label: words::CONSTRAIN,
        keys: &["K"],
        enabled: |lab| {
            several(lab)?;
            if lab.offers().is_empty() { Err(words::NOTHING_TO_SAY) } else { Ok(()) }
        },
        run: |_| focus(".strip button"),
    },
    Action {
        id: "equation",
        group: Group::Tool,
        contexts: &[Context::Thing],
        label: words::EQUATION,
        keys: &["E"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::begin_equation,
    },
    Action {
        id: "number",
        group: Group::Tool,
        contexts: &[Context::Sheet],
        label: words::NUMBER,
        keys: &["Shift+N"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.wish.set(Some(Wish::Number)),
    },
    Action {
        id: "insert",
        group: Group::Tool,
        contexts: &[Context::Sheet],
        label: words::INSERT,
        keys: &["I"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.open_drawer(Drawer::Bin);
            request_animation_frame(|| focus(".bin input"));
        },
    },
    Action {
        id: "deselect",
        group: Group::Edit,
        contexts: &[],
        label: words::DESELECT,
        keys: &["Escape"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::escape,
    },
    Action {
        id: "fit",
        group: Group::View,
        contexts: &[Context::Sheet],
        label: words::FIT,
        keys: &["F"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::Fit)),
    },
    Action {
        id: "zoom-in",
        group: Group::View,
        contexts: &[],
        label: words::ZOOM_IN,
        keys: &["+", "="],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::By(1.25))),
    },
    Action {
        id: "zoom-out",
        group: Group::View,
        contexts: &[],
        label: words::ZOOM_OUT,
        keys: &["-"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.zoom.set(Some(Zoom::By(0.8))),
    },
    Action {
        id: "grid",
        group: Group::View,
        contexts: &[Context::Sheet],
        label: words::GRID,
        keys: &["G"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::toggle_grid,
    },
    Action {
        id: "annotations",
        group: Group::View,
        contexts: &[Context::Sheet],
        label: words::ANNOTATIONS,
        keys: &["Shift+D"],
        enabled: |lab| document(lab).map(drop),
        run: Lab::toggle_annotations,
    },
    of_class::INSERT,
    of_class::EDIT,
    of_class::RENAME,
    of_class::DELETE,
    crate::plot::SWEEP,
    recording::REPEAT,
    recording::IF,
    recording::GO,
    Action {
        id: "go-picture",
        group: Group::Go,
        contexts: &[],
        label: words::GO_PICTURE,
        keys: &["Alt+1"],
        enabled: |lab| document(lab).map(drop),
        run: |_| focus("#picture"),
    },
    Action {
        id: "go-structure",
        group: Group::Go,
        contexts: &[],
        label: words::GO_STRUCTURE,
        keys: &["Alt+2"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.open_drawer(Drawer::Structure);
            request_animation_frame(|| focus("[role=treeitem][tabindex='0']"));
        },
    },
    Action {
        id: "go-draw",
        group: Group::Go,
        contexts: &[],
        label: words::GO_DRAW,
        keys: &["Alt+7"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.open_drawer(Drawer::Draw);
            request_animation_frame(drafting::focus_drawer);
        },
    },
    Action {
        id: "go-values",
        group: Group::Go,
        contexts: &[],
        label: words::GO_VALUES,
        keys: &["Alt+3"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.go_to_dock(Tab::Table, ".dock .field"),
    },
    Action {
        id: "go-text",
        group: Group::Go,
        contexts: &[],
        label: words::GO_TEXT,
        keys: &["Alt+4"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.open_dock(Tab::Text);
            request_animation_frame(|| {
                // before the editor has come, its place: it takes the keyboard over
                focus("#editor");
                focus(".cm-content");
            });
        },
    },
    Action {
        id: "go-plot",
        group: Group::Go,
        contexts: &[],
        label: words::GO_PLOT,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.go_to_dock(Tab::Plot, "#tab-plot"),
    },
    Action {
        id: "go-family",
        group: Group::Go,
        contexts: &[],
        label: words::GO_FAMILY,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: |lab| lab.go_to_dock(Tab::Family, "#tab-family"),
    },
    Action {
        id: "go-inspector",
        group: Group::Go,
        contexts: &[],
        label: words::GO_INSPECTOR,
        keys: &["Alt+5"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.sheet.set(Sheet::Inspector);
            request_animation_frame(|| {
                let field = ".inspector .field";
                let is_there =
                    leptos::prelude::document().query_selector(field).ok().flatten().is_some();
                focus(if is_there { field } else { ".inspector button" });
            });
        },
    },
    Action {
        id: "go-why",
        group: Group::Go,
        contexts: &[],
        label: words::GO_WHY,
        keys: &["Alt+6"],
        enabled: |lab| document(lab).map(drop),
        run: |lab| {
            lab.why.set(true);
            request_animation_frame(|| focus("#why .scroll button"));
        },
    },
    Action {
        id: "download",
        group: Group::File,
        contexts: &[],
        label: words::DOWNLOAD,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::download,
    },
    Action {
        id: "share",
        group: Group::File,
        contexts: &[],
        label: words::SHARE,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::share,
    },
    Action {
        id: "export-svg",
        group: Group::File,
        contexts: &[],
        label: words::EXPORT_SVG,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::export_svg,
    },
    Action {
        id: "export-png",
        group: Group::File,
        contexts: &[],
        label: words::EXPORT_PNG,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::export_png,
    },
    Action {
        id: "export-dxf",
        group: Group::File,
        contexts: &[],
        label: words::EXPORT_DXF,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::export_dxf,
    },
    Action {
        id: "export-csv",
        group: Group::File,
        contexts: &[],
        label: words::EXPORT_CSV,
        keys: &[],
        enabled: |lab| document(lab).map(drop),
        run: Lab::export_csv,
    },
    Action {
        id: "plot",
        group: Group::View,
        contexts: &[Context::Thing, Context::Value],
        label: words::PLOT_SELECTION,
        keys: &["Shift+P"],
        enabled: |lab| {
            document(lab)?;
            if lab.selected.with(Option::is_some) { Ok(()) } else { Err(words::NOTHING_PLOTTED) }
        },
        run: Lab::plot_selection,
    },
    Action {
        id: "print",
        group: Group::File,
        contexts: &[],
        label: words::PRINT,
        keys: &["Ctrl+P"],
        enabled: |lab| document(lab).map(drop),
        run: |_| js::print(),
    },
    Action {
        id: "gallery",
        group: Group::File,
        contexts: &[],
        label: words::OPEN_GALLERY,
        keys: &[],
        enabled: |_| Ok(()),
        run: |_| route::go(route::GALLERY),
    },
    Action {
        id: "theme",
        group: Group::View,
        contexts: &[],
        label: words::THEME,
        keys: &[],
        enabled: |_| Ok(()),
        run: |lab| lab.colors.theme.update(|theme| *theme = theme.next()),
    },
    Action {
        id: "palette",
        group: Group::Go,
        contexts: &[],
        label: words::PALETTE,
        keys: &["Ctrl+K", "Ctrl+Shift+P", "?", "F1"],
        enabled: |_| Ok(()),
        run: |lab| lab.palette.update(|open| *open = !*open),
    },
];

/// Takes the tool that makes things of a class; the picture gets the keyboard.
fn hold(lab: Lab, class: &str) {
    lab.draw_with(class);
    focus("#picture");
}

/// Gives the clipboard a text; where the browser does not let it, the lab has it.
fn to_clipboard(text: Option<String>) {
    if let Some(text) = text {
        leptos::task::spawn_local(async move { drop(js::copy(&text).await) });
    }
}

fn apply(lab: Lab, command: &Command) {
    lab.apply(command);
}

fn on_selection(lab: Lab, command: impl FnOnce(Path) -> Command) {
    let path = lab.selected.get_untracked().and_then(|path| session::parse_path(&path));
    if let Some(path) = path {
        lab.apply(&command(path));
    }
}
