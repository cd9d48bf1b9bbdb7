//! Data inside the axes: lines, steps, dots, stems, and words at points.

use plotters::element::{Circle, EmptyElement, PathElement, Text};
use plotters::series::DashedLineSeries;
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

use super::axis::Settled;
use super::draw::{Chart, Drawn, INK, anchored, rgb, stroke, text};
use super::thin::{thin_dots, thin_line};
use super::{Panel, Series, Style};
use crate::markup::printable;

/// Draws one series; `pixels_per_unit` counts positions to the right and upwards.
pub(super) fn draw_series(
    chart: &mut Chart,
    series: &Series,
    axes: [&Settled; 2],
    pixels_per_unit: [f64; 2],
) -> Drawn {
    let finite = |point: &[f64; 2]| point.iter().all(|value| value.is_finite());
    let points: Vec<_> = series.points.iter().map(|point| shown(point, axes)).collect();
    let runs = points.split(|point| !finite(point)).filter(|run| !run.is_empty());
    match series.style {
        Style::Dots => {
            let dots: Vec<_> = points.iter().copied().filter(finite).collect();
            let style = rgb(series.colour).mix(0.75).filled();
            let dots = thin_dots(&dots, pixels_per_unit);
            let radius = if dots.len() < 400 { 25 } else { 15 };
            chart.draw_series(dots.iter().map(|[x, y]| Circle::new((*x, *y), radius, style)))?;
        }
        Style::Stems => {
            let foot = axes[1].position(0.0).max(axes[1].low); // NaN on a log axis: its low end
            let style = stroke(series.colour, 14);
            // Of the stems of one pixel column only the extremes can be seen.
            let stems: Vec<_> = runs.flat_map(|run| thin_line(run, pixels_per_unit[0])).collect();
            chart.draw_series(
                stems.iter().map(|[x, y]| PathElement::new([(*x, foot), (*x, *y)], style)),
            )?;
        }
        Style::Line | Style::Step | Style::Dashes => {
            for run in runs {
                draw_run(chart, series, &thin_line(run, pixels_per_unit[0]))?;
            }
        }
    }
    Ok(())
}

/// A point as positions; not finite beyond the sides, at the edge beyond top and bottom.
fn shown(point: &[f64; 2], [x, y]: [&Settled; 2]) -> [f64; 2] {
    let [across, up] = [x.position(point[0]), y.position(point[1])];
    let inside = (x.low..=x.high).contains(&across);
    [if inside { across } else { f64::NAN }, up.clamp(y.low, y.high)]
}

fn draw_run(chart: &mut Chart, series: &Series, points: &[[f64; 2]]) -> Drawn {
    let style = stroke(series.colour, 14);
    let pairs = points.iter().map(|[x, y]| (*x, *y));
    match series.style {
        Style::Dashes => {
            let dashes = DashedLineSeries::new(pairs, 60, 40, style);
            chart.draw_series(dashes)?;
        }
        Style::Step => {
            chart.draw_series([PathElement::new(stairs(points), style)])?;
        }
        _ => {
            chart.draw_series([PathElement::new(pairs.collect::<Vec<_>>(), style)])?;
        }
    }
    Ok(())
}

/// Each value held until the next point.
fn stairs(points: &[[f64; 2]]) -> Vec<(f64, f64)> {
    let mut stairs = Vec::with_capacity(2 * points.len());
    for pair in points.windows(2) {
        stairs.extend([(pair[0][0], pair[0][1]), (pair[1][0], pair[0][1])]);
    }
    stairs.extend(points.last().map(|[x, y]| (*x, *y)));
    stairs
}

/// Height of a line of a label, and half the width of a letter, in units of the drawing.
const LINE: i32 = 130;
const HALF_LETTER: i32 = 33;

/// Writes the labels, each centred above its point, or above the labels it would lie on.
pub(super) fn draw_labels(chart: &mut Chart, panel: &Panel, [x, y]: [&Settled; 2]) -> Drawn {
    let style = anchored(&text(11).color(&INK), HPos::Center, VPos::Bottom);
    let (std::ops::Range { start: left, end: right }, _) = chart.plotting_area().get_pixel_range();
    let mut taken: Vec<[i32; 3]> = Vec::new();
    for label in &panel.labels {
        let [across, up] = shown(&label.at, [x, y]);
        if !(across.is_finite() && up.is_finite()) {
            continue;
        }
        let words = printable(&label.text);
        let half = i32::try_from(words.chars().count()).unwrap_or(0) * HALF_LETTER;
        let (point, foot) = chart.backend_coord(&(across, up));
        // Words at a side move inwards, so that they do not cover the numbers of the axis.
        let middle = point.clamp(left + half, (right - half).max(left + half));
        // Where there is no room words would overprint others: tables have them all.
        let Some(lifted) = lifted_clear(&taken, [middle, foot, half]) else { continue };
        taken.push([middle, lifted, half]);
        let text = Text::new(words, (middle - point, lifted - foot), style.clone());
        chart.draw_series([EmptyElement::at((across, up)) + text])?;
    }
    Ok(())
}

/// Foot of a label, raised line by line until it lies on no other; none within eight lines.
fn lifted_clear(taken: &[[i32; 3]], [middle, foot, half]: [i32; 3]) -> Option<i32> {
    let covers = |foot: i32| {
        let overlaps = |[other, other_foot, other_half]: &[i32; 3]| {
            (other - middle).abs() < half + other_half && (other_foot - foot).abs() < LINE
        };
        taken.iter().any(overlaps)
    };
    (0..8).map(|line| foot - line * LINE).find(|foot| !covers(*foot))
}
