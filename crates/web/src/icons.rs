//! The page's icons, drawn as lines of the text's colour.

use leptos::prelude::*;

fn icon(path: &'static str) -> AnyView {
    view! {
        <svg class="icon" viewBox="0 0 16 16" width="16" height="16" aria-hidden="true" fill="none"
            stroke="currentColor" stroke-width="1.5" stroke-linecap="round" stroke-linejoin="round">
            <path d=path></path>
        </svg>
    }
    .into_any()
}

/// The icon of a tool, by its action.
pub fn of_tool(action: &str) -> AnyView {
    icon(match action {
        "select" => "M4 2.500l8 6-3.600.600L6.500 13z",
        "tool-point" => {
            "M8 6.500a1.500 1.500 0 100 3a1.500 1.500 0 000-3zM8 2v2M8 12v2M2 8h2M12 8h2"
        }
        "tool-line" => "M3.500 12.500l9-9M2.500 13.500h2v-2h-2zM11.500 4.500h2v-2h-2z",
        "tool-circle" => "M8 2.500a5.500 5.500 0 100 11a5.500 5.500 0 000-11zM8 7.800v.400",
        "tool-arc" => {
            "M2.500 12.500A10 10 0 0112.500 2.500M2.500 12.500v.100M12.500 2.500v.100M12 12v.400"
        }
        "tool-rectangle" => "M2.500 4h11v8h-11z",
        "tool-regularpolygon" => "M5 3h6l3 5-3 5H5L2 8z",
        "tool-caption" => "M3.500 5V3h9v2M8 3v10M6 13h4",
        "equation" => "M3 6h5M3 10h5M10.500 4.500l3 7M13.500 4.500l-3 7",
        "number" => "M2.500 8h4M9.500 8h4M8 6.500a1.500 1.500 0 100 3a1.500 1.500 0 000-3z",
        "insert" => "M3 6.500h10v6.500H3zM8 1.500v7M5.500 6L8 8.500 10.500 6",
        "dimension" => "M2.500 4v8M13.500 4v8M3 8h10M5 6L3 8l2 2M11 6l2 2-2 2",
        "constrain" => "M3 5.500h10M3 10.500h10",
        _ => "M8 3v10M3 8h10",
    })
}
/// An arrow head to the right.
pub fn chevron() -> AnyView {
    icon("M6 4l4 4-4 4")
}
/// A triangle to the right.
pub fn play() -> AnyView {
    icon("M5 3l8 5-8 5z")
}
/// A pencil.
pub fn edit() -> AnyView {
    icon("M3 13l.700-3L10.500 3.200l2.300 2.300L6 12.300zM9 4.700L11.300 7")
}
/// A square.
pub fn stop() -> AnyView {
    icon("M4.500 4.500h7v7h-7z")
}
/// Two rings of a chain.
pub fn link() -> AnyView {
    icon("M6.5 9.5l3-3M7 4.5l1-1a2.8 2.8 0 014 4l-1 1M9 11.5l-1 1a2.8 2.8 0 01-4-4l1-1")
}
/// A shut padlock.
pub fn locked() -> AnyView {
    icon("M4 7.5h8v6H4zM5.5 7.5V5a2.5 2.5 0 015 0v2.5M8 10v1.5")
}
/// An open padlock.
pub fn unlocked() -> AnyView {
    icon("M4 7.5h8v6H4zM5.5 7.5V4.5a2.5 2.5 0 014.9-.7")
}
/// An arrow that turns back.
pub fn undo() -> AnyView {
    icon("M6 3L3 6l3 3M3 6h6.5a3.5 3.5 0 010 7H7")
}
/// An arrow that turns forward.
pub fn redo() -> AnyView {
    icon("M10 3l3 3-3 3M13 6H6.500a3.5 3.5 0 000 7H9")
}
/// An arrow down into a tray.
pub fn save() -> AnyView {
    icon("M8 2.500v7M5 7l3 3 3-3M3 10.500v3h10v-3")
}
/// Four squares.
pub fn gallery() -> AnyView {
    icon(
        "M2.500 2.500h4.500v4.500H2.500zM9 2.500h4.500v4.500H9zM2.500 9h4.500v4.500H2.500zM9 9h4.500v4.500H9z",
    )
}
/// A magnifying glass.
pub fn search() -> AnyView {
    icon("M7 12A5 5 0 107 2a5 5 0 000 10zM10.700 10.700L14 14")
}
/// A disc, half of it dark.
pub fn theme() -> AnyView {
    icon(
        "M8 2.200a5.800 5.800 0 100 11.600a5.800 5.800 0 000-11.600zM8 2.200v11.600M8 5h4.800M8 8h5.700M8 11h4.800",
    )
}
/// A cross.
pub fn close() -> AnyView {
    icon("M4 4l8 8M12 4l-8 8")
}
/// A tick.
pub fn holds() -> AnyView {
    icon("M3 8.500l3.500 3.500L13 4.500")
}
/// An exclamation mark in a triangle.
pub fn warning() -> AnyView {
    icon("M8 2.500L14 13.500H2zM8 6.500v3M8 11.500v.1")
}
