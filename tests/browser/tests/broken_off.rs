//! Recordings and visits that are broken off by a page that goes, and go on in the next one.

use super::recorded::record;
use browser::Visit;
use browser::drafting::{asked, construct, enter, has, pick, press, set};
use browser::hands::{self, state};

#[tokio::test]
async fn a_recording_that_was_broken_off_goes_on_in_its_loop() {
    let visit = Visit::open_empty().await;
    visit.until("document.getElementById('picture')?.width > 10").await;
    hands::use_library(&visit, "contours").await;
    record(&visit, "Flange", &[("pitch", "20")]).await;
    // a slot at the top, and three more around the middle
    construct(&visit, "Contour.slot(from,to,radius)").await;
    for typed in ["30<90", "@20<0", "4"] {
        enter(&visit, typed).await;
    }
    construct(&visit, ":pattern(about,count)").await;
    pick(&visit, 10.0, 34.0).await;
    enter(&visit, "0,0").await;
    enter(&visit, "4").await;
    has(&visit, "=> contour.turned(about: Point(0, 0), by: nth * 360 deg / 4)").await;
    press(&visit, "[data-draft='repeat']").await;
    construct(&visit, "Circle").await;
    enter(&visit, "50,5").await;
    enter(&visit, "3").await;
    has(&visit, "circle = Circle(center: Point(50, 5), radius: 3)").await;
    visit.leave_and_return().await;
    visit.until("document.querySelector('.notice .primary')").await;
    press(&visit, ".notice .primary").await;
    press(&visit, "[data-draft='times']").await;
    asked(&visit, "was (50, 5)").await;
    // so far on from the hole of the turn before
    enter(&visit, "@pitch,0").await;
    asked(&visit, "how many turns").await;
    enter(&visit, "3").await;
    has(&visit, "repeat 3 times with center = Point(50, 5)").await;
    visit
        .until("document.querySelector(\"[data-step='turns']\").innerText.includes('3 turns')")
        .await;
    visit.picture("flange").await;
    press(&visit, "[data-draft='stop']").await;
}

#[tokio::test]
async fn a_visit_by_other_values_goes_on_where_it_was_when_its_tab_was_shut() {
    let visit = Visit::open_empty().await;
    visit.until("document.getElementById('picture')?.width > 10").await;
    record(&visit, "Sheet", &[("pitch", "60"), ("size", "25")]).await;
    press(&visit, "[data-draft='repeat']").await;
    construct(&visit, "Circle").await;
    enter(&visit, "0,0").await;
    enter(&visit, "size").await;
    has(&visit, "circle = Circle(center: Point(0, 0), radius: size)").await;
    press(&visit, "[data-draft='times']").await;
    asked(&visit, "was (0, 0)").await;
    enter(&visit, "@pitch,0").await;
    asked(&visit, "was size").await;
    enter(&visit, "size").await;
    asked(&visit, "how many turns").await;
    enter(&visit, "3").await;
    has(&visit, "repeat 3 times with center = Point(0, 0)").await;
    has(&visit, "sheet: Sheet").await;
    let own = state(&visit).await["text"].clone();
    // the third turn, by other values of both parameters
    press(&visit, "[data-visit='picked']").await;
    pick(&visit, 145.0, 0.0).await;
    let turn = "document.querySelector('[data-step=turns]').innerText.includes('turn 3 of 3')";
    let is_next = "document.querySelector(\"[data-step='turns.circle'].next\")";
    let is_there = format!("{turn} && {is_next}");
    visit.until(&is_there).await;
    set(&visit, "pitch", "70").await;
    set(&visit, "size", "30").await;
    has(&visit, "sheet: Sheet {").await;
    has(&visit, "its own values, while it is visited by others").await;
    visit.leave_and_return().await;
    visit.until("document.querySelector('.notice .primary')").await;
    press(&visit, ".notice .primary").await;
    visit.until(&is_there).await;
    for (parameter, value) in [("pitch", "70"), ("size", "30")] {
        visit
            .until(&format!(
                "document.querySelector(\"[name='value-{parameter}']\").value == {value}"
            ))
            .await;
    }
    visit.picture("visited-again").await;
    press(&visit, "[data-visit='own']").await;
    visit.until("!document.querySelector(\"[data-visit='own']\")").await;
    assert_eq!(state(&visit).await["text"], own);
    press(&visit, "[data-draft='stop']").await;
    visit.until("document.querySelector(\"[data-draft='more']\")").await;
}
