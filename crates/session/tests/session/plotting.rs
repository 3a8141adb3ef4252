//! Plots: sweeps, loci, samples of a drag, and what is said where there is nothing to plot.

use crate::desk::{Desk, at, gallery};
use session::plotting::{Plot, Request, Sweep};

fn swept(desk: &Desk, show: &[&str], (of, from, to): (&str, &str, &str), steps: u32) -> Plot {
    desk.session
        .plot(desk.id, &request(show, (of, from, to), steps))
        .expect("the sweep is possible")
}

fn request(show: &[&str], (of, from, to): (&str, &str, &str), steps: u32) -> Request {
    let [of, from, to] = [of, from, to].map(String::from);
    let show = show.iter().map(|s| String::from(*s)).collect();
    Request { show, over: None, sweep: Some(Sweep { of, from, to, steps }) }
}

#[test]
fn the_voltage_over_a_resistance_is_that_of_a_divider() {
    let desk = Desk::of(&gallery("voltage-divider"));
    let before = desk.text();
    let plot = swept(
        &desk,
        &["voltmeter.voltage", "r2.resistance * meter.current"],
        ("r2.resistance", "10 ohm", "410 ohm"),
        40,
    );
    assert_eq!((plot.over.unit.as_str(), plot.curves[0].axis.unit.as_str()), ("ohm", "V"));
    for curve in &plot.curves {
        assert_eq!(curve.points.len(), 41);
        for &(r, u) in curve.points.iter().flatten() {
            assert!((u - 1.5 * r / (100.0 + r)).abs() < 1e-9, "{u} V over {r} ohm");
        }
    }
    assert!(plot.notes.is_empty(), "{:?}", plot.notes);
    assert_eq!(desk.text(), before);
    // held by an anchor against drags, it is set
    let plot = swept(&desk, &["meter.current"], ("battery.emf", "0 V", "3 V"), 3);
    let points: Vec<(f64, f64)> = plot.curves[0].points.iter().copied().flatten().collect();
    let near = |(u, i): &(f64, f64)| (i - 5.0 * u).abs() < 1e-9;
    assert!(points.len() == 4 && points.iter().all(near), "mA over V: {points:?}");
}

#[test]
fn a_sweep_can_be_looked_at_and_left_before_its_end() {
    let desk = Desk::of(&gallery("voltage-divider"));
    let asked = request(&["meter.current"], ("r2.resistance", "10 ohm", "410 ohm"), 40);
    let mut sweeping = desk.session.begin_sweep(desk.id, &asked).expect("it is possible");
    assert_eq!(sweeping.progress(), (0, 41));
    assert!(sweeping.plot().is_empty());
    for done in 1..=41 {
        assert_eq!(desk.session.go_on(desk.id, &mut sweeping), Ok(true));
        assert_eq!(sweeping.progress(), (done, 41));
        let points = sweeping.plot().curves.swap_remove(0).points;
        let over: Vec<f64> = points.into_iter().flatten().map(|(r, _)| r).collect();
        assert_eq!(over.len() as u32, done);
        assert!(over.is_sorted(), "{over:?}");
    }
    assert_eq!(desk.session.go_on(desk.id, &mut sweeping), Ok(false));
    assert_eq!(sweeping.finished(), desk.session.plot(desk.id, &asked));
}

#[test]
fn a_locus_keeps_its_distance_and_ends_where_the_linkage_ends() {
    let desk = Desk::of(&gallery("four-bar"));
    let plot = swept(&desk, &["coupler.p2", "crank.p2"], ("coupler.p2.x", "60", "400"), 100);
    assert!(plot.curves.is_empty() && plot.loci.len() == 2);
    let tip: Vec<(f64, f64)> = plot.loci[0].points.iter().copied().flatten().collect();
    assert!(tip.len() > 5 && tip.len() < 101, "{} of 101", tip.len());
    for (x, y) in tip {
        assert!((((x - 160.0) * (x - 160.0) + y * y).sqrt() - 120.0).abs() < 1e-6, "({x}, {y})");
    }
    assert!(!plot.notes.is_empty());
    assert_eq!(plot.drawn_loci().elements.len(), 2);
}

#[test]
fn an_angle_that_is_swept_is_told_in_round_degrees() {
    let desk = Desk::of(
        "use geometry\ncrank: Line { p1 = (0, 0)  p2 = (60, 80) }\n\
         anchor crank.p1\nconstraint crank.length = 100\n",
    );
    let plot = swept(&desk, &["crank.p2.x"], ("crank.direction", "-180 deg", "180 deg"), 200);
    let csv = plot.csv();
    let angles: Vec<&str> = csv.lines().filter_map(|line| line.split(',').next()).skip(1).collect();
    assert_eq!(angles[..4], ["-180", "-178.2", "-176.4", "-174.6"]);
}

#[test]
fn every_event_of_a_drag_is_a_sample() {
    let mut desk = Desk::of(&gallery("quadrilateral"));
    let over = Some(String::from("q.outer.side3.p1.x"));
    let show = ["q.inner.side3.p1.x", "q.inner.side3.p1"].map(String::from).to_vec();
    let watched = Request { show, over, sweep: None };
    desk.session.watch(desk.id, Some(&watched)).expect("both can be read");
    assert!(desk.session.plot(desk.id, &watched).expect("nothing is wrong").is_empty());
    desk.drag("q.outer.side3.p1", &[(450.0, 150.0), (455.0, 160.0), (465.0, 164.0)]);
    let plot = desk.session.plot(desk.id, &watched).expect("nothing is wrong");
    let points: Vec<(f64, f64)> = plot.curves[0].points.iter().copied().flatten().collect();
    assert_eq!(points, [(445.0, 384.0), (450.0, 386.5), (455.0, 389.0), (465.0, 394.0)]);
    assert_eq!(plot.loci[0].points.last(), Some(&Some((394.0, 238.0))));
    assert_eq!(
        plot.csv().lines().next(),
        Some("q.outer.side3.p1.x,q.inner.side3.p1.x,q.inner.side3.p1.x,q.inner.side3.p1.y")
    );
    assert_eq!(plot.csv().lines().nth(4), Some("465,394,394,238"));
    // the next press begins anew, in the document as it is then
    desk.session.press(desk.id, &at("q.outer.side3.p1")).expect("it is free");
    let plot = desk.session.plot(desk.id, &watched).expect("nothing is wrong");
    assert_eq!(plot.curves[0].points, [Some((465.0, 394.0))]);
    desk.session.cancel(desk.id);
    desk.session.watch(desk.id, None).expect("nothing is asked");
    assert!(desk.session.plot(desk.id, &watched).expect("nothing is wrong").is_empty());
}

#[test]
fn what_cannot_be_plotted_is_told() {
    let desk = Desk::of(
        "class Point { x, y: Length }\na: Real = 1\nb: Real\nconstraint b = 2 * a\nname: Text = \"n\"\np: Point\n",
    );
    let told = |show: &[&str], range: (&str, &str, &str), steps: u32| {
        let plot = desk.session.plot(desk.id, &request(show, range, steps));
        plot.expect_err("it is no plot").message
    };
    let range = ("a", "0", "1");
    assert!(told(&["c"], range, 4).starts_with("c: "), "{}", told(&["c"], range, 4));
    let broken = "b +: found the end of the text, wanted an expression";
    assert!(told(&["a", "b +"], range, 4).starts_with(broken), "{}", told(&["a", "b +"], range, 4));
    assert!(desk.session.understand(desk.id, "b +").is_err());
    assert!(desk.session.understand(desk.id, "b + 1").is_ok());
    assert_eq!(told(&["name"], range, 4), "name is a text, and a plot shows numbers and places");
    assert_eq!(told(&[], range, 4), "nothing is named that could be shown");
    assert_eq!(told(&["b"], ("a", "1", "1"), 4), "the range from 1 to 1 is empty");
    assert_eq!(told(&["b"], range, 0), "0 steps, where 1 to 10000 can be");
    assert!(told(&["b"], ("a", "zero", "1"), 4).contains("zero"));
    assert!(
        told(&["b"], ("p", "0", "1"), 4).contains("number"),
        "{}",
        told(&["b"], ("p", "0", "1"), 4)
    );
    let half = desk
        .session
        .plot(desk.id, &request(&["1 / a"], ("a", "-1", "1"), 4))
        .expect("it has a gap");
    let points = &half.curves[0].points;
    assert_eq!(
        points[..],
        [Some((-1.0, -1.0)), Some((-0.5, -2.0)), None, Some((0.5, 2.0)), Some((1.0, 1.0))]
    );
    assert!(half.svg((640.0, 360.0)).matches("<polyline").count() == 2);
}

#[test]
fn a_curve_over_a_whole_turn_does_not_run_back_where_the_angle_begins_again() {
    let desk = Desk::of(&gallery("four-bar"));
    let plot = swept(&desk, &["rocker.direction"], ("turn", "-180 deg", "180 deg"), 24);
    let over: Vec<f64> = plot.curves[0].points.iter().flatten().map(|(x, _)| *x).collect();
    assert_eq!(over.len(), 25);
    assert!(over.windows(2).all(|pair| pair[0] < pair[1]), "{over:?}");
}

#[test]
fn a_sweep_of_an_angle_goes_on_past_half_a_turn_either_way() {
    let desk = Desk::of(
        "use geometry\ncrank: Line { p1 = (0, 0)  p2 = (30, 0) }\nanchor crank.p1\n\
         constraint crank.length = 30\n",
    );
    let plot = swept(&desk, &["crank.p2.y"], ("crank.direction", "-360 deg", "360 deg"), 8);
    let heights = plot.curves[0].points.iter().flatten().map(|(_, y)| (y * 1e6).round() / 1e6);
    let heights: Vec<f64> = heights.collect();
    assert_eq!(heights, [0.0, 30.0, 0.0, -30.0, 0.0, 30.0, 0.0, -30.0, 0.0], "{:?}", plot.notes);
}
