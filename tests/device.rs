//! The whole device: phases exact, decisions right, and safe whatever the switches do.

use helixlock_rtl::settings::bcd;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// What a pass is set to; the machine of these tests moves one fringe every `fringe` clocks and
/// one line every `line` clocks.
#[derive(Clone, Copy, Debug)]
struct Pass {
    a: u32,
    b: u32,
    x2: bool,
    m: u32,
    step_period: u32,
    line: u64,
    fringe: u64,
}

/// 6 lines last as long as 8 fringes: A = 6, B = 8.
const PASS: Pass = Pass { a: 6, b: 8, x2: true, m: 8, step_period: 40, line: 16, fringe: 12 };

/// A device after its master reset, wheels set, all switches off.
fn dialled(pass: Pass) -> Bench {
    let mut bench = Bench::new("device");
    bench.set(&[("divide_a", bcd(pass.a)), ("divide_b", bcd(pass.b))]);
    bench.set(&[("range_x2", pass.x2.into()), ("initial_phase", bcd(pass.m))]);
    bench.set(&[("step_period", pass.step_period.into()), ("master_reset", 1)]);
    bench.clocks(4);
    bench.set(&[("master_reset", 0)]);
    bench
}

/// Whether a square wave rises in this clock, its pin to be set.
fn pins(bench: &mut Bench, pass: Pass, clock: u64, lag: u64) {
    let high = |time: u64, period: u64| u64::from(time % period < period / 2);
    bench.set(&[
        ("grating", high(clock, pass.line)),
        ("laser", high(clock + 1000 * pass.fringe - lag, pass.fringe)),
    ]);
}

/// Clocks per comparison period.
fn period(pass: Pass) -> u64 {
    u64::from(pass.a) * pass.line * (1 + u64::from(pass.x2))
}

/// Starts a pass and gives the clocks T1 was high in each of the first periods.
fn widths(pass: Pass, periods: usize) -> Vec<u64> {
    let mut bench = dialled(pass);
    bench.set(&[("start", 1)]);
    let mut widths = Vec::new();
    let mut high = 0;
    let mut running = false;
    for clock in 0.. {
        pins(&mut bench, pass, clock, 0);
        bench.clock();
        high += bench.get("t1");
        if bench.high("grating_divided") {
            if running {
                widths.push(high);
            }
            running = true;
            high = 0;
        }
        if widths.len() == periods {
            break;
        }
    }
    widths
}

/// T1 starts at 360° − m/B·360° (twice B at ×2), and is wider by at most a line, the one that
/// was half over when the gate opened; two clocks are the gate's own.
#[test]
fn initial_phase_is_m_laser_pulses() {
    for x2 in [false, true] {
        for m in 2..8 {
            let pass = Pass { x2, m, ..PASS };
            let nominal = period(pass) - u64::from(m) * pass.fringe;
            for width in widths(pass, 4) {
                let allowed = nominal - 2..=nominal + pass.line;
                assert!(allowed.contains(&width), "m = {m}, x2 {x2}: {width} of {nominal} clocks");
            }
        }
    }
}

/// With nothing moving but the trains, the width is the same in every period.
#[test]
fn phase_stands_still() {
    let widths = widths(PASS, 12);
    assert!(widths.windows(2).all(|pair| pair[0] == pair[1]), "{widths:?}");
}

/// A late laser is a wider pulse, and forward; an early one a narrower pulse, and reverse.
#[test]
fn late_laser_goes_forward() {
    for (m, forward) in [(4, true), (12, false)] {
        let mut bench = dialled(Pass { m, ..PASS });
        bench.set(&[("start", 1)]);
        for clock in 0..4 * period(PASS) {
            pins(&mut bench, PASS, clock, 0);
            bench.clock();
        }
        assert!(bench.high("discriminator.decided"));
        assert_eq!(bench.high("q"), forward, "m = {m}");
    }
}

/// Closed over a table that a step moves by a fraction of a fringe, the loop hunts with a period
/// of two comparisons.
#[test]
fn hunts_at_half_the_comparison_frequency() {
    // 19 steps a comparison move the laser's edge by 5.8 clocks: more than coincidence hides.
    let mut bench = dialled(Pass { step_period: 10, ..PASS });
    bench.set(&[("start", 1), ("correct", 1)]);
    let mut table = 0; // in 1/120 of a fringe: 10 a clock, and 3 a step
    let mut directions = Vec::new();
    for clock in 0..60 * period(PASS) {
        table += 10;
        let fringe = u64::from(table % 120 < 60);
        bench.set(&[("grating", u64::from(clock % PASS.line < 8)), ("laser", fringe)]);
        bench.clock();
        if bench.high("step") {
            table = if bench.high("forward") { table + 3 } else { table - 3 };
        }
        if bench.high("grating_divided") {
            directions.push(bench.high("q"));
        }
    }
    let settled = &directions[20..];
    assert!(settled.windows(2).all(|pair| pair[0] != pair[1]), "{settled:?}");
}

/// A = 1 at ×1 has no middle line: it measures, and never decides or steps.
#[test]
fn no_middle_no_decision() {
    let pass = Pass { a: 1, b: 1, x2: false, m: 0, line: 24, fringe: 24, step_period: 5 };
    let mut bench = dialled(pass);
    bench.set(&[("start", 1), ("correct", 1)]);
    let mut rises = 0;
    for clock in 0..2000 {
        pins(&mut bench, pass, clock, 7);
        bench.clock();
        rises += u32::from(bench.high("grating_divided"));
        assert!(!bench.high("step") && bench.high("cp1") && bench.high("cp2"));
    }
    assert!(rises > 70, "it measures");
}

/// The document's +8 −6, through the whole device, by the manual switch; then the playback.
#[test]
fn manual_steps_are_played_back() {
    let mut bench = dialled(PASS);
    let press = |bench: &mut Bench, forward: u64| {
        bench.set(&[("manual_forward", forward)]);
        bench.set(&[("manual_step", 1)]);
        bench.clocks(10);
        bench.set(&[("manual_step", 0)]);
        bench.clocks(90);
    };
    (0..8).for_each(|_| press(&mut bench, 1));
    (0..6).for_each(|_| press(&mut bench, 0));
    assert_eq!((bench.get("count"), bench.get("count_forward")), (2, 1));
    bench.set(&[("playback", 1)]);
    let mut steps = 0;
    for _ in 0..1000 {
        bench.clock();
        steps += bench.get("step");
    }
    assert_eq!((steps, bench.get("zero")), (2, 1));
}

/// One thing an operator may do, and for how many clocks the machine then runs.
#[derive(Clone, Copy, Debug)]
struct Act {
    switch: &'static str,
    level: u64,
    clocks: u64,
}

fn act() -> impl Strategy<Value = Act> {
    let switch = prop_oneof![
        4 => Just("start"),
        4 => Just("correct"),
        3 => Just("playback"),
        3 => Just("manual_step"),
        2 => Just("manual_forward"),
        2 => Just("calibrate"),
        1 => Just("master_reset"),
    ];
    (switch, 0..4_u64, 1..400_u64).prop_map(|(switch, dice, clocks)| match switch {
        "calibrate" => Act { switch, level: dice, clocks },
        "master_reset" => Act { switch, level: u64::from(dice == 0), clocks: clocks % 6 + 1 },
        _ => Act { switch, level: u64::from(dice > 0), clocks },
    })
}

/// What must hold in every clock, from what was seen before.
#[derive(Default)]
struct Watch {
    position: i64,
    ring: i64,
    since_step: u64,
    q: Option<bool>,
}

impl Watch {
    /// Looks at the outputs before a rising edge.
    fn before(&mut self, bench: &mut Bench, step_period: u64) {
        assert_ne!(bench.get("t1"), bench.get("t2"));
        assert_ne!(bench.get("q"), bench.get("q_bar"));
        assert_ne!(bench.get("forward"), bench.get("reverse"));
        assert!(bench.high("cp1") || bench.high("cp2"), "wider and narrower at once");
        let side = if bench.high("count_forward") { 1 } else { -1 };
        let count = i64::try_from(bench.get("count")).expect("12 bits");
        assert_eq!(side * count, self.position, "the count is the position");
        assert_eq!(bench.high("zero"), self.position == 0);
        let phases = bench.get("phase_a") << 2 | bench.get("phase_b") << 1 | bench.get("phase_c");
        let sequence = [0b100, 0b110, 0b010, 0b011, 0b001, 0b101];
        assert_eq!(phases, sequence[usize::try_from(self.ring.rem_euclid(6)).expect("small")]);
        if !bench.high("measuring") {
            assert!(!bench.high("phase_meter.meter") && !bench.high("discriminator.decided"));
        }
        if let Some(q) = self.q {
            assert_eq!(bench.high("q"), q, "Q changes at a decision only");
        }
        self.q = match (bench.high("master_reset"), bench.high("cp1"), bench.high("cp2")) {
            (true, ..) | (_, true, false) => Some(false),
            (_, false, true) => Some(true),
            _ => Some(bench.high("q")),
        };
        self.since_step += 1;
        if bench.high("step") {
            self.step(bench, step_period);
        }
        if bench.high("master_reset") {
            *self = Self { since_step: step_period, q: Some(false), ..Self::default() };
        }
    }

    /// Looks at a step.
    fn step(&mut self, bench: &mut Bench, step_period: u64) {
        assert!(self.since_step >= step_period, "{} clocks after the last", self.since_step);
        self.since_step = 0;
        let way = if bench.high("forward") { 1 } else { -1 };
        if bench.high("playback_input.level") {
            assert_eq!(way, -self.position.signum(), "playback goes to zero and stays");
        }
        self.position += way;
        self.ring += way;
        assert!(self.position.abs() <= 4095);
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, ..kept_beside_source() })]

    /// Switches thrown in any order, while grating and laser run or drift.
    #[test]
    fn any_history_is_safe(
        acts in vec(act(), 1..25),
        step_period in 2..60_u32,
        fringe in 9..16_u64,
        x2: bool,
        m in 0..12_u32,
        near_limit: bool,
    ) {
        let pass = Pass { x2, m, step_period, fringe, ..PASS };
        let mut bench = dialled(pass);
        let mut watch = Watch { since_step: u64::from(step_period), ..Watch::default() };
        if near_limit {
            bench.force(&[("reset_counter.magnitude_q", 4090), ("reset_counter.side_q", 1)]);
            watch.position = 4090;
        }
        let mut clock = 0;
        for act in acts {
            bench.set(&[(act.switch, act.level)]);
            for _ in 0..act.clocks {
                pins(&mut bench, pass, clock, 0);
                watch.before(&mut bench, step_period.into());
                bench.clock();
                clock += 1;
            }
        }
    }
}

/// Two devices that woke up differently are alike after a reset of four clocks.
#[test]
fn power_up_state_is_forgotten() {
    let mut one = Bench::new("device");
    let mut other = Bench::new("device");
    other.force_all(0xb5);
    for bench in [&mut one, &mut other] {
        bench.set(&[("divide_a", 0x006), ("divide_b", 0x008), ("step_period", 40)]);
        bench.set(&[("master_reset", 1)]);
        bench.clocks(4);
    }
    assert!(one.same_flip_flops(&other));
}
