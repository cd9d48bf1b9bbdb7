//! Figures through plotters, on a grid of tenths of a pixel.

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::ranged1d::{DefaultFormatting, KeyPointHint, Ranged};
use plotters::drawing::{DrawingArea, DrawingAreaErrorKind, IntoDrawingArea};
use plotters::element::{Circle, PathElement, Rectangle, Text};
use plotters::prelude::{Cartesian2d, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, IntoFont, RGBColor, ShapeStyle, TextStyle};

use super::axis::Settled;
use super::series::{draw_labels, draw_series};
use super::{Band, Figure, Panel, Series, Style};
use crate::Colour;
use crate::markup::printable;

/// Units of the drawing to a pixel: the library rounds to whole units.
const UNITS: u32 = 10;
/// Pixels around the axes: above for the title, left and below for numbers and names.
const TITLE_PX: u32 = 30;
const LEFT_PX: u32 = 70;
const MARGIN_PX: u32 = 12;
const BELOW_PX: u32 = 44;
const RIGHT_PX: u32 = 18;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<Settled, Settled>>;
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

pub(super) const INK: RGBColor = RGBColor(33, 37, 41);
const FAINT_INK: RGBColor = RGBColor(90, 98, 108);
const GRID: RGBColor = RGBColor(228, 231, 235);

/// The library takes its round numbers from the axis, and counts in positions.
impl Ranged for Settled {
    type FormatOption = DefaultFormatting;
    type ValueType = f64;

    #[expect(clippy::cast_possible_truncation, reason = "shares of a picture's width are small")]
    fn map(&self, position: &f64, limit: (i32, i32)) -> i32 {
        let share = (position - self.low) / (self.high - self.low);
        let length = f64::from(limit.1) - f64::from(limit.0);
        (f64::from(limit.0) + (share * length).clamp(-1e6, 1e6)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() { Vec::new() } else { self.ticks.clone() }
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

/// The figure as SVG text.
pub(super) fn svg(figure: &Figure) -> String {
    let height_px: u32 = figure.panels.iter().map(|panel| panel.height_px.max(120)).sum();
    let (width_px, height_px) = (figure.width_px.max(240), height_px.max(1));
    let mut text = String::new();
    {
        let size = (width_px * UNITS, height_px * UNITS);
        let mut rest = SVGBackend::with_string(&mut text, size).into_drawing_area();
        for panel in &figure.panels {
            let (area, below) = rest.split_vertically(panel.height_px.max(120) * UNITS);
            draw_panel(&area, panel).expect("text in memory takes whatever is drawn");
            rest = below;
        }
    }
    in_pixels(&text, width_px, height_px)
}

/// Says the size in pixels and leaves the grid of tenths inside.
fn in_pixels(svg: &str, width_px: u32, height_px: u32) -> String {
    let fine = format!("width=\"{}\" height=\"{}\"", width_px * UNITS, height_px * UNITS);
    svg.replacen(&fine, &format!("width=\"{width_px}\" height=\"{height_px}\""), 1)
}

fn draw_panel(area: &Area, panel: &Panel) -> Drawn {
    draw_title(area, panel)?;
    let (width, height) = area.dim_in_pixel();
    let inner_px = [
        (width / UNITS).saturating_sub(LEFT_PX + RIGHT_PX).max(1),
        (height / UNITS).saturating_sub(TITLE_PX + BELOW_PX).max(1),
    ];
    let values = |axis: usize| {
        let points = panel.series.iter().flat_map(|series| &series.points);
        let labels = panel.labels.iter().map(|label| &label.at);
        points.chain(labels).map(move |point| point[axis]).chain(feet(panel, axis))
    };
    let x = Settled::new(&panel.x, values(0), (inner_px[0] / 75).max(2) as usize, 0.0);
    let room = if panel.labels.is_empty() { 0.04 } else { 0.1 };
    let y = Settled::new(&panel.y, values(1), (inner_px[1] / 32).max(2) as usize, room);
    let mut chart = ChartBuilder::on(area)
        .margin_top(TITLE_PX * UNITS)
        .margin_right(RIGHT_PX * UNITS)
        .margin_left(MARGIN_PX * UNITS)
        .x_label_area_size(BELOW_PX * UNITS)
        .y_label_area_size((LEFT_PX - MARGIN_PX) * UNITS)
        .build_cartesian_2d(x.clone(), y.clone())?;
    draw_axes(&mut chart, panel, [&x, &y])?;
    for band in &panel.bands {
        draw_band(&mut chart, *band, [&x, &y])?;
    }
    let scale =
        [f64::from(inner_px[0]) / (x.high - x.low), f64::from(inner_px[1]) / (y.high - y.low)];
    for series in &panel.series {
        draw_series(&mut chart, series, [&x, &y], scale)?;
    }
    draw_labels(&mut chart, panel, [&x, &y])
}

/// Stems and bands of an axis have to lie inside it.
fn feet(panel: &Panel, axis: usize) -> impl Iterator<Item = f64> {
    let stems = panel.series.iter().filter(move |series| axis == 1 && series.style == Style::Stems);
    let bands = panel.bands.iter().filter_map(move |band| match band {
        Band::X { range, .. } if axis == 0 => Some(*range),
        Band::Y { range, .. } if axis == 1 => Some(*range),
        _ => None,
    });
    stems.map(|_| 0.0).chain(bands.flatten())
}

fn draw_title(area: &Area, panel: &Panel) -> Drawn {
    let left = units(LEFT_PX);
    let middle = units(TITLE_PX) / 2;
    let bold = text(13).style(plotters::style::FontStyle::Bold);
    let title = anchored(&bold.color(&INK), HPos::Left, VPos::Center);
    area.draw(&Text::new(printable(&panel.title), (left, middle), title))?;
    let mut right = area.dim_in_pixel().0.cast_signed() - units(RIGHT_PX);
    for series in panel.series.iter().rev().filter(|series| !series.name.is_empty()) {
        let name = printable(&series.name);
        // The library cannot measure text; 6.5 pixels a letter leave room in common fonts.
        right -= i32::try_from(name.chars().count() * 65).unwrap_or(0);
        let style = anchored(&text(12).color(&INK), HPos::Left, VPos::Center);
        area.draw(&Text::new(name, (right, middle), style))?;
        draw_key(area, series, (right - units(6), middle))?;
        right -= units(42);
    }
    Ok(())
}

/// A sample of a series for the legend, to the left of `at`.
fn draw_key(area: &Area, series: &Series, (x, y): (i32, i32)) -> Drawn {
    let style = stroke(series.colour, 22);
    match series.style {
        Style::Dots => area.draw(&Circle::new((x - units(6), y), units(3), style.filled())),
        Style::Dashes => {
            let dash =
                |from: i32| PathElement::new([(x - from, y), (x - from + units(7), y)], style);
            area.draw(&dash(units(20)))?;
            area.draw(&dash(units(9)))
        }
        Style::Line | Style::Step | Style::Stems => {
            area.draw(&PathElement::new([(x - units(20), y), (x, y)], style))
        }
    }
}

fn draw_axes(chart: &mut Chart, panel: &Panel, [x, y]: [&Settled; 2]) -> Drawn {
    let numbers = text(11).color(&FAINT_INK);
    chart
        .configure_mesh()
        .bold_line_style(ShapeStyle { color: GRID.to_rgba(), filled: false, stroke_width: 8 })
        .light_line_style(GRID.mix(0.0))
        .axis_style(ShapeStyle { color: FAINT_INK.to_rgba(), filled: false, stroke_width: 10 })
        .label_style(numbers)
        .axis_desc_style(text(12).color(&INK))
        .x_label_formatter(&|position| x.text(*position))
        .y_label_formatter(&|position| y.text(*position))
        .set_all_tick_mark_size(4 * UNITS)
        .x_desc(printable(&panel.x.label))
        .y_desc(printable(&panel.y.label))
        .draw()
}

fn draw_band(chart: &mut Chart, band: Band, [x, y]: [&Settled; 2]) -> Drawn {
    let ends = |axis: &Settled, range: [f64; 2]| {
        range.map(|value| axis.position(value).clamp(axis.low, axis.high))
    };
    let (horizontal, vertical, colour) = match band {
        Band::X { range, colour } => (ends(x, range), [y.low, y.high], colour),
        Band::Y { range, colour } => ([x.low, x.high], ends(y, range), colour),
    };
    let corners = [(horizontal[0], vertical[0]), (horizontal[1], vertical[1])];
    let finite = corners.iter().all(|(x, y)| x.is_finite() && y.is_finite());
    if finite {
        chart.draw_series([Rectangle::new(corners, rgb(colour).mix(0.16).filled())])?;
    }
    Ok(())
}

pub(super) fn text(size_px: u32) -> plotters::style::FontDesc<'static> {
    // The library divides sizes by 1.24 on their way to SVG.
    ("system-ui, sans-serif", f64::from(size_px * UNITS) * 1.24).into_font()
}

pub(super) fn anchored<'a>(
    style: &TextStyle<'a>,
    horizontal: HPos,
    vertical: VPos,
) -> TextStyle<'a> {
    style.pos(Pos::new(horizontal, vertical))
}

fn units(pixels: u32) -> i32 {
    (pixels * UNITS).cast_signed()
}

pub(super) fn rgb(colour: Colour) -> RGBColor {
    let (red, green, blue) = colour.rgb();
    RGBColor(red, green, blue)
}

pub(super) fn stroke(colour: Colour, width: u32) -> ShapeStyle {
    ShapeStyle { color: rgb(colour).to_rgba(), filled: false, stroke_width: width }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axis, Label};

    fn figure(points: Vec<[f64; 2]>, style: Style) -> Figure {
        let panel = Panel {
            title: "before & after".into(),
            height_px: 200,
            x: Axis::linear("position in mm"),
            y: Axis::linear("error in µm"),
            bands: vec![Band::Y { range: [-1.0, 1.0], colour: Colour::Green }],
            series: vec![Series::new("measured", Colour::Blue, style, points)],
            labels: vec![Label { at: [1.0, 0.5], text: "<peak>".into() }],
        };
        Figure { width_px: 900, panels: vec![panel] }
    }

    #[test]
    fn a_million_points_stay_a_small_picture() {
        let points = (0..1_000_000).map(|i| [f64::from(i), f64::from(i % 97)]).collect();
        let svg = figure(points, Style::Line).svg();
        assert!(svg.len() < 100_000, "{}", svg.len());
        assert!(svg.starts_with("<svg width=\"900\" height=\"200\" viewBox=\"0 0 9000 2000\""));
        assert!(svg.contains("before &amp; after") && svg.contains("&lt;peak&gt;"));
    }

    #[test]
    fn whatever_the_numbers_there_is_a_picture() {
        let odd = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-320, f64::MAX, f64::MIN];
        let points: Vec<_> = odd.iter().flat_map(|x| odd.iter().map(|y| [*x, *y])).collect();
        for style in [Style::Line, Style::Dashes, Style::Step, Style::Dots, Style::Stems] {
            for points in [Vec::new(), points.clone()] {
                let svg = figure(points, style).svg();
                assert!(svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{style:?}");
            }
        }
    }

    #[test]
    fn a_gap_interrupts_a_line() {
        let gap = vec![[0.0, 0.0], [1.0, 1.0], [2.0, f64::NAN], [3.0, 1.0], [4.0, 0.0]];
        let lines =
            |points| figure(points, Style::Line).svg().matches("stroke=\"#005B9E\"").count();
        let whole = vec![[0.0, 0.0], [1.0, 1.0], [3.0, 1.0], [4.0, 0.0]];
        assert_eq!(lines(gap), lines(whole) + 1);
    }
}
