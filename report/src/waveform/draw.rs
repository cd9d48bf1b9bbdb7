//! Waveforms as SVG text.

use std::fmt::Write;

use super::shapes::{Segment, characters, push, push_box, push_path, push_run};
use super::{Arrow, Lane, Waveform};
use crate::Colour;
use crate::markup::escaped;
use crate::plot::axis::Settled;
use crate::plot::thin::thin_line;
use crate::{Axis, Scale};

const NAMES_PX: f64 = 150.0;
const RIGHT_PX: f64 = 14.0;
const MARKS_PX: f64 = 20.0;
const TIME_PX: f64 = 44.0;
const BIT_PX: f64 = 30.0;
const ANALOGUE_PX: f64 = 84.0;
/// Room above and below the trace of a lane.
const GAP_PX: f64 = 7.0;
/// Edges closer than this cannot be told apart.
const BUSY_PX: f64 = 1.2;
/// Room for the numbers of an analogue lane.
const SCALE_PX: f64 = 48.0;
/// Width of a letter of a bus.
const LETTER_PX: f64 = 7.0;
/// Fill of what is unknown, and of what changes too often to be seen.
const UNKNOWN: &str = "#f3d4d6";
const BUSY: &str = "#9db6cc";

/// Where things lie.
struct Layout<'a> {
    waveform: &'a Waveform,
    time: Settled,
    right_px: f64,
    /// Top of each lane, and the bottom of the last.
    tops_px: Vec<f64>,
}

/// The waveform as SVG text.
pub(super) fn svg(waveform: &Waveform) -> String {
    let layout = Layout::new(waveform);
    let (width, bottom) = (layout.right_px + RIGHT_PX, layout.bottom_px());
    let height = bottom + TIME_PX;
    let mut svg = format!(
        "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         xmlns=\"http://www.w3.org/2000/svg\" font-family=\"system-ui, sans-serif\" \
         font-size=\"12\" fill=\"#212529\">\n\
         <defs><marker id=\"tip\" viewBox=\"0 0 8 8\" refX=\"7\" refY=\"4\" markerWidth=\"7\" \
         markerHeight=\"7\" orient=\"auto\"><path d=\"M0,0.8 L8,4 L0,7.2 z\" fill=\"#c81e28\"/>\
         </marker></defs>\n"
    );
    layout.push_time(&mut svg);
    for (lane, top) in waveform.lanes.iter().zip(&layout.tops_px) {
        layout.push_lane(&mut svg, lane, *top);
    }
    layout.push_marks(&mut svg);
    for arrow in &waveform.arrows {
        layout.push_arrow(&mut svg, arrow);
    }
    svg.push_str("</svg>\n");
    svg
}

impl<'a> Layout<'a> {
    fn new(waveform: &'a Waveform) -> Self {
        let width_px = f64::from(waveform.width_px.max(320));
        let right_px = width_px - RIGHT_PX;
        let axis = Axis { label: String::new(), scale: Scale::Linear, range: Some(waveform.range) };
        let time = Settled::new(&axis, waveform.range.into_iter(), 8, 0.0);
        let mut top = if waveform.marks.is_empty() { 4.0 } else { MARKS_PX };
        let mut tops_px = vec![top];
        for lane in &waveform.lanes {
            top += if matches!(lane, Lane::Analogue { .. }) { ANALOGUE_PX } else { BIT_PX };
            tops_px.push(top);
        }
        Self { waveform, time, right_px, tops_px }
    }

    fn bottom_px(&self) -> f64 {
        self.tops_px.last().copied().unwrap_or(MARKS_PX)
    }

    fn x_px(&self, instant: f64) -> f64 {
        let share = (instant - self.time.low) / (self.time.high - self.time.low);
        NAMES_PX + share.clamp(0.0, 1.0) * (self.right_px - NAMES_PX)
    }

    /// Changes inside the range, the first of them what held when it began.
    fn visible<'v, V>(&self, changes: &'v [(f64, V)]) -> &'v [(f64, V)] {
        let begun = changes.partition_point(|(instant, _)| *instant <= self.time.low);
        let over = changes.partition_point(|(instant, _)| *instant <= self.time.high);
        &changes[begun.saturating_sub(1)..over.max(begun.saturating_sub(1))]
    }

    fn push_time(&self, svg: &mut String) {
        let bottom = self.bottom_px();
        for tick in &self.time.ticks {
            let x = self.x_px(*tick);
            let text = self.time.text(*tick);
            push(
                svg,
                &format!(
                    "<path d=\"M{x:.1},{:.1} V{bottom:.1}\" stroke=\"#e4e7eb\"/>\
                 <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\" \
                 fill=\"#5a626c\">{text}</text>",
                    self.tops_px[0],
                    bottom + 16.0
                ),
            );
        }
        let middle = f64::midpoint(NAMES_PX, self.right_px);
        push(
            svg,
            &format!(
                "<path d=\"M{NAMES_PX},{bottom:.1} H{:.1}\" stroke=\"#5a626c\"/>\
             <text x=\"{middle:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
                self.right_px,
                bottom + 36.0,
                escaped(&self.waveform.time_label)
            ),
        );
    }

    fn push_lane(&self, svg: &mut String, lane: &Lane, top: f64) {
        let (name, height) = match lane {
            Lane::Bit { name, .. } | Lane::Bus { name, .. } => (name, BIT_PX),
            Lane::Analogue { name, .. } => (name, ANALOGUE_PX),
        };
        let right = if height > BIT_PX { NAMES_PX - SCALE_PX } else { NAMES_PX - 10.0 };
        let middle = top + height / 2.0 + 4.0;
        let name = escaped(name);
        push(
            svg,
            &format!("<text x=\"{right}\" y=\"{middle:.1}\" text-anchor=\"end\">{name}</text>"),
        );
        let ends = [top + height - GAP_PX, top + GAP_PX];
        match lane {
            Lane::Bit { changes, .. } => self.push_bit(svg, changes, ends),
            Lane::Bus { changes, .. } => self.push_bus(svg, changes, ends),
            Lane::Analogue { .. } => self.push_curve(svg, lane, ends),
        }
    }

    fn push_bit(&self, svg: &mut String, changes: &[(f64, Option<bool>)], [low, high]: [f64; 2]) {
        let mut path = String::new();
        let mut drawing = false;
        for Segment { begin_px, end_px, value } in self.segments(changes) {
            let Some(Some(bit)) = value else {
                let fill = if value.is_some() { UNKNOWN } else { BUSY };
                push_box(svg, [begin_px, end_px], [low, high], fill);
                drawing = false;
                continue;
            };
            let level = if *bit { high } else { low };
            let _ = if drawing {
                write!(path, "V{level:.1} H{end_px:.1} ")
            } else {
                write!(path, "M{begin_px:.1},{level:.1} H{end_px:.1} ")
            };
            drawing = true;
        }
        push_path(svg, &path, Colour::Blue);
    }

    fn push_bus(&self, svg: &mut String, changes: &[(f64, String)], [low, high]: [f64; 2]) {
        const SLANT_PX: f64 = 3.0;
        let mut path = String::new();
        for Segment { begin_px, end_px, value } in self.segments(changes) {
            let Some(word) = value else {
                push_box(svg, [begin_px, end_px], [low, high], BUSY);
                continue;
            };
            let slant = SLANT_PX.min((end_px - begin_px) / 2.0);
            let (left, right) = (begin_px + slant, end_px - slant);
            let middle = f64::midpoint(low, high);
            let _ = write!(
                path,
                "M{begin_px:.1},{middle:.1} L{left:.1},{high:.1} H{right:.1} L{end_px:.1},{middle:.1} \
                 L{right:.1},{low:.1} H{left:.1} Z "
            );
            if LETTER_PX * characters(word) < end_px - begin_px {
                push(
                    svg,
                    &format!(
                        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"11\">{}</text>",
                        f64::midpoint(begin_px, end_px),
                        middle + 4.0,
                        escaped(word)
                    ),
                );
            }
        }
        push_path(svg, &path, Colour::Blue);
    }

    fn push_curve(&self, svg: &mut String, lane: &Lane, [low, high]: [f64; 2]) {
        let Lane::Analogue { points, colour, held, .. } = lane else { return };
        let pairs: Vec<_> = points.iter().map(|[instant, value]| (*instant, *value)).collect();
        let visible = self.visible(&pairs);
        let axis = Axis::linear("");
        let scale = Settled::new(&axis, visible.iter().map(|(_, value)| *value), 5, 0.04);
        let y_px = |value: f64| low - (value - scale.low) / (scale.high - scale.low) * (low - high);
        for tick in &scale.ticks {
            let (y, text) = (y_px(*tick), scale.text(*tick));
            push(
                svg,
                &format!(
                    "<path d=\"M{NAMES_PX},{y:.1} H{:.1}\" stroke=\"#e4e7eb\"/><text x=\"{:.1}\" y=\"{:.1}\" \
                 text-anchor=\"end\" font-size=\"11\" fill=\"#5a626c\">{text}</text>",
                    self.right_px,
                    NAMES_PX - 8.0,
                    y + 4.0
                ),
            );
        }
        let seen: Vec<_> =
            visible.iter().map(|(instant, value)| [self.x_px(*instant), y_px(*value)]).collect();
        let mut path = String::new();
        for run in seen.split(|[_, y]| !y.is_finite()).filter(|run| !run.is_empty()) {
            push_run(&mut path, &thin_line(run, 1.0), *held);
        }
        if let Some([_, y]) = seen.last().filter(|[_, y]| *held && y.is_finite()) {
            let _ = write!(path, "V{y:.1} H{:.1}", self.right_px);
        }
        push_path(svg, &path, *colour);
    }

    /// What is seen of a bit or a bus, from left to right.
    fn segments<'v, V>(&self, changes: &'v [(f64, V)]) -> Vec<Segment<'v, V>> {
        let visible = self.visible(changes);
        let ends = visible.iter().skip(1).map(|(instant, _)| self.x_px(*instant));
        let mut segments: Vec<Segment<V>> = Vec::new();
        let mut short_before = false;
        for ((instant, value), end_px) in visible.iter().zip(ends.chain([self.right_px])) {
            let begin_px = self.x_px(*instant);
            let short = end_px - begin_px < BUSY_PX;
            match segments.last_mut().filter(|_| short && short_before) {
                Some(busy) => (busy.end_px, busy.value) = (end_px, None),
                None => segments.push(Segment { begin_px, end_px, value: Some(value) }),
            }
            short_before = short;
        }
        segments
    }

    fn push_marks(&self, svg: &mut String) {
        let bottom = self.bottom_px();
        for (instant, word) in &self.waveform.marks {
            let x = self.x_px(*instant);
            push(
                svg,
                &format!(
                    "<path d=\"M{x:.1},{:.1} V{bottom:.1}\" stroke=\"{grey}\" stroke-dasharray=\"3 3\"/>\
                 <text x=\"{x:.1}\" y=\"13\" text-anchor=\"middle\" font-size=\"11\">{}</text>",
                    MARKS_PX - 3.0,
                    escaped(word),
                    grey = Colour::Grey.hex()
                ),
            );
        }
    }

    /// A curve from the middle of one lane to the middle of the other.
    fn push_arrow(&self, svg: &mut String, arrow: &Arrow) {
        let y_px = |lane: usize| {
            let ends = [self.tops_px.get(lane), self.tops_px.get(lane + 1)];
            if let [Some(top), Some(bottom)] = ends {
                Some(f64::midpoint(*top, *bottom))
            } else {
                None
            }
        };
        let (Some(from_y), Some(to_y)) = (y_px(arrow.from.0), y_px(arrow.to.0)) else { return };
        let (from_x, to_x) = (self.x_px(arrow.from.1), self.x_px(arrow.to.1));
        let middle = f64::midpoint(from_y, to_y);
        push(
            svg,
            &format!(
                "<path d=\"M{from_x:.1},{from_y:.1} C{from_x:.1},{middle:.1} {to_x:.1},{middle:.1} \
             {to_x:.1},{to_y:.1}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.1\" marker-end=\"url(#tip)\"/>",
                Colour::Red.hex()
            ),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waveform(lanes: Vec<Lane>) -> Waveform {
        Waveform {
            width_px: 600,
            time_label: "time in ms".into(),
            range: [0.0, 10.0],
            lanes,
            arrows: Vec::new(),
            marks: Vec::new(),
        }
    }

    fn bit(changes: impl IntoIterator<Item = (f64, bool)>) -> Lane {
        let changes = changes.into_iter().map(|(instant, bit)| (instant, Some(bit))).collect();
        Lane::Bit { name: "T1".into(), changes }
    }

    #[test]
    fn the_level_from_before_the_range_still_holds() {
        let svg =
            waveform(vec![bit([(-7.0, false), (-5.0, true), (5.0, false), (12.0, true)])]).svg();
        assert!(svg.contains("<path d=\"M150.0,11.0 H368.0 V27.0 H586.0\""), "{svg}");
    }

    #[test]
    fn a_million_edges_are_one_block() {
        let edges = (0..1_000_000).map(|index| (f64::from(index) * 1e-5, index % 2 == 0));
        let svg = waveform(vec![bit(edges)]).svg();
        assert!(svg.len() < 4_000, "{}", svg.len());
        assert!(svg.contains("<rect"), "{svg}");
    }

    #[test]
    fn arrows_to_lanes_that_are_not_there_are_left_out() {
        let mut waveform = waveform(vec![bit([(0.0, true)])]);
        waveform.arrows = vec![Arrow { from: (0, 1.0), to: (7, 2.0) }];
        assert!(!waveform.svg().contains("marker-end"));
    }
}
