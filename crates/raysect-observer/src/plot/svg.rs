use std::fmt::Write;
use std::path::Path;

use super::axis::Axis;
use crate::ObserverError;
use crate::file::write_atomically;

/// A drawing that is being written; lengths in pixels, y downward.
pub(super) struct Svg {
    width: f64,
    height: f64,
    body: String,
}

/// The part of a drawing that values are drawn in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Area {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

/// Where a text ends.
#[derive(Debug, Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

const SMALL: f64 = 13.0;
const LARGE: f64 = 16.0;
/// Length of a mark.
const MARK: f64 = 5.0;

impl Svg {
    pub(super) fn new(width: f64, height: f64) -> Self {
        let mut svg = Self { width, height, body: String::new() };
        svg.rectangle(Area { left: 0.0, top: 0.0, width, height }, "white", "none");
        svg
    }

    /// Adds a piece as it is.
    pub(super) fn raw(&mut self, piece: &str) {
        self.body.push_str(piece);
        self.body.push('\n');
    }

    pub(super) fn rectangle(&mut self, area: Area, fill: &str, stroke: &str) {
        let Area { left, top, width, height } = area;
        self.raw(&format!(
            r#"<rect x="{left:.2}" y="{top:.2}" width="{width:.2}" height="{height:.2}" fill="{fill}" stroke="{stroke}"/>"#
        ));
    }

    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), colour: &str, width: f64) {
        let ((x1, y1), (x2, y2)) = (from, to);
        self.raw(&format!(
            r#"<line x1="{x1:.2}" y1="{y1:.2}" x2="{x2:.2}" y2="{y2:.2}" stroke="{colour}" stroke-width="{width}"/>"#
        ));
    }

    pub(super) fn polyline(&mut self, points: &[(f64, f64)], colour: &str) {
        let points = joined(points);
        self.raw(&format!(
            r#"<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5" stroke-linejoin="round"/>"#
        ));
    }

    pub(super) fn polygon(&mut self, points: &[(f64, f64)], colour: &str) {
        let points = joined(points);
        self.raw(&format!(
            r#"<polygon points="{points}" fill="{colour}" fill-opacity="0.25" stroke="none"/>"#
        ));
    }

    pub(super) fn text(&mut self, at: (f64, f64), anchor: Anchor, size: f64, text: &str) {
        self.turned_text(at, anchor, size, 0.0, text);
    }

    /// A text turned clockwise by an angle [deg].
    fn turned_text(&mut self, (x, y): (f64, f64), anchor: Anchor, size: f64, angle: f64, text: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let turn = if angle == 0.0 {
            String::new()
        } else {
            format!(r#" transform="rotate({angle} {x:.2} {y:.2})""#)
        };
        let text = escaped(text);
        self.raw(&format!(
            r#"<text x="{x:.2}" y="{y:.2}" font-size="{size}" text-anchor="{anchor}"{turn}>{text}</text>"#
        ));
    }

    pub(super) fn title(&mut self, area: Area, title: &str) {
        self.text((area.left + 0.5 * area.width, area.top - 14.0), Anchor::Middle, LARGE, title);
    }

    /// Marks and title below an area.
    pub(super) fn x_axis(&mut self, area: Area, axis: &Axis, label: &str) {
        let bottom = area.top + area.height;
        for (value, mark) in axis.marks() {
            let x = area.left + axis.place(value) * area.width;
            self.line((x, bottom), (x, bottom + MARK), "black", 1.0);
            self.text((x, bottom + MARK + SMALL), Anchor::Middle, SMALL, &mark);
        }
        let middle = area.left + 0.5 * area.width;
        self.text((middle, bottom + 3.2 * SMALL), Anchor::Middle, SMALL, &axis.titled(label));
    }

    /// Marks and title at the left of an area; the axis runs upward.
    pub(super) fn y_axis(&mut self, area: Area, axis: &Axis, label: &str) {
        for (value, mark) in axis.marks() {
            self.row_mark(area, axis.place(value), &mark);
        }
        self.side_title(area, &axis.titled(label));
    }

    /// A title at the left of an area, read from below.
    pub(super) fn side_title(&mut self, area: Area, title: &str) {
        let at = (area.left - 4.6 * SMALL, area.top + 0.5 * area.height);
        self.turned_text(at, Anchor::Middle, SMALL, -90.0, title);
    }

    /// A mark at the left of an area, this far up, 0 … 1.
    pub(super) fn row_mark(&mut self, area: Area, place: f64, mark: &str) {
        let y = area.top + (1.0 - place) * area.height;
        self.line((area.left - MARK, y), (area.left, y), "black", 1.0);
        self.text((area.left - MARK - 3.0, y + 0.35 * SMALL), Anchor::End, SMALL, mark);
    }

    /// Marks and title at the right of an area.
    pub(super) fn right_axis(&mut self, area: Area, axis: &Axis, label: &str) {
        let right = area.left + area.width;
        for (value, mark) in axis.marks() {
            let y = area.top + (1.0 - axis.place(value)) * area.height;
            self.line((right, y), (right + MARK, y), "black", 1.0);
            self.text((right + MARK + 3.0, y + 0.35 * SMALL), Anchor::Start, SMALL, &mark);
        }
        let at = (right + 5.2 * SMALL, area.top + 0.5 * area.height);
        self.turned_text(at, Anchor::Middle, SMALL, -90.0, &axis.titled(label));
    }

    /// The whole file.
    pub(super) fn finish(self) -> String {
        let Self { width, height, body } = self;
        let font = r#"font-family="DejaVu Sans, Arial, sans-serif""#;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} \
             {height}\" {font}>\n{body}</svg>\n"
        )
    }
}

/// Writes a drawing, whole or not at all.
pub(super) fn save(path: &Path, svg: &str) -> Result<(), ObserverError> {
    Ok(write_atomically(path, |writer| writer.write_all(svg.as_bytes()))?)
}

fn joined(points: &[(f64, f64)]) -> String {
    let mut text = String::new();
    for (x, y) in points {
        // Writing to a text cannot fail.
        let _ = write!(text, "{x:.2},{y:.2} ");
    }
    text.trim_end().to_owned()
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Bytes in base 64 (RFC 4648, section 4).
pub(super) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let word = (0..3).fold(0u32, |word, i| word << 8 | u32::from(group.get(i).copied().unwrap_or(0)));
        for digit in 0..4 {
            let value = word >> (18 - 6 * digit) & 63;
            text.push(if digit <= group.len() { char::from(DIGITS[value as usize]) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_is_that_of_the_standard() {
        // Test vectors of RFC 4648, section 10.
        let pairs = [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ];
        for (plain, coded) in pairs {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
        assert_eq!(base64(&[0xfb, 0xff, 0xbf]), "+/+/");
    }

    #[test]
    fn texts_cannot_break_the_file() {
        assert_eq!(escaped("<a> & \"b\""), "&lt;a&gt; &amp; &quot;b&quot;");
        let mut svg = Svg::new(10.0, 10.0);
        svg.text((1.0, 1.0), Anchor::Start, 10.0, "</svg>");
        assert_eq!(svg.finish().matches("</svg>").count(), 1);
    }
}
