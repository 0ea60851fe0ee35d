//! The few HTML elements that a report needs.

use std::fmt::Write;

use crate::numbers;

/// Text with the characters that HTML reserves replaced.
pub(crate) fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

/// A number with `digits` decimals and a real minus sign; what rounds to zero has no sign.
pub(crate) fn fixed(value: f64, digits: usize) -> String {
    numbers::fixed(value, digits).replace('-', "−")
}

/// A number with its sign.
pub(crate) fn signed(value: f64, digits: usize) -> String {
    let text = fixed(value, digits);
    if text.starts_with('−') || text.bytes().all(|b| b == b'0' || b == b'.') {
        text
    } else {
        format!("+{text}")
    }
}

/// A small number as a·10ᵇ.
pub(crate) fn power_of_ten(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{value:.1e}");
    match text.split_once('e') {
        Some(("1.0", exponent)) => format!("10<sup>{}</sup>", exponent.replace('-', "−")),
        Some((mantissa, exponent)) => {
            format!(
                "{}·10<sup>{}</sup>",
                mantissa.replace('-', "−"),
                exponent.replace('-', "−")
            )
        }
        None => escape(&text),
    }
}

/// Values with commas between them.
pub(crate) fn joined(values: impl IntoIterator<Item = String>) -> String {
    values.into_iter().collect::<Vec<_>>().join(", ")
}

/// A cell of a table; its text is HTML.
#[derive(Debug, Clone)]
pub(crate) enum Cell {
    /// Left-aligned.
    Text(String),
    /// Right-aligned, figures of equal width.
    Number(String),
    /// With a class of its own.
    Class(&'static str, String),
    /// Text across so many columns.
    Wide(usize, String),
}

/// A table with a caption. Each head is HTML with the number of columns it spans; rows of heads come first.
pub(crate) fn table(caption: &str, heads: &[&[(&str, usize)]], rows: &[Vec<Cell>]) -> String {
    let mut html = format!("<table>\n<caption>{caption}</caption>\n<thead>\n");
    for head in heads {
        html.push_str("<tr>");
        for (text, span) in *head {
            let span = if *span > 1 {
                format!(" class=\"group\" colspan=\"{span}\"")
            } else {
                String::new()
            };
            let _ = write!(html, "<th{span}>{text}</th>");
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</thead>\n<tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for cell in row {
            let _ = match cell {
                Cell::Text(text) => write!(html, "<td>{text}</td>"),
                Cell::Number(text) => write!(html, "<td class=\"n\">{text}</td>"),
                Cell::Wide(span, text) => write!(html, "<td colspan=\"{span}\">{text}</td>"),
                Cell::Class(class, text) => write!(html, "<td class=\"{class}\">{text}</td>"),
            };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody>\n</table>\n");
    html
}

/// A figure: an image file beside the page, and a caption (HTML). `text` describes it to who cannot see it.
pub(crate) fn figure(file: &str, text: &str, caption: &str) -> String {
    format!(
        "<figure>\n<img src=\"{}\" alt=\"{}\">\n<figcaption>{caption}</figcaption>\n</figure>\n",
        escape(file),
        escape(text)
    )
}

/// A page that needs nothing but itself and the files it names.
pub(crate) fn page(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n{body}</body>\n</html>\n",
        escape(title)
    )
}

const STYLE: &str = include_str!("page.css");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(fixed(-199.24, 1), "−199.2");
        assert_eq!(fixed(-0.0001, 3), "0.000");
        assert_eq!(signed(0.0004, 3), "0.000");
        assert_eq!(signed(0.0006, 3), "+0.001");
        assert_eq!(power_of_ten(-2.34e-13), "−2.3·10<sup>−13</sup>");
        assert_eq!(power_of_ten(1e-10), "10<sup>−10</sup>");
        assert_eq!(power_of_ten(0.0), "0");
    }

    #[test]
    fn what_html_reserves_is_escaped() {
        assert_eq!(escape("a < b & \"c\""), "a &lt; b &amp; &quot;c&quot;");
        assert!(figure("a.svg", "x < 1", "b").contains("alt=\"x &lt; 1\""));
        assert!(page("A & B", "").contains("<title>A &amp; B</title>"));
    }

    #[test]
    fn a_table_has_its_cells() {
        let rows = [vec![Cell::Text("a".into()), Cell::Number("1".into())]];
        let html = table("c", &[&[("h", 2)], &[("i", 1), ("j", 1)]], &rows);
        assert!(html.contains("<th class=\"group\" colspan=\"2\">h</th>"));
        assert!(html.contains("<td>a</td><td class=\"n\">1</td>"));
    }
}
