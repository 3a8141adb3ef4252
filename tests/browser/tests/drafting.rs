//! Drawing by constructions, and a program recorded by drawing one example: with the mouse, and without a line of text.

use browser::Visit;
use browser::drafting::{asked, calculate, define, enter, fill, has, pick, press, set, submit};
use browser::hands::{chord, state, text_of};

#[tokio::test]
async fn the_circle_that_is_nearest_to_the_picks_is_drawn() {
    let visit = Visit::open(Some("belt.thing")).await;
    visit.until("document.querySelector('#tab-draw')").await;
    press(&visit, "#tab-draw").await;
    press(&visit, "[data-construction='Circle.tangent(first,second,radius)']").await;
    // the ground from above, and the larger wheel from its right: the circle lies between
    pick(&visit, 60.0, -100.0).await;
    pick(&visit, 58.0, -15.0).await;
    enter(&visit, "20").await;
    let text = text_of(&state(&visit).await);
    assert!(text.contains("circle => Circle.tangent("), "{text}");
    assert!(text.contains("ground") && text.contains("radius: 20"), "{text}");
}

#[tokio::test]
async fn a_washer_is_recorded_by_drawing_one() {
    let visit = Visit::open(Some("belt.thing")).await;
    visit.until("document.querySelector('#tab-draw')").await;
    press(&visit, "#tab-draw").await;
    visit.actions.set(0);
    fill(&visit, "input[name='program']", "Washer").await;
    press(&visit, "[data-draft='record']").await;
    for (name, example, question) in
        [("inner", "84", "Clearance hole?"), ("outer", "160", "Outer diameter?")]
    {
        fill(&visit, "input[name='question']", question).await;
        define(&visit, name, example).await;
    }
    press(&visit, "[data-construction='Circle']").await;
    pick(&visit, 290.0, -70.0).await;
    enter(&visit, "inner / 2").await;
    pick(&visit, 290.0, -70.0).await;
    enter(&visit, "outer / 2").await;
    visit.until("document.querySelectorAll('.steps li').length === 2").await;
    let text = text_of(&state(&visit).await);
    assert!(text.contains("circle2 = Circle(center: circle.center, radius: outer / 2)"), "{text}");
    press(&visit, "[data-draft='stop']").await;
    assert_eq!(visit.actions.get(), 16);
    press(&visit, "#tab-bin").await;
    visit.until("document.querySelector(\".tile[data-class='Washer']\")").await;
}

/// Records figure 7.6 up to the end of its first turn.
async fn first_ring(visit: &Visit) {
    visit.until("document.querySelector('main') && window.__thinglab").await;
    visit.script("location.hash = '#/figure.thing'").await;
    visit.until("window.__thinglab.state().path === 'figure.thing'").await;
    press(visit, "#tab-draw").await;
    visit.actions.set(0);
    fill(visit, "input[name='program']", "Rings").await;
    press(visit, "[data-draft='record']").await;
    for (name, example) in [("radius", "40"), ("minimum", "2")] {
        define(visit, name, example).await;
    }
    press(visit, "[data-construction='Axis.horizontal(y)']").await;
    // a click on a free place is all of how high
    pick(visit, 200.0, 0.0).await;
    press(visit, "[data-construction='Axis.vertical(x)']").await;
    pick(visit, 0.0, 200.0).await;
    press(visit, "[data-draft='repeat']").await;
    press(visit, "[data-construction='Circle.tangent(first,second,radius)']").await;
    pick(visit, -40.0, 0.0).await;
    pick(visit, 0.0, 40.0).await;
    press(visit, "[data-parameter='radius']").await;
    visit.until("window.__thinglab.state().text.includes('circle = ')").await;
    press(visit, "[data-construction='Circle.concentric(with,radius)']").await;
    pick(visit, -80.0, 40.0).await;
    press(visit, "[data-draft='calculator']").await;
    // the keys leave the drawing in sight
    visit.until("document.querySelector('.prompt').offsetWidth < 400").await;
    press(visit, "[data-measure='radius']").await;
    pick(visit, -80.0, 40.0).await;
    visit.until("document.querySelector('[name=operand]').value === 'circle.radius'").await;
    calculate(visit, &["÷", "2"]).await;
    visit.until("document.querySelector('.computed').innerText.includes('20')").await;
    calculate(visit, &["M", "give"]).await;
    visit.until("window.__thinglab.state().text.includes('circle2 = ')").await;
}

#[tokio::test]
async fn figure_7_6_is_drawn_as_its_chapter_tells() {
    let visit = Visit::open_empty().await;
    first_ring(&visit).await;
    press(&visit, "[data-draft='until']").await;
    // the horizontal becomes the first circle, the vertical stays, the radius becomes half of the circle's
    asked(&visit, "was axis:").await;
    pick(&visit, -20.0, 74.6).await;
    asked(&visit, "was axis2").await;
    press(&visit, "[data-draft='same']").await;
    asked(&visit, "was radius").await;
    press(&visit, "[data-draft='calculator']").await;
    // the same expression as in the first turn, which the calculator has kept
    calculate(&visit, &["MR", "give"]).await;
    asked(&visit, "after the last turn").await;
    press(&visit, "[data-measure='radius']").await;
    pick(&visit, -80.0, 40.0).await;
    calculate(&visit, &["<"]).await;
    press(&visit, "[data-parameter='minimum']").await;
    visit.until("document.querySelector('.computed').innerText.includes('false')").await;
    calculate(&visit, &["give"]).await;
    visit.until("window.__thinglab.state().text.includes('until circle.radius < minimum')").await;
    let of_turns = "document.querySelector(\"[data-step='turns']\").innerText";
    visit.until(&format!("{of_turns}.includes('6 turns')")).await;
    // the mirror is of every circle of the loop
    press(&visit, "[data-construction='Point:mirrored']").await;
    for _ in 0..2 {
        press(&visit, "[data-draft='wider']").await;
    }
    pick(&visit, -80.0, 40.0).await;
    pick(&visit, 0.0, 200.0).await;
    visit.until("window.__thinglab.state().text.includes('turns.mirrored(about: axis2)')").await;
    press(&visit, "[data-draft='stop']").await;
    assert_eq!(visit.actions.get(), 43);
    let text = text_of(&state(&visit).await);
    let wanted = "turns = repeat with first = axis, radius2 = radius {
        circle = Circle.tangent(first, axis2, radius: radius2)
        circle2 = Circle.concentric(with: circle, radius: circle.radius / 2)
        next first = -circle, radius2 = (circle.radius / 2)
    } until circle.radius < minimum";
    assert!(text.contains(wanted), "{text}");
    // 40, 20, 10, 5, 2.5; and 80 before them
    for (parameter, value, turns) in [("minimum", "5", 5), ("radius", "80", 6)] {
        set(&visit, parameter, value).await;
        visit.until(&format!("{of_turns}.includes('{turns} turns')")).await;
    }
}

#[tokio::test]
async fn a_wrong_step_is_found_by_what_it_drew_and_replaced() {
    let visit = Visit::open_empty().await;
    first_ring(&visit).await;
    press(&visit, "[data-draft='times']").await;
    asked(&visit, "was axis:").await;
    pick(&visit, -20.0, 74.6).await;
    asked(&visit, "was axis2").await;
    press(&visit, "[data-draft='same']").await;
    asked(&visit, "was radius").await;
    enter(&visit, "circle.radius / 2").await;
    asked(&visit, "how many turns").await;
    enter(&visit, "3").await;
    visit.until("window.__thinglab.state().text.includes('repeat 3 times')").await;
    // the outer circle of the second turn is picked: its step comes next
    press(&visit, "[data-visit='picked']").await;
    pick(&visit, -40.0, 96.6).await;
    visit.until("document.querySelector('.steps .next')?.dataset.step === 'turns.circle'").await;
    // its rows tell that turn
    let told = "document.querySelector(\"[data-step='turns'] .step\").innerText";
    visit.until(&format!("{told}.includes('turn 2 of 3')")).await;
    // without a pointer the arrow keys go through what is drawn
    press(&visit, "[data-visit='end']").await;
    press(&visit, "[data-visit='picked']").await;
    visit.until("document.activeElement?.id === 'picture'").await;
    for _ in 0..12 {
        chord(&visit, &[], '\u{E014}').await;
        let told = "return document.body.innerText.includes('turns[1].circle: Enter')";
        if visit.script(told).await == true {
            break;
        }
    }
    chord(&visit, &[], '\u{E007}').await;
    visit.until("document.querySelector('.steps .next')?.dataset.step === 'turns.circle'").await;
    visit.until(&format!("{told}.includes('turn 2 of 3')")).await;
    // the inner circle shall have a quarter of the radius
    press(&visit, "[data-step='turns.circle2'] [data-step-replace]").await;
    press(&visit, "[data-construction='Circle.concentric(with,radius)']").await;
    pick(&visit, -40.0, 96.6).await;
    enter(&visit, "circle.radius / 4").await;
    visit
        .until("window.__thinglab.state().text.includes('with: circle, radius: circle.radius / 4')")
        .await;
    // its numbers stand on the drawing: another one is typed there
    press(&visit, "[data-step='turns.circle2'] .step").await;
    let number = "document.querySelector(\"[data-step-number='radius']\")";
    visit.until(&format!("{number}?.innerText.includes('5')")).await;
    visit
        .script(&format!("{number}.dispatchEvent(new MouseEvent('dblclick', {{bubbles: true}}))"))
        .await;
    visit.until("document.activeElement?.name === 'step-number'").await;
    submit(&visit, "input[name='step-number']", "circle.radius / 8").await;
    visit.until("window.__thinglab.state().text.includes('radius: circle.radius / 8')").await;
    // how often the loop runs is asked anew, from what it was
    press(&visit, "[data-step='turns'] .step").await;
    press(&visit, "[data-step-operand='times']").await;
    asked(&visit, "is 3").await;
    visit
        .until("getSelection().toString() === '3' || document.activeElement?.selectionEnd === 1")
        .await;
    enter(&visit, "4").await;
    visit.until("window.__thinglab.state().text.includes('repeat 4 times')").await;
    // a step that another one speaks of: that one is asked about
    press(&visit, "[data-step='turns.circle'] [data-step-delete]").await;
    asked(&visit, "is drawn from circle").await;
    press(&visit, "[data-draft='back']").await;
    press(&visit, "[data-visit='end']").await;
    press(&visit, "[data-draft='stop']").await;
}

#[tokio::test]
async fn a_family_is_a_grid_in_which_rows_are_changed_and_used() {
    let visit = Visit::open(Some("bearing.thing")).await;
    press(&visit, "#tab-family").await;
    let outcome = |row: &str| {
        format!("document.querySelector(\"[data-row='{row}'] .outcome\")?.innerText ?? ''")
    };
    visit.until(&format!("{} === 'drawn'", outcome("6210"))).await;
    press(&visit, "[data-family='take']").await;
    visit
        .until("window.__thinglab.state().text.includes('(\"6204\", 20 mm, 47 mm, 14 mm, 8)')")
        .await;
    // an outer diameter within the bore
    visit.until("!document.querySelector(\"[data-cell='4,2']\").readOnly").await;
    visit.script("document.querySelector(\"[data-cell='4,2']\").select()").await;
    submit(&visit, "[data-cell='4,2']", "10 mm").await;
    visit.until(&format!("{}.includes('wall is not met')", outcome("6204"))).await;
    press(&visit, "[data-row='6206'] [data-family='apply']").await;
    visit.until("window.__thinglab.state().text.includes('outer = 62')").await;
    // placed, it has a place of its own
    press(&visit, "[data-row='6206'] [data-family='place']").await;
    visit.until("window.__thinglab.state().text.includes(': Placed of Bearing {')").await;
    press(&visit, "[data-family='pictures']").await;
    visit.until("document.querySelectorAll('.specimen img').length === 10").await;
    // a drawing for each row in one archive: what it says at its end is how many there are
    visit
        .script(
            "const was = URL.createObjectURL;
             URL.createObjectURL = blob => {
                 blob.arrayBuffer().then(bytes => { window.archive = new DataView(bytes); });
                 return was.call(URL, blob);
             };",
        )
        .await;
    for format in ["svg", "dxf"] {
        visit.script("window.archive = undefined").await;
        press(&visit, &format!("[data-family='save-{format}']")).await;
        // the row whose diameters do not fit is left out
        visit
            .until("window.archive?.getUint16(0) === 0x504b && archive.getUint16(archive.byteLength - 12, true) === 10")
            .await;
    }
    press(&visit, "[data-family='map']").await;
    visit
        .until("document.querySelector('.map path.now') && document.querySelector('.map .look-2')")
        .await;
}

#[tokio::test]
async fn a_table_that_changed_is_read_again_and_a_block_of_cells_is_pasted() {
    let visit = Visit::open(Some("bearing.thing")).await;
    press(&visit, "#tab-family").await;
    visit.until("document.querySelector(\"[data-row='6210']\")").await;
    let table = include_str!("../../../gallery/bearing.csv");
    visit.put("bearing.csv", &format!("{}\n6211,55,100,21,10\n", table.trim_end()));
    // one comes back from the spreadsheet
    visit.script("window.dispatchEvent(new Event('focus'))").await;
    let outcome = |row: &str| {
        format!("document.querySelector(\"[data-row='{row}'] .outcome\")?.innerText ?? ''")
    };
    visit.until(&format!("{} === 'drawn'", outcome("6211"))).await;
    press(&visit, "[data-family='take']").await;
    // two rows, the second without its last cell, from the row that is not there yet
    visit.until("document.querySelector(\"[data-cell='11,0']\")").await;
    visit
        .script(
            "const data = new DataTransfer();
             data.setData('text/plain', '6212\\t60\\t110\\t22\\t10\\n6213\\t65\\t120\\t23\\t\\n');
             document.querySelector(\"[data-cell='11,0']\").dispatchEvent(
                 new ClipboardEvent('paste', { clipboardData: data, bubbles: true, cancelable: true }))",
        )
        .await;
    visit.until(&format!("{} === 'drawn'", outcome("6213"))).await;
    has(&visit, "(\"6212\", 60, 110, 22, 10)").await;
    // what is refused is marked where it stands
    submit(&visit, "[data-cell='12,1']", "5 kg").await;
    visit.until("document.querySelector(\"[data-cell='12,1'][aria-invalid='true']\")").await;
    visit.picture("family-pasted").await;
}
