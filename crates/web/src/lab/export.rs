//! What leaves the lab: the picture as SVG, PNG or DXF, the values as CSV, print, and a link that carries the document.

use super::{ABSENT, Lab, Notice};
use crate::server::Stored;
use crate::{js, route, words};
use leptos::prelude::*;
use presentation::annotations::draw_for_dxf;
use presentation::sheet::printed_true;
use presentation::table::csv;
use session::Session;
use session::view::PictureView;

/// Longer links than this are not opened by every program, in letters.
const LONGEST_LINK: usize = 30_000;

impl Lab {
    /// The file's name without its ending, and the picture, once what is typed beside it is in it.
    fn drawn(self) -> Option<(String, PictureView)> {
        self.flush_text();
        let path = self.current.get_untracked()?;
        let name = path.rsplit('/').next().unwrap_or(&path);
        let name = String::from(name.trim_end_matches(".thing"));
        Some((name, self.ask_of_shown(Session::picture)?))
    }

    /// The picture as SVG with what stands on it, where a unit has so many pixels, or of a readable size.
    fn svg_of(self, mut picture: PictureView, pixels: Option<f64>) -> String {
        let usual = if self.shows_notes() { session::roomy } else { session::readable };
        let pixels = pixels.unwrap_or_else(|| usual(&picture));
        self.draw_notes(&mut picture, pixels);
        session::svg_at(&picture, pixels)
    }

    /// Hands the user the picture as SVG.
    pub fn export_svg(self) {
        if let Some((name, picture)) = self.drawn() {
            js::download(&format!("{name}.svg"), &self.svg_of(picture, None));
        }
    }

    /// Hands the user the picture as PNG, at twice its size.
    pub fn export_png(self) {
        if let Some((name, picture)) = self.drawn() {
            js::download_png(&format!("{name}.png"), &self.svg_of(picture, None));
        }
    }

    /// Hands the user the picture as DXF, in millimetres.
    pub fn export_dxf(self) {
        let Some((name, mut picture)) = self.drawn() else { return };
        draw_for_dxf(&mut picture, |picture, pixels| self.draw_notes(picture, pixels));
        if let Some(dxf) = self.ask_of_shown(|session, id| session.dxf_of(id, &picture)) {
            js::download(&format!("{name}.dxf"), &dxf);
        }
    }

    /// The title of what is printed, and the picture in lines: as large as it is where a page has room for it, else
    /// whether it is to be fitted to the page.
    pub fn printed(self) -> Option<(String, String, bool)> {
        let (_, picture) = self.drawn()?;
        // what stands on it needs room on the page as well
        let has_room = |scale: &f64| {
            let mut noted = picture.clone();
            self.draw_notes(&mut noted, *scale);
            printed_true(&noted.drawing, noted.millimetres).is_some()
        };
        let scale = printed_true(&picture.drawing, picture.millimetres).filter(has_room);
        let title = self.document.with_untracked(|d| d.as_ref().map(|d| d.title.clone()))?;
        let svg = self.svg_of(picture, scale);
        Some(match scale {
            Some(_) => (words::true_size(&title), svg, false),
            None => (title, svg, true),
        })
    }

    /// Hands the user the values as CSV.
    pub fn export_csv(self) {
        if let Some((name, _)) = self.drawn() {
            self.list();
            js::download(&format!("{name}.csv"), &self.values.with_untracked(|rows| csv(rows)));
        }
    }

    /// Copies an address that carries the whole document.
    pub fn share(self) {
        self.flush_text();
        let Some(name) = self.current.get_untracked() else { return };
        let name = String::from(name.rsplit('/').next().unwrap_or(&name));
        let text = self.text.with_untracked(|text| text.source.clone());
        leptos::task::spawn_local(async move {
            let packed = js::pack(&format!("{name}\n{text}")).await.as_string().unwrap_or_default();
            let link = route::share(&packed);
            if link.len() > LONGEST_LINK {
                self.say_refused(words::link_too_long(link.len(), LONGEST_LINK));
                return;
            }
            let copied = js::copy(&link).await.is_truthy();
            if !copied {
                route::replace(&route::to_shared(&packed));
            }
            let said = if copied { words::LINK_COPIED } else { words::LINK_IN_BAR };
            self.notice.set(Some(Notice::Said(String::from(said))));
        });
    }

    /// Makes a new document of what a link carries.
    pub fn open_shared(self, packed: &str) {
        let packed = String::from(packed);
        leptos::task::spawn_local(async move {
            let unpacked = js::unpack(&packed).await.as_string();
            let Some((name, text)) = unpacked.as_deref().and_then(|all| all.split_once('\n'))
            else {
                self.arriving.set(false);
                self.say_refused(String::from(words::LINK_BROKEN));
                return;
            };
            let path = self.free_path(name.trim_end_matches(".thing")).await;
            let (text, version) = (String::from(text), String::from(ABSENT));
            match self.take_up(&path, Stored { text, version, writable: true }).await {
                Ok(_) => route::go(&route::to(&path)),
                Err(message) => {
                    self.arriving.set(false);
                    self.say_refused(message);
                }
            }
        });
    }
}
